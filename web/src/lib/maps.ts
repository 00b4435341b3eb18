// The maps of normalised times around a design, and its place on them.
import { post } from './api';
import { numberOf } from './catalogue';
import { chamberOf, lineOf, type Parts, rowOf } from './rig';
import type { CurvePoint, Design, Group, Requirements, Response } from './types';
import type { MapData } from '../plots/contour';

export interface Place {
  data: MapData;
  at: { x: number; y: number };
  normalised: number | null; // the map's value there
  seconds: number | null; // the same as a time of this rig
}

export interface GroupMaps {
  rise: Place;
  fall: Place;
  pump: Place | null;
  source: number; // ratio to ambient
  expansion: number;
  critical: number;
  criticalOut: number;
  conductance: number | null; // dm³/(s·bar), of the whole line
}

type Time = 'rise_time_normalised' | 'fall_time_normalised';
type Row = Record<Time, number | null>;
type Grid = Record<string, number[]>;

const steps = (from: number, to: number, n: number): number[] =>
  Array.from({ length: n }, (_, i) => from + ((to - from) * i) / (n - 1));

function expansionOf(group: Group): number {
  const table = group.pressure_volume;
  if (!table) return group.expansion_ratio ?? 1;
  const at = table.findIndex((p) => p.pressure_kpa_gauge >= group.operating_pressure_kpa_gauge);
  return table[Math.max(at, 0)]!.volume_ml / table[0]!.volume_ml;
}

function deliveryAt(curve: CurvePoint[], kpa: number): number {
  const after = curve.findIndex((p) => p.pressure_kpa_gauge >= kpa);
  if (after < 0) return 0;
  const [a, b] = [curve[Math.max(0, after - 1)]!, curve[after]!];
  const width = b.pressure_kpa_gauge - a.pressure_kpa_gauge;
  const share = width > 0 ? (kpa - a.pressure_kpa_gauge) / width : 0;
  return a.free_air_l_per_min + share * (b.free_air_l_per_min - a.free_air_l_per_min);
}

export async function mapsOf(
  design: Design,
  requirements: Requirements,
  parts: Parts,
  group: Group,
): Promise<GroupMaps> {
  const ambient = requirements.ambient?.pressure_kpa_abs ?? 100;
  const ratio = (kpaGauge: number) => (kpaGauge + ambient) / ambient;
  const own = design.settings.group_pressure_kpa_gauge?.[requirements.actuators.indexOf(group)];
  const stop = own ?? design.settings.source_pressure_kpa_gauge;
  const source = ratio(stop);
  const operating = ratio(group.operating_pressure_kpa_gauge);
  const expansion = expansionOf(group);
  const valve = parts.get(rowOf(design, 'valve', group.name)?.id ?? '');
  const critical = (valve && numberOf(valve, 'critical_ratio_fill')) ?? 0.3;
  const criticalOut = (valve && numberOf(valve, 'critical_ratio_exhaust')) ?? critical;
  const fractions = {
    rise: requirements.rise ?? { to_fraction: 0.95 },
    fall: requirements.fall ?? { to_fraction: 0.05 },
  };
  const fixed: Grid = {
    source_pressure_ratio: [source],
    operating_pressure_ratio: [operating],
    expansion_ratio: [expansion],
    critical_ratio: [critical],
  };
  const rows = async (grid: Grid): Promise<Row[]> =>
    (
      await post<{ rows: Row[] }>('/v1/maps', {
        schema: 'map/1',
        ...fractions,
        ...fixed,
        ...grid,
      })
    ).rows;
  // The grid over two axes, row by row of y, and its value at one point.
  const map = async (
    [xName, x]: [string, number[]],
    [yName, y]: [string, number[]],
    time: Time,
    at: { x: number; y: number },
    rest: Grid = {},
    xIsOuter = true,
  ) => {
    const found = await rows({ ...rest, [xName]: x, [yName]: y });
    const [one] = await rows({ ...rest, [xName]: [at.x], [yName]: [at.y] });
    const values = y.flatMap((_, j) =>
      x.map((__, i) => found[xIsOuter ? i * y.length + j : j * x.length + i]![time]),
    );
    return { data: { x, y, values }, at, normalised: one![time] };
  };

  const rise = await map(
    ['source_pressure_ratio', steps(1.1, Math.max(2 * source - 1, source + 1, 4), 56)],
    ['operating_pressure_ratio', steps(1.05, Math.max(2 * operating - 1, 3), 44)],
    'rise_time_normalised',
    { x: source, y: operating },
  );
  // What is never reached lies behind the border that is drawn over it.
  const { x, values } = rise.data;
  for (let k = x.length; k < values.length; ++k) values[k] ??= values[k - x.length]!;
  const fall = await map(
    ['operating_pressure_ratio', steps(1.05, Math.max(2 * operating - 1, 3), 44)],
    ['expansion_ratio', steps(1, Math.max(2 * expansion - 1, 3), 32)],
    'fall_time_normalised',
    { x: operating, y: expansion },
    { source_pressure_ratio: [1000], critical_ratio: [criticalOut] },
  );

  // One C for the whole line: with it the map gives the time that the line takes.
  const alone = await post<Response>('/v1/simulations', {
    schema: 'simulation/1',
    ...fractions,
    ...(requirements.ambient && { ambient: requirements.ambient }),
    ...(design.configuration === 'co2' && { gas: 'co2' }),
    actuators: [{ name: group.name, ...chamberOf(group), line: lineOf(design, group) }],
    source: { kind: 'regulated', source_pressure_kpa_gauge: stop },
    valve: [{ t_s: 0, state: 'inflate' }],
    t_end_s: 0.01,
  });
  const volume_dm3 = (group.rest_volume_ml ?? group.pressure_volume![0]!.volume_ml) / 1e3;
  const alone_s = alone.performance.groups[0]!.rise_time_s;
  const conductance =
    rise.normalised !== null && alone_s ? (rise.normalised * volume_dm3) / alone_s : null;
  const seconds = (normalised: number | null) =>
    normalised === null || conductance === null ? null : (normalised * volume_dm3) / conductance;

  const pumpRow = rowOf(design, 'compressor');
  const curve = pumpRow && parts.get(pumpRow.id)?.curve;
  const reservoir = design.settings.reservoir_volume_ml;
  let pump: Omit<Place, 'seconds'> | null = null;
  if (pumpRow && curve && reservoir !== null && conductance !== null) {
    const at = {
      x: reservoir / 1e3 / volume_dm3,
      y: (pumpRow.quantity * deliveryAt(curve, stop)) / 60 / conductance,
    };
    pump = await map(
      ['reservoir_volume_normalised', steps(at.x / 4, 2 * at.x, 36)],
      ['compressor_flow_normalised', steps(0, Math.max(2 * at.y, 0.1), 24)],
      'rise_time_normalised',
      at,
      { actuator_count: [group.count] },
      false,
    );
  }
  return {
    rise: { ...rise, seconds: seconds(rise.normalised) },
    // The way out is another line, with a C of its own.
    fall: { ...fall, seconds: alone.performance.groups[0]!.fall_time_s },
    pump: pump && { ...pump, seconds: seconds(pump.normalised) },
    source,
    expansion,
    critical,
    criticalOut,
    conductance,
  };
}
