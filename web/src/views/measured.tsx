// Measured data: drop a file, see it, ask what the model lacks.
import { signal, useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, type FieldError, post } from '../lib/api';
import { significant } from '../lib/format';
import { ended, follow, watched } from '../lib/jobs';
import { bandsOf, type Diagnosis, type Measurement, readMeasurement, type Rig } from '../lib/measurement';
import { routes, serves } from '../lib/models';
import { route, setQuery } from '../lib/route';
import { toShown, unitOf } from '../lib/units';
import { Lines } from '../plots/lines';
import { Check, Notice, NumberField, Panel, Segmented, Select } from '../ui/controls';
import { FilePicker } from '../ui/files';
import { DiagnosisView } from './diagnosis';

const measurement = signal<Measurement | null>(null);
const fromCsv = signal(false);
const problem = signal('');
const errors = signal<FieldError[]>([]);

async function take(file: File): Promise<void> {
  try {
    const text = await file.text();
    measurement.value = readMeasurement(file.name, text);
    fromCsv.value = !text.trimStart().startsWith('{');
    problem.value = '';
  } catch (error) {
    problem.value = `${file.name} cannot be read: ${(error as Error).message}`;
  }
  errors.value = [];
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
    errors.value = [];
    problem.value = '';
    try {
      const accepted = await post<{ id: string }>('/v1/diagnoses', data);
      setQuery({ job: accepted.id });
    } catch (error) {
      const refused = asProblem(error);
      problem.value = refused.status === 404 ? 'This service cannot diagnose measurements.' : refused.message;
      errors.value = refused.errors;
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
    <div class="measured" onDragOver={(e) => { e.preventDefault(); over.value = true; }} onDragLeave={() => (over.value = false)} onDrop={drop}>
      <div class="toolbar">
        <h1>Measured data</h1>
        {data && <span class="muted">{data.name}: {data.runs.length} runs, {data.runs.reduce((n, run) => n + run.t_s.length, 0)} samples</span>}
        <span class="toolbar-group">
          <FilePicker label={data ? 'Another file…' : 'Open a file…'} accept=".json,.csv,application/json,text/csv" onFile={(file) => void take(file)} primary={!data} />
        </span>
      </div>
      {problem.value && (
        <Notice kind="bad">
          {problem.value}
          {errors.value.length > 0 && <ul>{errors.value.map((e) => <li key={e.pointer}><code>{e.pointer}</code> {e.detail}</li>)}</ul>}
        </Notice>
      )}
      {routes.value && !canDiagnose && (
        <Notice kind="warn">This service does not diagnose measurements yet; files can be looked at only.</Notice>
      )}
      {!data && !self && (
        <div class={`drop ${over.value ? 'over' : ''}`}>
          <p><b>Drop a measurement here</b>, as JSON (measurement/1) or CSV with the columns <code>run, t_s, valve, pressure_kpa_gauge</code>.</p>
          <p class="muted">The valve is hold, inflate or deflate. A CSV may also hold source_pressure_kpa_gauge, inlet_pressure_kpa_gauge, temperature_k, volume_ml and flow_l_per_min_anr.</p>
        </div>
      )}
      {data && fromCsv.value && !result && <RigForm />}
      {data && !result && <Preview data={data} />}
      {data && !result && (
        <div class="toolbar end">
          <button type="button" class="primary" disabled={!canDiagnose || busy.value || (now?.job ? !ended(now.job.status) : false)} onClick={() => void diagnose()}>
            Find what the model lacks
          </button>
        </div>
      )}
      {now && !now.job && now.problem && <Notice kind="bad">{now.problem.message}</Notice>}
      {now?.job && !ended(now.job.status) && (
        <p class="loading" role="status">
          Fitting and comparing models… {now.job.progress?.seconds !== undefined && `${significant(now.job.progress.seconds, 2)} s`}
        </p>
      )}
      {now?.job && ended(now.job.status) && !result && <Notice kind="bad">{now.job.detail ?? `The diagnosis was ${now.job.status}.`}</Notice>}
      {result && <DiagnosisView diagnosis={result} id={job!} data={data} />}
    </div>
  );
}

function RigForm() {
  const data = measurement.value!;
  const { actuator, line, supply } = data.rig;
  const set = (rig: Partial<Rig>) => (measurement.value = { ...data, rig: { ...data.rig, ...rig } });
  const setActuator = (name: keyof Rig['actuator']) => (v: number | null) => set({ actuator: { ...actuator, [name]: v } });
  const setLine = (name: keyof Rig['line']) => (v: number | null) => set({ line: { ...line, [name]: v } });
  const errorAt = (pointer: string) => errors.value.find((e) => e.pointer === pointer)?.detail;
  const source = data.runs[0]?.source_pressure_kpa_gauge;
  const sigma = data.relative_uncertainty ?? {};
  const setSigma = (name: string) => (v: number | null) =>
    (measurement.value = { ...data, relative_uncertainty: { ...sigma, ...(v === null ? {} : { [name]: v }) } });
  return (
    <Panel title="The rig it was measured on">
      <div class="fields">
        <NumberField label="Volume at rest" kind="volume_ml" value={actuator.rest_volume_ml} error={errorAt('/rig/actuator/rest_volume_ml')} onChange={setActuator('rest_volume_ml')} />
        <NumberField label="Expansion" unit="× at operating" value={actuator.expansion_ratio} error={errorAt('/rig/actuator/expansion_ratio')} onChange={setActuator('expansion_ratio')} />
        <NumberField label="Operating pressure" kind="pressure" value={actuator.operating_pressure_kpa_gauge} error={errorAt('/rig/actuator/operating_pressure_kpa_gauge')} onChange={setActuator('operating_pressure_kpa_gauge')} />
        <NumberField label="Conductance C of the line" unit="dm³/(s·bar)" value={line.sonic_conductance_dm3_per_s_bar} error={errorAt('/rig/line/sonic_conductance_dm3_per_s_bar')} onChange={setLine('sonic_conductance_dm3_per_s_bar')} />
        <NumberField label="Critical ratio b" value={line.critical_ratio} error={errorAt('/rig/line/critical_ratio')} onChange={setLine('critical_ratio')} />
        <NumberField label="C uncertain by" unit="1 σ, share" value={typeof sigma.sonic_conductance === 'number' ? sigma.sonic_conductance : null} optional hint="exact if empty" onChange={setSigma('sonic_conductance')} />
        <NumberField label="Volume uncertain by" unit="1 σ, share" value={typeof sigma.rest_volume === 'number' ? sigma.rest_volume : null} optional hint="exact if empty" onChange={setSigma('rest_volume')} />
        {supply.kind === 'regulated' && (
          <NumberField
            label="Source pressure" kind="pressure" value={source} error={errorAt('/runs/0/source_pressure_kpa_gauge')}
            onChange={(v) => (measurement.value = { ...data, runs: data.runs.map((run) => ({ ...run, source_pressure_kpa_gauge: v ?? undefined })) })}
          />
        )}
      </div>
      <div class="toolbar">
        <Select
          label="Supply" value={supply.kind} onChange={(kind) => set({ supply: { kind } })}
          options={[{ value: 'regulated', label: 'regulated' }, { value: 'measured', label: 'as measured (source column)' }, { value: 'none', label: 'none: a closed or emptying chamber' }]}
        />
        <span class="checks" role="group" aria-label="Runs with a blocked actuator">
          {data.runs.slice(0, 20).map((run, i) => (
            <Check
              key={run.id} label={`${run.id} blocked`} checked={run.blocked ?? false}
              onChange={(blocked) => (measurement.value = { ...data, runs: data.runs.map((r, j) => (i === j ? { ...r, blocked } : r)) })}
            />
          ))}
        </span>
      </div>
    </Panel>
  );
}

export function RunPicker({ ids, value }: { ids: string[]; value: string }) {
  if (ids.length < 2) return null;
  const onChange = (id: string) => setQuery({ run: id === ids[0] ? undefined : id });
  return ids.length <= 6
    ? <Segmented label="run" options={ids} value={value} onChange={onChange} />
    : <Select label="run" value={value} options={ids.map((id) => ({ value: id, label: id }))} onChange={onChange} />;
}

export const pickRun = (ids: string[]): string => {
  const asked = route.value.query.get('run');
  return asked && ids.includes(asked) ? asked : (ids[0] ?? '');
};

export const PhaseKey = () => (
  <p class="hint phase-key">
    Shades: <i class="swatch inflate" /> inflate <i class="swatch hold" /> hold <i class="swatch deflate" /> deflate
  </p>
);

function Preview({ data }: { data: Measurement }) {
  const ids = data.runs.map((run) => run.id);
  const run = data.runs.find((r) => r.id === pickRun(ids))!;
  const show = (values: (number | null)[]) => values.map((v) => (v === null ? null : toShown('pressure', v)));
  const source = run.channels?.source_pressure_kpa_gauge;
  return (
    <Panel title={`Run ${run.id}${run.blocked ? ', blocked' : ''}`} aside={<RunPicker ids={ids} value={run.id} />}>
      <Lines
        title="Measured pressure" x={run.t_s} xLabel="time, s" yLabel={`pressure, ${unitOf('pressure')}`} height={300}
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
