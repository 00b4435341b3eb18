// A number as people type it, without a unit. The same rules as the service's reader of texts
// (catalog/units/quantity.h): a comma is read as a decimal one, or one between thousands, where only
// one of them can be meant.
export type Typed = number | 'ambiguous' | 'unreadable';

const shape = /^([+-]?)(\d[\d.,]*|[.,]\d+)(e[+-]?\d+)?$/i;
// Blanks between thousands, as this page prints them.
const blanks = /(?<=\d)[ \u00a0\u2009\u202f](?=\d{3}(?!\d))/g;

const areThousands = (groups: string[]): boolean =>
  /^[1-9]\d{0,2}$/.test(groups[0]!) && groups.slice(1).every((group) => /^\d{3}$/.test(group));

// Digits with at most one point.
function plain(digits: string): string | 'ambiguous' | 'unreadable' {
  const last = Math.max(digits.lastIndexOf('.'), digits.lastIndexOf(','));
  if (last < 0) return digits;
  const mark = digits[last]!;
  const other = mark === '.' ? ',' : '.';
  const groups = digits.split(mark);
  if (!digits.includes(other)) {
    if (groups.length === 2) {
      if (mark === ',' && areThousands(groups)) return 'ambiguous';
      return digits.replace(',', '.');
    }
    return areThousands(groups) ? groups.join('') : 'unreadable';
  }
  if (groups.length > 2 || !groups[1] || !areThousands(groups[0]!.split(other)))
    return 'unreadable';
  return `${groups[0]!.replaceAll(other, '')}.${groups[1]}`;
}

export function readTyped(text: string): Typed {
  const found = shape.exec(text.trim().replace('−', '-').replace(blanks, ''));
  if (!found) return 'unreadable';
  const [, sign, digits, power] = found;
  const read = plain(digits!);
  if (read === 'ambiguous' || read === 'unreadable') return read;
  const value = Number(`${sign}${read}${power ?? ''}`);
  return Number.isFinite(value) ? value : 'unreadable';
}
