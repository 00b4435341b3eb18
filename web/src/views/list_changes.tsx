// What changed since another list, and the parts that were added, changed or removed meanwhile.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { objectiveUnit } from '../lib/amounts';
import { change, significant } from '../lib/format';
import {
  changesOf,
  type Entered,
  type ListChanges,
  ranksInWords,
  ranksWith,
} from '../lib/list_changes';
import { type CatalogueChanges, changesBetween, type PartChange } from '../lib/revisions';
import { link } from '../lib/route';
import type { Answer, PartRow } from '../lib/types';
import { Panel } from '../ui/controls';

const namedMax = 8;

// What changed in the catalogue from one revision to the other, once it is read.
export function useCatalogueChanges(from?: number, to?: number): CatalogueChanges | null {
  const changes = useSignal<CatalogueChanges | null>(null);
  useEffect(() => {
    changes.value = null;
    if (from === undefined || to === undefined || from >= to) return;
    let isCurrent = true;
    changesBetween(from, to).then(
      (read) => isCurrent && (changes.value = read),
      () => undefined,
    );
    return () => void (isCurrent = false);
  }, [from, to]);
  return changes.value;
}

const verbs = ['added', 'removed', 'changed'] as const;
const verbOf = ({ before, after }: PartChange): (typeof verbs)[number] =>
  before === null ? 'added' : after === null ? 'removed' : 'changed';

function PartName({ part }: { part: PartChange }) {
  const row = (part.after ?? part.before)!;
  const name = [row.manufacturer, row.part_number].filter(Boolean).join(' ');
  return (
    <>
      {part.after ? (
        <a href={link(['catalogue', row.family], { part: part.id })}>{name}</a>
      ) : (
        <b>{name}</b>
      )}{' '}
      <span class="muted">({row.family.replaceAll('_', ' ')})</span>
    </>
  );
}

// The parts by what happened to them, those first that `uses` tells something of.
export function PartsChanged(props: {
  changes: CatalogueChanges;
  uses: (part: PartChange) => string;
}) {
  const { parts, others } = props.changes;
  return (
    <ul class="reasons">
      {verbs.map((verb) => {
        const rows = parts
          .filter((part) => verbOf(part) === verb)
          .map((part) => ({ part, use: props.uses(part) }))
          .sort((a, b) => Number(b.use !== '') - Number(a.use !== ''));
        if (rows.length === 0) return null;
        return (
          <li key={verb}>
            {verb[0]!.toUpperCase() + verb.slice(1)}:{' '}
            {rows.slice(0, namedMax).map(({ part, use }, i) => (
              <span key={part.id}>
                {i > 0 && '; '}
                <PartName part={part} />
                {use && `, ${use}`}
              </span>
            ))}
            {rows.length > namedMax && ` and ${rows.length - namedMax} more`}.
          </li>
        );
      })}
      {others.length > 0 && <li>Further: {others.slice(0, namedMax).join(', ')}.</li>}
    </ul>
  );
}

// Where a part is in the lists.
function useOf(part: PartChange, answer: Answer, other: Answer): string {
  const now = ranksWith(answer.designs, part.id);
  const then = ranksWith(other.designs, part.id);
  if (now.length > 0) return `now in ${ranksInWords(now)}`;
  if (then.length > 0) return `was in ${ranksInWords(then)}`;
  return '';
}

export function ListChangesPanel(props: {
  answer: Answer;
  other: Answer;
  id: string;
  otherId: string;
}) {
  const { answer, other, id } = props;
  const [from, to] = [other.catalogue_revision?.number, answer.catalogue_revision?.number];
  const catalogue = useCatalogueChanges(from, to);
  const changes = changesOf(answer, other);
  const count = changes.entered.length + changes.left.length + changes.moved.length;
  const isUnused =
    catalogue !== null &&
    catalogue.others.length === 0 &&
    catalogue.parts.length > 0 &&
    catalogue.parts.every((part) => useOf(part, answer, other) === '');
  return (
    <Panel
      title={
        from !== undefined && to !== undefined && from < to
          ? `Changes since revision ${from} of the catalogue`
          : 'Changes since the other list'
      }
      aside={<a href={link(['designs', props.otherId])}>The list before</a>}
    >
      <div class="changes" role="status">
        <p>{inShort(answer, other, changes)}</p>
        {catalogue && <PartsChanged changes={catalogue} uses={(p) => useOf(p, answer, other)} />}
        {isUnused && <p class="muted">None of these parts is in either list.</p>}
        {count > 0 && (
          <details>
            <summary>Design by design</summary>
            <Moves changes={changes} catalogue={catalogue} id={id} />
          </details>
        )}
      </div>
    </Panel>
  );
}

function inShort(answer: Answer, other: Answer, { entered, left, moved }: ListChanges): string {
  const [first, was] = [answer.designs[0], other.designs[0]];
  const counts =
    entered.length + left.length === 0
      ? moved.length === 0
        ? 'The same designs as before.'
        : `The same designs as before, ${moved.length} on another rank.`
      : `${entered.length} new, ${left.length} no longer listed${moved.length > 0 ? `, ${moved.length} on another rank` : ''}.`;
  const amount = (objective: number) =>
    `${significant(objective, 4)} ${objectiveUnit(answer.requirements)}`;
  const best = !first
    ? 'Nothing meets the requirements now.'
    : !was
      ? `Nothing met the requirements before; now the best is ${amount(first.objective)}.`
      : `Best ${significant(was.objective, 4)} → ${amount(first.objective)} (${change(first.objective / was.objective - 1)}).`;
  return `${counts} ${best}`;
}

const partNames = (rows: PartRow[]): string =>
  rows.map((p) => (p.id === 'custom' ? `${p.family} made to measure` : p.part_number)).join(', ');

function enteredInWords({ like }: Entered): string {
  if (!like) return 'new';
  const [now, then] = [partNames(like.now), partNames(like.then)];
  return `new: as #${like.rank} was${now && `, with ${now}`}${then && ` in place of ${then}`}`;
}

function Moves(props: { changes: ListChanges; catalogue: CatalogueChanges | null; id: string }) {
  const { entered, left, moved } = props.changes;
  const gone = (rows: PartRow[]): string => {
    const of = (verb: string) =>
      rows.find((row) =>
        props.catalogue?.parts.some((part) => part.id === row.id && verbOf(part) === verb),
      );
    const [removed, changed] = [of('removed'), of('changed')];
    if (removed) return `${removed.part_number} was removed`;
    return changed ? `${changed.part_number} was changed` : 'others are better now';
  };
  const rows = [
    ...entered.map((e) => ({ rank: e.design.rank, text: enteredInWords(e) })),
    ...moved.map(({ design, from }) => ({ rank: design.rank, text: `was #${from}` })),
  ].sort((a, b) => a.rank - b.rank);
  const reasons = new Map<string, number[]>();
  for (const { parts, rank } of left)
    reasons.set(gone(parts), [...(reasons.get(gone(parts)) ?? []), rank]);
  return (
    <ul class="history">
      {rows.map(({ rank, text }) => (
        <li key={rank}>
          <a href={link(['designs', props.id, String(rank)])}>#{rank}</a> {text}
        </li>
      ))}
      {[...reasons].map(([reason, ranks]) => (
        <li key={reason}>
          No longer listed, as {reason}: what was {ranksInWords(ranks)}
        </li>
      ))}
    </ul>
  );
}
