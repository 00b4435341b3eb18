// Of a guaranteed list: what certainty costs, the best design on paper beside the best guaranteed
// one, and which test of a part would save most.
import { Fragment } from 'preact';

import { objectiveUnit } from '../lib/amounts';
import { fieldName, percent, significant } from '../lib/format';
import { link } from '../lib/route';
import type { Answer, Design, PartTest, Saving, SavingTogether } from '../lib/types';
import { Panel } from '../ui/controls';
import { number, Table } from '../ui/table';
import { identity } from './kinds';

const provenances = {
  measured: 'measured',
  datasheet: 'data sheet',
  third_party: 'third party',
  derived: 'derived',
  estimated: 'estimated',
} as const;

export function Guarantee({ answer }: { answer: Answer }) {
  const { guarantee, on_paper: paper } = answer;
  if (!guarantee || !paper) return null;
  const unit = objectiveUnit(answer.requirements);
  const tolerances = Object.entries(provenances)
    .map(
      ([of, word]) => `${word} ±${percent(guarantee.tolerance[of as keyof typeof provenances], 0)}`,
    )
    .join(', ');
  const rows: { name: string; design: Design | undefined; isProved: boolean }[] = [
    { name: 'guaranteed', design: answer.designs[0], isProved: answer.status === 'optimal' },
    { name: 'on paper', design: paper.designs[0], isProved: paper.status === 'optimal' },
  ];
  return (
    <Panel title="What certainty costs">
      <p>
        These designs meet every requirement with all numbers of their parts within their tolerances
        ({tolerances}; a number that states its uncertainty: twice that).
        {guarantee.costs_share !== null && (
          <>
            {' '}
            Certainty costs <b>{percent(guarantee.costs_share)}</b>. Performance and margins are
            those of the worst case; mass, volume and cost rank as printed.
          </>
        )}
      </p>
      <Table
        label="The best guaranteed design and the best on paper"
        heads={['best', number('objective', unit), 'pump or bottle, valves', 'proof']}
      >
        {rows.map(({ name, design, isProved }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            <td class="num">{design ? significant(design.objective, 4) : '–'}</td>
            <td>
              {design ? `${identity(design).source}; ${identity(design).valves}` : 'none found'}
            </td>
            <td>{isProved ? 'proved' : 'not proved'}</td>
          </tr>
        ))}
      </Table>
      <Tests savings={answer.measure_first ?? []} unit={unit} />
      <Together ways={answer.measure_together ?? []} unit={unit} />
      {answer.measure_first_complete === false && (
        <p class="muted">Time ran out before all tests of parts were looked at.</p>
      )}
    </Panel>
  );
}

const testName = ({ protocol }: PartTest): string => protocol.replace(/_/g, ' ');
const numbersOf = (test: PartTest): string =>
  test.numbers.map((field) => fieldName(field).label || field.replace(/_/g, ' ')).join(', ');

function Together({ ways, unit }: { ways: SavingTogether[]; unit: string }) {
  if (ways.length === 0) return null;
  return (
    <Table
      label="What several tests make of designs on paper"
      heads={['measure all of', 'design on paper', number('then', unit), number('share')]}
    >
      {ways.map(({ rank, tests, objective, saving_share }) => (
        <tr key={rank}>
          <th scope="row">
            {tests.map((test, i) => (
              <Fragment key={`${test.part} ${test.protocol}`}>
                {i > 0 && ', '}
                <a
                  href={link(['catalogue', test.family], { part: test.part, protocol: 'open' })}
                  data-tip={`${testName(test)}: ${numbersOf(test)}`}
                >
                  {test.part}
                </a>
              </Fragment>
            ))}
          </th>
          <td>rank {rank}</td>
          <td class="num">{significant(objective, 4)}</td>
          <td class="num">{percent(saving_share)}</td>
        </tr>
      ))}
    </Table>
  );
}

function Tests({ savings, unit }: { savings: Saving[]; unit: string }) {
  if (savings.length === 0)
    return <p class="muted">No test of one or two parts was found to make the best better.</p>;
  return (
    <Table
      label="What to measure first"
      heads={['measure first', 'test', 'what it settles', number('saves', unit), number('share')]}
    >
      {savings.map((saving) => (
        <tr key={`${saving.part} ${saving.protocol} ${saving.with?.part ?? ''}`}>
          <th scope="row">
            <a href={link(['catalogue', saving.family], { part: saving.part })}>{saving.part}</a>
            {saving.with && (
              <>
                {' with '}
                <a href={link(['catalogue', saving.with.family], { part: saving.with.part })}>
                  {saving.with.part}
                </a>
              </>
            )}
          </th>
          <td>
            <a
              href={link(['catalogue', saving.family], { part: saving.part, protocol: 'open' })}
              data-tip="Steps, precision and a template"
            >
              {testName(saving)}
            </a>
          </td>
          <td>{numbersOf(saving)}</td>
          <td class="num">
            {saving.saving !== null
              ? significant(saving.saving)
              : saving.saving_interval!.map((bound) => significant(bound)).join(' to ')}
          </td>
          <td class="num">{saving.saving_share === null ? '–' : percent(saving.saving_share)}</td>
        </tr>
      ))}
    </Table>
  );
}
