// What panels of jobs under way share.
import { useSignal } from '@preact/signals';

import { asProblem } from '../lib/api';
import { again, cancel } from '../lib/jobs';

export function CancelButton({ self }: { self: string }) {
  const stopping = useSignal(false);
  const stop = () => {
    stopping.value = true;
    cancel(self).catch(() => (stopping.value = false));
  };
  return (
    <button type="button" disabled={stopping.value} onClick={stop}>
      {stopping.value ? 'Stopping…' : 'Cancel'}
    </button>
  );
}

// Of a job that failed or was cancelled.
export function AgainButton({ self, name }: { self: string; name: string }) {
  const problem = useSignal('');
  const isAsked = useSignal(false);
  const ask = () => {
    isAsked.value = true;
    problem.value = '';
    again(self)
      .catch((error) => (problem.value = asProblem(error).message))
      .finally(() => (isAsked.value = false));
  };
  return (
    <>
      <button type="button" disabled={isAsked.value} aria-label={`Again: ${name}`} onClick={ask}>
        Again
      </button>
      {problem.value && (
        <p class="error" role="alert">
          {problem.value}
        </p>
      )}
    </>
  );
}

export const Bar = ({ label, share }: { label: string; share: number }) => (
  <div
    class="gap-bar"
    role="progressbar"
    aria-label={label}
    aria-valuemin={0}
    aria-valuemax={100}
    aria-valuenow={Math.round(100 * share)}
  >
    <span style={{ width: `${100 * share}%` }} />
  </div>
);
