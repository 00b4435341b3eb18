// What the models of a diagnosis have of each run alone: its start and its clock. With them and the
// effects the service simulates every curve again.
import { inWords } from '../lib/effect_words';
import { shown, significant } from '../lib/format';
import { type Diagnosis, type ModelName } from '../lib/measurement';
import { unitOf } from '../lib/units';
import { Chip, Panel } from '../ui/controls';
import { extra, number, Table } from '../ui/table';

const models: [ModelName, string][] = [
  ['before', 're-fitted'],
  ['after', 'after'],
  ['learned', 'with the learned term'],
];

export function NumbersOfRuns({ d }: { d: Diagnosis }) {
  if (!d.runs?.length) return null;
  const differs = d.effects.length > 0 || d.tied.length > 0; // after from before
  const named = models.filter(([name]) => d[name] && (name !== 'after' || differs));
  return (
    <Panel
      title="Numbers of each run"
      aside={
        <span class="muted">what the models start from; the saved JSON gives every curve</span>
      }
    >
      <Table
        label="Numbers of each run"
        boxClass="phases"
        heads={[
          'run',
          'model',
          number('start', unitOf('pressure')),
          extra(number('temperature', 'K')),
          number('clock late', 'ms'),
          extra(number('valve turns at', 's')),
        ]}
      >
        {d.runs.flatMap((run) =>
          named.map(([name, label], i) => (
            <tr key={run.id + name}>
              {i === 0 && (
                <th scope="row" rowSpan={named.length}>
                  {run.id} {run.held_out && <Chip>held out</Chip>}
                  {run.copy_of && <Chip kind="warn">same readings as {run.copy_of}</Chip>}
                </th>
              )}
              <td>{label}</td>
              <td class="num">{shown('pressure', run[name]?.initial_pressure_kpa_gauge, 5)}</td>
              <td class="num extra">{significant(run[name]?.initial_temperature_k, 4)}</td>
              <td class="num">{significant(1e3 * (run[name]?.clock_s ?? 0))}</td>
              <td class="num extra">
                {(run[name]?.valve_s ?? []).map((t_s) => significant(t_s, 4)).join(', ')}
              </td>
            </tr>
          )),
        )}
      </Table>
      {(d.held_out_fitted ?? []).map(({ run, numbers }) => (
        <p key={run} class="muted">
          Fitted to {run}, though it is held out: {numbers.map(inWords).join(', ')}.
        </p>
      ))}
    </Panel>
  );
}
