// Why there is no design: what cannot be met together, and the least that makes it feasible.
import { requirementName, requirementNumber, requirementUnit, sense } from '../lib/amounts';
import { percent, significant } from '../lib/format';
import { edit, load } from '../lib/requirements';
import { go } from '../lib/route';
import type { Answer, ConflictEntry, Relaxed } from '../lib/types';
import { Chip, Panel } from '../ui/controls';
import { extra, heard, number, Table } from '../ui/table';

// To the easy side, so that what was found still meets it.
function eased(pointer: string, value: number): number {
  const size = 10 ** (Math.floor(Math.log10(Math.abs(value))) - 3);
  const isLeast = pointer.startsWith('/duty/');
  const easy = (isLeast ? Math.floor(value / size) : Math.ceil(value / size)) * size;
  return Number(easy.toPrecision(4));
}

// The requirements with these numbers as far as the catalogue reaches, and without what is dropped.
function askFor(answer: Answer, changes: { requirement: string; value: number | null }[]): void {
  load(answer.asked ?? answer.requirements);
  for (const { requirement, value } of changes) {
    const path = requirement.slice(1).split('/');
    edit(
      path.map((step) => (/^\d+$/.test(step) ? Number(step) : step)),
      value === null ? undefined : eased(requirement, value),
    );
  }
  go(['requirements']);
}

// What is found is enough, not the least: the searches behind each number end with the time.
export function Conflicts({ answer }: { answer: Answer }) {
  const conflicts = answer.conflicts!;
  const rows = conflicts.flat();
  const relaxation = answer.relaxation ?? [];
  const canAsk = relaxation.every((change) => change.requirement !== 'prices');
  return (
    <Panel title="These requirements cannot be met together">
      <p>
        {conflicts.length > 1
          ? 'One of each table has to give; '
          : rows.length > 1
            ? 'One of them has to give; '
            : ''}
        each row says what was found to be enough while the others stay.
        {!rows.every((row) => row.proved) &&
          ' Time ran out before it was clear that those in doubt take part.'}
        {rows.some((row) => row.required !== null && row.best === null) &&
          (answer.conflicts_complete
            ? ' Where there is no number, nothing is enough while the others stay.'
            : ' Where there is no number, none was found in the time given; a longer limit may find one.')}
      </p>
      {conflicts.map((entries, i) => (
        <ConflictTable key={i} answer={answer} entries={entries} place={i} />
      ))}
      {relaxation.length > 0 && (
        <p>
          The least that makes it feasible:{' '}
          {relaxation.map((change) => changeInWords(change, answer)).join('; ')}.{' '}
          {canAsk && (
            <button type="button" onClick={() => askFor(answer, relaxation)}>
              Ask for this
            </button>
          )}
        </p>
      )}
    </Panel>
  );
}

function changeInWords({ requirement, required, value }: Relaxed, answer: Answer): string {
  const name = requirementName(requirement, answer.requirements.actuators);
  if (value === null) return `${name} dropped`;
  const unit = requirementUnit(requirement);
  const text = (n: number | null) => requirementNumber(requirement, n);
  return `${name} ${sense(requirement)} ${text(value)} ${unit} in place of ${text(required)}`;
}

interface ConflictRows {
  answer: Answer;
  entries: ConflictEntry[];
  place: number;
}

function ConflictTable({ answer, entries, place }: ConflictRows) {
  const ask = ({ requirement, best }: ConflictEntry) =>
    askFor(answer, [{ requirement, value: best }]);
  return (
    <Table
      label={place ? `Conflicting requirements, ${place + 1}` : 'Conflicting requirements'}
      heads={[
        'requirement',
        number('asked'),
        number('best found'),
        extra(number('enough to give')),
        heard('change'),
      ]}
    >
      {entries.map((row) => (
        <tr key={row.requirement}>
          <th scope="row">
            {requirementName(row.requirement, answer.requirements.actuators)}{' '}
            <small class="muted">{requirementUnit(row.requirement)}</small>{' '}
            {!row.proved && <Chip kind="warn">in doubt</Chip>}
          </th>
          <td class="num">
            {row.required !== null &&
              `${sense(row.requirement)} ${requirementNumber(row.requirement, row.required)}`}
          </td>
          <td class="num">{requirementNumber(row.requirement, row.best)}</td>
          <td class="num extra">{give(row.relaxation)}</td>
          <td class="num">
            {row.best !== null && (
              <button type="button" onClick={() => ask(row)}>
                Ask for that
              </button>
            )}
          </td>
        </tr>
      ))}
    </Table>
  );
}

// "745 %" is read worse than "8.4 times".
const give = (share: number | null): string =>
  share !== null && share > 1 ? `${significant(1 + share, 2)} ×` : percent(share);
