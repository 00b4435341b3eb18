// Measured runs: read from JSON (measurement/1) or CSV, and what a diagnosis says of them.
import { signal } from '@preact/signals';

import type { FieldError } from './api';

export type ValveState = 'hold' | 'inflate' | 'deflate';

export interface Run {
  id: string;
  specimen?: string; // the piece of the actuator; left out: the common one
  blocked?: boolean;
  volume?: 'free' | 'imposed'; // imposed: channels.volume_ml drives it
  source_pressure_kpa_gauge?: number | string; // a text has its unit
  initial?: { pressure_kpa_gauge: number };
  valve: { t_s: number; state: ValveState; uncertainty_s?: number | string }[];
  t_s: number[];
  pressure_kpa_gauge: (number | null)[];
  channels?: {
    source_pressure_kpa_gauge?: (number | null)[];
    chambers?: Record<string, (number | null)[]>; // of several, but that of pressure_kpa_gauge
  };
  rig?: Partial<Rig>;
}

export interface Rig {
  actuator: {
    rest_volume_ml?: number;
    expansion_ratio?: number;
    operating_pressure_kpa_gauge?: number;
  };
  line: { sonic_conductance_dm3_per_s_bar?: number; critical_ratio?: number };
  supply: { kind: 'regulated' | 'measured' | 'compressor' | 'none' };
  chambers?: { name: string }[]; // in place of the actuator
  pressure_of?: string; // of which of them pressure_kpa_gauge is; the first
  [more: string]: unknown;
}

export interface Measurement {
  schema: 'measurement/1';
  name?: string;
  rig: Rig;
  relative_uncertainty?: Record<string, number | string>; // or "unknown"
  runs: Run[];
  holdout?: string[];
  assume?: string[]; // what suspect units and exchanged inputs are
  time_limit_s?: number; // of its diagnosis
}

export interface Estimate {
  value: number;
  ci95?: [number, number];
  identified?: boolean;
}

// A declared number as it was fitted.
export interface FittedNumber extends Estimate {
  declared: number;
  unit: string;
  specimen?: string | null; // whose it is, where each specimen has its own
  chamber?: string; // the same of several chambers
}

export interface ErrorReport {
  rms_kpa: number;
  rms_percent: number;
  peak_kpa: number;
  holdout_rms_kpa?: number | null;
  runs?: Record<string, number>;
  effects?: { id: string; parameters: Record<string, number | string> }[];
  factors?: Record<string, number>;
}

export type ModelName = 'declared' | 'before' | 'after' | 'learned';

// What a model of a diagnosis has of one run alone.
export interface RunNumbers {
  initial_pressure_kpa_gauge: number;
  initial_temperature_k: number;
  clock_s: number;
  valve_s?: number[]; // instants of the commands, where they are not exact
  fitted_alone?: string[]; // of a run held out
}

export interface FittedEffect {
  id: string;
  chamber?: string; // of several, where the effect is one of a single chamber
  words?: string; // what it does, in units for people
  parameters: Record<string, Estimate | string>;
}

export interface Experiment extends Partial<Run> {
  id: string;
  source_pressure_kpa_gauge?: number;
  t_end_s?: number;
  sample_hz?: number;
  measure?: string[];
  expected_difference_kpa?: number;
  expected_delta_bic?: number;
  why?: string;
}

export interface Discrepancy {
  equation: string;
  features: string[];
  learned: FittedEffect | null;
  effects?: FittedEffect[]; // as fitted beside the term
  rms_before_kpa: number;
  rms_after_kpa: number | null;
  holdout_before_kpa: number | null;
  holdout_after_kpa: number | null;
  places: { axis: string; where: string; share: number }[];
}

// A declared number that is found wrong.
export interface WrongNumber {
  name: string;
  declared: number;
  fitted: number;
  unit: string;
  deviation_sigma: number | null;
  instead_of: string[];
  specimen?: string | null; // the piece that has the number for itself; null: without a name
  chamber?: string; // the same of several chambers
  words?: string;
}

// A piece of the actuator, where runs name them, with what was fitted to its runs.
export interface Specimen {
  name: string | null; // null: of the runs that name none
  runs: string[];
  fitted: Record<string, FittedNumber>;
  words: string;
}

// A number of a part that the runs measure; of a pump one for each pressure of its table.
export interface MeasuredNumber {
  part: string;
  number: string;
  field: string;
  pressure_kpa_gauge?: number;
  declared: number;
  fitted: number;
  unit: string;
  uncertainty: number | null; // relative, one standard deviation
  interval_95: [number, number];
  refused: string | null;
}

// What was written into a part of the catalogue, or why nothing was.
export interface SavedPart {
  part: string;
  specimen: string | null; // the piece of its type
  numbers: {
    field: string;
    before: number;
    value: number;
    uncertainty: number;
    combined: boolean;
    contradiction: string | null;
    warning: string | null; // an estimate that was off
    written: boolean;
    pieces: number;
    spread: number | null; // between the pieces, relative
  }[];
  refused: string[];
  revision: { number: number; hash: string } | null;
}

export interface Diagnosis {
  schema: 'diagnosis/1';
  name?: string;
  verdict: 'adequate' | 'explained' | 'tie' | 'unexplained' | 'undecided';
  sentence: string;
  noise_kpa: number;
  declared: ErrorReport;
  before: ErrorReport;
  after: ErrorReport;
  learned?: ErrorReport | null;
  runs?: ({ id: string; held_out: boolean; left_out: number[]; copy_of?: string } & Partial<
    Record<ModelName, RunNumbers>
  >)[];
  held_out_fitted?: { run: string; numbers: string[] }[];
  effects: FittedEffect[];
  numbers?: WrongNumber[];
  specimens?: Specimen[];
  specimen_spread?: Record<string, number>; // standard deviation over the mean, by number
  measured?: MeasuredNumber[];
  measured_refused?: string[];
  saved_part?: SavedPart;
  bottles?: {
    specimen: string | null;
    rest_volume_ml: number;
    numbers: { number: string; fitted: number; agrees: boolean }[];
  }[]; // what other bottles say of the measured numbers
  measurement?: Measurement; // lists of more than 20,000 readings by their hash
  slips?: { what: string; assume: string }[]; // to be settled before an effect is named
  predicts_better?: boolean | null; // runs that no fit saw
  stability?: { change: string; delta_bic: number | null; holds: boolean }[];
  candidates: {
    effects: string[];
    laws: Record<string, string>;
    bic: number;
    delta_bic: number;
    rms_kpa: number;
    holdout_rms_kpa: number | null;
    converged: boolean;
    reason?: string | null; // why it is not named though it fits better than what is
  }[];
  tied: string[][];
  tied_laws: Record<string, string>[];
  tied_sets?: { effects: FittedEffect[]; numbers: WrongNumber[] }[]; // as each was fitted
  next_experiment: Experiment | null;
  reason?: string | null; // why a tie has none
  residual: {
    white: boolean | null;
    independent_of_inputs: boolean | null;
    phases: {
      run: string;
      phase: string;
      mean_kpa: number;
      trend_kpa_per_s: number;
      rms_kpa: number;
      start_s: number;
      end_s: number;
    }[];
  };
  fitted: Record<string, FittedNumber>;
  discrepancy: Discrepancy | null;
  unexplained_fraction: number;
  warnings: string[];
  series: {
    run: string;
    held_out: boolean;
    phase: string[];
    t_s: number[];
    measured_kpa: (number | null)[];
    declared_kpa: (number | null)[];
    before_kpa: (number | null)[];
    after_kpa: (number | null)[];
  }[];
  provenance: { files: { name: string; sha256: string }[] };
  revision: SavedModel | null; // what saving keeps
}

export interface SavedModel {
  effects: { id: string; parameters: Record<string, number | string> }[];
  factors: Record<string, number>;
  covariance: { parameters: string[]; matrix: number[][] };
  data: { name: string; sha256: string }[];
  tied?: string[][]; // of a tie the sets that did as well
}

// Of a CSV, before its numbers are written: those of another rig would pass for its own.
export const emptyRig = (): Rig => ({ actuator: {}, line: {}, supply: { kind: 'regulated' } });

// What a JSON file holds: a measurement, or the rig that a CSV was measured on.
export type Content =
  | { kind: 'measurement'; document: Measurement; text: string }
  | { kind: 'rig'; document: Pick<Measurement, 'rig'> & Partial<Measurement> };

export const isJson = (text: string): boolean => /^\s*[{[]/.test(text);

export function readJson(text: string): Content {
  const given = JSON.parse(text);
  const runs = given.runs as Run[] | undefined;
  const hasSamples = Array.isArray(runs) && runs.some((run) => Array.isArray(run.t_s));
  if (!hasSamples && (given.actuator || given.rig)) {
    return { kind: 'rig', document: given.rig ? given : { rig: given } };
  }
  if (given.schema !== 'measurement/1')
    throw new Error(`its schema is ${JSON.stringify(given.schema)}, not "measurement/1"`);
  if (!hasSamples) throw new Error('it has no runs');
  const broken = runs.find(
    (run) => !Array.isArray(run.t_s) || run.t_s.length !== run.pressure_kpa_gauge?.length,
  );
  if (broken) throw new Error(`run ${broken.id} has not as many pressures as times`);
  return { kind: 'measurement', document: given, text };
}

// The runs of CSV files with the document beside them, which holds the rig and what it says of each.
export const withRig = (runs: Run[], beside: Pick<Measurement, 'rig'> & Partial<Measurement>) => ({
  ...beside,
  schema: 'measurement/1' as const,
  runs: runs.map((run) => ({ ...beside.runs?.find((other) => other.id === run.id), ...run })),
});

// More runs for a measurement; ids that recur get a number. Runs of another rig carry it.
export function withRuns(data: Measurement, more: Run[], rig?: Rig): Measurement {
  const ids = new Set(data.runs.map((run) => run.id));
  const runs = more.map((run) => {
    let id = run.id;
    for (let n = 2; ids.has(id); ++n) id = `${run.id}-${n}`;
    ids.add(id);
    const isOther = rig && JSON.stringify(rig) !== JSON.stringify(data.rig);
    return { ...run, id, ...(isOther && { rig: { ...rig, ...run.rig } }) };
  });
  return { ...data, runs: [...data.runs, ...runs] };
}

const phaseOf: Record<ValveState, string> = {
  inflate: '--phase-inflate',
  hold: '--phase-hold',
  deflate: '--phase-deflate',
};

export interface Shade {
  from: number;
  to: number;
  colour: string;
}

// Shades behind a plot: what the valve was told, but for commands whose instant a file calls
// unknown.
export const shadesOf = (valve: Run['valve'] | undefined, end: number): Shade[] =>
  (valve ?? [])
    .filter((command) => Number.isFinite(command.t_s))
    .map((command, i, all) => ({
      from: command.t_s,
      to: all[i + 1]?.t_s ?? end,
      colour: phaseOf[command.state],
    }));

// Seconds that a diagnosis may take where nothing is said, and one that writes into a part: a pump's
// dozen numbers take a minute and more.
export const usualLimitS = 60;
export const partLimitS = 300;

// What the page has open, the file's own text while it is as it was, and what the service finds
// wrong with it.
export const measurement = signal<Measurement | null>(null);
export const originalText = signal<string | null>(null);
export const measurementErrors = signal<FieldError[]>([]);
