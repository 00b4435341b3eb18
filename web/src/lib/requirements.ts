// The requirements being written: one document, kept in the address, checked as it changes.
import { batch, computed, effect, signal } from '@preact/signals';

import crawler from '../../../examples/crawler.json';
import exosuit from '../../../examples/exosuit.json';
import gripper from '../../../examples/gripper.json';
import { asProblem, type FieldError, post, type Problem } from './api';
import { route, setQuery } from './route';
import type { Group, Requirements } from './types';
import { inNumbers, isOf, type Remarked, type Understood } from './understood';
import { ambientKpa } from './units';

// Limits that are the usual ones anyway are left out, so that they follow an edited pressure.
function withoutUsualLimits(document: Requirements): Requirements {
  const isUsual = ({ pressure_kpa_gauge_max: highest, operating_pressure_kpa_gauge: p }: Group) =>
    typeof highest === 'number' && Math.abs(highest / p - 1.05) < 1e-9;
  const actuators = document.actuators.map((group) => {
    const { pressure_kpa_gauge_max: _, ...others } = group;
    return isUsual(group) ? others : group;
  });
  return { ...document, actuators };
}

export const presets: Record<string, Requirements> = Object.fromEntries(
  Object.entries({ exosuit, gripper, crawler }).map(([name, document]) => [
    name,
    withoutUsualLimits(document as Requirements),
  ]),
);

const bytesOf = (text: string): string => String.fromCharCode(...new TextEncoder().encode(text));

export function encode(document: Requirements): string {
  return btoa(bytesOf(JSON.stringify(document)))
    .replaceAll('+', '-')
    .replaceAll('/', '_')
    .replace(/=+$/, '');
}

export function decode(text: string): Requirements | null {
  try {
    const bytes = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
    const json = new TextDecoder().decode(Uint8Array.from(bytes, (c) => c.charCodeAt(0)));
    const document = JSON.parse(json);
    return Array.isArray(document?.actuators) && document.duty ? document : null;
  } catch {
    return null;
  }
}

// What is written here outlives a reload of the page; a new window begins with the example.
const kept = 'plenum-requirements';
const start = route.value.query.get('r');
const asked = start ? decode(start) : null;
const before = asked ? null : decode(sessionStorage.getItem(kept) ?? '');
export const requirements = signal<Requirements>(asked ?? before ?? presets.exosuit!);
// Whether they are as they were before the page was loaded again, and not those of the address.
export const areRestored = computed(() => before !== null && requirements.value === before);
export const fieldErrors = signal<FieldError[]>([]);
export type Validity = 'checking' | 'valid' | 'invalid' | 'unknown';
export const validity = signal<Validity>('checking');
export const whyUnknown = signal('');
// Of the requirements as they were when they were last valid.
export const understood = signal<Understood[]>([]);
export const warnings = signal<{ pointer: string; detail: string }[]>([]);
export const numbers = computed(() => inNumbers(requirements.value, understood.value));

type Path = (string | number)[];

export const valueAt = (document: unknown, path: Path): unknown =>
  path.reduce<unknown>(
    (at, step) => (at as Record<string | number, unknown> | undefined)?.[step],
    document,
  );

// Sets the value at a path such as ['duty', 'frequency_hz'] in a copy; undefined removes it.
export function edit(path: Path, value: unknown): void {
  const next = structuredClone(requirements.peek()) as unknown as Record<string | number, unknown>;
  let at = next;
  for (const step of path.slice(0, -1)) at = (at[step] ??= {}) as Record<string | number, unknown>;
  const last = path[path.length - 1]!;
  if (value === undefined) delete at[last];
  else at[last] = value;
  requirements.value = next as unknown as Requirements;
}

export function load(document: Requirements): void {
  batch(() => {
    requirements.value = structuredClone(document);
    validity.value = 'checking';
  });
}

export const errorAt = (pointer: string): string | undefined =>
  fieldErrors.value.find((error) => error.pointer === pointer)?.detail;

// What was understood of the text at a pointer, as it is now.
export const understoodAt = (pointer: string): Understood | undefined =>
  understood.value.find((row) => row.pointer === pointer && isOf(requirements.value, row));

export const warningAt = (pointer: string): string | undefined =>
  warnings.value.find((warning) => warning.pointer === pointer)?.detail;

// Takes what the service refuses to the fields; false where it is not the requirements that are wrong.
export function refuse(problem: Problem): boolean {
  if (problem.status !== 422 && problem.status !== 400) return false;
  batch(() => {
    fieldErrors.value = problem.errors;
    validity.value = 'invalid';
  });
  return true;
}

let checking: AbortController | undefined;
let timer = 0;

async function validate(document: Requirements): Promise<void> {
  checking?.abort();
  const mine = (checking = new AbortController());
  try {
    const valid = await post<Remarked>('/v1/designs?validate_only=true', document, mine.signal);
    batch(() => {
      understood.value = valid.understood ?? [];
      warnings.value = valid.warnings ?? [];
      fieldErrors.value = [];
      validity.value = 'valid';
    });
  } catch (error) {
    if (mine.signal.aborted) return;
    const problem = asProblem(error);
    if (refuse(problem)) return;
    batch(() => {
      fieldErrors.value = [];
      validity.value = 'unknown';
      whyUnknown.value =
        problem.status === 0
          ? 'The service does not answer; nothing was checked.'
          : `Not checked: ${problem.message}.`;
    });
  }
}

effect(() => {
  ambientKpa.value = numbers.value.ambient?.pressure_kpa_abs ?? 100;
});

effect(() => {
  const document = requirements.value;
  const same = JSON.stringify(document) === JSON.stringify(presets.exosuit);
  if (same) sessionStorage.removeItem(kept);
  else sessionStorage.setItem(kept, encode(document));
  validity.value = 'checking';
  clearTimeout(timer);
  timer = window.setTimeout(() => {
    void validate(document);
    if ((route.peek().path[0] ?? 'requirements') === 'requirements') {
      setQuery({ r: same ? undefined : encode(document) });
    }
  }, 150);
});

// An address with other requirements was opened.
effect(() => {
  const { path, query } = route.value;
  const text = query.get('r');
  if ((path[0] ?? 'requirements') !== 'requirements' || !text) return;
  const document = decode(text);
  if (document && JSON.stringify(document) !== JSON.stringify(requirements.peek())) load(document);
});
