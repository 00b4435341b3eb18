// A sweep: its form, then its table and a plot.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { objectiveName, objectiveUnit } from '../lib/amounts';
import { ask, asProblem, get } from '../lib/api';
import { duration, percent, significant } from '../lib/format';
import { requirements } from '../lib/requirements';
import { link, route } from '../lib/route';
import { shownValue, type SweptField, sweptField } from '../lib/sweep_values';
import { cancelSweep, type Sweep, type SweepRow, type SweepTable } from '../lib/sweeps';
import { toShown } from '../lib/units';
import { statusWord } from '../lib/words';
import { Lines } from '../plots/lines';
import { Chip, Notice, Panel } from '../ui/controls';
import { saveFile } from '../ui/files';
import { ActionButton } from '../ui/job';
import { number, Table } from '../ui/table';
import { NewSweep } from './sweep_form';

const periodMs = 1000;

export function SweepView() {
  const id = route.value.path[1];
  return id ? <OneSweep key={id} id={id} /> : <NewSweep />;
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
            : table.rows.length === 1
              ? 'The search has ended.'
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
  const field = sweptField(pointer, requirements.value.actuators);
  return (
    <Lines
      title={`${objectiveName(objective)} against ${field.name}`}
      x={rows.map((row) => toShown(field.kind, row.values[0] as number))}
      xLabel={[field.name, field.unit].filter(Boolean).join(', ')}
      xUnit={field.unit}
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

const valueText = (field: SweptField, value: SweepRow['values'][number]): string =>
  typeof value === 'number' ? shownValue(field, value) : value === null ? '–' : String(value);

function Outcome({ row }: { row: SweepRow }) {
  const word = row.outcome && statusWord[row.outcome];
  return word ? <Chip kind={word.kind}>{word.text}</Chip> : <>{row.status ?? 'not kept'}</>;
}

function Rows({ table }: { table: SweepTable }) {
  const fields = table.varied.map((pointer) => sweptField(pointer, requirements.value.actuators));
  return (
    <Table
      label="Answers"
      class="answers"
      heads={[
        'variant',
        ...fields.map((field) => number(field.name, field.unit)),
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
              {valueText(fields[i]!, value)}
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
          <td class="parts-of">{row.parts?.join('; ') ?? row.conflict ?? row.detail ?? '–'}</td>
          <td class="num">{row.seconds === null ? '–' : duration(row.seconds)}</td>
        </tr>
      ))}
    </Table>
  );
}
