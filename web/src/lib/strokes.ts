// The slowest stroke of each group, cut out of a design's periodic response.
import { traceName } from './rig';
import type { Design, Group, Requirements } from './types';

export interface Stroke {
  name: string; // of group and phase
  group: Group;
  isRise: boolean;
  achieved_s: number;
  limit_s: number | null;
  target_kpa_gauge: number;
  target_share: number; // of the way from where it rests
  peak_kpa_gauge: number | null; // of a rise, where the valve may close late
  t_s: number[]; // from the command on
  pressure_kpa_gauge: (number | null)[];
  source_kpa_gauge: (number | null)[];
}

type Values = (number | null)[];

// Shares of the period at which actuators of a phase begin to fill, and how long each fill may take.
function commandsOf(group: Group, phase: number) {
  const strokes = group.strokes_per_period ?? 1;
  return {
    begins: Array.from({ length: strokes }, (_, k) => (phase + k / strokes) % 1),
    open: (group.inflate_fraction ?? 0.5) / strokes,
    closed: (1 - (group.inflate_fraction ?? 0.5)) / strokes,
  };
}

// Samples of one period from a moment on, across its end if need be.
function cut(t_s: number[], values: Values, from_s: number, length_s: number, period_s: number) {
  const times: number[] = [];
  const cutValues: Values = [];
  for (const round of [0, 1]) {
    t_s.forEach((t, i) => {
      const after = t + round * period_s - from_s;
      if (after < -1e-9 || after > length_s || (times.length > 0 && after <= times.at(-1)!)) return;
      times.push(after);
      cutValues.push(values[i] ?? null);
    });
  }
  return { times, cutValues };
}

// When the target is reached, between samples by a straight line; null where it is not.
function reached(times: number[], values: Values, isThere: (p: number) => number): number | null {
  for (let i = 1; i < times.length; ++i) {
    const [before, after] = [isThere(values[i - 1] ?? NaN), isThere(values[i] ?? NaN)];
    if (before < 0 && after >= 0)
      return times[i - 1]! + (-before / (after - before)) * (times[i]! - times[i - 1]!);
  }
  return null;
}

export function strokesOf(design: Design, requirements: Requirements): Stroke[] {
  const { response } = design;
  const period = 1 / requirements.duty.frequency_hz;
  const groups = requirements.actuators;
  const own = design.settings.group_pressure_kpa_gauge; // behind a regulator of each group
  return groups.flatMap((group, g) => {
    const traces = response.groups.filter((trace) => trace.name === group.name);
    const found = design.performance.groups.find(({ name }) => name === group.name);
    if (!found) return [];
    const turn = requirements.duty.simultaneous === false ? g / groups.length : 0;
    const operating = group.operating_pressure_kpa_gauge;
    const sign = Math.sign(operating);
    const peak = found.peak_kpa_gauge ?? operating;
    return [true, false].flatMap((isRise): Stroke[] => {
      const share = isRise
        ? (requirements.rise?.to_fraction ?? 0.95)
        : (requirements.fall?.to_fraction ?? 0.05);
      // Falls end near where the actuator rests, which may be below ambient.
      const rest = isRise ? 0 : (group.low_pressure_kpa_gauge ?? 0);
      const target = rest + share * (operating - rest);
      const achieved = isRise ? found.rise_time_s : found.fall_time_s;
      const limit = (isRise ? group.rise_time_s_max : group.fall_time_s_max) ?? null;
      const isThere = (p: number) => (isRise ? 1 : -1) * sign * (p - target);
      let slowest: Stroke | null = null;
      let longest = -1;
      for (const trace of traces) {
        const given =
          typeof group.phase === 'number' ? group.phase : turn / (group.strokes_per_period ?? 1);
        const { begins, open, closed } = commandsOf(group, trace.phase ?? given);
        const room = (isRise ? open : closed) * period;
        const length = Math.min(room, 1.4 * Math.max(achieved, limit ?? 0));
        for (const begin of begins) {
          const from = ((begin + (isRise ? 0 : open)) % 1) * period;
          const { times, cutValues } = cut(
            response.t_s,
            trace.pressure_kpa_gauge,
            from,
            length,
            period,
          );
          const at = reached(times, cutValues, isThere) ?? length;
          if (at <= longest) continue;
          longest = at;
          slowest = {
            name: traceName(trace),
            group,
            isRise,
            achieved_s: achieved,
            limit_s: limit,
            target_kpa_gauge: target,
            target_share: share,
            peak_kpa_gauge: isRise && sign * (peak - operating) > 1e-6 ? peak : null,
            t_s: times,
            pressure_kpa_gauge: cutValues,
            source_kpa_gauge: own
              ? times.map(() => own[g]!)
              : cut(response.t_s, response.source_pressure_kpa_gauge, from, length, period)
                  .cutValues,
          };
        }
      }
      return slowest ? [slowest] : [];
    });
  });
}
