// What a diagnosis found: the verdict, measured against model before and after, residuals, the
// candidates, the next experiment; and the revised model, saved and used.
import { useSignal } from '@preact/signals';

import { asProblem, post } from '../lib/api';
import { fieldName, significant } from '../lib/format';
import { previousJob, start } from '../lib/jobs';
import { bandsOf, type Diagnosis, effectName, type ErrorReport, type Estimate, type Measurement, verdictSentence } from '../lib/measurement';
import { models, refreshModels, serves } from '../lib/models';
import { load, requirements } from '../lib/requirements';
import { go } from '../lib/route';
import { toShown, unitOf } from '../lib/units';
import { Lines } from '../plots/lines';
import { Chip, Notice, Panel, TextField } from '../ui/controls';
import { saveFile } from '../ui/files';
import { PhaseKey, pickRun, RunPicker } from './measured';

const kinds: Record<Diagnosis['verdict'], { text: string; kind: string }> = {
  adequate: { text: 'adequate', kind: 'good' },
  explained: { text: 'explained', kind: 'good' },
  tie: { text: 'a tie', kind: 'warn' },
  unexplained: { text: 'unexplained', kind: 'bad' },
  undecided: { text: 'undecided', kind: 'warn' },
};

export function DiagnosisView({ diagnosis: d, id, data }: { diagnosis: Diagnosis; id: string; data: Measurement | null }) {
  const word = kinds[d.verdict];
  return (
    <>
      <Panel
        title={<><Chip kind={word.kind}>{word.text}</Chip> {verdictSentence(d)}</>}
        aside={<button type="button" onClick={() => saveFile(`${data?.name ?? id}-diagnosis.json`, `${JSON.stringify(d, null, 2)}\n`)}>JSON</button>}
      >
        <Errors d={d} />
        {d.warnings?.map((warning) => <Notice key={warning} kind="warn">{warning}</Notice>)}
      </Panel>
      {d.series && d.series.length > 0 && <Curves d={d} data={data} />}
      <div class="plots even">
        <Effects d={d} />
        <Phases d={d} />
      </div>
      {d.next_experiment && <NextExperiment d={d} />}
      {d.discrepancy?.places && d.discrepancy.places.length > 0 && (
        <Panel title="Where the unexplained part lives">
          <ul class="history">{d.discrepancy.places.map((p) => <li key={p.axis + p.where}>{p.axis}: {p.where} ({significant(100 * p.share, 2)} % of its energy)</li>)}</ul>
        </Panel>
      )}
      <Candidates d={d} />
      {d.effects.length > 0 && <SaveModel id={id} />}
    </>
  );
}

function Errors({ d }: { d: Diagnosis }) {
  const rows: [string, ErrorReport | undefined][] = [['as declared', d.declared], ['re-fitted', d.before], ['with effects', d.after]];
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Errors of the model">
      <table>
        <thead>
          <tr>
            <th scope="col">model</th><th scope="col" class="num">RMS <small>kPa</small></th><th scope="col" class="num">of operating <small>%</small></th>
            <th scope="col" class="num">peak <small>kPa</small></th><th scope="col" class="num">held out <small>kPa</small></th>
          </tr>
        </thead>
        <tbody>
          {rows.map(([label, report]) => report && (
            <tr key={label}>
              <th scope="row">{label}</th>
              <td class="num">{significant(report.rms_kpa)}</td>
              <td class="num">{significant(report.rms_percent)}</td>
              <td class="num">{significant(report.peak_kpa)}</td>
              <td class="num">{significant(report.holdout_rms_kpa)}</td>
            </tr>
          ))}
          <tr>
            <td>noise of the readings</td><td class="num">{significant(d.noise_kpa)}</td><td /><td /><td />
          </tr>
        </tbody>
      </table>
    </div>
  );
}

function Curves({ d, data }: { d: Diagnosis; data: Measurement | null }) {
  const ids = d.series!.map((series) => series.run);
  const series = d.series!.find((s) => s.run === pickRun(ids))!;
  const run = data?.runs.find((r) => r.id === series.run);
  const bands = bandsOf(run, series.t_s[series.t_s.length - 1] ?? 0);
  const show = (values: (number | null)[]) => values.map((v) => (v === null ? null : toShown('pressure', v)));
  const rest = (model: (number | null)[]) =>
    series.measured_kpa.map((v, i) => (v === null || model[i] == null ? null : v - model[i]!));
  return (
    <Panel title="Measured against model" aside={<RunPicker ids={ids} value={series.run} />}>
      <Lines
        title={`Run ${series.run}`} x={series.t_s} xLabel="time, s" yLabel={`pressure, ${unitOf('pressure')}`} height={280} bands={bands} sync="diagnosis"
        lines={[
          { label: 'measured', values: show(series.measured_kpa), colour: '--c6', width: 2.4 },
          { label: 'model before', values: show(series.before_kpa), colour: '--c2', dash: [6, 3] },
          { label: 'model after', values: show(series.after_kpa), colour: '--c1' },
        ]}
      />
      <Lines
        title="Residual: measured less model" x={series.t_s} xLabel="time, s" yLabel="residual, kPa" height={180} bands={bands} sync="diagnosis"
        lines={[
          { label: 'before', values: rest(series.before_kpa), colour: '--c2', width: 1 },
          { label: 'after', values: rest(series.after_kpa), colour: '--c1', width: 1 },
        ]}
      />
      {run && <PhaseKey />}
    </Panel>
  );
}

const interval = (e: Estimate): string => (e.ci95 ? `${significant(e.ci95[0])} … ${significant(e.ci95[1])}` : '–');

function EstimateRow({ name, value }: { name: string; value: Estimate | string }) {
  const { label, unit } = fieldName(name);
  return (
    <tr>
      <td>{label}</td>
      {typeof value === 'string' ? (
        <td class="num" colSpan={2}>{value}</td>
      ) : (
        <>
          <td class="num">{significant(value.value)} {unit}</td>
          <td class="num">{value.identified === false ? 'not fixed by the data' : interval(value)}</td>
        </>
      )}
    </tr>
  );
}

function Effects({ d }: { d: Diagnosis }) {
  const fitted = Object.entries(d.fitted ?? {});
  return (
    <Panel title="What the model gets">
      {d.effects.length === 0 && <p>{d.verdict === 'tie' ? 'Nothing yet: the tie has to be decided first.' : 'No effect was established.'}</p>}
      {d.effects.map((effect) => (
        <div key={effect.id}>
          <h3>{effectName(effect.id)} <code>{effect.id}</code></h3>
          <table>
            <thead><tr><th scope="col">parameter</th><th scope="col" class="num">value</th><th scope="col" class="num">95 %</th></tr></thead>
            <tbody>{Object.entries(effect.parameters).map(([name, value]) => <EstimateRow key={name} name={name} value={value} />)}</tbody>
          </table>
        </div>
      ))}
      {fitted.length > 0 && (
        <>
          <h3>Declared numbers, re-fitted</h3>
          <table>
            <thead><tr><th scope="col">number</th><th scope="col" class="num">value</th><th scope="col" class="num">95 %</th></tr></thead>
            <tbody>{fitted.map(([name, value]) => <EstimateRow key={name} name={name} value={value} />)}</tbody>
          </table>
        </>
      )}
    </Panel>
  );
}

function Phases({ d }: { d: Diagnosis }) {
  const { phases, white, independent_of_inputs } = d.residual;
  const most = Math.max(1e-9, ...phases.map((p) => Math.abs(p.mean_kpa)));
  return (
    <Panel title="What is left, by phase" aside={<span class="muted">after the best fit</span>}>
      <p>
        <Chip kind={white ? 'good' : 'warn'}>{white ? 'white' : 'not white'}</Chip>{' '}
        <Chip kind={independent_of_inputs ? 'good' : 'warn'}>{independent_of_inputs ? 'independent of the inputs' : 'follows the inputs'}</Chip>
        {d.unexplained_fraction > 0 && <span> {significant(100 * d.unexplained_fraction, 2)} % of its variance is more than noise.</span>}
      </p>
      <div class="scroll phases" tabIndex={0} role="region" aria-label="Residuals by phase">
        <table>
          <thead>
            <tr><th scope="col">run</th><th scope="col">phase</th><th scope="col" class="num">mean <small>kPa</small></th><th scope="col"><span class="only-heard">bar</span></th><th scope="col" class="num">trend <small>kPa/s</small></th></tr>
          </thead>
          <tbody>
            {phases.map((p, i) => (
              <tr key={i}>
                <td>{p.run}</td><td>{p.phase}</td><td class="num">{significant(p.mean_kpa, 2)}</td>
                <td>
                  <span class="swing-track">
                    <i class={p.mean_kpa > 0 ? 'slower' : 'faster'} style={{ width: `${(Math.abs(p.mean_kpa) / most) * 50}%`, left: p.mean_kpa > 0 ? '50%' : `${50 - (Math.abs(p.mean_kpa) / most) * 50}%` }} />
                  </span>
                </td>
                <td class="num">{significant(p.trend_kpa_per_s, 2)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </Panel>
  );
}

function Candidates({ d }: { d: Diagnosis }) {
  const tied = new Set(d.tied.map((set) => set.join()));
  return (
    <Panel title="Candidates" aside={<span class="muted">less BIC is better; below 10 is close</span>}>
      <div class="scroll phases" tabIndex={0} role="region" aria-label="Candidate models">
        <table>
          <thead>
            <tr><th scope="col">effects</th><th scope="col" class="num">ΔBIC</th><th scope="col" class="num">RMS <small>kPa</small></th><th scope="col" class="num">held out <small>kPa</small></th></tr>
          </thead>
          <tbody>
            {d.candidates.map((c, i) => (
              <tr key={i} class={i === 0 ? 'baseline' : ''}>
                <th scope="row">{c.effects.map(effectName).join(' + ') || 'base model'} {tied.has(c.effects.join()) && <Chip kind="warn">tied</Chip>}</th>
                <td class="num">{significant(c.delta_bic)}</td><td class="num">{significant(c.rms_kpa)}</td><td class="num">{significant(c.holdout_rms_kpa)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </Panel>
  );
}

function NextExperiment({ d }: { d: Diagnosis }) {
  const next = d.next_experiment!;
  return (
    <Panel title="The experiment that would tell">
      {next.why && <p>{next.why}</p>}
      <dl class="facts">
        {next.source_pressure_kpa_gauge !== undefined && (
          <div><dt>source</dt><dd>{significant(toShown('pressure', next.source_pressure_kpa_gauge))} <small>{unitOf('pressure')}</small></dd></div>
        )}
        <div><dt>actuator</dt><dd>{next.blocked ? 'blocked' : 'free'}</dd></div>
        {next.t_end_s !== undefined && <div><dt>for</dt><dd>{significant(next.t_end_s)} <small>s</small></dd></div>}
        {next.expected_difference_kpa !== undefined && (
          <div><dt>expected difference</dt><dd>{significant(next.expected_difference_kpa)} <small>kPa</small></dd></div>
        )}
      </dl>
      <p>
        Valve: {(next.valve ?? []).map((command) => `${command.state} at ${significant(command.t_s)} s`).join(', ') || '–'}.{' '}
        {next.measure && `Measure ${next.measure.map((name) => fieldName(name).label).join(', ')}.`}
      </p>
    </Panel>
  );
}

// Saves the revision and ranks the requirements of the other view with it.
function SaveModel({ id }: { id: string }) {
  const name = useSignal('');
  const problem = useSignal('');
  const saved = useSignal('');
  const canSave = serves('POST /v1/models');
  const save = async () => {
    try {
      await post('/v1/models', { name: name.value, diagnosis: id });
      saved.value = name.value;
      problem.value = '';
      await refreshModels();
    } catch (error) {
      const refused = asProblem(error);
      problem.value = [refused.message, ...refused.errors.map((e) => e.detail)].join(' ');
    }
  };
  const rank = async () => {
    const before = previousJob.value;
    const revised = { ...requirements.value, model: saved.value };
    try {
      const job = await start(revised);
      load(revised);
      go(['designs', job], { with: before ?? undefined });
    } catch (error) {
      const refused = asProblem(error);
      problem.value = [refused.message, ...refused.errors.map((e) => e.detail)].join(' ');
    }
  };
  return (
    <Panel title="Save as a model revision and rank again">
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {!canSave && <Notice kind="warn">This service does not save model revisions over HTTP yet.</Notice>}
      <div class="toolbar">
        <TextField label="Name" value={name.value} onChange={(v) => (name.value = v)} hint={models.value.some((m) => m.name === name.value) ? 'taken' : ''} />
        <button type="button" disabled={!canSave || name.value.trim() === ''} onClick={() => void save()}>Save the revision</button>
        <button type="button" class="primary" disabled={saved.value === ''} onClick={() => void rank()}>
          Rank {requirements.value.name || 'the requirements'} with {saved.value || 'it'}
        </button>
      </div>
    </Panel>
  );
}
