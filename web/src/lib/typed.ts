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

// What to say of an ambiguous text.
export const mayBeEither = (text: string): string =>
  `may be ${text.replace(',', '.')} or ${text.replace(',', '')}: write one of them`;

// A share as a number, or in percent: "5 %" is 0.05, and 5 where the field counts in percent.
export function readShare(text: string, inPercent: boolean): Typed {
  const percent = /^(.*?)\s*%$/.exec(text.trim());
  if (!percent) return readTyped(text);
  const typed = readTyped(percent[1]!);
  return typeof typed === 'number' && !inPercent ? Number((typed / 100).toPrecision(12)) : typed;
}

// Amounts that stand side by side in one text, each with or without a unit: "6 psi, 8 psi",
// "0,5; 0,6", "600 ms 700 ms", "0.02 0.05". A blank parts two of them where a number begins after
// it, a comma where a blank or a unit is beside it, or where there are several.
export function splitAmounts(text: string): string[] {
  const pieces = text.split(/[;\s]*[;\t\n]\s*|,\s+|,$|(?<=[^\d\s.,]),|\s+(?=[-+−]?[.,]?\d)/);
  return pieces
    .flatMap((piece) => (/^[^,]+(,[^,]+){2,}$/.test(piece) ? piece.split(',') : [piece]))
    .map((piece) => piece.trim())
    .filter(Boolean);
}
