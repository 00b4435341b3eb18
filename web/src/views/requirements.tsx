// What the supply has to do: the form, its check, and the start of a search.
import { useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';

import { placeInWords } from '../lib/amounts';
import { asProblem, type FieldError, type Problem } from '../lib/api';
import { fieldKind, inUnit } from '../lib/format';
import { previousJob, start } from '../lib/jobs';
import {
  areRestored,
  edit,
  fieldErrors,
  load,
  numbers,
  presets,
  refuse,
  requirements,
  validity,
  valueAt,
  whyUnknown,
} from '../lib/requirements';
import { go, link } from '../lib/route';
import type { Requirements } from '../lib/types';
import { Notice, Panel, TextField } from '../ui/controls';
import { FilePicker, saveFile } from '../ui/files';
import { noteText } from '../lib/words';
import { focusFirstWrong, focusOn } from '../ui/refused';
import { Drawing } from './drawing';
import { Groups } from './groups';
import { Objective } from './objective';
import { Conditions, Duty, Supply } from './requirement_panels';

export function RequirementsView() {
  const problem = useSignal<Problem | null>(null);
  const busy = useSignal(false);
  const form = useRef<HTMLFormElement>(null);
  const document = requirements.value;
  const isInvalid = validity.value === 'invalid';
  const goToWhatIsWrong = () => {
    const pointers = fieldErrors.value.map((error) => error.pointer);
    if (!focusFirstWrong(form.current!, pointers))
      form.current!.querySelector<HTMLElement>('.verdict')?.focus();
  };
  const run = async () => {
    if (isInvalid) {
      goToWhatIsWrong();
      return;
    }
    busy.value = true;
    problem.value = null;
    try {
      const id = await start(document);
      if (previousJob.value !== id) go(['designs', id]);
    } catch (error) {
      const refused = asProblem(error);
      if (refuse(refused))
        setTimeout(goToWhatIsWrong); // once the fields are marked
      else problem.value = refused;
    } finally {
      busy.value = false;
    }
  };
  const open = async (file: File) => {
    try {
      const given = JSON.parse(await file.text()) as Requirements;
      if (!Array.isArray(given.actuators) || !given.duty)
        throw new Error('it has no "actuators" and "duty"');
      load(given);
      problem.value = null;
    } catch (error) {
      problem.value = asProblem(
        new Error(`${file.name} is no requirements file: ${(error as Error).message}`),
      );
    }
  };
  return (
    <form
      ref={form}
      class="split"
      noValidate
      onSubmit={(event) => {
        event.preventDefault();
        void run();
      }}
    >
      <div class="column">
        <div class="toolbar">
          <h1>Requirements</h1>
          <span class="toolbar-group" role="group" aria-label="Examples">
            <span class="muted">Begin with</span>
            {Object.entries(presets).map(([name, preset]) => (
              <button
                key={name}
                type="button"
                aria-pressed={document.name === name}
                onClick={() => load(preset)}
              >
                {name}
              </button>
            ))}
          </span>
          <span class="toolbar-group">
            <FilePicker
              label="Open…"
              accept=".json,application/json"
              onFiles={([file]) => void open(file!)}
            />
            <button
              type="button"
              onClick={() =>
                saveFile(
                  `${document.name || 'requirements'}.json`,
                  `${JSON.stringify(document, null, 2)}\n`,
                )
              }
            >
              Save
            </button>
          </span>
        </div>
        {areRestored.value && (
          <Notice kind="info">
            These are your requirements from before the page was loaded again.{' '}
            <button type="button" class="small" onClick={() => load(presets.exosuit!)}>
              Begin with the example
            </button>
          </Notice>
        )}
        <p class="muted">
          Say what the actuators need: plenum chooses the parts of their air supply from the
          catalogue and proves that no other choice is better.
        </p>
        <Panel
          title="Actuators"
          aside={
            <>
              <TextField
                label="Name"
                value={document.name ?? ''}
                onChange={(v) => edit(['name'], v || undefined)}
              />
              <TextField
                label="Note"
                value={noteText(document.note)}
                onChange={(v) => edit(['note'], v || undefined)}
              />
            </>
          }
        >
          <Groups />
        </Panel>
        <Duty />
        <Supply />
        <Objective />
        <Conditions />
      </div>
      <div class="column side">
        <Panel title="The system">
          <Drawing requirements={numbers.value} />
        </Panel>
        <div class="panel go">
          <Verdict />
          {problem.value && <Notice kind="bad">{problem.value.message}</Notice>}
          <button
            type="submit"
            class="primary"
            disabled={busy.value}
            aria-disabled={isInvalid || undefined}
          >
            {busy.value ? 'Starting…' : 'Find the best designs'}
          </button>
          {validity.value === 'valid' && (
            <a href={link(['sweep'])}>Compare values of one number: a sweep…</a>
          )}
        </div>
      </div>
    </form>
  );
}

function Verdict() {
  if (validity.value === 'valid')
    return (
      <p class="verdict good" role="status">
        These requirements can be searched.
      </p>
    );
  if (validity.value === 'checking')
    return (
      <p class="verdict" role="status">
        Checking…
      </p>
    );
  if (validity.value === 'unknown')
    return (
      <p class="verdict bad" role="status">
        {whyUnknown.value}
      </p>
    );
  const n = fieldErrors.value.length;
  return (
    <div class="verdict bad" role="status" tabIndex={-1}>
      {n === 1 ? 'One thing has to change:' : `${n} things have to change:`}
      <ul>
        {fieldErrors.value.map((error) => (
          <li key={error.pointer + error.detail}>
            <button type="button" class="quiet small" onClick={() => focusOn(error.pointer)}>
              {placeInWords(error.pointer, requirements.value.actuators)}
            </button>{' '}
            {detailInWords(error)}
          </li>
        ))}
      </ul>
    </div>
  );
}

// What is said of a text speaks of its own unit already.
function detailInWords({ pointer, detail }: FieldError): string {
  const value = valueAt(requirements.value, pointer.split('/').slice(1));
  return typeof value === 'string'
    ? detail
    : inUnit(fieldKind(pointer.replace(/_max$/, '')), detail);
}
