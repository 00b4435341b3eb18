// Recordings as CSV: the service reads them; what it understood and asks, and the answers.
import { ask } from './api';
import type { Measurement, Run, ValveState } from './measurement';

export interface RecordingQuestion {
  option: 'encoding' | 'delimiter' | 'decimal' | 'header_row' | 'column' | 'valve';
  heading: string | null; // of a column, or the id of a run
  question: string;
  answers: string[];
}

export interface RecordingColumn {
  key: string;
  heading: string;
  field: string | null;
  unit: string | null;
  factor: number | null;
  offset: number | null;
  meaning: string | null;
  first: string[];
}

export interface UnderstoodRecording {
  encoding: string | null;
  delimiter: string | null;
  decimal: string | null;
  heading_line: number | null;
  columns: RecordingColumn[];
  runs: { id: string; readings: number; missing: number }[];
  notes: string[];
}

export interface TableAnswers {
  encoding?: string;
  delimiter?: string;
  decimal?: string;
  columns?: Record<string, string>; // "pressure_kpa_gauge [bar]"; empty: left out
}

interface Content {
  csv?: string;
  csv_base64?: string;
}

export interface Recording {
  name: string;
  content: Content;
  rig: object; // of the request: a rig, or a measurement without readings
  answers: TableAnswers;
  understood: UnderstoodRecording;
  questions: RecordingQuestion[];
  measurement: Measurement | null; // null while questions are open
}

export const recordingFields = [
  't_s',
  'date',
  'run',
  'specimen',
  'valve',
  'inflate_valve',
  'deflate_valve',
  'pressure_kpa_gauge',
  'source_pressure_kpa_gauge',
  'inlet_pressure_kpa_gauge',
  'temperature_k',
  'volume_ml',
  'flow_l_per_min_anr',
  'valve_opening',
  'source_setpoint_kpa_gauge',
];

// Text where the bytes are UTF-8, which is shorter; else the bytes.
async function contentOf(file: File): Promise<Content> {
  const bytes = new Uint8Array(await file.arrayBuffer());
  try {
    return { csv: new TextDecoder('utf-8', { fatal: true }).decode(bytes) };
  } catch {
    let text = '';
    for (let i = 0; i < bytes.length; i += 8192)
      text += String.fromCharCode(...bytes.subarray(i, i + 8192));
    return { csv_base64: btoa(text) };
  }
}

type Answer = Pick<Recording, 'understood' | 'questions' | 'measurement'>;

async function read(content: Content, rig: object, table: TableAnswers): Promise<Answer> {
  const body = { schema: 'recording/1', ...content, rig, table };
  return (await ask<Answer>('POST', '/v1/measurements', { body })).body;
}

export async function openRecording(file: File, rig: object): Promise<Recording> {
  const content = await contentOf(file);
  const answer = await read(content, rig, {});
  return { name: file.name, content, rig, answers: {}, ...answer };
}

export async function answered(recording: Recording, answers: TableAnswers): Promise<Recording> {
  return { ...recording, answers, ...(await read(recording.content, recording.rig, answers)) };
}

export const isOpen = ({ questions }: Recording): boolean =>
  questions.some((one) => one.option !== 'valve');

// The runs of a recording, ready for a measurement; those without a valve have an empty one.
export const runsOf = (recording: Recording): Run[] =>
  (recording.measurement?.runs ?? []).map((run) => ({ ...run, valve: run.valve ?? [] }));

// What the service suggests for a run without a valve.
export function suggestedValve(recordings: Recording[], id: string): Run['valve'] | null {
  for (const { questions } of recordings)
    for (const one of questions)
      if (one.option === 'valve' && one.heading === id && one.answers[0])
        return JSON.parse(one.answers[0]) as Run['valve'];
  return null;
}

export const splitField = (target: string): { field: string; unit: string } => {
  const [, field = target, unit = ''] = /^([^[]*?)\s*(?:\[(.*)\])?$/.exec(target) ?? [];
  return { field, unit };
};

export const valveStates: ValveState[] = ['inflate', 'hold', 'deflate'];
