// A search under way: best so far, the bound of the proof closing on it, cancel.
import { useSignal } from '@preact/signals';

import { count, duration, percent, significant } from '../lib/format';
import { cancel, type Watched } from '../lib/jobs';
import { Lines } from '../plots/lines';
import { Notice, Panel } from '../ui/controls';

export function ProgressPanel({ watched, self }: { watched: Watched; self: string }) {
  const stopping = useSignal(false);
  const progress = watched.job?.progress;
  const trace = watched.trace;
  const best = progress?.best ?? null;
  const bound = progress?.lower_bound ?? null;
  const gap = best !== null && bound !== null && best > 0 ? Math.max(0, 1 - bound / best) : null;
  const queued = watched.job?.status === 'queued';
  return (
    <Panel
      title={queued ? 'Waiting for its turn' : 'Searching'}
      aside={
        <button
          type="button" disabled={stopping.value}
          onClick={() => {
            stopping.value = true;
            void cancel(self);
          }}
        >
          {stopping.value ? 'Stopping…' : 'Cancel'}
        </button>
      }
    >
      <dl class="facts" aria-live="polite">
        <div><dt>time</dt><dd>{progress ? duration(progress.seconds) : '–'}</dd></div>
        <div><dt>best so far</dt><dd>{significant(best, 4)}</dd></div>
        <div><dt>nothing better than</dt><dd>{significant(bound, 4)}</dd></div>
        <div><dt>gap</dt><dd>{percent(gap)}</dd></div>
        <div><dt>evaluated</dt><dd>{count(progress?.evaluated ?? 0)}</dd></div>
        <div><dt>open boxes</dt><dd>{count(progress?.open ?? 0)}</dd></div>
      </dl>
      <div class="gap-bar" role="progressbar" aria-label="How far the proof has closed" aria-valuemin={0} aria-valuemax={100} aria-valuenow={gap === null ? 0 : Math.round(100 * (1 - gap))}>
        <span style={{ width: `${gap === null ? 0 : 100 * (1 - gap)}%` }} />
      </div>
      {trace.length > 1 && (
        <Lines
          title="The proof closing" xLabel="time, s" yLabel="objective" height={200}
          x={trace.map((p) => p.seconds)}
          lines={[
            { label: 'best so far', values: trace.map((p) => p.best), colour: '--c1' },
            { label: 'lower bound', values: trace.map((p) => p.lower_bound), colour: '--c2', dash: [5, 3] },
          ]}
        />
      )}
      {watched.problem && <Notice kind="bad">{watched.problem.message}</Notice>}
    </Panel>
  );
}
