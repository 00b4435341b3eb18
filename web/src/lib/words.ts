// What was proved or found, in words.
import { count, duration, percent, scientific } from './format';
import type { Diagnosis } from './measurement';
import type { Answer } from './types';

const provedFirst = (designs: number): string =>
  designs === 0
    ? ''
    : designs === 1
      ? ' The first is proved.'
      : ` The first ${designs} are proved.`;

const leftOutWhy: Record<string, string> = {
  exclude: 'excluded',
  require: 'beside those required',
  orderable: 'that cannot be ordered',
  vacuum: 'not rated for vacuum',
  holding: 'that cannot close both ways',
  prices: 'without a price',
};

// What the proof does not speak of.
function leftOut(answer: Answer): string {
  const parts = Object.entries(answer.left_out ?? {}).map(([why, what]) => {
    const how = Array.isArray(what) ? what.length : Object.values(what).reduce((a, b) => a + b, 0);
    return `${count(how)} ${leftOutWhy[why] ?? `by ${why}`}`;
  });
  return parts.length ? ` Parts left out of the catalogue: ${parts.join(', ')}.` : '';
}

export function proofInWords(answer: Answer): string {
  const { proof, status, designs } = answer;
  const total = scientific(proof.combinations);
  const listed = designs.length;
  const rest = proof.complete ? ', the rest ruled out by bounds' : '';
  const did = `${total} combinations in ${duration(answer.seconds)}: ${count(proof.evaluated)} evaluated, ${count(proof.simulated)} simulated${rest}.`;
  if (answer.front_proof && listed > 0) {
    const { searches, proved, unexplored } = answer.front_proof;
    const work = `${searches} searches among ${total} combinations in ${duration(answer.seconds)}, ${proved === searches ? 'all' : count(proved)} proved.`;
    return unexplored.length === 0
      ? `Proved: ${listed === 1 ? 'this design is' : `these ${listed} designs are`} the whole front. ${work}`
      : `Best front found, not proved: ${unexplored.length} of its regions may hide designs. ${work}`;
  }
  switch (status) {
    case 'optimal':
      return listed === 0
        ? `Proved: nothing can be listed. ${did}`
        : answer.list === 'kinds'
          ? `Proved: no kind of ${answer.guarantee ? 'guaranteed ' : ''}design that is not listed beats ${listed === 1 ? 'this one' : `the last of these ${listed}`}, except further kinds with a source that stands on the list.${leftOut(answer)} ${did}`
          : `Proved: no other combination of catalogue parts${answer.guarantee ? ' that is guaranteed' : ''} beats ${listed === 1 ? 'this design' : `the last of these ${listed} designs`}.${leftOut(answer)} ${did}`;
    case 'feasible':
      if (listed === 0)
        return `Nothing was found in the time given, and nothing was proved: there may be designs. ${did}`;
      return proof.gap === null || proof.gap > 0.99
        ? `Best found so far; nothing was proved. ${did}`
        : `Best found, not proved: a design that is not listed could be up to ${percent(proof.gap)} better than the last one.${provedFirst(proof.proved_designs ?? 0)} ${did}`;
    case 'infeasible':
      return `Proved: no combination of catalogue parts meets all requirements together. ${did}`;
    case 'cancelled':
      return `Cancelled before the proof was complete; these are the best found. ${did}`;
  }
}

// "1 design", "2 designs".
export const counted = (n: number, what: string): string => `${n} ${what}${n === 1 ? '' : 's'}`;

// The name of a family of parts for people.
export const familyWord = (family: string): string =>
  family === 'co2' ? 'CO₂' : family.replaceAll('_', ' ');

// A run's name in a title; a recording without a column of runs is one run, called "run".
export const runTitle = (id: string): string => (id === 'run' ? 'The run' : `Run ${id}`);

// A note of a document, which may be of any form.
export const noteText = (note: unknown): string =>
  note === undefined || note === null ? '' : typeof note === 'string' ? note : JSON.stringify(note);

export interface Word {
  text: string;
  kind: string; // of a chip
}

export const statusWord: Record<Answer['status'], Word> = {
  optimal: { text: 'proved', kind: 'good' },
  feasible: { text: 'best found', kind: 'warn' },
  infeasible: { text: 'infeasible', kind: 'bad' },
  cancelled: { text: 'cancelled', kind: 'warn' },
};

export const verdictWord: Record<Diagnosis['verdict'], Word> = {
  adequate: { text: 'adequate', kind: 'good' },
  explained: { text: 'explained', kind: 'good' },
  tie: { text: 'a tie', kind: 'warn' },
  unexplained: { text: 'unexplained', kind: 'bad' },
  undecided: { text: 'undecided', kind: 'warn' },
};
