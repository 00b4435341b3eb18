// What panels of jobs under way share.
import { useSignal } from '@preact/signals';

import { cancel } from '../lib/jobs';

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
