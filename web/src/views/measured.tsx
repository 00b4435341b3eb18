// Measured data: drop files, see them, ask what the model lacks.
import { signal, useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';

import shipped from '../../../examples/simulated_recording.json?url';
import { ask, asProblem, type FieldError } from '../lib/api';
import { significant } from '../lib/format';
import { diagnosisPath, ended, useJob } from '../lib/jobs';
import {
  type Diagnosis,
  emptyRig,
  type Measurement,
  measurement,
  measurementErrors,
  originalText,
  isJson,
  readJson,
  type Rig,
  shadesOf,
  usualLimitS,
  withRig,
  withRuns,
} from '../lib/measurement';
import {
  answered,
  isOpen,
  openRecording,
  type Recording,
  runsOf,
  suggestedValve,
  type TableAnswers,
} from '../lib/recording';
import { route, setQuery } from '../lib/route';
import type { Doing, Job } from '../lib/types';
import { pressuresShown, unitOf } from '../lib/units';
import { runTitle } from '../lib/words';
import { Lines } from '../plots/lines';
import { Notice, NumberField, Panel } from '../ui/controls';
import { ErrorList, FilePicker } from '../ui/files';
import { focusFirstWrong } from '../ui/refused';
import { AgainButton, Bar, CancelButton } from '../ui/job';
import { DiagnosisView } from './diagnosis';
import { RecordingPanel } from './recording_columns';
import { RigForm } from './rig_form';
import { PhaseKey, pickRun, RunPicker } from './runs';
import { useValveMarks, ValveMarks } from './valve_marks';

const fromCsv = signal(false);
const problem = signal('');
const recordings = signal<Recording[]>([]); // of what is open

const refusedWith = (name: string, error: unknown): void => {
  const { message, errors } = asProblem(error);
  problem.value = `${name} cannot be read: ${errors[0] ? errors[0].detail : message}`;
  measurementErrors.value = errors.slice(1);
};

const nameOf = (file: { name: string }): string => file.name.replace(/\.[^.]*$/, '');

// Puts the runs of the recordings into the measurement, in the place of what these had before.
function showRecordings(data: Measurement | null, rig: Rig | undefined): void {
  const read = recordings.value.filter((one) => one.measurement);
  if (read.length === 0) return;
  const ids = new Set(read.flatMap((one) => runsOf(one).map((run) => run.id)));
  const kept = (data?.runs ?? []).filter((run) => !ids.has(run.id));
  const base: Measurement = data
    ? { ...data, runs: kept }
    : { schema: 'measurement/1', name: nameOf(read[0]!), rig: rig ?? emptyRig(), runs: [] };
  const known = new Map((data?.runs ?? []).map((run) => [run.id, run.source_pressure_kpa_gauge]));
  measurement.value = read.reduce((whole, one) => {
    const runs = runsOf(one).map((run) => ({
      source_pressure_kpa_gauge: known.get(run.id),
      ...run,
    }));
    return withRuns(whole, runs);
  }, base);
}

async function answerTable(recording: Recording, answers: TableAnswers): Promise<void> {
  try {
    const next = await answered(recording, answers);
    recordings.value = recordings.value.map((one) => (one === recording ? next : one));
    problem.value = '';
    measurementErrors.value = [];
    showRecordings(measurement.value, undefined);
  } catch (error) {
    refusedWith(recording.name, error);
  }
}

// Files together are one measurement: the rig of a CSV may be one of them. `added` keeps what is open.
async function take(files: File[], added: boolean): Promise<void> {
  let data = added ? measurement.value : null;
  let text: string | null = null;
  let beside: Parameters<typeof withRig>[1] | null = null;
  const tables: File[] = [];
  const opened: Recording[] = added ? recordings.value : [];
  for (const file of files) {
    try {
      const whole = await file.text();
      if (!isJson(whole)) {
        tables.push(file);
        continue;
      }
      const content = readJson(whole);
      if (content.kind === 'rig') beside = content.document;
      else if (data) data = withRuns(data, content.document.runs, content.document.rig);
      else {
        data = content.document;
        text = content.text;
      }
    } catch (error) {
      problem.value = `${file.name} cannot be read: ${(error as Error).message}`;
      return;
    }
  }
  for (const file of tables) {
    try {
      opened.push(await openRecording(file, beside ?? { rig: data?.rig ?? {} }));
    } catch (error) {
      refusedWith(file.name, error);
      return;
    }
  }
  if (!data && tables.length === 0 && !measurement.value) {
    problem.value = 'A rig alone is no measurement: drop the CSV, too.';
    return;
  }
  fromCsv.value = (added ? fromCsv.value || !data : !data) && tables.length > 0 && !beside;
  recordings.value = [...opened];
  measurement.value = data ?? (tables.length > 0 ? null : measurement.value);
  problem.value = '';
  measurementErrors.value = [];
  showRecordings(data, beside?.rig);
  if (beside && measurement.value)
    measurement.value = { ...measurement.value, ...withRig(measurement.value.runs, beside) };
  originalText.value = files.length === 1 && !added ? text : null;
  setQuery({ job: undefined, run: undefined });
}

export function MeasuredView() {
  const over = useSignal(false);
  const page = useRef<HTMLDivElement>(null);
  const busy = useSignal(false);
  const job = route.value.query.get('job');
  const now = useJob<Diagnosis, Doing>(job ? diagnosisPath(job) : null);
  const result = now?.job?.result ?? undefined;
  // Said beside its field already.
  const isBesideField = ({ pointer }: FieldError) =>
    fromCsv.value && /^\/(rig|relative_uncertainty)\/|\/source_pressure_kpa_gauge$/.test(pointer);
  const isRunning = now?.job ? !ended(now.job.status) : false;
  const data = measurement.value;
  const goToWhatIsWrong = () =>
    focusFirstWrong(
      page.current!,
      measurementErrors.value.map((error) => error.pointer),
    );
  const limit = (seconds: number | null) => {
    const { time_limit_s: _, ...rest } = data!;
    measurement.value = seconds === null ? rest : { ...rest, time_limit_s: seconds };
    originalText.value = null;
  };
  const diagnose = async (text = originalText.value ?? JSON.stringify(data)) => {
    measurementErrors.value = [];
    problem.value = '';
    if (page.current!.querySelector('[aria-invalid="true"]')) {
      goToWhatIsWrong();
      return;
    }
    busy.value = true;
    try {
      const { body } = await ask<{ id: string }>('POST', '/v1/diagnoses', {
        text,
        headers: { 'Content-Type': 'application/json' },
      });
      setQuery({ job: body.id });
    } catch (error) {
      const refused = asProblem(error);
      problem.value = refused.errors.length > 0 ? 'Numbers are missing or wrong.' : refused.message;
      measurementErrors.value = refused.errors;
      setTimeout(goToWhatIsWrong); // once the fields are marked
    } finally {
      busy.value = false;
    }
  };
  // The same record again, with what a slip of the pen in it is.
  const settle = (assume: string) => {
    const record = data ?? result?.measurement;
    if (record)
      void diagnose(JSON.stringify({ ...record, assume: [...(record.assume ?? []), assume] }));
  };
  const drop = (event: DragEvent) => {
    event.preventDefault();
    over.value = false;
    const files = [...(event.dataTransfer?.files ?? [])];
    if (files.length) void take(files, false);
  };
  const accept = '.json,.csv,application/json,text/csv';
  return (
    <div
      ref={page}
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
            {data.name}: {data.runs.length} {data.runs.length === 1 ? 'run' : 'runs'},{' '}
            {data.runs.reduce((n, run) => n + run.t_s.length, 0)} samples
          </span>
        )}
        {!data && result && <span class="muted">{result.name}</span>}
        <span class="toolbar-group">
          {data && (
            <FilePicker label="Add runs…" accept={accept} multiple onFiles={(f) => take(f, true)} />
          )}
          <FilePicker
            label={data ? 'Another file…' : 'Open files…'}
            accept={accept}
            multiple
            onFiles={(files) => take(files, false)}
            primary={!data && !result}
          />
        </span>
      </div>
      {problem.value && (
        <Notice kind="bad">
          {problem.value}
          <ErrorList errors={measurementErrors.value.filter((error) => !isBesideField(error))} />
        </Notice>
      )}
      {!data && !job && recordings.value.length === 0 && <Welcome over={over.value} />}
      {!result &&
        recordings.value.map((one) => (
          <RecordingPanel
            key={one.name}
            recording={one}
            onChange={(answers) => void answerTable(one, answers)}
          />
        ))}
      {data && fromCsv.value && !result && <RigForm />}
      {data && !result && <Preview data={data} />}
      {data && !result && !isRunning && !recordings.value.some(isOpen) && (
        <div class="toolbar end">
          <NumberField
            label="Time limit"
            unit="s"
            value={data.time_limit_s ?? null}
            usual={usualLimitS}
            range={[0.01, 3600]}
            onChange={limit}
            onText={() => undefined}
          />
          <button
            type="button"
            class="primary"
            disabled={busy.value}
            onClick={() => void diagnose()}
          >
            Find what the model lacks
          </button>
        </div>
      )}
      {now?.problem && <Notice kind="bad">{now.problem.message}</Notice>}
      {now?.job && isRunning && <Running job={now.job} />}
      {now?.job && !isRunning && !result && (
        <>
          <Notice kind={now.job.status === 'failed' ? 'bad' : 'warn'}>
            {now.job.detail ?? `The diagnosis was ${now.job.status}.`}
          </Notice>
          <AgainButton self={diagnosisPath(job!)} name={now.job.name || 'unnamed'} />
        </>
      )}
      {result && <DiagnosisView diagnosis={result} id={job!} data={data} settle={settle} />}
    </div>
  );
}

// A recording to try it with, which comes with the page.
async function takeShipped(): Promise<void> {
  try {
    const answer = await fetch(shipped);
    await take([new File([await answer.blob()], 'simulated_recording.json')], false);
  } catch (error) {
    problem.value = `The recording cannot be read: ${(error as Error).message}`;
  }
}

const Welcome = ({ over }: { over: boolean }) => (
  <div class={`drop ${over ? 'over' : ''}`}>
    <p>
      <b>Drop a measurement here</b> and see what the model lacks: JSON (measurement/1), or CSV as
      your instrument writes it.
    </p>
    <pre>
      {`Time (ms);p [bar];valve
0;0,001;0
10;0,009;1
20;0,024;1`}
    </pre>
    <p class="muted">
      Columns are found by their headings and units, and can be put right by hand; a valve without a
      column is marked on the curve. The rig is asked for, or dropped beside it as JSON. Several
      files are read as one measurement.
    </p>
    <p>
      No recording at hand?{' '}
      <button type="button" onClick={() => void takeShipped()}>
        Open a shipped one
      </button>{' '}
      It is simulated: an actuator whose wall creeps.
    </p>
  </div>
);

function Running({ job }: { job: Job<Diagnosis, Doing> }) {
  const progress = job.progress;
  return (
    <Panel
      title={job.status === 'queued' ? 'Waiting for its turn' : 'Fitting and comparing models'}
      aside={<CancelButton self={job.links.self} />}
    >
      <Bar label="How much of the diagnosis is done" share={progress?.share ?? 0} />
      <p role="status">
        {progress ? `${progress.doing}, ${significant(progress.seconds, 2)} s` : 'Starting…'}
      </p>
    </Panel>
  );
}

function Preview({ data }: { data: Measurement }) {
  const ids = data.runs.map((run) => run.id);
  const run = data.runs.find((r) => r.id === pickRun(ids))!;
  const source = run.channels?.source_pressure_kpa_gauge;
  const chambers = Object.entries(run.channels?.chambers ?? {});
  const { rig } = data;
  const marks = useValveMarks(run);
  const isUnmarked = recordings.value.some(({ questions }) =>
    questions.some((one) => one.option === 'valve' && one.heading === run.id),
  );
  return (
    <Panel
      title={`${runTitle(run.id)}${run.blocked ? ', blocked' : ''}`}
      aside={<RunPicker ids={ids} value={run.id} />}
    >
      <Lines
        title="Measured pressure"
        x={run.t_s}
        xLabel="time, s"
        yLabel={`pressure, ${unitOf('pressure')}`}
        height={300}
        bands={shadesOf(run.valve, run.t_s[run.t_s.length - 1] ?? 0)}
        onPick={isUnmarked ? marks.mark : undefined}
        lines={[
          {
            label: rig.pressure_of ?? rig.chambers?.[0]?.name ?? 'actuator',
            values: pressuresShown(run.pressure_kpa_gauge),
            colour: '--c1',
          },
          ...chambers.map(([label, values], i) => ({
            label,
            values: pressuresShown(values),
            colour: `--c${2 + (i % 4)}`,
          })),
          ...(source ? [{ label: 'source', values: pressuresShown(source), colour: '--c6' }] : []),
        ]}
      />
      <PhaseKey />
      {isUnmarked && (
        <ValveMarks run={run} marks={marks} suggested={suggestedValve(recordings.value, run.id)} />
      )}
    </Panel>
  );
}
