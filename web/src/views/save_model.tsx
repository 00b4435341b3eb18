// Keeps what a diagnosis established as a model revision, and ranks the requirements with it.
import { signal, useSignal } from '@preact/signals';

import { asProblem, post } from '../lib/api';
import { start } from '../lib/jobs';
import { effectNames } from '../lib/effect_words';
import { type Diagnosis, type SavedModel } from '../lib/measurement';
import { models, refreshModels } from '../lib/models';
import { load, requirements } from '../lib/requirements';
import { go } from '../lib/route';
import { Notice, Panel, TextField } from '../ui/controls';

interface Saved {
  name: string;
  version: number;
  hash: string;
}

// What was saved of which diagnosis, as long as the window is open.
const kept = 'plenum-saved-models';
const savedOf = signal<Record<string, Saved>>(JSON.parse(sessionStorage.getItem(kept) ?? '{}'));

export function SaveModel({
  diagnosis: d,
  id,
  model,
}: {
  diagnosis: Diagnosis;
  id: string;
  model: SavedModel;
}) {
  const saved = savedOf.value[id] ?? null;
  const name = useSignal(saved?.name ?? '');
  const problem = useSignal('');
  const attempt = async (act: () => Promise<void>) => {
    try {
      problem.value = '';
      await act();
    } catch (error) {
      problem.value = asProblem(error).sentence;
    }
  };
  const save = async () => {
    const made = await post<Saved>('/v1/models', { name: name.value.trim(), model });
    savedOf.value = { ...savedOf.value, [id]: made };
    sessionStorage.setItem(kept, JSON.stringify(savedOf.value));
    await refreshModels();
  };
  const rank = async () => {
    const revised = { ...requirements.value, model: ranked!.name };
    const job = await start(revised);
    load(revised);
    go(['designs', job]);
  };
  const known = models.value.find((m) => m.name === name.value.trim());
  // A model that was saved before may be named, too.
  const isSaved = saved !== null && ['', saved.name].includes(name.value.trim());
  const ranked = known ?? (isSaved ? saved : null);
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
        {model.tied && ' Other sets do as well: the run proposed above would decide.'}
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
          disabled={ranked === null}
          onClick={() => void attempt(rank)}
        >
          Rank {requirements.value.name || 'the requirements'} with {ranked?.name ?? 'it'}
        </button>
      </div>
      {saved ? (
        <p role="status">
          Saved as {saved.name}, version {saved.version}.
        </p>
      ) : (
        known && (
          <p class="hint">
            {known.name}, version {known.version}, was saved before: it ranks with that one unless
            this revision is saved.
          </p>
        )
      )}
    </Panel>
  );
}
