// Numbers as a person reads them: three significant digits, thin spaces between thousands.
import { type Kind, toShown, unitOf } from './units';

const thin = '\u202f';

const group = (digits: string): string => digits.replace(/\B(?=(\d{3})+(?!\d))/g, thin);

export function significant(value: number | null | undefined, digits = 3): string {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  if (value === 0) return '0';
  const magnitude = Math.floor(Math.log10(Math.abs(value)));
  if (magnitude >= 9 || magnitude < -5) {
    const [mantissa, exponent] = value.toExponential(digits - 1).split('e');
    return `${mantissa!.replace('-', '−')}×10${superscript(Number(exponent))}`;
  }
  const places = Math.max(0, digits - 1 - magnitude);
  const [whole = '', part] = Math.abs(value).toFixed(places).split('.');
  return `${value < 0 ? '−' : ''}${group(whole)}${part ? `.${part}` : ''}`;
}

// To the digits that matter beside `scale`: thousandths of it.
export function beside(scale: number, value: number): string {
  const places = Math.max(0, 2 - Math.floor(Math.log10(Math.max(scale, 1e-9))));
  return value
    .toFixed(Math.min(places, 9))
    .replace(/^-(?=0\.?0*$)/, '')
    .replace('-', '−');
}

// Without zeros at the end: bounds and ticks.
export const short = (value: number, digits = 6): string => {
  const text = significant(value, digits);
  if (text.includes('×')) return text.replace(/\.?0+×/, '×').replace(/^(−?)1×/, '$1');
  return text.includes('.') ? text.replace(/\.?0+$/, '') : text;
};

export const isSame = (a: number, b: number): boolean =>
  Math.abs(a - b) <= 1e-4 * Math.max(Math.abs(a), Math.abs(b));

// Enough digits to tell two numbers apart.
export function digitsApart(a: number, b: number): number {
  if (isSame(a, b) || !Number.isFinite(a - b)) return 3;
  const size = Math.max(Math.abs(a), Math.abs(b));
  return Math.min(7, Math.max(3, Math.ceil(Math.log10(size / Math.abs(a - b))) + 2));
}

export const shown = (kind: Kind, value: number | null | undefined, digits = 3): string =>
  value === null || value === undefined ? '–' : significant(toShown(kind, value), digits);

export const percent = (share: number | null | undefined, digits = 1): string =>
  share === null || share === undefined
    ? '–'
    : `${(100 * share).toFixed(digits).replace('-', '−')} %`;

// Of an uncertainty: one as large as the number itself tells nothing.
export const uncertainty = (share: number | null | undefined, digits = 1): string =>
  typeof share === 'number' && share >= 1 ? 'not told' : percent(share, digits);

export function signed(value: number, digits = 3): string {
  if (Math.abs(value) < 1e-12) return '±0';
  return `${value > 0 ? '+' : '−'}${significant(Math.abs(value), digits)}`;
}

// A relative change, "±0 %" below what a person would call one.
export const change = (share: number): string =>
  Math.abs(share) < 5e-5 ? '±0 %' : `${signed(100 * share, 2)} %`;

// A count that may pass 2⁵³, as digits.
export const count = (value: number | string | undefined): string => group(String(value ?? '–'));

export const scientific = (value: string): string =>
  value.length > 7 ? `${value[0]}.${value[1]} × 10${superscript(value.length - 1)}` : group(value);

const superscript = (n: number): string =>
  [...String(n)].map((d) => (d === '-' ? '⁻' : '⁰¹²³⁴⁵⁶⁷⁸⁹'[Number(d)])).join('');

export function duration(seconds: number): string {
  if (seconds < 60) return `${significant(seconds, 2)} s`;
  if (seconds < 3600) return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
  return `${Math.floor(seconds / 3600)} h ${Math.round((seconds % 3600) / 60)} min`;
}

// A time of the service (RFC 3339) in the reader's own clock; the day unless it is today's, or always.
export const moment = (at: string, withDay = false): string => {
  const time = new Date(at);
  const two = (n: number) => String(n).padStart(2, '0');
  const day = `${time.getFullYear()}-${two(time.getMonth() + 1)}-${two(time.getDate())} `;
  const isToday = !withDay && time.toDateString() === new Date().toDateString();
  return `${isToday ? '' : day}${two(time.getHours())}:${two(time.getMinutes())}`;
};

// Names of fields, as the contract writes them, in words: "mass_kg" → "mass", unit "kg".
const units: [RegExp, string][] = [
  [/_l_per_min_bar$/, 'L/(min·bar)'],
  [/_rad_per_s$/, 'rad/s'],
  [/_kpa_per_s$/, 'kPa/s'],
  [/_pa_per_s$/, 'Pa/s'],
  [/_pa2_s_per_kg$/, 'Pa²·s/kg'],
  [/_pa2_s2_per_kg2$/, 'Pa²·s²/kg²'],
  [/_per_s$/, '1/s'],
  [/_dm3_per_s_bar$/, 'dm³/(s·bar)'],
  [/_l_per_min_anr(_max)?$/, 'L/min ANR'],
  [/_l_per_min$/, 'L/min'],
  [/_kg_per_m$/, 'kg/m'],
  [/_eur_per_m$/, '€/m'],
  [/_kpa_gauge$/, 'kPa gauge'],
  [/_kpa_abs$/, 'kPa abs'],
  [/_kpa$/, 'kPa'],
  [/_kg$/, 'kg'],
  [/_ml$/, 'mL'],
  [/_mm$/, 'mm'],
  [/_ms$/, 'ms'],
  [/_eur$/, '€'],
  [/_ah$/, 'Ah'],
  [/_wh$/, 'Wh'],
  [/_hz$/, 'Hz'],
  [/_l$/, 'L'],
  [/_w$/, 'W'],
  [/_a$/, 'A'],
  [/_v$/, 'V'],
  [/_m$/, 'm'],
  [/_s$/, 's'],
  [/_k$/, 'K'],
];

export const fieldKind = (field: string): Kind =>
  field.endsWith('_kpa_gauge')
    ? 'pressure'
    : field.endsWith('_kpa_abs')
      ? 'absolute'
      : field.endsWith('_kpa')
        ? 'difference'
        : field.endsWith('_ml')
          ? 'volume_ml'
          : field.endsWith('_l')
            ? 'volume_l'
            : 'plain';

// The service speaks in the document's units: its limits in those shown.
export const inUnit = (kind: Kind, error: string): string =>
  kind === 'plain'
    ? error
    : error.replace(
        /(≥|≤|>|<|not) (-?\d[\d.]*(?:e[+-]?\d+)?)/g,
        (_, sign, number) => `${sign} ${short(toShown(kind, Number(number)))}`,
      );

// Pressures that the service names in a sentence ("85.27 kPa gauge", "120 to 300 kPa"), as shown. Those
// without a reference may be differences, whose unit alone changes.
export const pressuresInUnit = (sentence: string): string =>
  sentence.replace(
    /([-−]?\d+(?:\.\d+)?(?: to [-−]?\d+(?:\.\d+)?)?) kPa( gauge)?\b(?!\/| abs)/g,
    (whole, values: string, gauge?: string) => {
      const kind = gauge ? 'pressure' : 'difference';
      if (unitOf(kind) === (gauge ? 'kPa gauge' : 'kPa')) return whole;
      const shownOf = (text: string) => short(toShown(kind, Number(text.replace('−', '-'))), 4);
      return `${values.split(' to ').map(shownOf).join(' to ')} ${unitOf(kind)}`;
    },
  );

export function fieldName(field: string): { label: string; unit: string } {
  if (field === 'current_max_a') return { label: 'current max', unit: 'A' };
  for (const [suffix, unit] of units) {
    if (suffix.test(field))
      return {
        label: field.replace(suffix, '').replaceAll('_', ' '),
        unit: unitOf(fieldKind(field), unit),
      };
  }
  return { label: field.replaceAll('_', ' '), unit: '' };
}

// The same, short enough for the head of a column: C and b as in ISO 6358.
export function columnName(field: string): { label: string; unit: string } {
  const { label, unit } = fieldName(field);
  return {
    label: label
      .replace('sonic conductance', 'C')
      .replace('critical ratio', 'b')
      .replace('pressure', 'p')
      .replace(' diameter', ' ⌀'),
    unit: unit.replace(' gauge', ''),
  };
}
