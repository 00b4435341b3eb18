// A sweep: made of the requirements and one of their values, then its table and a plot.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { objectiveName, objectiveUnit, placeInWords } from '../lib/amounts';
import { ask, asProblem, get, type Problem } from '../lib/api';
import { duration, percent, short, significant } from '../lib/format';
import { requirements } from '../lib/requirements';
import { go, link, route } from '../lib/route';
import {
  cancelSweep,
  evenly,
  numbersOf,
  startSweep,
  type Sweep,
  type SweepRow,
  type SweepTable,
  valuesOf,
} from '../lib/sweeps';
import { statusWord } from '../lib/words';
import { Lines } from '../plots/lines';
import { Chip, Notice, Panel, Segmented, Select, TextField } from '../ui/controls';
import { saveFile } from '../ui/files';
import { ActionButton } from '../ui/job';
import { number, Table } from '../ui/table';

const periodMs = 1000;

export function SweepView() {
  const id = route.value.path[1];
  return id ? <OneSweep key={id} id={id} /> : <NewSweep />;
}

function NewSweep() {
  const document = requirements.value;
  const fields = numbersOf(document).filter((pointer) => !pointer.startsWith('/ranking/'));
  const field = useSignal(
    fields.find((pointer) => pointer.endsWith('/frequency_hz')) ?? fields[0]!,
  );
  const how = useSignal<'list' | 'steps'>('list');
  const list = useSignal('');
  const from = useSignal('');
  const to = useSignal('');
  const steps = useSignal('5');
  const problem = useSignal<Problem | null>(null);
  const busy = useSignal(false);
  const chosen = fields.includes(field.value) ? field.value : fields[0]!;
  const nameOf = (pointer: string) => placeInWords(pointer, document.actuators);
  const values =
    how.value === 'list'
      ? valuesOf(list.value)
      : evenly(Number(from.value || NaN), Number(to.value || NaN), Number(steps.value || NaN));
  const begin = async () => {
    busy.value = true;
    problem.value = null;
    try {
      go(['sweep', await startSweep(document, chosen, nameOf(chosen), values)]);
    } catch (error) {
      problem.value = asProblem(error);
    } finally {
      busy.value = false;
    }
  };
  return (
    <Panel first title="A sweep">
      <p class="muted">
        The <a href={link(['requirements'])}>requirements</a> are searched once for each value of
        one of their numbers, in the units of the document; the answers stand in one table.
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
            value={chosen}
            options={fields.map((pointer) => ({
              value: pointer,
              label: `${nameOf(pointer)} (${pointer})`,
            }))}
            onChange={(v) => (field.value = v)}
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
        {how.value === 'list' ? (
          <TextField
            label="Values"
            hint="numbers with a blank between, as 0.05 0.1 0.2"
            value={list.value}
            onChange={(v) => (list.value = v)}
          />
        ) : (
          <>
            <TextField label="From" value={from.value} onChange={(v) => (from.value = v)} />
            <TextField label="To" value={to.value} onChange={(v) => (to.value = v)} />
            <TextField
              label="How many values"
              value={steps.value}
              onChange={(v) => (steps.value = v)}
            />
          </>
        )}
        <p role="status">
          {values.length === 0
            ? 'No values yet.'
            : `${values.length} searches: ${values.join(', ')}`}
        </p>
        {problem.value && <Notice kind="bad">{problem.value.sentence}</Notice>}
        <button type="submit" class="primary" disabled={busy.value || values.length === 0}>
          {busy.value ? 'Starting…' : 'Start the sweep'}
        </button>
      </form>
    </Panel>
  );
}

// The sweep and its table, asked for again until it has ended.
function useSweep(id: string) {
  const sweep = useSignal<Sweep | null>(null);
  const table = useSignal<SweepTable | null>(null);
  const problem = useSignal('');
  useEffect(() => {
    let timer = 0;
    let isOver = false;
    const refresh = async () => {
      try {
        const now = await get<Sweep>(`/v1/sweeps/${id}`);
        table.value = await get<SweepTable>(now.links.table);
        sweep.value = now;
        problem.value = '';
        if (now.ended_at) return;
      } catch (error) {
        problem.value = asProblem(error).message;
      }
      if (!isOver) timer = window.setTimeout(() => void refresh(), periodMs);
    };
    void refresh();
    return () => {
      isOver = true;
      clearTimeout(timer);
    };
  }, [id]);
  return { sweep: sweep.value, table: table.value, problem: problem.value };
}

function OneSweep({ id }: { id: string }) {
  const { sweep, table, problem } = useSweep(id);
  if (!sweep || !table)
    return problem ? <Notice kind="bad">{problem}</Notice> : <p role="status">Loading…</p>;
  const { queued, running } = sweep.jobs;
  const left = queued + running;
  return (
    <>
      {problem && <Notice kind="bad">{problem}</Notice>}
      <Panel
        first
        title={sweep.name || 'A sweep'}
        aside={
          <>
            <ActionButton
              label="CSV"
              act={async () => {
                const csv = await ask<string>('GET', `${sweep.links.table}?format=csv`);
                saveFile(`${id}.csv`, csv.body, 'text/csv');
              }}
            />
            {left > 0 && <ActionButton label="Cancel" act={() => cancelSweep(id)} />}
          </>
        }
      >
        <p role="status">
          {left > 0
            ? `${table.rows.length - left} of ${table.rows.length} searches have ended.`
            : `All ${table.rows.length} searches have ended.`}
        </p>
        <SweepPlot table={table} />
        <Rows table={table} />
      </Panel>
    </>
  );
}

// The objective against the value, where one number was varied.
function SweepPlot({ table }: { table: SweepTable }) {
  const pointer = table.varied[0];
  const rows = table.rows
    .filter((row) => typeof row.values[0] === 'number' && row.objective !== null)
    .sort((a, b) => (a.values[0] as number) - (b.values[0] as number));
  if (pointer === undefined || !table.objective || rows.length < 2) return null;
  const objective = { objective: table.objective };
  const unit = objectiveUnit(objective);
  return (
    <Lines
      title={`${objectiveName(objective)} against ${pointer}`}
      x={rows.map((row) => row.values[0] as number)}
      xLabel={pointer.split('/').pop()!}
      yLabel={`${objectiveName(objective)}${unit && ` (${unit})`}`}
      lines={[
        {
          label: objectiveName(objective),
          values: rows.map((row) => row.objective),
          colour: '--c1',
          points: true,
        },
      ]}
    />
  );
}

const valueText = (value: SweepRow['values'][number]): string =>
  typeof value === 'number' ? short(value) : value === null ? '–' : String(value);

function Outcome({ row }: { row: SweepRow }) {
  const word = row.outcome && statusWord[row.outcome];
  return word ? <Chip kind={word.kind}>{word.text}</Chip> : <>{row.status ?? 'not kept'}</>;
}

function Rows({ table }: { table: SweepTable }) {
  return (
    <Table
      label="Answers"
      heads={[
        'variant',
        ...table.varied.map((pointer) =>
          number(placeInWords(pointer, requirements.value.actuators)),
        ),
        'result',
        number('objective'),
        number('mass', 'kg'),
        number('volume', 'L'),
        number('cost', '€'),
        number('gap'),
        'parts',
        number('took'),
      ]}
    >
      {table.rows.map((row) => (
        <tr key={row.name}>
          <th scope="row">
            {row.link ? (
              <a href={link(['designs', row.link.split('/').pop()!])}>{row.name}</a>
            ) : (
              row.name
            )}
          </th>
          {row.values.map((value, i) => (
            <td key={table.varied[i]} class="num">
              {valueText(value)}
            </td>
          ))}
          <td>
            <Outcome row={row} />
          </td>
          <td class="num">{significant(row.objective, 4)}</td>
          <td class="num">{significant(row.mass_kg, 4)}</td>
          <td class="num">{significant(row.volume_l, 4)}</td>
          <td class="num">{significant(row.cost_eur, 4)}</td>
          <td class="num">{percent(row.gap)}</td>
          <td>{row.parts?.join('; ') ?? row.conflict ?? row.detail ?? '–'}</td>
          <td class="num">{row.seconds === null ? '–' : duration(row.seconds)}</td>
        </tr>
      ))}
    </Table>
  );
}
