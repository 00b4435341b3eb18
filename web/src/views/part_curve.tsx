// The curve of a pump in the form of a part: lines of pressure, free air and current, in the units
// that the page shows or each with a unit of its own.
import { useId } from 'preact/hooks';

import type { FieldError } from '../lib/api';
import { inUnit } from '../lib/format';
import { mayBeEither, readTyped, splitAmounts } from '../lib/typed';
import type { CurvePoint, Part } from '../lib/types';
import { fromShown, toShown, unitOf } from '../lib/units';

type Column = 'pressure_kpa_gauge' | 'free_air_l_per_min' | 'current_a';
const columns: Column[] = ['pressure_kpa_gauge', 'free_air_l_per_min', 'current_a'];
const nameOf: Record<Column, string> = {
  pressure_kpa_gauge: 'pressure',
  free_air_l_per_min: 'free air',
  current_a: 'current',
};
const shownUnit = (column: Column): string =>
  ({
    pressure_kpa_gauge: unitOf('pressure'),
    free_air_l_per_min: 'L/min ANR',
    current_a: 'A',
  })[column];

export const allColumns = (): string =>
  columns.map((column) => `${nameOf[column]} in ${shownUnit(column)}`).join(', ');

const kindOf = (column: Column) => (column === 'pressure_kpa_gauge' ? 'pressure' : 'plain');

// "free flow 12 L/min, 0.8 A" in place of points.
export const isFreeFlow = (text: string): boolean => text.trim().startsWith('free flow');

export const curveText = (curve: CurvePoint[] | undefined): string =>
  (curve ?? [])
    .map((point) =>
      columns
        .map((column) => point[column])
        .map((value, i) =>
          value === undefined
            ? ''
            : String(Number(toShown(kindOf(columns[i]!), value).toPrecision(7))),
        )
        .filter(Boolean)
        .join(' '),
    )
    .join('\n');

const linesOf = (text: string): string[] =>
  text
    .split('\n')
    .map((line) => line.trim())
    .filter(Boolean);

// A number, or a text with a unit as the service reads it.
export type GivenPoint = Partial<Record<Column, number | string>>;

function readLine(line: string, number: number): GivenPoint | string {
  const split = splitAmounts(line);
  const cells = split.length > 1 ? split : line.split(',').map((cell) => cell.trim());
  if (cells.length !== columns.length) {
    const missing = columns.slice(cells.length).map((column) => `the ${nameOf[column]}`);
    const what =
      missing.length > 0 ? `lacks ${missing.join(' and ')}` : 'has more than three numbers';
    return `line ${number} ${what}: each needs ${allColumns()}`;
  }
  const point: GivenPoint = {};
  for (const [i, column] of columns.entries()) {
    const cell = cells[i]!;
    const typed = readTyped(cell);
    if (typed === 'ambiguous') return `line ${number}: “${cell}” ${mayBeEither(cell)}`;
    if (typed === 'unreadable' && !/^[-+−]?[.,]?\d/.test(cell))
      return `line ${number}: the ${nameOf[column]} “${cell}” is no number`;
    point[column] = typeof typed === 'number' ? fromShown(kindOf(column), typed) : cell;
  }
  return point;
}

// Points, or what is wrong with a line; those of the part itself where they were not changed.
export function readCurve(text: string, part?: Part): GivenPoint[] | FieldError {
  if (part?.curve && text === curveText(part.curve)) return part.curve;
  const points: GivenPoint[] = [];
  for (const [i, line] of linesOf(text).entries()) {
    const read = readLine(line, i + 1);
    if (typeof read === 'string') return { pointer: '/curve', detail: read };
    points.push(read);
  }
  return points;
}

// What the service says of a point, in the words of the form.
function inWords({ pointer, detail }: FieldError, text: string): string {
  const [, index, name] = /^\/curve\/(\d+)\/(\w+)$/.exec(pointer) ?? [];
  const column = columns.find((one) => one === name);
  if (index === undefined || !column) return detail;
  const isWithUnit = /[a-z]/i.test(linesOf(text)[Number(index)] ?? '');
  const said = isWithUnit ? detail : inUnit(kindOf(column), detail);
  return `line ${Number(index) + 1}: the ${nameOf[column]} ${said}`;
}

export function CurveField(props: {
  text: string;
  errors: FieldError[];
  onChange: (text: string) => void;
}) {
  const id = useId();
  const wrong = props.errors
    .filter((error) => error.pointer === '/curve' || error.pointer.startsWith('/curve/'))
    .map((error) => inWords(error, props.text));
  return (
    <div class="curve">
      <label for={id}>Curve: {allColumns()}; one point a line</label>
      <textarea
        id={id}
        rows={6}
        value={props.text}
        data-pointer="/curve"
        aria-invalid={wrong.length > 0 ? true : undefined}
        aria-describedby={`${id}-hint`}
        placeholder="or what the sheet prints: free flow 12 L/min, 0.8 A"
        onInput={(event) => props.onChange(event.currentTarget.value)}
      />
      <span class={wrong.length > 0 ? 'error' : 'hint'} id={`${id}-hint`}>
        {wrong.join('; ') || 'or each number with its unit: 0.6 bar, 3 L/min, 0.55 A'}
      </span>
    </div>
  );
}
