// A search under way: best so far, the bound of the proof closing on it, cancel.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { objectiveName, objectiveUnit } from '../lib/amounts';
import { count, duration, percent, significant } from '../lib/format';
import type { Watched } from '../lib/jobs';
import { Lines } from '../plots/lines';
import { Notice, Panel } from '../ui/controls';
import { FactList } from '../ui/facts';
import { Bar, CancelButton } from '../ui/job';

// Seconds since `seconds` were told.
function useTicking(seconds: number | undefined): number {
  const since = useSignal(0);
  useEffect(() => {
    since.value = 0;
    if (seconds === undefined) return;
    const told = performance.now();
    const timer = setInterval(() => (since.value = (performance.now() - told) / 1000), 500);
    return () => clearInterval(timer);
  }, [seconds]);
  return since.value;
}

export function ProgressPanel({ watched, self }: { watched: Watched; self: string }) {
  const progress = watched.job?.progress;
  const trace = watched.trace;
  const best = progress?.best ?? null;
  const bound = progress?.lower_bound || null; // 0 says nothing: a revised search proves at its end
  const gap = best !== null && bound !== null && best > 0 ? Math.max(0, 1 - bound / best) : null;
  const hasBounds = trace.some((p) => p.lower_bound);
  const unit = progress ? objectiveUnit(progress) : '';
  const name = progress ? objectiveName(progress) : '';
  const since = useTicking(progress?.seconds);
  const queued = watched.job?.status === 'queued';
  return (
    <Panel
      title={queued ? 'Waiting for its turn' : 'Searching'}
      aside={<CancelButton self={self} />}
    >
      <FactList
        isLive
        facts={[
          ['time', progress ? duration(progress.seconds + since) : '–'],
          [
            name ? `least ${name} so far` : 'best so far',
            significant(best, 4),
            best === null ? '' : unit,
          ],
          ['all others at least', significant(bound, 4), bound === null ? '' : unit],
          ['gap', percent(gap)],
          ['evaluated', count(progress?.evaluated ?? 0)],
          ['regions left', bound === null ? '–' : count(progress?.open ?? 0)],
        ]}
      />
      <Bar label="How far the proof has closed" share={gap ? 1 - gap : null} />
      {progress?.status === 'infeasible' && (
        <p role="status">
          No combination of parts meets the requirements: that is proved. What stands in the way is
          being looked for.
        </p>
      )}
      {gap === 0 && (
        <p role="status">
          Nothing beats the best so far; what else belongs on the list is still being proved.
        </p>
      )}
      {best !== null && bound === null && (
        <p role="status">What is proved of these designs is known at the end of the search.</p>
      )}
      {trace.length > 1 && (
        <Lines
          title={hasBounds ? 'The proof closing' : 'The best so far'}
          xLabel="time, s"
          yLabel={[name || 'objective', unit].filter(Boolean).join(', ')}
          height={200}
          x={trace.map((p) => p.seconds)}
          lines={[
            { label: 'best so far', values: trace.map((p) => p.best), colour: '--c1' },
            ...(hasBounds
              ? [
                  {
                    label: 'all others at least',
                    values: trace.map((p) => p.lower_bound || null),
                    colour: '--c2',
                    dash: [5, 3],
                  },
                ]
              : []),
          ]}
        />
      )}
      {watched.problem && <Notice kind="bad">{watched.problem.message}</Notice>}
    </Panel>
  );
}
