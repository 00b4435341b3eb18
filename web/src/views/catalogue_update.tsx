// What the catalogue of the installed program has newer: shown first, then taken over.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, post } from '../lib/api';
import { Dialog, Notice } from '../ui/controls';

interface SeedUpdate {
  added: string[];
  replaced: string[];
  removed: string[];
  kept: string[];
  revision: { number: number; hash: string };
}

const path = '/v1/catalog/update';
const shownMax = 40;

const kinds = [
  ['added', 'Added'],
  ['replaced', 'Changed'],
  ['removed', 'Removed'],
  ['kept', 'Changed or removed by you, left as they are'],
] as const;

export function SeedDialog(props: { onClose: (changed: boolean) => void }) {
  const plan = useSignal<SeedUpdate | null>(null);
  const done = useSignal(false);
  const problem = useSignal('');
  const busy = useSignal(false);
  useEffect(() => {
    post<SeedUpdate>(`${path}?dry_run=true`, {}).then(
      (answer) => (plan.value = answer),
      (error) => (problem.value = asProblem(error).message),
    );
  }, []);
  const update = async () => {
    busy.value = true;
    try {
      plan.value = await post<SeedUpdate>(path, {});
      done.value = true;
    } catch (error) {
      problem.value = asProblem(error).message;
    } finally {
      busy.value = false;
    }
  };
  const now = plan.value;
  const isSame = now !== null && !now.added.length && !now.replaced.length && !now.removed.length;
  return (
    <Dialog
      wide
      title="Update from the installed catalogue"
      onClose={() => props.onClose(done.value)}
    >
      {problem.value && <Notice kind="bad">Not updated: {problem.value}.</Notice>}
      {!now && !problem.value && <p role="status">Comparing…</p>}
      {now && isSame && <p role="status">The installed catalogue has nothing newer.</p>}
      {now && done.value && (
        <Notice kind="good">
          Taken over as revision {now.revision.number}. The history can take it back.
        </Notice>
      )}
      {now && (!isSame || now.kept.length > 0) && (
        <dl class="update">
          {kinds.map(([name, label]) => {
            const ids = now[name];
            return (
              ids.length > 0 && (
                <div key={name}>
                  <dt>
                    {label}: {ids.length}
                  </dt>
                  <dd>
                    {ids.slice(0, shownMax).join(', ')}
                    {ids.length > shownMax && ` and ${ids.length - shownMax} more`}
                  </dd>
                </div>
              )
            );
          })}
        </dl>
      )}
      {now && !isSame && !done.value && (
        <div class="toolbar end">
          <button type="button" class="primary" disabled={busy.value} onClick={() => void update()}>
            {busy.value ? 'Taking over…' : 'Take this over'}
          </button>
        </div>
      )}
    </Dialog>
  );
}
