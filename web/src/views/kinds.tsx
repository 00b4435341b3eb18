// What stands beside a list of kinds: the best of each configuration and of what can be ordered, and
// the other designs of a kind.
import { amountText, axisOf, objectiveUnit, requirementName, supplyWord } from '../lib/amounts';
import { change, count, significant } from '../lib/format';
import { link } from '../lib/route';
import type { Answer, Best, Design, PartRow, Requirements } from '../lib/types';
import { Panel } from '../ui/controls';
import { RankAgainButton } from '../ui/job';
import { number, Table } from '../ui/table';

const named = (parts: PartRow[]): string =>
  [
    ...new Set(
      parts.map(
        (p) =>
          `${p.unit !== 'm' && p.quantity !== 1 ? `${p.quantity}× ` : ''}${p.manufacturer} ${p.part_number}`,
      ),
    ),
  ].join(' + ');

// What tells people one design from another: pump, bottle or tank, and valves.
export function identity(design: Pick<Design, 'parts'>): { source: string; valves: string } {
  const of = (...families: string[]) =>
    named(design.parts.filter((p) => families.includes(p.family)));
  return {
    source:
      of('compressor', 'vacuum_pump', 'ejector', 'cylinder', 'co2') ||
      of('reservoir') ||
      `wall, ${of('regulator')}`,
    valves: of('valve'),
  };
}

function conflictInWords({ conflict }: Best, { requirements }: Answer): string {
  const names = conflict.map((c) => requirementName(c.requirement, requirements.actuators));
  return names.length === 1
    ? `${names[0]} cannot be met`
    : `${names.slice(0, -1).join(', ')} and ${names.at(-1)} cannot be met together`;
}

// The best design of each configuration, and of products that one can order, where the list does
// not show it.
export function Bests({ answer, id }: { answer: Answer; id: string }) {
  // `alone`: what of the supply's requirements leaves only these.
  const rows: { name: string; best: Best; alone: Requirements['supply'] }[] = (
    answer.by_configuration ?? []
  ).map((best) => ({
    name: best.configuration ? supplyWord({ configuration: best.configuration }) : '',
    best,
    alone: best.configuration ? { configurations: [best.configuration] } : {},
  }));
  if (answer.orderable && answer.orderable.design?.rank !== 1)
    rows.push({ name: 'products to order', best: answer.orderable, alone: { parts: 'orderable' } });
  if (rows.length < 2) return null;
  const mass = axisOf('mass')!;
  return (
    <Panel title="The best of each">
      <Table
        label="The best design of each supply"
        heads={[
          'of',
          number('mass', 'kg'),
          number(`to #1`),
          'pump or bottle, valves',
          { text: 'place' },
        ]}
      >
        {rows.map(({ name, best, alone }) => (
          <tr key={name}>
            <th scope="row">{name}</th>
            {best.design ? (
              <>
                <td class="num">{amountText(mass, best.design.totals.mass_kg)}</td>
                <td class="num nowrap">
                  {best.relative_distance === null ? '–' : change(best.relative_distance)}
                </td>
                <td>{`${identity(best.design).source}; ${identity(best.design).valves}`}</td>
                <td class="nowrap">
                  {best.design.rank ? (
                    <a href={link(['designs', id, String(best.design.rank)])}>
                      #{best.design.rank}
                    </a>
                  ) : best.status === 'optimal' ? (
                    <>
                      proved, not listed{' '}
                      <RankAgainButton
                        answer={answer}
                        label="List these"
                        tip={`The same search with ${name} alone`}
                        changed={(asked) => ({ ...asked, supply: { ...asked.supply, ...alone } })}
                      />
                    </>
                  ) : (
                    `not proved: ${significant(best.lower_bound ?? 0)} ${objectiveUnit(answer.requirements)} at least`
                  )}
                </td>
              </>
            ) : (
              <td colSpan={4}>
                {best.status === 'infeasible' ? 'none, proved' : 'none found yet'}
                {best.conflict.length > 0 && `: ${conflictInWords(best, answer)}`}
              </td>
            )}
          </tr>
        ))}
      </Table>
    </Panel>
  );
}

// Of a design: what else of its kind comes within 1 %.
export function VariantsPanel({ design }: { design: Design }) {
  const { variants } = design;
  if (!variants) return null;
  if (variants.found === 0)
    return (
      <Panel title="Variants">
        <p>
          {variants.complete
            ? 'Proved: no other design of this kind comes within 1 %.'
            : 'No other design of this kind within 1 % was found in the steps given.'}
        </p>
      </Panel>
    );
  return (
    <Panel
      title={`${variants.complete ? '' : 'At least '}${count(variants.found)} ${variants.found === 1 ? 'variant' : 'variants'}`}
    >
      <p>
        The same pump or bottle and valves with other {variants.differ_in.join(', ')}, within 1 % of
        this design; sized, not simulated.
      </p>
      <Table
        label="Variants of this design"
        boxClass="ranked"
        heads={[number('to this'), 'other parts']}
      >
        {variants.examples.map((variant, i) => (
          <tr key={i}>
            <td class="num nowrap">{change(variant.objective / design.objective - 1)}</td>
            <td>{named(variant.parts)}</td>
          </tr>
        ))}
      </Table>
    </Panel>
  );
}
