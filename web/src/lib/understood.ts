// What the service understood of a document: texts with units, actuators by their shape.
import type { Group, Requirements } from './types';

export interface Understood {
  pointer: string;
  given: unknown;
  value: number;
  unit: string;
  condition?: string; // of a standard volume
  name?: string; // of a shape: which number of the group it came to
  formula?: string;
}

export interface Remarked {
  understood?: Understood[];
  warnings?: { pointer: string; detail: string }[];
  notes?: { pointer: string; note: unknown }[];
}

// The name under which the other chamber of a double-acting cylinder is understood.
export const rodSide = 'operating_volume_ml of the rod side';

export const shapes = ['cylinder', 'muscle', 'pouch', 'body'] as const;
export type Shape = (typeof shapes)[number];

const stepsOf = (pointer: string): string[] => pointer.split('/').slice(1);
const valueIn = (document: unknown, steps: string[]): unknown =>
  steps.reduce<unknown>(
    (at, step) => (at as Record<string, unknown> | undefined)?.[step],
    document,
  );

// Whether it was understood of this document, and not of how it was before.
export const isOf = (document: unknown, row: Understood): boolean =>
  JSON.stringify(valueIn(document, stepsOf(row.pointer))) === JSON.stringify(row.given);

// The same requirements in numbers alone, for what computes or draws with them. A text or a shape
// that is not understood (yet) is left out.
export function inNumbers(document: Requirements, understood: Understood[]): Requirements {
  const numbers = structuredClone(document);
  for (const row of understood) {
    if (!isOf(document, row)) continue;
    const steps = stepsOf(row.pointer);
    const owner = valueIn(numbers, steps.slice(0, -1)) as Record<string, unknown>;
    const name = row.name ?? steps.at(-1)!;
    if (name !== 'operating_volume_ml') owner[name] = row.value;
  }
  for (const group of numbers.actuators) for (const shape of shapes) delete group[shape];
  leaveOutTexts(numbers as unknown as Record<string, unknown>);
  return numbers;
}

// The same with the two chambers of each double-acting cylinder as groups, as answers have them: one
// is filled while the other is emptied.
export function withSides(requirements: Requirements): Requirements {
  const groups = requirements.actuators as (Group & { [rodSide]?: number })[];
  if (!groups.some((group) => group[rodSide] !== undefined)) return requirements;
  const actuators = groups.flatMap(({ [rodSide]: rod_ml, ...group }, g): Group[] => {
    const strokes = group.strokes_per_period ?? 1;
    const share = group.inflate_fraction ?? 0.5;
    const turn = requirements.duty.simultaneous === false ? g / groups.length / strokes : 0;
    const phase = group.phase ?? turn;
    if (rod_ml === undefined) return [{ ...group, phase }];
    const later = (begin: number) => (begin + share / strokes) % 1;
    return [
      { ...group, phase, name: `${group.name}, cap side` },
      {
        ...group,
        name: `${group.name}, rod side`,
        expansion_ratio: rod_ml / group.rest_volume_ml!,
        phase: Array.isArray(phase) ? phase.map(later) : later(Number(phase)),
        inflate_fraction: 1 - share,
      },
    ];
  });
  return { ...requirements, actuators };
}

// Groups as they were asked for, by name: a pointer counts a double-acting cylinder once.
export const entriesOf = (groups: { name: string }[]): string[] =>
  groups
    .filter(
      ({ name }, g) => !(name.endsWith(', rod side') && groups[g - 1]?.name.endsWith(', cap side')),
    )
    .map(({ name }) => name.replace(/, cap side$/, ''));

export const namesUnit = (name: string): boolean =>
  /_(kpa_gauge|kpa_abs|kpa|ml|l|mm|m|s|ms|hz|kg|k|eur|wh|deg|anr|l_per_min|dm3_per_s_bar|ah|v|a|w)(_max|_min)?$/.test(
    name,
  );

// What requirements take as a text, too: a number with its unit; of actuations for how long.
export const takesText = (name: string): boolean => namesUnit(name) || name === 'actuations';

// Numbers without a unit, among them the limits on numbers of parts.
const namesNumber = (name: string): boolean =>
  /^(count|fittings_per_line|contraction|cells|actuations|probability_min|\w+_(ratio|fraction|max))$/.test(
    name,
  );

function leaveOutTexts(object: Record<string, unknown>): void {
  for (const [name, value] of Object.entries(object)) {
    if (typeof value === 'string' && (namesUnit(name) || namesNumber(name))) delete object[name];
    else if (value && typeof value === 'object') leaveOutTexts(value as Record<string, unknown>);
  }
}

export const shapeOf = (group: Group): Shape | undefined => shapes.find((shape) => group[shape]);
