// Measured data: drop a file, see it, ask what the model lacks.
import { signal, useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, post } from '../lib/api';
import { significant } from '../lib/format';
import { ended, follow, watched } from '../lib/jobs';
import {
  bandsOf,
  type Diagnosis,
  type Measurement,
  measurement,
  measurementErrors,
  readMeasurement,
} from '../lib/measurement';
import { routes, serves } from '../lib/models';
import { route, setQuery } from '../lib/route';
import { toShown, unitOf } from '../lib/units';
import { Lines } from '../plots/lines';
import { Notice, Panel } from '../ui/controls';
import { FilePicker } from '../ui/files';
import { DiagnosisView } from './diagnosis';
import { RigForm } from './rig_form';
import { PhaseKey, pickRun, RunPicker } from './runs';

const fromCsv = signal(false);
const problem = signal('');

async function take(file: File): Promise<void> {
  try {
    const text = await file.text();
    measurement.value = readMeasurement(file.name, text);
    fromCsv.value = !text.trimStart().startsWith('{');
    problem.value = '';
  } catch (error) {
    problem.value = `${file.name} cannot be read: ${(error as Error).message}`;
  }
  measurementErrors.value = [];
  setQuery({ job: undefined, run: undefined });
}

export function MeasuredView() {
  const over = useSignal(false);
  const busy = useSignal(false);
  const job = route.value.query.get('job');
  const self = job ? `/v1/diagnoses/${job}` : null;
  useEffect(() => {
    if (self) void follow(self);
  }, [self]);
  const now = self ? watched.value[self] : undefined;
  const result = now?.job?.result as unknown as Diagnosis | undefined;
  const data = measurement.value;
  const canDiagnose = serves('POST /v1/diagnoses');
  const diagnose = async () => {
    busy.value = true;
    measurementErrors.value = [];
    problem.value = '';
    try {
      const accepted = await post<{ id: string }>('/v1/diagnoses', data);
      setQuery({ job: accepted.id });
    } catch (error) {
      const refused = asProblem(error);
      problem.value =
        refused.status === 404 ? 'This service cannot diagnose measurements.' : refused.message;
      measurementErrors.value = refused.errors;
    } finally {
      busy.value = false;
    }
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    over.value = false;
    const file = event.dataTransfer?.files[0];
    if (file) void take(file);
  };
  return (
    <div
      class="measured"
      onDragOver={(e) => {
        e.preventDefault();
        over.value = true;
      }}
      onDragLeave={() => (over.value = false)}
      onDrop={drop}
    >
      <div class="toolbar">
        <h1>Measured data</h1>
        {data && (
          <span class="muted">
            {data.name}: {data.runs.length} runs,{' '}
            {data.runs.reduce((n, run) => n + run.t_s.length, 0)} samples
          </span>
        )}
        <span class="toolbar-group">
          <FilePicker
            label={data ? 'Another file…' : 'Open a file…'}
            accept=".json,.csv,application/json,text/csv"
            onFile={(file) => void take(file)}
            primary={!data}
          />
        </span>
      </div>
      {problem.value && (
        <Notice kind="bad">
          {problem.value}
          {measurementErrors.value.length > 0 && (
            <ul>
              {measurementErrors.value.map((e) => (
                <li key={e.pointer}>
                  <code>{e.pointer}</code> {e.detail}
                </li>
              ))}
            </ul>
          )}
        </Notice>
      )}
      {routes.value && !canDiagnose && (
        <Notice kind="warn">
          This service does not diagnose measurements yet; files can be looked at only.
        </Notice>
      )}
      {!data && !self && (
        <div class={`drop ${over.value ? 'over' : ''}`}>
          <p>
            <b>Drop a measurement here</b>, as JSON (measurement/1) or CSV with the columns{' '}
            <code>run, t_s, valve, pressure_kpa_gauge</code>.
          </p>
          <p class="muted">
            The valve is hold, inflate or deflate. A CSV may also hold source_pressure_kpa_gauge,
            inlet_pressure_kpa_gauge, temperature_k, volume_ml and flow_l_per_min_anr.
          </p>
        </div>
      )}
      {data && fromCsv.value && !result && <RigForm />}
      {data && !result && <Preview data={data} />}
      {data && !result && (
        <div class="toolbar end">
          <button
            type="button"
            class="primary"
            disabled={!canDiagnose || busy.value || (now?.job ? !ended(now.job.status) : false)}
            onClick={() => void diagnose()}
          >
            Find what the model lacks
          </button>
        </div>
      )}
      {now && !now.job && now.problem && <Notice kind="bad">{now.problem.message}</Notice>}
      {now?.job && !ended(now.job.status) && (
        <p class="loading" role="status">
          Fitting and comparing models…{' '}
          {now.job.progress?.seconds !== undefined &&
            `${significant(now.job.progress.seconds, 2)} s`}
        </p>
      )}
      {now?.job && ended(now.job.status) && !result && (
        <Notice kind="bad">{now.job.detail ?? `The diagnosis was ${now.job.status}.`}</Notice>
      )}
      {result && <DiagnosisView diagnosis={result} id={job!} data={data} />}
    </div>
  );
}

function Preview({ data }: { data: Measurement }) {
  const ids = data.runs.map((run) => run.id);
  const run = data.runs.find((r) => r.id === pickRun(ids))!;
  const show = (values: (number | null)[]) =>
    values.map((v) => (v === null ? null : toShown('pressure', v)));
  const source = run.channels?.source_pressure_kpa_gauge;
  return (
    <Panel
      title={`Run ${run.id}${run.blocked ? ', blocked' : ''}`}
      aside={<RunPicker ids={ids} value={run.id} />}
    >
      <Lines
        title="Measured pressure"
        x={run.t_s}
        xLabel="time, s"
        yLabel={`pressure, ${unitOf('pressure')}`}
        height={300}
        bands={bandsOf(run, run.t_s[run.t_s.length - 1] ?? 0)}
        lines={[
          { label: 'actuator', values: show(run.pressure_kpa_gauge), colour: '--c1' },
          ...(source ? [{ label: 'source', values: show(source), colour: '--c6' }] : []),
        ]}
      />
      <PhaseKey />
    </Panel>
  );
}
