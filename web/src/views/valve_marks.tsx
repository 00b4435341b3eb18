// What the valve of a run did, marked on its curve: for a recording without a column of the valve.
import { useSignal } from '@preact/signals';

import { significant } from '../lib/format';
import { measurement, type Run, type ValveState } from '../lib/measurement';
import { valveStates } from '../lib/recording';
import { Segmented } from '../ui/controls';

const put = (id: string, valve: Run['valve']): void => {
  const data = measurement.value!;
  const sorted = [...valve].sort((a, b) => a.t_s - b.t_s);
  measurement.value = {
    ...data,
    runs: data.runs.map((run) => (run.id === id ? { ...run, valve: sorted } : run)),
  };
};

export function useValveMarks(run: Run) {
  const state = useSignal<ValveState>('inflate');
  const mark = (t_s: number) =>
    put(run.id, [...run.valve.filter((one) => one.t_s !== t_s), { t_s, state: state.value }]);
  return { state, mark };
}

export function ValveMarks(props: {
  run: Run;
  marks: ReturnType<typeof useValveMarks>;
  suggested: Run['valve'] | null;
}) {
  const { run, marks, suggested } = props;
  return (
    <>
      <p>
        The file does not say what the valve did. Choose what it begins to do, then click on the
        curve where it does.
      </p>
      <div class="toolbar">
        <Segmented
          label="from here"
          options={valveStates}
          value={marks.state.value}
          onChange={(state) => (marks.state.value = state)}
        />
        {suggested && (
          <button type="button" onClick={() => put(run.id, suggested)}>
            Mark as the curve suggests
          </button>
        )}
      </div>
      <ul class="valve-marks">
        {run.valve.map((one, i) => (
          <li key={`${one.t_s} ${one.state}`}>
            {one.state} from{' '}
            <input
              type="number"
              step="any"
              aria-label={`Instant ${i + 1}, s`}
              value={one.t_s}
              onChange={(event) => {
                const t_s = event.currentTarget.valueAsNumber;
                if (Number.isFinite(t_s))
                  put(
                    run.id,
                    run.valve.map((other) => (other === one ? { ...one, t_s } : other)),
                  );
              }}
            />{' '}
            s{' '}
            <button
              type="button"
              aria-label={`Remove ${one.state} from ${significant(one.t_s, 4)} s`}
              onClick={() =>
                put(
                  run.id,
                  run.valve.filter((other) => other !== one),
                )
              }
            >
              ×
            </button>
          </li>
        ))}
      </ul>
    </>
  );
}
