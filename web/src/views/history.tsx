// The history of a part, and of the catalogue, of which each write can be undone.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, get, post } from '../lib/api';
import { partPath } from '../lib/catalogue';
import { fieldName, moment } from '../lib/format';
import type { Part } from '../lib/types';
import { Dialog, Notice } from '../ui/controls';
import { heard, number, Table } from '../ui/table';

interface Revision {
  number: number;
  at: string;
  who: string;
  what: string;
}

export function PartHistory({ id }: { id: string }) {
  const entries = useSignal<
    { revision: Revision; before: Part | null; after: Part | null }[] | null
  >(null);
  const load = () =>
    get<{ history: never[] }>(`${partPath(id)}/history`).then(
      (answer) => (entries.value = answer.history),
      () => (entries.value = []),
    );
  return (
    <details
      onToggle={(event) => event.currentTarget.open && entries.value === null && void load()}
    >
      <summary>History</summary>
      {entries.value?.length === 0 && <p>No changes are recorded.</p>}
      <ul class="history">
        {entries.value?.map(({ revision, before, after }) => (
          <li key={revision.number}>
            <b>revision {revision.number}</b>{' '}
            <span class="muted">
              {moment(revision.at)} {revision.who}
            </span>{' '}
            {before === null ? 'added' : after === null ? 'removed' : changes(before, after)}
          </li>
        ))}
      </ul>
    </details>
  );
}

function changes(before: Part, after: Part): string {
  const names = [...new Set([...Object.keys(before), ...Object.keys(after)])].filter(
    (name) => name !== 'provenance',
  );
  const different = names.filter(
    (name) => JSON.stringify(before[name]) !== JSON.stringify(after[name]),
  );
  const text = (value: unknown) =>
    value !== null && typeof value === 'object' ? '…' : String(value ?? '–');
  return (
    different
      .map((name) => `${fieldName(name).label} ${text(before[name])} → ${text(after[name])}`)
      .join(', ') || 'sources changed'
  );
}

export function RevisionsDialog({ onClose }: { onClose: (changed: boolean) => void }) {
  const list = useSignal<Revision[] | null>(null);
  const problem = useSignal('');
  const changed = useSignal(false);
  const load = () =>
    get<{ revisions: Revision[] }>('/v1/revisions').then(
      (answer) => (list.value = answer.revisions),
      (error) => (problem.value = asProblem(error).message),
    );
  useEffect(() => void load(), []);
  const undo = async (number: number) => {
    try {
      await post(`/v1/revisions/${number}/undo`, {});
      changed.value = true;
      problem.value = '';
      await load();
    } catch (error) {
      problem.value = asProblem(error).sentence;
    }
  };
  return (
    <Dialog title="History of the catalogue" onClose={() => onClose(changed.value)}>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      <Table label="Revisions" heads={[number('revision'), 'when', 'who', 'what', heard('undo')]}>
        {list.value?.map((r) => (
          <tr key={r.number}>
            <td class="num">{r.number}</td>
            <td class="nowrap">{moment(r.at)}</td>
            <td>{r.who}</td>
            <td>{r.what}</td>
            <td>
              {r.number > 1 && (
                <button
                  type="button"
                  class="small"
                  aria-label={`Undo revision ${r.number}`}
                  onClick={() => void undo(r.number)}
                >
                  Undo
                </button>
              )}
            </td>
          </tr>
        ))}
      </Table>
    </Dialog>
  );
}
