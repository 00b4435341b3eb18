// Parts from a CSV file: what would happen is shown before anything is written.
import { useSignal } from '@preact/signals';

import { ask, asProblem, type FieldError } from '../lib/api';
import { Dialog, Notice } from '../ui/controls';
import { ExportButton, FilePicker } from '../ui/files';

interface Plan {
  added: string[];
  replaced: string[];
  unchanged: string[];
}

export function ImportDialog({
  family,
  onClose,
}: {
  family: string;
  onClose: (done: boolean) => void;
}) {
  const text = useSignal('');
  const plan = useSignal<Plan | null>(null);
  const errors = useSignal<FieldError[]>([]);
  const problem = useSignal('');
  const send = (dryRun: boolean) =>
    ask<Plan>('POST', `/v1/parts/import?family=${family}&dry_run=${dryRun}`, {
      text: text.value,
      headers: { 'Content-Type': 'text/csv' },
    });
  const preview = async (csv: string) => {
    text.value = csv;
    plan.value = null;
    errors.value = [];
    problem.value = '';
    if (csv.trim() === '') return;
    try {
      plan.value = (await send(true)).body;
    } catch (error) {
      const refused = asProblem(error);
      errors.value = refused.errors;
      problem.value = refused.errors.length
        ? `${refused.errors.length} errors; nothing can be imported.`
        : refused.message;
    }
  };
  const write = async () => {
    try {
      await send(false);
      onClose(true);
    } catch (error) {
      problem.value = asProblem(error).message;
    }
  };
  const n = plan.value ? plan.value.added.length + plan.value.replaced.length : 0;
  const list = (label: string, ids: string[]) =>
    ids.length > 0 && (
      <p>
        <b>
          {ids.length} {label}:
        </b>{' '}
        {ids.slice(0, 12).join(', ')}
        {ids.length > 12 && ' …'}
      </p>
    );
  return (
    <Dialog wide title={`Import ${family} parts from CSV`} onClose={() => onClose(false)}>
      <p class="hint">
        The columns are those of the export; cells may carry units, such as 6 bar or 350 g.
      </p>
      <div class="toolbar">
        <FilePicker
          label="Choose a file…"
          accept=".csv,text/csv"
          onFiles={([file]) => void file!.text().then(preview)}
        />
        <ExportButton family={family} label="Export as a pattern" />
      </div>
      <label class="curve">
        or paste it here
        <textarea
          rows={8}
          value={text.value}
          onInput={(e) => void preview(e.currentTarget.value)}
        />
      </label>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {errors.value.length > 0 && (
        <ul class="import-errors">
          {errors.value.slice(0, 50).map((e) => (
            <li key={e.pointer + e.detail}>
              <code>{e.pointer}</code> {e.detail}
            </li>
          ))}
        </ul>
      )}
      {plan.value && (
        <Notice kind="info">
          {list('to add', plan.value.added)}
          {list('to replace', plan.value.replaced)}
          {list('unchanged', plan.value.unchanged)}
        </Notice>
      )}
      <div class="toolbar end">
        <button type="button" class="primary" disabled={n === 0} onClick={() => void write()}>
          Import {n === 1 ? 'the part' : `${n} parts`}
        </button>
      </div>
    </Dialog>
  );
}
