// What panels of jobs under way share.
import { useSignal } from '@preact/signals';

import { asProblem } from '../lib/api';
import { again, cancel, start } from '../lib/jobs';
import { go } from '../lib/route';
import type { Answer, Requirements } from '../lib/types';

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

// A button whose action may fail, which is then said beside it.
export function ActionButton(props: { label: string; tip?: string; act: () => Promise<void> }) {
  const { label, tip, act } = props;
  const problem = useSignal('');
  const run = () => {
    problem.value = '';
    act().catch((error) => (problem.value = asProblem(error).sentence));
  };
  return (
    <>
      <button type="button" data-tip={tip} onClick={run}>
        {label}
      </button>
      {problem.value && (
        <span class="error" role="alert">
          {problem.value}
        </span>
      )}
    </>
  );
}

// Starts the same search with the catalogue as it is now, or with `changed` requirements, and goes
// to its list.
export function RankAgainButton(props: {
  answer: Answer;
  label: string;
  tip?: string;
  changed?: (asked: Requirements) => Requirements;
}) {
  const { answer, changed, ...button } = props;
  const rank = async () => {
    const asked = answer.asked ?? answer.requirements;
    go(['designs', await start(changed ? changed(asked) : asked)]);
  };
  return <ActionButton {...button} act={rank} />;
}

// Of a job under way: never full, as it is not done. `share`: null where it is not known how far it
// is.
export const Bar = ({ label, share }: { label: string; share: number | null }) => {
  const percent = share === null ? undefined : Math.min(99, Math.floor(100 * share));
  return (
    <div
      class={`gap-bar ${share === null ? 'unknown' : ''}`}
      role="progressbar"
      aria-label={label}
      aria-valuemin={0}
      aria-valuemax={100}
      aria-valuenow={percent}
    >
      <span style={percent === undefined ? undefined : { width: `${percent}%` }} />
    </div>
  );
};
