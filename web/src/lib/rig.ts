// A design as a simulation/1 request: the same line, source and schedule that its ranking used.
import { loadPart, numberOf } from './catalogue';
import { type Change, changed, groupPressures } from './evaluation';
import { feedOf, feedsOf } from './pumps';
import type { Design, Effect, Group, Part, Requirements, Response } from './types';
import { goesBelow, hasTank, isDirect, isEjector, isVacuum } from './vacuum';

export type Parts = Map<string, Part>;

export async function partsOf(design: Design): Promise<Parts> {
  const ids = [...new Set(design.parts.map((row) => row.id))].filter((id) => id !== 'custom');
  const loaded = await Promise.all(ids.map((id) => loadPart(id).catch(() => null)));
  return new Map(
    loaded.filter((entry) => entry !== null).map((entry) => [entry.part.id, entry.part]),
  );
}

// Why a design can no longer be simulated as it was, or null.
export function missingPart(design: Design, parts: Parts): string | null {
  const row = design.parts.find((r) => r.id !== 'custom' && !parts.has(r.id));
  return row ? `${row.part_number} (${row.id}) is no longer in the catalogue` : null;
}

export const rowOf = (design: Design, family: string, group?: string) =>
  design.parts.find((row) => row.family === family && (group === undefined || row.group === group));

export function lineOf(design: Design, group: Group) {
  const id = (family: string) => rowOf(design, family, group.name)?.id;
  const fittings = group.fittings_per_line ?? 2;
  const fitting = Array.from({ length: fittings }, () => ({ part: id('fitting') }));
  return {
    elements: [
      { part: id('valve') },
      ...fitting.slice(0, Math.ceil(fittings / 2)),
      { part: id('tubing'), length_m: group.tube_length_m },
      ...fitting.slice(Math.ceil(fittings / 2)),
    ],
  };
}

interface CurvePoint {
  pressure_kpa_gauge: number;
  free_air_l_per_min: number;
}

// Of an ejector a straight line from its flow without vacuum to its deepest one.
const curveOf = (part: Part): CurvePoint[] =>
  part.curve ?? [
    { pressure_kpa_gauge: numberOf(part, 'vacuum_max_kpa_gauge')!, free_air_l_per_min: 0 },
    { pressure_kpa_gauge: 0, free_air_l_per_min: numberOf(part, 'suction_flow_l_per_min_anr')! },
  ];

// Behind a check valve that opens at a difference of `crackingKpa` there is so much less of their
// pressure, or of their vacuum; what it leaves begins at ambient.
function behind(points: CurvePoint[], crackingKpa: number): CurvePoint[] {
  const left = ({ pressure_kpa_gauge: p, free_air_l_per_min }: CurvePoint): CurvePoint => ({
    pressure_kpa_gauge: p < 0 ? p + crackingKpa : p - crackingKpa,
    free_air_l_per_min,
  });
  const beyond = ({ pressure_kpa_gauge: p }: CurvePoint) => Math.abs(p) >= crackingKpa;
  return points.flatMap((point, i) => {
    if (beyond(point)) return [left(point)];
    const next = [points[i - 1], points[i + 1]].find((other) => other && beyond(other));
    if (!next) return [];
    const share =
      (crackingKpa - Math.abs(point.pressure_kpa_gauge)) /
      Math.abs(next.pressure_kpa_gauge - point.pressure_kpa_gauge);
    const flow = point.free_air_l_per_min;
    return [
      {
        pressure_kpa_gauge: 0,
        free_air_l_per_min: flow + share * (next.free_air_l_per_min - flow),
      },
    ];
  });
}

// What feeds all groups, or one behind a regulator or on pumps of its own, by its place.
function sourceOf(
  design: Design,
  requirements: Requirements,
  parts: Parts,
  change: Change,
  own: number | null,
) {
  const pump =
    rowOf(design, 'compressor') ??
    (isVacuum(design.configuration)
      ? (rowOf(design, 'vacuum_pump') ?? rowOf(design, 'ejector'))
      : undefined);
  if (pump && !hasTank(design.configuration)) {
    // Pumps take in volume: the table is of 100 kPa, and holds at the same ratios of pressure.
    const share = (requirements.ambient?.pressure_kpa_abs ?? 100) / 100;
    const valve = rowOf(design, 'check_valve');
    const cracking = (valve && numberOf(parts.get(valve.id)!, 'cracking_pressure_kpa_gauge')) ?? 0;
    const alone = curveOf(parts.get(pump.id)!).map(
      ({ pressure_kpa_gauge, free_air_l_per_min }) => ({
        pressure_kpa_gauge: share * pressure_kpa_gauge,
        free_air_l_per_min: share * free_air_l_per_min,
      }),
    );
    const pumps = {
      curve: cracking > 0 ? behind(alone, cracking) : alone,
      count: pump.quantity / feedsOf(requirements),
    };
    const ejector = isEjector(design.configuration);
    if (isDirect(design.configuration))
      return { kind: ejector ? 'direct_vacuum_pump' : design.configuration, ...pumps };
    return {
      kind: ejector ? 'vacuum_pump' : design.configuration,
      ...pumps,
      reservoir_volume_ml: change.reservoir_ml ?? design.settings.reservoir_volume_ml,
      initial_pressure_kpa_gauge: change.source_kpa,
      stop_pressure_kpa_gauge: change.source_kpa,
    };
  }
  const row = rowOf(design, 'regulator', own === null ? undefined : nameOf(requirements, own));
  if (design.configuration === 'tank' && !row) {
    return {
      kind: 'tank',
      reservoir_volume_ml: design.settings.reservoir_volume_ml,
      initial_pressure_kpa_gauge: change.source_kpa,
    };
  }
  const regulator = row && parts.get(row.id);
  const flows = [
    regulator ? numberOf(regulator, 'flow_max_l_per_min_anr') : null,
    design.configuration === 'mains'
      ? (requirements.supply?.mains?.flow_l_per_min_anr_max ?? null)
      : null,
  ].filter((flow): flow is number => flow !== null);
  return {
    kind: 'regulated',
    source_pressure_kpa_gauge:
      own === null ? change.source_kpa : groupPressures(design, change)![own],
    ...(regulator && {
      regulator: {
        sonic_conductance_dm3_per_s_bar: numberOf(regulator, 'sonic_conductance_dm3_per_s_bar'),
        critical_ratio: numberOf(regulator, 'critical_ratio'),
      },
    }),
    ...(flows.length > 0 && { flow_l_per_min_anr_max: Math.min(...flows) }),
  };
}

const nameOf = (requirements: Requirements, g: number) =>
  requirements.actuators[g]!.name ?? `group ${g + 1}`;

export const traceName = (trace: { name: string; phase?: number }) =>
  trace.phase === undefined ? trace.name : `${trace.name}, phase ${trace.phase}`;

// Actuators of a group that are filled at once, and from when in the period on.
function squadsOf(requirements: Requirements) {
  const groups = requirements.actuators;
  return groups.flatMap((group, g) => {
    const strokes = group.strokes_per_period ?? 1;
    const turn = requirements.duty.simultaneous === false ? g / groups.length / strokes : 0;
    const given = group.phase ?? turn;
    const phases = (Array.isArray(given) ? given : [Number(given)]).map((phase) => phase % 1);
    const begins = [...new Set(phases)].sort((a, b) => a - b);
    return begins.map((phase) => ({
      group,
      phase,
      count: phases.length > 1 ? phases.filter((p) => p === phase).length : group.count,
      name: traceName({ name: group.name, ...(begins.length > 1 && { phase }) }),
    }));
  });
}

function schedule(requirements: Requirements, group: Group, phase: number, cycles: number) {
  const period = 1 / requirements.duty.frequency_hz;
  const strokes = group.strokes_per_period ?? 1;
  const open = (group.inflate_fraction ?? 0.5) / strokes;
  const begins = Array.from({ length: strokes }, (_, k) => (phase + k / strokes) % 1).sort(
    (a, b) => a - b,
  );
  return Array.from({ length: cycles }, (_, cycle) =>
    begins.flatMap((begin) => [
      { t_s: (cycle + begin) * period, state: 'inflate' },
      { t_s: (cycle + begin + open) * period, state: 'deflate' },
    ]),
  ).flat();
}

// Volume and pressure of a group's actuator, as requests have them.
export const chamberOf = (group: Group) => ({
  ...(group.pressure_volume
    ? { pressure_volume: group.pressure_volume }
    : { rest_volume_ml: group.rest_volume_ml, expansion_ratio: group.expansion_ratio }),
  operating_pressure_kpa_gauge: group.operating_pressure_kpa_gauge,
});

// Where an actuator rests below ambient, and what it empties into; its valve closes there.
export const railOf = (group: Group, { settings }: Design) =>
  goesBelow(group)
    ? {
        low_pressure_kpa_gauge: group.low_pressure_kpa_gauge,
        exhaust_pressure_kpa_gauge: settings.vacuum_kpa_gauge,
        close_at_low_pressure: true,
      }
    : {};

// One request, or where each group has a regulator or pumps of its own one of each.
export function simulationsOf(
  design: Design,
  asked: Requirements,
  parts: Parts,
  change: Change,
  cycles: number,
  effects: Effect[] = [],
): unknown[] {
  const each = design.settings.group_pressure_kpa_gauge || feedOf(asked) !== 'shared';
  const places = each ? asked.actuators.map((_, g) => g) : [null];
  return places.map((own) => simulationOf(design, asked, parts, change, cycles, effects, own));
}

// The responses to these requests as one; the source's pressure is the highest of all.
export function joined(responses: Response[]): Response {
  const [first] = responses as [Response, ...Response[]];
  if (responses.length === 1) return first;
  return {
    ...first,
    groups: responses.flatMap(({ groups }) => groups),
    performance: {
      ...first.performance,
      groups: responses.flatMap(({ performance }) => performance.groups),
    },
    source_pressure_kpa_gauge: first.source_pressure_kpa_gauge.map((_, i) =>
      Math.max(...responses.map(({ source_pressure_kpa_gauge }) => source_pressure_kpa_gauge[i]!)),
    ),
  };
}

function simulationOf(
  design: Design,
  asked: Requirements,
  parts: Parts,
  change: Change,
  cycles: number,
  effects: Effect[],
  own: number | null,
): unknown {
  const requirements = changed(asked, change);
  const end = cycles / requirements.duty.frequency_hz;
  // What a sensor would show is not what rankings are about.
  const acting = effects.filter((effect) => !effect.id.startsWith('sensor_'));
  return {
    schema: 'simulation/1',
    ...(acting.length > 0 && { effects: acting }),
    ...(design.configuration === 'co2' && { gas: 'co2' }),
    ...(requirements.ambient && { ambient: requirements.ambient }),
    ...(requirements.rise && { rise: requirements.rise }),
    ...(requirements.fall && { fall: requirements.fall }),
    actuators: (own === null
      ? squadsOf(requirements)
      : squadsOf(requirements).filter(({ group }) => group === requirements.actuators[own])
    ).map(({ group, phase, count, name }) => {
      const valve = parts.get(rowOf(design, 'valve', group.name)?.id ?? '');
      return {
        name,
        count: feedOf(requirements) === 'per_actuator' ? 1 : count,
        ...chamberOf(group),
        close_at_operating_pressure: valve?.function !== '3/2',
        ...railOf(group, design),
        line: lineOf(design, group),
        valve: schedule(requirements, group, phase, cycles),
      };
    }),
    source: sourceOf(design, requirements, parts, change, own),
    t_end_s: end,
    sample_hz: 2400 / end,
  };
}
