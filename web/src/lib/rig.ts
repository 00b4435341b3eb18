// A design as a simulation/1 request: the same line, source and schedule that its ranking used.
import { loadPart, numberOf } from './catalogue';
import type { Design, Group, Part, Requirements, Response } from './types';

// What may be tried on a design; 1 or the design's own value changes nothing.
export interface Change {
  source_kpa: number;
  reservoir_ml: number | null;
  tube: number; // factors
  rest_volume: number;
  operating: number;
}

export const asDesigned = (design: Design): Change => ({
  source_kpa: design.settings.source_pressure_kpa_gauge,
  reservoir_ml: design.settings.reservoir_volume_ml,
  tube: 1,
  rest_volume: 1,
  operating: 1,
});

export type Parts = Map<string, Part>;

export async function partsOf(design: Design): Promise<Parts> {
  const ids = [...new Set(design.parts.map((row) => row.id))].filter((id) => id !== 'custom');
  const loaded = await Promise.all(ids.map((id) => loadPart(id).catch(() => null)));
  return new Map(loaded.filter((entry) => entry !== null).map((entry) => [entry.part.id, entry.part]));
}

// Why a design can no longer be simulated as it was, or null.
export function missingPart(design: Design, parts: Parts): string | null {
  const row = design.parts.find((r) => r.id !== 'custom' && !parts.has(r.id));
  return row ? `${row.part_number} (${row.id}) is no longer in the catalogue` : null;
}

const rowOf = (design: Design, family: string, group?: string) =>
  design.parts.find((row) => row.family === family && (group === undefined || row.group === group));

function lineOf(design: Design, group: Group, change: Change) {
  const id = (family: string) => rowOf(design, family, group.name)?.id;
  const fittings = group.fittings_per_line ?? 2;
  const fitting = Array.from({ length: fittings }, () => ({ part: id('fitting') }));
  return {
    elements: [
      { part: id('valve') },
      ...fitting.slice(0, Math.ceil(fittings / 2)),
      { part: id('tubing'), length_m: Math.min(100, Math.max(0.01, group.tube_length_m * change.tube)) },
      ...fitting.slice(Math.ceil(fittings / 2)),
    ],
  };
}

function sourceOf(design: Design, requirements: Requirements, parts: Parts, change: Change) {
  const pump = rowOf(design, 'compressor');
  if (pump) {
    return {
      kind: 'compressor',
      curve: parts.get(pump.id)!.curve!.map(({ pressure_kpa_gauge, free_air_l_per_min }) => ({ pressure_kpa_gauge, free_air_l_per_min })),
      count: pump.quantity,
      reservoir_volume_ml: change.reservoir_ml,
      initial_pressure_kpa_gauge: change.source_kpa,
      stop_pressure_kpa_gauge: change.source_kpa,
    };
  }
  const row = rowOf(design, 'regulator');
  const regulator = row && parts.get(row.id);
  const flows = [
    regulator ? numberOf(regulator, 'flow_max_l_per_min_anr') : null,
    design.configuration === 'mains' ? (requirements.supply?.mains?.flow_l_per_min_anr_max ?? null) : null,
  ].filter((flow): flow is number => flow !== null);
  return {
    kind: 'regulated',
    source_pressure_kpa_gauge: change.source_kpa,
    ...(regulator && {
      regulator: {
        sonic_conductance_dm3_per_s_bar: numberOf(regulator, 'sonic_conductance_dm3_per_s_bar'),
        critical_ratio: numberOf(regulator, 'critical_ratio'),
      },
    }),
    ...(flows.length > 0 && { flow_l_per_min_anr_max: Math.min(...flows) }),
  };
}

// Commands of group `index` of `n`: staggered groups begin a share of the period later.
function schedule(requirements: Requirements, index: number, n: number, cycles: number) {
  const period = 1 / requirements.duty.frequency_hz;
  const phase = requirements.duty.simultaneous === false ? index / n : 0;
  return Array.from({ length: cycles }, (_, cycle) => [
    { t_s: (cycle + phase) * period, state: 'inflate' },
    { t_s: (cycle + phase + 0.5) * period, state: 'deflate' },
  ]).flat();
}

export interface StrokeTimes {
  rise_s: number | null;
  fall_s: number | null;
}

// Rise and fall of each group as the schedule of `simulationOf` asks for them, the slowest of the
// cycles; between samples on a straight line. null: some stroke does not get there.
export function strokesOf(response: Response, requirements: Requirements, cycles: number): StrokeTimes[] {
  const t = response.t_s;
  const period = 1 / requirements.duty.frequency_hz;
  const groups = requirements.actuators;
  return groups.map((group, g) => {
    const p = response.groups[g]!.pressure_kpa_gauge;
    const high = (requirements.rise?.to_fraction ?? 0.95) * group.operating_pressure_kpa_gauge;
    const low = (requirements.fall?.to_fraction ?? 0.05) * group.operating_pressure_kpa_gauge;
    const phase = requirements.duty.simultaneous === false ? g / groups.length : 0;
    const crossing = (from: number, level: number, sign: number): number | null => {
      for (let i = Math.max(1, t.findIndex((time) => time >= from)); i < t.length && t[i]! <= from + period / 2; ++i) {
        const [a, b] = [p[i - 1], p[i]];
        if (a == null || b == null || sign * (b - level) < 0) continue;
        const share = b === a ? 1 : Math.min(1, Math.max(0, (level - a) / (b - a)));
        return Math.max(0, t[i - 1]! + share * (t[i]! - t[i - 1]!) - from);
      }
      return null;
    };
    let rise: number | null = 0;
    let fall: number | null = 0;
    for (let cycle = 0; cycle < cycles; ++cycle) {
      const start = (cycle + phase) * period;
      const up = crossing(start, high, 1);
      rise = up === null || rise === null ? null : Math.max(rise, up);
      if (start + period > t[t.length - 1]! + 1e-9) continue;
      const down = crossing(start + period / 2, low, -1);
      fall = down === null || fall === null ? null : Math.max(fall, down);
    }
    return { rise_s: rise, fall_s: fall };
  });
}

export function simulationOf(
  design: Design, requirements: Requirements, parts: Parts, change: Change, cycles: number, samples = 2400,
): unknown {
  const groups = requirements.actuators;
  const end = cycles / requirements.duty.frequency_hz;
  return {
    schema: 'simulation/1',
    ...(design.configuration === 'co2' && { gas: 'co2' }),
    ...(requirements.ambient && { ambient: requirements.ambient }),
    ...(requirements.rise && { rise: requirements.rise }),
    ...(requirements.fall && { fall: requirements.fall }),
    actuators: groups.map((group, i) => {
      const valve = parts.get(rowOf(design, 'valve', group.name)?.id ?? '');
      return {
        name: group.name,
        count: group.count,
        ...(group.pressure_volume
          ? { pressure_volume: group.pressure_volume.map((p) => ({ ...p, volume_ml: p.volume_ml * change.rest_volume })) }
          : { rest_volume_ml: group.rest_volume_ml! * change.rest_volume, expansion_ratio: group.expansion_ratio }),
        operating_pressure_kpa_gauge: group.operating_pressure_kpa_gauge * change.operating,
        close_at_operating_pressure: valve?.function !== '3/2',
        line: lineOf(design, group, change),
        valve: schedule(requirements, i, groups.length, cycles),
      };
    }),
    source: sourceOf(design, requirements, parts, change),
    t_end_s: end,
    sample_hz: samples / end,
  };
}
