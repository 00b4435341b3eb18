// Tables of parts for the service to read: the answers to what it asks, and the memory of them.
import type { Family } from './types';

export interface Question {
  option: 'encoding' | 'delimiter' | 'decimal' | 'header_row' | 'column';
  heading: string | null;
  question: string;
  answers: string[];
}

export interface ColumnRead {
  key: string;
  heading: string;
  targets: string[]; // "mass_kg [g]"
  decimal: 'point' | 'comma' | null;
  samples: string[];
}

export interface Understood {
  as_exported: boolean;
  encoding: string | null;
  delimiter: string | null;
  header_row: number | null;
  ids: string;
  columns: ColumnRead[];
  set: Record<string, string>;
  left_out: { row: number; why: string }[];
  left_out_count: number;
}

// What a person answered: of the whole table, of its columns, the same for all rows.
export interface Answers {
  encoding?: string;
  delimiter?: string;
  decimal?: string;
  header_row?: string;
  columns: Record<string, string>;
  set: Record<string, string>;
}

export const noAnswers = (): Answers => ({ columns: {}, set: {} });

export function importPath(family: string, answers: Answers, dryRun: boolean): string {
  const query = new URLSearchParams({ family, dry_run: String(dryRun) });
  for (const option of ['encoding', 'delimiter', 'decimal', 'header_row'] as const) {
    const answer = answers[option];
    if (answer) query.set(option, answer);
  }
  for (const [key, target] of Object.entries(answers.columns))
    query.append('column', `${key}=${target}`);
  for (const [column, value] of Object.entries(answers.set))
    if (value.trim()) query.append('set', `${column}=${value}`);
  return `/v1/parts/import?${query}`;
}

// A file's shape: its headings, or, while those are not known, its first line.
export function shapeOf(family: string, understood: Understood | null, start: string): string {
  const headings = understood?.columns.map((column) => column.heading).join('\t');
  return `${family}\n${headings || start.split(/[\r\n]/, 1)[0]!.slice(0, 200)}`;
}

const memory = 'plenum-imports';
const remembered = 50;

function all(): Record<string, Answers> {
  try {
    return JSON.parse(localStorage.getItem(memory) ?? '{}') as Record<string, Answers>;
  } catch {
    return {};
  }
}

export const recall = (shape: string): Answers | undefined => all()[shape];

export function remember(shapes: string[], answers: Answers): void {
  const kept = Object.entries(all()).filter(([shape]) => !shapes.includes(shape));
  const added = shapes.map((shape): [string, Answers] => [shape, answers]);
  const newest = [...kept, ...added].slice(-remembered);
  localStorage.setItem(memory, JSON.stringify(Object.fromEntries(newest)));
}

export function forget(shapes: string[]): void {
  const kept = Object.entries(all()).filter(([shape]) => !shapes.includes(shape));
  localStorage.setItem(memory, JSON.stringify(Object.fromEntries(kept)));
}

// "mass_kg [g]" apart; of several targets the first.
export function splitTarget(target: string): { column: string; unit: string } {
  const match = /^([^ [+]+)(?: \[(.*?)\])?/.exec(target);
  return { column: match?.[1] ?? '', unit: match?.[2] ?? '' };
}

export const plainColumns = ['id', 'manufacturer', 'part_number', 'notes', 'series', 'orderable'];

// What price lists print in place of a column of the catalogue, and the column that it goes into.
const printed: Record<string, string> = {
  body_size_mm: 'body_volume_ml',
  body_cylinder_mm: 'body_volume_ml',
  body_length_mm: 'body_volume_ml',
  body_width_mm: 'body_volume_ml',
  body_height_mm: 'body_volume_ml',
  body_depth_mm: 'body_volume_ml',
  body_diameter_mm: 'body_volume_ml',
  free_flow_l_per_min: 'curve',
  current_a: 'curve',
  c_rate: 'current_max_a',
  offer_price: 'offers',
  offer_currency: 'offers',
  offer_pack: 'offers',
  offer_supplier: 'offers',
  offer_date: 'offers',
  offer_link: 'offers',
};

export function printedColumnsOf(meta: Family): string[] {
  const has = (name: string) =>
    name === 'offers' ||
    (name === 'curve' ? meta.has_curve : meta.numbers.some((field) => field.name === name));
  return Object.keys(printed).filter((name) => has(printed[name]!));
}

// Whether the cells of a column are numbers with a unit.
export const takesUnit = (meta: Family, column: string): boolean =>
  meta.numbers.some((field) => field.name === column) ||
  column === 'offer_price' ||
  (column in printed && !column.startsWith('offer_') && column !== 'c_rate');

export function columnsOf(meta: Family): string[] {
  const listed = [...printedColumnsOf(meta), 'aliases', 'offers', 'documents'];
  const fields = [...meta.numbers, ...meta.texts].map((field) => field.name);
  return [...plainColumns, ...fields, ...(meta.has_curve ? ['curve'] : []), ...listed];
}

// What every part needs and no column of the table gives.
export function missingColumns(meta: Family, understood: Understood): string[] {
  const given = new Set(
    understood.columns.flatMap((column) =>
      column.targets
        .map((target) => splitTarget(target).column)
        .flatMap((name) => [name, printed[name] ?? name]),
    ),
  );
  const needed = [...meta.numbers, ...meta.texts].filter((field) => field.required);
  return ['manufacturer', 'part_number', ...needed.map((field) => field.name)].filter(
    (name) => !given.has(name),
  );
}
