// Keeps what a diagnosis established as a model revision, and ranks the requirements with it.
import { useSignal } from '@preact/signals';

import { asProblem, post } from '../lib/api';
import { start } from '../lib/jobs';
import { type Diagnosis, effectNames, type SavedModel } from '../lib/measurement';
import { models, refreshModels } from '../lib/models';
import { load, requirements } from '../lib/requirements';
import { go } from '../lib/route';
import { Notice, Panel, TextField } from '../ui/controls';

interface Saved {
  name: string;
  version: number;
  hash: string;
}

export function SaveModel({ diagnosis: d, model }: { diagnosis: Diagnosis; model: SavedModel }) {
  const name = useSignal('');
  const problem = useSignal('');
  const saved = useSignal<Saved | null>(null);
  const attempt = async (act: () => Promise<void>) => {
    try {
      problem.value = '';
      await act();
    } catch (error) {
      problem.value = asProblem(error).sentence;
    }
  };
  const save = async () => {
    saved.value = await post<Saved>('/v1/models', { name: name.value, model });
    await refreshModels();
  };
  const rank = async () => {
    const revised = { ...requirements.value, model: saved.value!.name };
    const job = await start(revised);
    load(revised);
    go(['designs', job]);
  };
  const known = models.value.find((m) => m.name === name.value);
  const factors = Object.keys(model.factors);
  return (
    <Panel title="Save as a model revision and rank again">
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      <p class="muted">
        Kept: {model.effects.length ? effectNames(model.effects.map((e) => e.id)) : 'no effect'}
        {factors.length > 0 &&
          `, ${factors.length} re-fitted ${factors.length === 1 ? 'number' : 'numbers'}`}
        , their variances, the errors and the hash of the data. Ranking uses the effects, but those
        of the sensor.
        {d.discrepancy?.learned && ' The learned term holds only within the range of these data.'}
      </p>
      <div class="toolbar">
        <TextField
          label="Name"
          value={name.value}
          onChange={(v) => (name.value = v)}
          hint={known ? `becomes version ${known.version + 1}` : 'a-z, 0-9, -'}
        />
        <button
          type="button"
          disabled={name.value.trim() === ''}
          onClick={() => void attempt(save)}
        >
          Save the revision
        </button>
        <button
          type="button"
          class="primary"
          disabled={saved.value === null}
          onClick={() => void attempt(rank)}
        >
          Rank {requirements.value.name || 'the requirements'} with {saved.value?.name ?? 'it'}
        </button>
      </div>
      {saved.value && (
        <p role="status">
          Saved as {saved.value.name}, version {saved.value.version}.
        </p>
      )}
    </Panel>
  );
}
