// A sweep to begin: one number of the requirements, and the values that it is to have.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, type Problem } from '../lib/api';
import { requirements } from '../lib/requirements';
import { go, link } from '../lib/route';
import {
  evenly,
  refusedValues,
  shownValue,
  sweptField,
  type SweptValue,
  textsOf,
  useValues,
  withUnit,
} from '../lib/sweep_values';
import { numbersOf, startSweep } from '../lib/sweeps';
import { readTyped } from '../lib/typed';
import { Notice, Panel, Segmented, Select, TextField } from '../ui/controls';

export function NewSweep() {
  const document = requirements.value;
  const pointers = numbersOf(document).filter((pointer) => !pointer.startsWith('/ranking/'));
  const chosen = useSignal(
    pointers.find((pointer) => pointer.endsWith('/frequency_hz')) ?? pointers[0]!,
  );
  const how = useSignal<'list' | 'steps'>('list');
  const list = useSignal('');
  const from = useSignal('');
  const to = useSignal('');
  const steps = useSignal('5');
  const problem = useSignal<Problem | null>(null);
  const refused = useSignal('');
  const busy = useSignal(false);
  const pointer = pointers.includes(chosen.value) ? chosen.value : pointers[0]!;
  const field = sweptField(pointer, document.actuators);
  const isList = how.value === 'list';
  const ends = [from.value.trim(), to.value.trim()];
  const texts = isList ? textsOf(list.value) : ends.filter(Boolean);
  const read = useValues(document, field, texts);
  const number = readTyped(steps.value);
  const isNumber = typeof number === 'number' && Number.isInteger(number);
  const wrongSteps =
    isNumber && number >= 2 && number <= 256 ? undefined : 'a whole number from 2 to 256';
  const given = valuesOf(isList, read, typeof number === 'number' ? number : 0);
  const shown = given.map((value) => shownValue(field, value));
  const values = given.filter((_, i) => shown.indexOf(shown[i]!) === i);
  const isAsked = read.some((one) => one.value === undefined && one.error === undefined);
  const errors = read.map((one) => one.error).filter(Boolean);
  const ofText = (text: string) => (text ? read[texts.indexOf(text)]?.error : undefined);
  useEffect(() => void (refused.value = ''), [pointer, texts.join('\n'), how.value]);

  // Of a list each value; of two ends so many between them.
  function valuesOf(all: boolean, typed: SweptValue[], count: number): number[] {
    const known = typed.map((one) => one.value).filter((value) => value !== undefined);
    if (known.length < typed.length) return [];
    if (all) return known;
    return known.length === 2 ? evenly(field, known[0]!, known[1]!, count) : [];
  }
  const begin = async () => {
    busy.value = true;
    problem.value = null;
    const patches = values.map((value) => ({
      name: withUnit(field, shownValue(field, value)),
      value,
    }));
    try {
      go(['sweep', await startSweep(document, pointer, field.name, patches)]);
    } catch (error) {
      const found = asProblem(error);
      const names = patches.map((patch) => patch.name);
      refused.value = refusedValues(field, names, found.errors);
      if (!refused.value) problem.value = found;
    } finally {
      busy.value = false;
    }
  };
  const unitHint = field.unit
    ? `in ${field.unit}${field.takesUnits ? ', or each with its unit' : ''}`
    : '';
  return (
    <Panel first title="A sweep">
      <p class="muted">
        The <a href={link(['requirements'])}>requirements</a> are searched once for each value of
        one of their numbers; the answers stand in one table.
      </p>
      <form
        noValidate
        onSubmit={(event) => {
          event.preventDefault();
          void begin();
        }}
      >
        <div class="toolbar">
          <Select
            label="Field"
            value={pointer}
            options={pointers.map((one) => ({
              value: one,
              label: `${sweptField(one, document.actuators).name} (${one})`,
            }))}
            onChange={(v) => (chosen.value = v)}
          />
          <Segmented
            label="Given as"
            value={how.value}
            options={[
              { value: 'list', label: 'a list' },
              { value: 'steps', label: 'from – to' },
            ]}
            onChange={(v) => (how.value = v)}
          />
        </div>
        {isList ? (
          <TextField
            label="Values"
            hint={[unitHint, 'several with a blank or a semicolon between']
              .filter(Boolean)
              .join('; ')}
            error={errors.join('; ') || refused.value || undefined}
            value={list.value}
            onChange={(v) => (list.value = v)}
          />
        ) : (
          <>
            <TextField
              label="From"
              hint={unitHint}
              error={ofText(ends[0]!)}
              value={from.value}
              onChange={(v) => (from.value = v)}
            />
            <TextField
              label="To"
              hint={unitHint}
              error={ofText(ends[1]!) ?? (refused.value || undefined)}
              value={to.value}
              onChange={(v) => (to.value = v)}
            />
            <TextField
              label="How many values"
              error={wrongSteps}
              value={steps.value}
              onChange={(v) => (steps.value = v)}
            />
          </>
        )}
        <p role="status">
          {values.length > 0
            ? `${values.length} ${values.length === 1 ? 'search' : 'searches'}: ${withUnit(field, values.map((value) => shownValue(field, value)).join(', '))}`
            : isAsked
              ? 'Reading the values…'
              : errors.length > 0 || (!isList && wrongSteps)
                ? 'See the field that is marked.'
                : 'No values yet.'}
        </p>
        {problem.value && <Notice kind="bad">{problem.value.sentence}</Notice>}
        <button type="submit" class="primary" disabled={busy.value || values.length === 0}>
          {busy.value ? 'Starting…' : 'Start the sweep'}
        </button>
      </form>
    </Panel>
  );
}
