// Sweeps: the requirements with one value changed again and again, searched as one.
import { signal } from '@preact/signals';

import { ask, get, post } from './api';
import type { JobStatus, Requirements } from './types';
import { namesUnit } from './understood';

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

export const stepsOf = (pointer: string): string[] =>
  pointer
    .split('/')
    .slice(1)
    .map((step) => step.replaceAll('~1', '/').replaceAll('~0', '~'));

// Pointers to the numbers of a document, in its order; also to those that are typed with a unit.
export function numbersOf(document: unknown, pointer = ''): string[] {
  if (typeof document === 'number') return [pointer];
  if (typeof document === 'string') return namesUnit(pointer.split('/').pop()!) ? [pointer] : [];
  if (document === null || typeof document !== 'object') return [];
  return Object.entries(document).flatMap(([name, value]) =>
    numbersOf(value, `${pointer}/${name.replaceAll('~', '~0').replaceAll('/', '~1')}`),
  );
}

// A copy of the document with another value at the pointer.
export function withValue(document: unknown, steps: string[], value: number | string): unknown {
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

export async function startSweep(
  requirements: Requirements,
  pointer: string,
  label: string,
  values: { name: string; value: number }[],
): Promise<string> {
  const steps = stepsOf(pointer);
  const accepted = await post<{ id: string }>('/v1/sweeps', {
    schema: 'sweep/1',
    name: [requirements.name, label].filter(Boolean).join(': ').slice(0, 200),
    requirements,
    patches: values.map(({ name, value }) => ({
      name,
      merge: mergeFor(requirements, steps, value),
    })),
  });
  return accepted.id;
}

export async function cancelSweep(id: string): Promise<void> {
  await ask('DELETE', `/v1/sweeps/${id}`);
}
