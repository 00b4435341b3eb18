// Measured runs: read from JSON (measurement/1) or CSV, and what a diagnosis says of them.

export type ValveState = 'hold' | 'inflate' | 'deflate';

export interface Run {
  id: string;
  blocked?: boolean;
  source_pressure_kpa_gauge?: number;
  initial?: { pressure_kpa_gauge: number };
  valve: { t_s: number; state: ValveState }[];
  t_s: number[];
  pressure_kpa_gauge: (number | null)[];
  channels?: Record<string, (number | null)[]>;
}

export interface Rig {
  actuator: { rest_volume_ml: number; expansion_ratio: number; operating_pressure_kpa_gauge: number };
  line: { sonic_conductance_dm3_per_s_bar: number; critical_ratio: number };
  supply: { kind: 'regulated' | 'measured' | 'compressor' | 'none' };
  [more: string]: unknown;
}

export interface Measurement {
  schema: 'measurement/1';
  name?: string;
  rig: Rig;
  relative_uncertainty?: Record<string, number | 'unknown'>;
  runs: Run[];
  holdout?: string[];
}

export interface Estimate {
  value: number;
  ci95?: [number, number];
  identified?: boolean;
}

export interface ErrorReport {
  rms_kpa: number;
  rms_percent: number;
  peak_kpa: number;
  holdout_rms_kpa?: number | null;
  runs?: Record<string, number>;
}

export interface Diagnosis {
  schema: 'diagnosis/1';
  verdict: 'adequate' | 'explained' | 'tie' | 'unexplained' | 'undecided';
  sentence?: string;
  noise_kpa: number;
  declared?: ErrorReport;
  before: ErrorReport;
  after: ErrorReport;
  effects: { id: string; parameters: Record<string, Estimate | string> }[];
  candidates: { effects: string[]; bic: number; delta_bic: number; rms_kpa: number; holdout_rms_kpa?: number | null }[];
  tied: string[][];
  next_experiment: {
    blocked?: boolean;
    source_pressure_kpa_gauge?: number;
    valve?: { t_s: number; state: ValveState }[];
    t_end_s?: number;
    measure?: string[];
    expected_difference_kpa?: number;
    why?: string;
  } | null;
  residual: {
    white: boolean;
    independent_of_inputs: boolean;
    phases: { run: string; phase: string; mean_kpa: number; trend_kpa_per_s: number; rms_kpa?: number; start_s?: number; end_s?: number }[];
  };
  fitted: Record<string, Estimate>;
  discrepancy?: { places?: { axis: string; where: string; share: number }[] } | null;
  unexplained_fraction: number;
  warnings?: string[];
  series?: {
    run: string;
    phase: string[];
    t_s: number[];
    measured_kpa: (number | null)[];
    before_kpa: (number | null)[];
    after_kpa: (number | null)[];
  }[];
}

const channelNames = ['source_pressure_kpa_gauge', 'inlet_pressure_kpa_gauge', 'temperature_k', 'volume_ml', 'flow_l_per_min_anr'];
const states = new Set(['hold', 'inflate', 'deflate']);

// Long form: run,t_s,valve,pressure_kpa_gauge and channels. Throws a sentence with the line.
export function readCsv(text: string): Run[] {
  const lines = text.split(/\r?\n/).filter((line) => line.trim() && !line.startsWith('#'));
  const head = (lines[0] ?? '').split(',').map((name) => name.trim());
  for (const name of ['run', 't_s', 'valve', 'pressure_kpa_gauge']) {
    if (!head.includes(name)) throw new Error(`the CSV needs a column ${name}; it has ${head.join(', ')}`);
  }
  const column = (name: string) => head.indexOf(name);
  const runs = new Map<string, Run>();
  const number = (cell: string | undefined, line: number, name: string): number | null => {
    if (cell === undefined || cell.trim() === '' || cell.trim() === 'nan') return null;
    const value = Number(cell);
    if (!Number.isFinite(value)) throw new Error(`line ${line}: ${name} is "${cell}", not a number`);
    return value;
  };
  lines.slice(1).forEach((line, i) => {
    const cells = line.split(',').map((cell) => cell.trim());
    const id = cells[column('run')] || 'run';
    const at = number(cells[column('t_s')], i + 2, 't_s');
    const state = cells[column('valve')] ?? '';
    if (at === null) throw new Error(`line ${i + 2}: t_s is missing`);
    if (!states.has(state)) throw new Error(`line ${i + 2}: valve is "${state}", not hold, inflate or deflate`);
    let run = runs.get(id);
    if (!run) runs.set(id, (run = { id, valve: [], t_s: [], pressure_kpa_gauge: [] }));
    if (run.t_s.length > 0 && at <= run.t_s[run.t_s.length - 1]!) throw new Error(`line ${i + 2}: t_s must rise within run ${id}`);
    if (run.valve[run.valve.length - 1]?.state !== state) run.valve.push({ t_s: at, state: state as ValveState });
    run.t_s.push(at);
    run.pressure_kpa_gauge.push(number(cells[column('pressure_kpa_gauge')], i + 2, 'pressure_kpa_gauge'));
    for (const name of channelNames) {
      if (column(name) < 0) continue;
      ((run.channels ??= {})[name] ??= []).push(number(cells[column(name)], i + 2, name));
    }
  });
  if (runs.size === 0) throw new Error('the CSV has no rows');
  return [...runs.values()];
}

export const plainRig = (): Rig => ({
  actuator: { rest_volume_ml: 50, expansion_ratio: 2, operating_pressure_kpa_gauge: 100 },
  line: { sonic_conductance_dm3_per_s_bar: 0.05, critical_ratio: 0.3 },
  supply: { kind: 'regulated' },
});

// `name` is the file's; a CSV gets a rig to be filled in.
export function readMeasurement(name: string, text: string): Measurement {
  const title = name.replace(/\.[^.]*$/, '');
  if (!text.trimStart().startsWith('{')) return { schema: 'measurement/1', name: title, rig: plainRig(), runs: readCsv(text) };
  const given = JSON.parse(text) as Measurement;
  if (given.schema !== 'measurement/1') throw new Error(`its schema is ${JSON.stringify(given.schema)}, not "measurement/1"`);
  if (!Array.isArray(given.runs) || given.runs.length === 0) throw new Error('it has no runs');
  const broken = given.runs.find((run) => !Array.isArray(run.t_s) || run.t_s.length !== run.pressure_kpa_gauge?.length);
  if (broken) throw new Error(`run ${broken.id} has not as many pressures as times`);
  return { ...given, name: given.name ?? title };
}

const phaseOf: Record<ValveState, string> = { inflate: '--phase-inflate', hold: '--phase-hold', deflate: '--phase-deflate' };

// Shades behind a plot: what the valve was told.
export function bandsOf(run: Run | undefined, end: number): { from: number; to: number; colour: string }[] {
  return (run?.valve ?? []).map((command, i, all) => ({ from: command.t_s, to: all[i + 1]?.t_s ?? end, colour: phaseOf[command.state] }));
}

const effectWords: Record<string, string> = {
  leak: 'a leak', inertia: 'inertia of the wall', creep: 'creep of the wall', hysteresis: 'hysteresis', heat_transfer: 'heat transfer to the wall',
  valve_delay: 'a delay of the valve', valve_ramp: 'a slow valve', dead_volume: 'dead volume', supply_droop: 'a drooping supply',
  exhaust_restriction: 'a restricted exhaust', nonlinear_compliance: 'a bent volume law', sensor_lag: 'lag of the sensor', sensor_offset: 'offset of the sensor',
  sensor_gain: 'gain of the sensor', cracking_pressure: 'a cracking pressure', line_dynamics: 'dynamics of the line', directional_conductance: 'a line that conducts better one way',
};

export const effectName = (id: string): string => effectWords[id] ?? id.replaceAll('_', ' ');

// The verdict in one sentence, where the service gives none.
export function verdictSentence(d: Diagnosis): string {
  if (d.sentence) return d.sentence;
  const names = d.effects.map((effect) => effectName(effect.id)).join(' and ');
  switch (d.verdict) {
    case 'adequate':
      return 'The model describes the measurement within its noise; nothing is missing.';
    case 'explained':
      return `The model lacks ${names}.`;
    case 'tie':
      return `${d.tied.map((set) => set.map(effectName).join(' and ')).join(', or ')} explain it equally well; one more experiment would tell.`;
    case 'unexplained':
      return 'Something is left that no known effect accounts for.';
    case 'undecided':
      return 'It could not be decided.';
  }
}
