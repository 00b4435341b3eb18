// What was asked of a list afterwards: what its requirements cost and how sure its designs are. A
// search of its own works it out; what it finds fills the list in place.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { pathOf, start, useJob, type Watched } from './jobs';
import { changesOf, signature } from './list_changes';
import { route, setQuery } from './route';
import type { Answer } from './types';

// The search that was asked for, by the id of the list.
const asked = signal<Record<string, string>>({});

export async function explain(id: string, answer: Answer): Promise<void> {
  const requirements = answer.asked ?? answer.requirements;
  const job = await start({
    ...requirements,
    // What is guaranteed meets its requirements in every draw.
    ...(!answer.guarantee && { robust: requirements.robust ?? {} }),
    ...(!answer.front && { explain: { prices: true, ranks: 4 } }),
  });
  asked.value = { ...asked.peek(), [id]: job };
  const [view, shown] = route.peek().path;
  if (view === 'designs' && shown === id) setQuery({ explained: job });
}

export interface Explanation {
  watched: Watched;
  self: string;
  fit: 'same' | 'other'; // whether it is of the very list
}

// One that was cancelled may have neither.
const hasPrices = (found: Answer): boolean =>
  (found.prices ?? []).some((row) => row.status !== 'cancelled');
const hasDraws = (found: Answer): boolean => (found.robust?.draws ?? 0) > 0;
export const foundNothing = (found: Answer | null | undefined): boolean =>
  !found || (!hasPrices(found) && !hasDraws(found));

function merged(answer: Answer, found: Answer): Answer {
  const of = new Map(found.designs.map((design) => [signature(design), design]));
  return {
    ...answer,
    designs: answer.designs.map((design) => {
      const { robustness, to_be_first } = of.get(signature(design)) ?? {};
      return {
        ...design,
        ...(robustness && hasDraws(found) && { robustness }),
        ...(to_be_first && { to_be_first }),
      };
    }),
    ...(hasPrices(found) && { prices: found.prices }),
    ...(hasDraws(found) && { robust: found.robust }),
  };
}

function isSame(a: Answer, b: Answer): boolean {
  const { entered, left, moved } = changesOf(a, b);
  return entered.length + left.length + moved.length === 0;
}

const kept = new WeakMap<Answer, { found: Answer; merged: Answer }>();

// The answer with what was worked out, and how far that is. `saved`: the document of the service
// itself that says the most of the list; an answer put together could not be verified.
export function useExplained(
  id: string,
  answer: Answer | null,
): { answer: Answer | null; saved: Answer | null; explanation: Explanation | null } {
  const job = route.value.query.get('explained') ?? asked.value[id];
  const self = job ? pathOf(job) : null;
  const watched = useJob(self);
  useEffect(() => {
    if (job && asked.peek()[id] !== job) asked.value = { ...asked.peek(), [id]: job };
  }, [id, job]);
  if (!answer || !self || !watched) return { answer, saved: answer, explanation: null };
  const found = watched.job?.result;
  if (!found) return { answer, saved: answer, explanation: { watched, self, fit: 'same' } };
  if (kept.get(answer)?.found !== found) kept.set(answer, { found, merged: merged(answer, found) });
  const fit = isSame(answer, found) ? 'same' : 'other';
  const isWhole = fit === 'same' && watched.job?.status === 'done';
  return {
    answer: kept.get(answer)!.merged,
    saved: isWhole ? found : answer,
    explanation: { watched, self, fit },
  };
}
