// The revisions of the catalogue: which one stands now, and what changed since another.
import { signal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { get, getAtMost } from './api';
import type { Part } from './types';

export interface Revision {
  number: number;
  hash: string; // of all parts
  at: string;
  who: string;
  what: string;
}
export type RevisionName = Pick<Revision, 'number' | 'hash'>;

export const head = signal<RevisionName | null>(null);

const periodMs = 10_000;

// Asks for the newest revision, now and then, while something is shown that rests on it.
export function useHead(): RevisionName | null {
  useEffect(() => {
    const refresh = () => {
      if (document.hidden) return;
      get<{ revisions: Revision[] }>('/v1/revisions?limit=1').then(
        ({ revisions: [newest] }) => {
          if (newest && newest.hash !== head.peek()?.hash) head.value = newest;
        },
        () => undefined,
      );
    };
    refresh();
    const timer = setInterval(refresh, periodMs);
    addEventListener('focus', refresh);
    return () => {
      clearInterval(timer);
      removeEventListener('focus', refresh);
    };
  }, []);
  return head.value;
}

// One part from the one revision to the other; null where it was not there.
export interface PartChange {
  id: string;
  before: Part | null;
  after: Part | null;
}

export interface CatalogueChanges {
  parts: PartChange[];
  others: string[]; // revisions too large or too many to look into, in their own words
}

const revisionsMax = 40;
const bytesMax = 4 << 20; // of one revision: some thousand parts

async function readRevisions(from: number, to: number): Promise<Revision[]> {
  const found: Revision[] = [];
  let cursor = '';
  for (;;) {
    const page = await get<{ revisions: Revision[]; next_cursor: string | null }>(
      `/v1/revisions?limit=100${cursor && `&cursor=${cursor}`}`,
    );
    found.push(...page.revisions.filter(({ number }) => number > from && number <= to));
    if (!page.next_cursor || page.revisions.at(-1)!.number <= from) return found;
    cursor = page.next_cursor;
  }
}

// What the parts of the revision `to` have that those of `from` had not, and the other way round.
export async function changesBetween(from: number, to: number): Promise<CatalogueChanges> {
  const revisions = await readRevisions(from, to);
  const net = new Map<string, PartChange>();
  const others: string[] = [];
  const read = await Promise.all(
    revisions
      .slice(0, revisionsMax)
      .map(({ number }) =>
        getAtMost<{ changes: PartChange[]; next_cursor: string | null }>(
          `/v1/revisions/${number}?limit=1000`,
          bytesMax,
        ),
      ),
  );
  // From the newest to the oldest: the first seen has what is now, the last what was then.
  revisions.forEach((revision, i) => {
    const document = read[i]?.next_cursor === null ? read[i] : null;
    if (!document) others.push(`${revision.what} (revision ${revision.number})`);
    for (const { id, before, after } of document?.changes ?? [])
      net.set(id, { id, before, after: net.has(id) ? net.get(id)!.after : after });
  });
  const isChange = ({ before, after }: PartChange) =>
    JSON.stringify(before) !== JSON.stringify(after);
  return { parts: [...net.values()].filter(isChange), others };
}
