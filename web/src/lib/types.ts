// The service's documents, as far as the page reads them. Units are in the names.
import type { Remarked } from './understood';

export interface Group {
  name: string;
  count: number;
  rest_volume_ml?: number;
  expansion_ratio?: number;
  pressure_volume?: { pressure_kpa_gauge: number; volume_ml: number }[];
  cylinder?: Record<string, unknown>;
  muscle?: Record<string, unknown>;
  pouch?: Record<string, unknown>;
  body?: Record<string, unknown>;
  operating_pressure_kpa_gauge: number;
  low_pressure_kpa_gauge?: number | null;
  tube_length_m: number;
  fittings_per_line?: number;
  rise_time_s_max?: number | null;
  fall_time_s_max?: number | null;
  pressure_kpa_gauge_max?: number | null;
  pressure_kpa_gauge_min?: number | null;
  relative_uncertainty?: { rest_volume?: number; expansion_ratio?: number };
  phase?: number | number[] | string;
  inflate_fraction?: number;
  strokes_per_period?: number;
}

export type Configuration =
  | 'cylinder'
  | 'co2'
  | 'compressor'
  | 'mains'
  | 'tank'
  | 'tank_and_pump'
  | 'direct_pump'
  | 'vacuum_pump'
  | 'direct_vacuum_pump'
  | 'ejector'
  | 'direct_ejector';
export type Amount = 'mass_kg' | 'volume_l' | 'cost_eur' | 'energy_wh';

// Where a number comes from, and how far it is trusted.
export type Trust = 'measured' | 'datasheet' | 'third_party' | 'derived' | 'estimated';

export type Regulation = 'shared' | 'per_group' | 'any';
export interface Mains {
  pressure_kpa_gauge: number;
  flow_l_per_min_anr_max?: number;
}
export type PumpFeed = 'shared' | 'per_group' | 'per_actuator';
export type PowerKind = 'battery' | 'wall' | 'robot';

export interface Requirements {
  schema: 'requirements/1';
  name?: string;
  note?: unknown;
  actuators: Group[];
  duty: { frequency_hz: number; actuations: number; simultaneous?: boolean };
  rise?: { to_fraction: number };
  fall?: { to_fraction: number };
  supply?: {
    configurations?: Configuration[];
    mains?: Mains;
    pumps?: PumpFeed;
    hold_on?: boolean; // pumps without a reservoir run on while actuators hold
    regulation?: Regulation;
    vacuum?: {
      configurations?: string[];
      vacuum_kpa_gauge_min?: number | null;
      mains?: Pick<Mains, 'pressure_kpa_gauge'>;
    };
    source_pressure_kpa_gauge_max?: number | null;
    tank_fill_kpa_gauge_max?: number | null;
    mass_kg_max?: number | null;
    volume_l_max?: number | null;
    cost_eur_max?: number | null;
    parts?: 'any' | 'orderable';
    power?: {
      kind: PowerKind;
      voltage_v?: number;
      energy_wh_max?: number;
      current_a_max?: number;
    };
  };
  ambient?: { pressure_kpa_abs: number; temperature_k: number };
  objective?: { minimize?: Amount | Partial<Record<Amount, number>>; pareto?: Amount[] };
  ranking?: {
    count?: number;
    time_limit_s?: number;
    probability_min?: number;
    solver?: string;
    list?: 'kinds' | 'combinations';
    per_source?: number;
  };
  prices?: 'known' | 'lower_bound';
  guarantee?: boolean | { tolerance?: Partial<Record<Trust, number>> };
  limits?: Record<string, number>;
  require?: Record<string, string[]>;
  exclude?: string[];
  own?: string[]; // at hand, free
  robust?: Record<string, unknown>;
  explain?: { prices?: boolean; ranks?: number; time_limit_s?: number };
  model?: string;
}

export interface PartRow {
  family: string;
  id: string;
  manufacturer: string;
  part_number: string;
  group: string | null;
  quantity: number;
  unit: 'm' | 'piece';
  mass_kg: number;
  volume_l: number;
  cost_eur: number | null;
}

// A part that is sold in packs: what all its rows need, and what is bought.
export interface PackRow {
  family: string;
  id: string;
  unit: 'm' | 'piece';
  quantity: number;
  pack: number;
  packs: number;
  left_over: number;
  cost_eur: number;
}

export interface Margin {
  requirement: string;
  required: number;
  achieved: number;
  relative_margin: number;
  binding: boolean;
}

export interface Trace {
  t_s: number[];
  groups: { name: string; count?: number; phase?: number; pressure_kpa_gauge: (number | null)[] }[];
  source_pressure_kpa_gauge: (number | null)[];
}

export interface Design {
  rank: number;
  configuration: Configuration;
  objective: number;
  parts: PartRow[];
  packs?: PackRow[]; // none in answers of releases before
  settings: {
    source_pressure_kpa_gauge: number;
    valve_duty: number | null;
    valve_duty_groups?: number[];
    compressor_duty: number | null;
    reservoir_volume_ml: number | null;
    tank_fill_kpa_gauge?: number | null;
    pump_stop_kpa_gauge?: number; // of a pump that goes on filling the tank
    vacuum_kpa_gauge?: number; // beside a pressure the weakest that it comes to
    vacuum_stop_kpa_gauge?: number; // where pumps keep it beside a pressure, with the next two
    vacuum_duty?: number;
    vacuum_reservoir_volume_ml?: number;
    group_pressure_kpa_gauge?: number[]; // where each group has a regulator of its own
    power?: { kind: PowerKind; voltage_v: number | null } | null;
  };
  totals: {
    mass_kg: number;
    volume_l: number;
    cost_eur: number | null;
    energy_wh: number;
    cost_eur_min?: number;
  };
  performance: {
    groups: {
      name: string;
      rise_time_s: number;
      fall_time_s: number;
      inflate_time_s?: number;
      frequency_hz_max: number;
      peak_kpa_gauge?: number;
    }[];
    frequency_hz_sustained: number;
    air_per_actuation_l_anr: number;
    air_total_l_anr: number;
    run_time_s: number;
    compressed_air_l_per_min_anr?: number | null;
  };
  margins: Margin[];
  data_quality: { mass_share_estimated: number; estimated: string[]; flow_estimated: boolean };
  response: Trace;
  kind?: {
    configuration: Configuration;
    sources: string[];
    regulators: string[];
    valves: string[];
  };
  variants?: {
    found: number;
    complete: boolean;
    differ_in: string[];
    examples: { objective: number; parts: PartRow[] }[];
  };
  guarantee?: { mass_kg_max: number; volume_l_max: number };
  robustness?: { probability: number; probability_ci95: [number, number]; share_rank_1: number };
  // What would have to change for it to be first.
  to_be_first?: {
    objective_gap: number;
    parts: { family: string; id: string; reduction_share: number; confirmed: boolean }[];
    requirements: {
      requirement: string;
      required: number;
      tightened: number;
      confirmed: boolean;
    }[];
    complete: boolean;
  };
}

// The best design of some, of a configuration say, or why there is none.
export interface Best {
  configuration: Configuration | null;
  status: Answer['status'];
  objective: number | null;
  relative_distance: number | null;
  lower_bound: number | null;
  design: (Omit<Design, 'rank'> & { rank: number | null }) | null;
  conflict: ConflictEntry[];
}

export interface Proof {
  combinations: string;
  complete: boolean;
  lower_bound: number | null;
  gap: number | null;
  proved_designs?: number; // the first so many
  evaluated: number | string;
  simulated: number;
  undecided: number;
  pruned: Record<string, string>;
}

export interface Effect {
  id: string;
  parameters: Record<string, number | string>;
}

// A field that cannot be met beside the others of its conflict; no number: `required` is null.
export interface ConflictEntry {
  requirement: string;
  required: number | null;
  best: number | null;
  relaxation: number | null;
  proved: boolean;
}

// One change of those that make a problem feasible; to be dropped where there is no value.
export interface Relaxed {
  requirement: string;
  required: number | null;
  value: number | null;
}

// A test of one part, and what it would save of the best guaranteed design.
export interface PartTest {
  part: string;
  family: string;
  protocol: string;
  numbers: string[];
}
export interface Saving extends PartTest {
  saving: number | null;
  saving_share: number | null;
  saving_interval?: [number, number];
  with?: PartTest;
}

// Tests after which a design on paper, by its rank, is a guaranteed one.
export interface SavingTogether {
  rank: number;
  tests: PartTest[];
  objective: number;
  saving_share: number;
}

// How a part is measured, and how precise that will be.
export interface ProtocolTest {
  protocol: string;
  numbers: string[];
  steps: string[];
  equipment: {
    bottle_l: number;
    check_bottle_l: number; // of another bottle, for one run
    source_pressure_kpa_gauge: number | null;
    sampling_hz: number;
    duration_s: number;
    repeats: number;
  } | null;
  recording: { template: unknown; columns: string[]; command: string } | null;
  precision: {
    field: string;
    pressure_kpa_gauge?: number;
    uncertainty: number; // relative, one standard deviation
    from_noise: number;
    from_rig: number;
    told: boolean;
    how: string;
  }[];
  warnings: string[];
}
export interface Protocol {
  schema: 'protocol/1';
  part: string;
  tests: ProtocolTest[];
}

export interface Answer extends Remarked {
  schema: 'designs/1';
  plenum?: string; // version
  name?: string;
  status: 'optimal' | 'feasible' | 'infeasible' | 'cancelled';
  designs: Design[];
  list?: 'kinds' | 'combinations';
  by_configuration?: Best[];
  orderable?: Best;
  price_basis?: 'known' | 'lower_bound';
  left_out?: Record<string, string[] | Record<string, number>>;
  hints?: { configuration: Configuration; objective: number; words: string }[];
  best_on_measured_flow: number | null;
  proof: Proof;
  front?: { objectives: Partial<Record<Amount, number>>; rank: number }[];
  front_proof?: { complete: boolean; searches: number; proved: number; unexplored: unknown[] };
  conflicts?: ConflictEntry[][];
  relaxation?: Relaxed[];
  conflicts_complete?: boolean;
  prices?: {
    requirement: string;
    required: number;
    loosened: number;
    saving: number | null;
    saving_share: number | null;
    status: string;
  }[];
  robust?: { draws: number; left_out?: number; seconds?: number };
  guarantee?: {
    tolerance: Record<Trust, number>;
    objective_on_paper: number | null;
    objective_guaranteed: number | null;
    costs: number | null;
    costs_share: number | null;
  };
  on_paper?: Pick<Answer, 'status' | 'designs' | 'proof'>;
  measure_first?: Saving[];
  measure_first_complete?: boolean;
  measure_together?: SavingTogether[];
  seconds: number;
  model?: { name: string; version: number; proved: boolean; effects: Effect[] };
  against_nominal?: {
    status: string;
    designs: {
      rank: number;
      nominal_rank: number | null;
      nominal: { objective: number } | null;
    }[];
    dropped: {
      nominal_rank: number;
      objective: number;
      parts: string[];
      // Missed at its own settings, a sentence, or nothing: others are better now.
      why: { requirement: string; required: number; achieved: number } | string | null;
    }[];
  };
  requirements: Requirements; // in numbers
  asked?: Requirements; // as they were written
  catalogue_revision?: { number: number; hash: string };
}

export interface Progress {
  seconds: number;
  evaluated: number | string;
  open?: number; // while it runs
  best: number | null;
  lower_bound: number | null;
  objective?: Requirements['objective']; // what they are amounts of
  note?: unknown; // on the requirements
  status?: 'infeasible'; // proved; the reasons are looked for
  outcome?: Answer['status']; // in the end
}

export type JobStatus = 'queued' | 'running' | 'done' | 'cancelled' | 'failed';

// What a diagnosis is at.
export interface Doing {
  seconds: number;
  share: number;
  doing: string;
  outcome?: string; // the verdict, in the end
}

export interface Job<Result = Answer, Report = Progress> {
  id: string;
  name: string;
  status: JobStatus;
  submitted_at: string;
  attempts: number;
  crashes: number; // times that its computation ended the service
  last_crash: string | null;
  catalogue_revision: { number: number; hash: string };
  progress: Report | null;
  result?: Result | null;
  detail?: string;
  links: { self: string; events: string };
}

export interface CurvePoint {
  pressure_kpa_gauge: number;
  free_air_l_per_min: number;
  current_a?: number;
}

export interface Provenance {
  kind: 'datasheet' | 'third_party' | 'derived' | 'estimated' | 'measured';
  source: string;
  uncertainty?: number; // relative, one standard deviation
}

export interface Offer {
  supplier: string;
  price: number; // of a pack, net of tax
  currency: string;
  pack: number;
  date: string;
  link: string;
}

export interface Document {
  link: string;
  sha256: string;
}
// As the service lists it: with its file, where that is kept.
export interface DocumentOfPart extends Document {
  file: { media_type: string; bytes: number; href: string } | null;
}

export interface Part {
  id: string;
  family: string;
  manufacturer: string;
  part_number: string;
  origin: string;
  notes: string;
  series: string;
  orderable: boolean | null; // null: not known
  aliases: string[];
  offers: Offer[];
  documents: Document[];
  curve?: CurvePoint[];
  provenance: Record<string, Provenance>;
  [field: string]: unknown;
}

export interface NumberField {
  name: string;
  min: number;
  max: number;
  required: boolean;
  meaning: string;
}
export interface TextField {
  name: string;
  allowed: string[];
  required: boolean;
  meaning: string;
}
export interface Family {
  name: string;
  numbers: NumberField[];
  texts: TextField[];
  has_curve: boolean;
}

export interface Response {
  schema: 'response/1';
  status: string;
  detail?: string;
  t_s: number[];
  groups: { name: string; pressure_kpa_gauge: (number | null)[]; volume_ml: number[] }[];
  source_pressure_kpa_gauge: (number | null)[];
  performance: {
    groups: {
      name: string;
      rise_time_s: number | null;
      fall_time_s: number | null;
      frequency_hz_max: number | null;
    }[];
  };
}
