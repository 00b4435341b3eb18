// What changed from one ranked list to another: designs that came, went and moved, and the parts
// that did it.
import type { Answer, Design, PartRow } from './types';

// Designs are the same when they have the same parts in the same numbers.
export const signature = (design: Design): string => design.parts.map(keyOf).sort().join('|');

const keyOf = (p: PartRow): string =>
  `${p.id}×${p.unit === 'm' ? '' : p.quantity}@${p.group ?? ''}`;

export interface Entered {
  design: Design;
  // The design of the other list that is most like it, and the parts that differ.
  like: { rank: number; now: PartRow[]; then: PartRow[] } | null;
}

export interface ListChanges {
  entered: Entered[];
  left: Design[]; // of the other list
  moved: { design: Design; from: number }[];
}

function mostLike(design: Design, others: Design[]): Entered['like'] {
  const mine = new Set(design.parts.map(keyOf));
  let best: Entered['like'] = null;
  for (const other of others) {
    const then = other.parts.filter((p) => !mine.has(keyOf(p)));
    if (best && best.then.length <= then.length) continue;
    const theirs = new Set(other.parts.map(keyOf));
    best = { rank: other.rank, then, now: design.parts.filter((p) => !theirs.has(keyOf(p))) };
  }
  return best;
}

export function changesOf(now: Answer, then: Answer): ListChanges {
  const was = new Map(then.designs.map((design) => [signature(design), design.rank]));
  const is = new Set(now.designs.map(signature));
  return {
    entered: now.designs
      .filter((design) => !was.has(signature(design)))
      .map((design) => ({ design, like: mostLike(design, then.designs) })),
    left: then.designs.filter((design) => !is.has(signature(design))),
    moved: now.designs.flatMap((design) => {
      const from = was.get(signature(design));
      return from === undefined || from === design.rank ? [] : [{ design, from }];
    }),
  };
}

// "#1 to #4, #7"
export function ranksInWords(ranks: number[]): string {
  const runs: [number, number][] = [];
  for (const rank of [...ranks].sort((a, b) => a - b)) {
    const last = runs.at(-1);
    if (last && rank === last[1] + 1) last[1] = rank;
    else runs.push([rank, rank]);
  }
  return runs.map(([a, b]) => (a === b ? `#${a}` : `#${a} to #${b}`)).join(', ');
}

export const ranksWith = (designs: Design[], id: string): number[] =>
  designs.filter((d) => d.parts.some((p) => p.id === id)).map((d) => d.rank);
