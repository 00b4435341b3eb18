// Sweeps: the requirements with one value changed again and again, searched as one.
import { signal } from '@preact/signals';

import { ask, get, post } from './api';
import type { JobStatus, Requirements } from './types';

export interface Sweep {
  id: string;
  name: string;
  status: JobStatus;
  submitted_at: string;
  ended_at: string | null;
  jobs: Record<JobStatus, number>;
  links: { self: string; table: string };
}

export interface SweepRow {
  name: string;
  status: JobStatus | null; // null: its job is no longer kept
  values: (number | string | boolean | null)[];
  outcome: 'optimal' | 'feasible' | 'infeasible' | 'cancelled' | null;
  configuration: string | null;
  objective: number | null;
  mass_kg: number | null;
  volume_l: number | null;
  cost_eur: number | null;
  energy_wh: number | null;
  parts: string[] | null;
  lower_bound: number | null;
  gap: number | null;
  conflict: string | null;
  seconds: number | null;
  detail: string | null;
  link: string | null;
}

export interface SweepTable {
  name: string;
  objective: Requirements['objective'] | null;
  varied: string[];
  rows: SweepRow[];
}

export const sweepList = signal<Sweep[] | null>(null);

export async function refreshSweeps(): Promise<void> {
  sweepList.value = (await get<{ sweeps: Sweep[] }>('/v1/sweeps')).sweeps;
}

// Pointers to the numbers of a document, in its order.
export function numbersOf(document: unknown, pointer = ''): string[] {
  if (typeof document === 'number') return [pointer];
  if (document === null || typeof document !== 'object') return [];
  return Object.entries(document).flatMap(([name, value]) =>
    numbersOf(value, `${pointer}/${name.replaceAll('~', '~0').replaceAll('/', '~1')}`),
  );
}

// A copy of the document with another value at the pointer.
function withValue(document: unknown, steps: string[], value: number): unknown {
  const [step, ...rest] = steps;
  if (step === undefined) return value;
  if (Array.isArray(document))
    return document.map((one, i) => (String(i) === step ? withValue(one, rest, value) : one));
  const fields = document as Record<string, unknown>;
  return { ...fields, [step]: withValue(fields[step], rest, value) };
}

// What a patch says of the field: a list is said as a whole (RFC 7396), of an object only the field.
function mergeFor(document: unknown, steps: string[], value: number): unknown {
  const [step, ...rest] = steps;
  if (step === undefined || Array.isArray(document)) return withValue(document, steps, value);
  const inner = (document as Record<string, unknown>)[step];
  return { [step]: mergeFor(inner, rest, value) };
}

// The values that are typed, or so many from one to another; none where they make no sense.
export function valuesOf(list: string): number[] {
  const texts = list.split(/[;\s]+/).filter(Boolean);
  const values = texts.map(Number);
  return values.every(Number.isFinite) ? [...new Set(values)] : [];
}

export function evenly(from: number, to: number, steps: number): number[] {
  if (![from, to].every(Number.isFinite) || !Number.isInteger(steps) || steps < 2) return [];
  const at = (i: number) => from + ((to - from) * i) / (steps - 1);
  return [...new Set(Array.from({ length: steps }, (_, i) => Number(at(i).toPrecision(6))))];
}

export async function startSweep(
  requirements: Requirements,
  pointer: string,
  label: string,
  values: number[],
): Promise<string> {
  const steps = pointer
    .split('/')
    .slice(1)
    .map((step) => step.replaceAll('~1', '/').replaceAll('~0', '~'));
  const accepted = await post<{ id: string }>('/v1/sweeps', {
    schema: 'sweep/1',
    name: [requirements.name, label].filter(Boolean).join(': ').slice(0, 200),
    requirements,
    patches: values.map((value) => ({
      name: String(value),
      merge: mergeFor(requirements, steps, value),
    })),
  });
  return accepted.id;
}

export async function cancelSweep(id: string): Promise<void> {
  await ask('DELETE', `/v1/sweeps/${id}`);
}
