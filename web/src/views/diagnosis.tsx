// What a diagnosis found: the verdict, measured against model before and after, residuals, the
// candidates, the next experiment; and the revised model, saved and used.
import { useSignal } from '@preact/signals';

import { asProblem, post } from '../lib/api';
import { significant } from '../lib/format';
import { start } from '../lib/jobs';
import {
  bandsOf,
  type Diagnosis,
  type Measurement,
  revisionOf,
  verdictSentence,
} from '../lib/measurement';
import { models, refreshModels, serves } from '../lib/models';
import { load, requirements } from '../lib/requirements';
import { go } from '../lib/route';
import { toShown, unitOf } from '../lib/units';
import { Lines } from '../plots/lines';
import { Chip, Notice, Panel, TextField } from '../ui/controls';
import { saveFile } from '../ui/files';
import { PhaseKey, pickRun, RunPicker } from './runs';
import { Candidates, Effects, Errors, NextExperiment, Phases } from './diagnosis_tables';

const kinds: Record<Diagnosis['verdict'], { text: string; kind: string }> = {
  adequate: { text: 'adequate', kind: 'good' },
  explained: { text: 'explained', kind: 'good' },
  tie: { text: 'a tie', kind: 'warn' },
  unexplained: { text: 'unexplained', kind: 'bad' },
  undecided: { text: 'undecided', kind: 'warn' },
};

export function DiagnosisView({
  diagnosis: d,
  id,
  data,
}: {
  diagnosis: Diagnosis;
  id: string;
  data: Measurement | null;
}) {
  const word = kinds[d.verdict];
  return (
    <>
      <Panel
        title={
          <>
            <Chip kind={word.kind}>{word.text}</Chip> {verdictSentence(d)}
          </>
        }
        aside={
          <button
            type="button"
            onClick={() =>
              saveFile(`${data?.name ?? id}-diagnosis.json`, `${JSON.stringify(d, null, 2)}\n`)
            }
          >
            JSON
          </button>
        }
      >
        <Errors d={d} />
        {d.warnings?.map((warning) => (
          <Notice key={warning} kind="warn">
            {warning}
          </Notice>
        ))}
      </Panel>
      {d.series && d.series.length > 0 && <Curves d={d} data={data} />}
      <div class="plots even">
        <Effects d={d} />
        <Phases d={d} />
      </div>
      {d.next_experiment && <NextExperiment d={d} />}
      {d.discrepancy?.places && d.discrepancy.places.length > 0 && (
        <Panel title="Where the unexplained part lives">
          <ul class="history">
            {d.discrepancy.places.map((p) => (
              <li key={p.axis + p.where}>
                {p.axis}: {p.where} ({significant(100 * p.share, 2)} % of its energy)
              </li>
            ))}
          </ul>
        </Panel>
      )}
      <Candidates d={d} />
      {d.effects.length > 0 && <SaveModel diagnosis={d} />}
    </>
  );
}

function Curves({ d, data }: { d: Diagnosis; data: Measurement | null }) {
  const ids = d.series!.map((series) => series.run);
  const series = d.series!.find((s) => s.run === pickRun(ids))!;
  const run = data?.runs.find((r) => r.id === series.run);
  const bands = bandsOf(run, series.t_s[series.t_s.length - 1] ?? 0);
  const show = (values: (number | null)[]) =>
    values.map((v) => (v === null ? null : toShown('pressure', v)));
  const rest = (model: (number | null)[]) =>
    series.measured_kpa.map((v, i) => (v === null || model[i] == null ? null : v - model[i]!));
  return (
    <Panel title="Measured against model" aside={<RunPicker ids={ids} value={series.run} />}>
      <Lines
        title={`Run ${series.run}`}
        x={series.t_s}
        xLabel="time, s"
        yLabel={`pressure, ${unitOf('pressure')}`}
        height={280}
        bands={bands}
        sync="diagnosis"
        lines={[
          { label: 'measured', values: show(series.measured_kpa), colour: '--c6', width: 2.4 },
          { label: 'model before', values: show(series.before_kpa), colour: '--c2', dash: [6, 3] },
          { label: 'model after', values: show(series.after_kpa), colour: '--c1' },
        ]}
      />
      <Lines
        title="Residual: measured less model"
        x={series.t_s}
        xLabel="time, s"
        yLabel="residual, kPa"
        height={180}
        bands={bands}
        sync="diagnosis"
        lines={[
          { label: 'before', values: rest(series.before_kpa), colour: '--c2', width: 1 },
          { label: 'after', values: rest(series.after_kpa), colour: '--c1', width: 1 },
        ]}
      />
      {run && <PhaseKey />}
    </Panel>
  );
}

// Saves the revision and ranks the requirements of the other view with it.
function SaveModel({ diagnosis }: { diagnosis: Diagnosis }) {
  const name = useSignal('');
  const problem = useSignal('');
  const saved = useSignal('');
  const canSave = serves('POST /v1/models');
  const save = async () => {
    try {
      await post('/v1/models', { name: name.value, model: revisionOf(diagnosis) });
      saved.value = name.value;
      problem.value = '';
      await refreshModels();
    } catch (error) {
      const refused = asProblem(error);
      problem.value = [refused.message, ...refused.errors.map((e) => e.detail)].join(' ');
    }
  };
  const rank = async () => {
    const revised = { ...requirements.value, model: saved.value };
    try {
      const job = await start(revised);
      load(revised);
      go(['designs', job]);
    } catch (error) {
      const refused = asProblem(error);
      problem.value = [refused.message, ...refused.errors.map((e) => e.detail)].join(' ');
    }
  };
  return (
    <Panel title="Save as a model revision and rank again">
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {!canSave && (
        <Notice kind="warn">This service does not save model revisions over HTTP yet.</Notice>
      )}
      <div class="toolbar">
        <TextField
          label="Name"
          value={name.value}
          onChange={(v) => (name.value = v)}
          hint={
            models.value.some((m) => m.name === name.value)
              ? 'becomes its next version'
              : 'a-z, 0-9, -'
          }
        />
        <button
          type="button"
          disabled={!canSave || name.value.trim() === ''}
          onClick={() => void save()}
        >
          Save the revision
        </button>
        <button
          type="button"
          class="primary"
          disabled={saved.value === ''}
          onClick={() => void rank()}
        >
          Rank {requirements.value.name || 'the requirements'} with {saved.value || 'it'}
        </button>
      </div>
    </Panel>
  );
}
