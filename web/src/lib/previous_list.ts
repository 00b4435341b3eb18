// The list of the same requirements from before the catalogue changed.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { get } from './api';
import { jobList, pathOf, refreshJobs, withNumbers } from './jobs';
import type { Answer, Job, Requirements } from './types';

const candidatesMax = 6; // answers that are looked into

// What decides which designs are listed; not how long it may take and what else is asked of them.
function inCanon(requirements: Requirements, answer: Answer): string {
  const { name: _, robust: __, explain: ___, ...asked } = requirements;
  const { time_limit_s: ____, ...ranking } = asked.ranking ?? {};
  const sorted = (value: unknown): unknown =>
    Array.isArray(value)
      ? value.map(sorted)
      : value && typeof value === 'object'
        ? Object.fromEntries(
            Object.entries(value)
              .filter(([name, member]) => name !== 'note' && member !== null)
              .sort(([a], [b]) => (a < b ? -1 : 1))
              .map(([name, member]) => [name, sorted(member)]),
          )
        : value;
  return JSON.stringify(sorted([{ ...asked, ranking }, answer.model?.version ?? 0]));
}

// Of the list with an id; null once it is known that there is none.
const found = signal<Record<string, string | null>>({});

async function find(id: string, answer: Answer): Promise<string | null> {
  await refreshJobs();
  const jobs = jobList.peek() ?? [];
  const mine = jobs.find((job) => job.id === id);
  const revision = answer.catalogue_revision;
  if (!mine || !revision) return null;
  const text = JSON.stringify;
  const candidates = jobs
    .slice(jobs.indexOf(mine) + 1)
    .filter(
      (job) =>
        job.status === 'done' &&
        job.name === mine.name &&
        job.catalogue_revision.number < revision.number &&
        job.catalogue_revision.hash !== revision.hash &&
        text(job.progress?.objective) === text(mine.progress?.objective),
    );
  const wanted = inCanon(answer.requirements, answer);
  for (const job of candidates.slice(0, candidatesMax)) {
    const { result } = withNumbers(await get<Job>(pathOf(job.id)));
    if (result && inCanon(result.requirements, result) === wanted) return job.id;
  }
  return null;
}

// Its id, once it is known.
export function usePreviousList(id: string, answer: Answer | null): string | null {
  useEffect(() => {
    if (!answer || id in found.peek()) return;
    found.value = { ...found.peek(), [id]: null };
    void find(id, answer).then(
      (job) => (found.value = { ...found.peek(), [id]: job }),
      () => undefined,
    );
  }, [id, answer !== null]);
  return found.value[id] ?? null;
}
