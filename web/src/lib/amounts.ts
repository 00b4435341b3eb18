// What designs are compared by: the axes of plots and the columns of tables.
import { fieldName, short, shown, significant } from './format';
import type { Amount, Design, PartRow, Requirements } from './types';
import { entriesOf } from './understood';
import { type Kind, unitOf } from './units';

export interface Axis {
  id: string;
  label: string;
  kind: Kind;
  unit: string;
  meaning: string;
  better: 'low' | 'high';
  of: (design: Design) => number | null;
}

const worst = (values: number[]): number => Math.max(...values);

export const leastMargin = (design: Design): number =>
  Math.min(...design.margins.map((margin) => margin.relative_margin));

const plain = (
  id: string,
  label: string,
  unit: string,
  meaning: string,
  of: Axis['of'],
  better: Axis['better'] = 'low',
  kind: Kind = 'plain',
): Axis => ({ id, label, unit, meaning, of, better, kind });

const settings = (of: (d: Design['settings']) => number | null) => (d: Design) => of(d.settings);

export const axes: Axis[] = [
  plain('mass', 'mass', 'kg', 'Of all parts together', (d) => d.totals.mass_kg),
  plain(
    'volume',
    'volume',
    '',
    'Of the bodies of all parts together',
    (d) => d.totals.volume_l,
    'low',
    'volume_l',
  ),
  plain('cost', 'cost', '€', 'Of all parts together', (d) => d.totals.cost_eur),
  plain(
    'cost-known',
    'cost, at least',
    '€',
    'Of the parts whose price is known; unknown ones count as 0',
    ({ totals }) => (totals.cost_eur === null ? (totals.cost_eur_min ?? null) : null),
  ),
  plain(
    'energy',
    'energy',
    'Wh',
    'Electrical, of pump and coils over all actuations',
    (d) => d.totals.energy_wh,
  ),
  plain('rise', 'rise', 's', 'The slowest rise of any group, in the periodic state', (d) =>
    worst(d.performance.groups.map((g) => g.rise_time_s)),
  ),
  plain('fall', 'fall', 's', 'The slowest fall of any group, in the periodic state', (d) =>
    worst(d.performance.groups.map((g) => g.fall_time_s)),
  ),
  plain(
    'margin',
    'least margin',
    '%',
    'What the tightest requirement has to spare',
    (d) => Math.round(1e5 * leastMargin(d)) / 1e3,
    'high',
  ),
  plain(
    'source',
    'source',
    '',
    'Pressure that the lines are fed from; without a reservoir the highest',
    settings((s) => s.source_pressure_kpa_gauge),
    'low',
    'pressure',
  ),
  plain(
    'reservoir',
    'reservoir',
    '',
    'Volume between pump and valves, or of the tank',
    settings((s) => s.reservoir_volume_ml),
    'low',
    'volume_ml',
  ),
  plain(
    'tank_fill',
    'tank fill',
    '',
    'Pressure that the tank is filled to beforehand',
    settings((s) => s.tank_fill_kpa_gauge ?? null),
    'low',
    'pressure',
  ),
  plain(
    'pump_stop',
    'pump stops',
    '',
    'Pressure of the tank below which the pump runs',
    settings((s) => s.pump_stop_kpa_gauge ?? null),
    'low',
    'pressure',
  ),
  plain(
    'rail',
    'vacuum',
    '',
    'Weakest pressure of the vacuum beside a pressure supply',
    settings((s) => (s.vacuum_stop_kpa_gauge === undefined ? null : s.vacuum_kpa_gauge!)),
    'low',
    'pressure',
  ),
  plain(
    'rail_duty',
    'vacuum pump duty',
    '%',
    'Share of the time that the vacuum pump beside a pressure supply runs',
    settings((s) => (s.vacuum_duty === undefined ? null : 100 * s.vacuum_duty)),
  ),
  plain(
    'sustained',
    'sustained',
    'Hz',
    'The highest frequency that the supply keeps up',
    (d) => d.performance.frequency_hz_sustained,
    'high',
  ),
  plain(
    'duty',
    'pump duty',
    '%',
    'Share of the time that the pump runs',
    settings((s) => (s.compressor_duty === null ? null : 100 * s.compressor_duty)),
  ),
  plain(
    'estimated',
    'estimated mass',
    '%',
    'How much of the mass rests on estimates',
    (d) => 100 * d.data_quality.mass_share_estimated,
  ),
  plain(
    'probability',
    'probability',
    '%',
    "That it meets everything within its parts' tolerances",
    (d) => (d.robustness ? 100 * d.robustness.probability : null),
    'high',
  ),
];

const supplyWords = {
  compressor: 'compressor',
  cylinder: 'cylinder',
  co2: 'CO₂',
  mains: 'wall',
  tank: 'tank',
  tank_and_pump: 'tank with a pump',
  direct_pump: 'pump without a reservoir',
  vacuum_pump: 'vacuum pump',
  direct_vacuum_pump: 'vacuum pump without a reservoir',
  ejector: 'ejector',
  direct_ejector: 'ejector without a reservoir',
};
export const powerWord = ({
  kind,
  voltage_v,
}: {
  kind: string;
  voltage_v: number | null;
}): string =>
  `power from the ${kind}${voltage_v === null ? '' : `, ${significant(voltage_v, 3)} V`}`;
export const supplyWord = ({ configuration }: Pick<Design, 'configuration'>): string =>
  supplyWords[configuration];

export const quantityOf = (part: PartRow): string =>
  part.unit === 'm' ? `${significant(part.quantity)} m` : `${part.quantity} ×`;

const axisOfAmount: Record<Amount, string> = {
  mass_kg: 'mass',
  volume_l: 'volume',
  cost_eur: 'cost',
  energy_wh: 'energy',
};

// What a plot shows of an answer at first: what was minimised, across and upwards.
export function usualAxes({ objective }: Pick<Requirements, 'objective'>): [string, string] {
  const { minimize, pareto } = objective ?? {};
  if (pareto) return [axisOfAmount[pareto[0]!], axisOfAmount[pareto[1]!]];
  const first = typeof minimize === 'string' ? axisOfAmount[minimize] : 'mass';
  return [first, first === 'volume' ? 'mass' : 'volume'];
}

export const axisOf = (id: string | null | undefined): Axis | undefined =>
  axes.find((axis) => axis.id === id);
// An amount in the unit chosen; of shares tenths of a percent are enough.
export function amountText(axis: Axis, value: number | null, digits = 3): string {
  const isShare = axis.unit === '%' && value !== null && Math.abs(value) >= 1;
  return isShare ? value.toFixed(1) : shown(axis.kind, value, digits);
}

export const axisUnit = (axis: Axis): string => unitOf(axis.kind, axis.unit);

// A requirement's pointer in words, as the groups are named.
export function requirementName(pointer: string, groups: { name: string }[]): string {
  const group = /^\/actuators\/(\d+)\/(.+)$/.exec(pointer);
  const names: Record<string, string> = {
    rise_time_s_max: 'rise time',
    fall_time_s_max: 'fall time',
    pressure_kpa_gauge_max: 'highest pressure',
    pressure_kpa_gauge_min: 'lowest pressure',
    '/duty/frequency_hz': 'frequency',
    '/duty/actuations': 'actuations',
    '/supply/source_pressure_kpa_gauge_max': 'source pressure',
    '/supply/vacuum/vacuum_kpa_gauge_min': 'vacuum',
    '/supply/tank_fill_kpa_gauge_max': 'tank fill',
    '/supply/mass_kg_max': 'mass',
    '/supply/volume_l_max': 'volume',
    '/supply/cost_eur_max': 'cost',
    '/supply/mains/flow_l_per_min_anr_max': 'wall flow',
    '/limits/compressors_max': 'pumps in parallel',
    '/limits/batteries_max': 'batteries in parallel',
    '/limits/cylinders_max': 'bottles in parallel',
    '/limits/co2_max': 'CO₂ bottles in parallel',
    '/limits/reservoirs_max': 'reservoirs in parallel',
    '/exclude': 'excluded parts',
    prices: 'parts with a known price only',
  };
  if (pointer.startsWith('/require/')) return `required ${pointer.slice(9).replace('_', ' ')}`;
  if (!group) return names[pointer] ?? pointer;
  const what = names[group[2]!] ?? group[2]!;
  const entries = entriesOf(groups);
  return entries.length > 1 ? `${what} of ${entries[Number(group[1])] ?? group[1]}` : what;
}

export function requirementUnit(pointer: string): string {
  if (pointer.includes('pressure') || pointer.includes('vacuum')) return unitOf('pressure');
  if (pointer.endsWith('_time_s_max')) return 's';
  if (pointer.endsWith('frequency_hz')) return 'Hz';
  if (pointer.endsWith('mass_kg_max')) return 'kg';
  if (pointer.endsWith('volume_l_max')) return unitOf('volume_l');
  if (pointer.endsWith('cost_eur_max')) return '€';
  return pointer.endsWith('_anr_max') ? 'L/min' : '';
}

// Where in the requirements something is, in the words of the form.
export function placeInWords(pointer: string, groups: { name: string }[]): string {
  const [, index, rest] = /^\/actuators\/(\d+)\/(.+)$/.exec(pointer) ?? [];
  const field = (rest ?? pointer)
    .replace(/\/\d+$/, '')
    .split('/')
    .pop()!;
  const name = fieldName(field.replace(/_max$/, '')).label || 'the requirements';
  return rest ? `${name} of ${entriesOf(groups)[Number(index)] ?? index}` : name;
}

// Whether a requirement is a least or a most.
export const sense = (pointer: string): string =>
  pointer.startsWith('/duty') || pointer.endsWith('_min') ? '≥' : '≤';

// What a search minimises, in words.
export function objectiveName({ objective }: Pick<Requirements, 'objective'>): string {
  const minimize = objective?.minimize ?? 'mass_kg';
  const words = { mass_kg: 'mass', volume_l: 'volume', cost_eur: 'cost', energy_wh: 'energy' };
  return typeof minimize === 'string' ? words[minimize] : 'weighted sum';
}

// Of what a search minimises; none for a weighted sum.
export function objectiveUnit({ objective }: Pick<Requirements, 'objective'>): string {
  const { minimize, pareto } = objective ?? {};
  const amount =
    typeof minimize === 'string' ? minimize : minimize ? '' : (pareto?.[0] ?? 'mass_kg');
  return { mass_kg: 'kg', volume_l: 'L', cost_eur: '€', energy_wh: 'Wh', '': '' }[amount];
}

// A requirement's number in the units chosen.
export function requirementNumber(pointer: string, value: number | null): string {
  if (pointer.includes('pressure') || pointer.includes('vacuum')) return shown('pressure', value);
  if (pointer.endsWith('volume_l_max')) return shown('volume_l', value);
  return value === null ? '–' : short(value, pointer.endsWith('actuations') ? 4 : 3);
}

// Which designs no other beats in both amounts.
export function paretoFront(points: { x: number; y: number }[], x: Axis, y: Axis): boolean[] {
  const sx = x.better === 'low' ? 1 : -1;
  const sy = y.better === 'low' ? 1 : -1;
  const order = points
    .map((p, i) => ({ x: sx * p.x, y: sy * p.y, i }))
    .sort((a, b) => a.x - b.x || a.y - b.y);
  const front = points.map(() => false);
  let lowest = Infinity;
  let last = { x: NaN, y: NaN };
  for (const p of order) {
    if (p.y < lowest || (p.x === last.x && p.y === last.y)) {
      front[p.i] = true;
      lowest = Math.min(lowest, p.y);
      last = p;
    }
  }
  return front;
}
