// Facts, parts, margins and estimates of a design.
import {
  amountText,
  axes,
  axisUnit,
  requirementName,
  requirementNumber,
  requirementUnit,
  sense,
} from '../lib/amounts';
import { fieldName, percent, significant } from '../lib/format';
import { link } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { Chip, Panel } from '../ui/controls';
import { type Fact, FactList } from '../ui/facts';
import { ShareBar } from '../ui/share_bar';
import { number, Table } from '../ui/table';

const familyColour: Record<string, string> = {
  compressor: '--c1',
  vacuum_pump: '--c1',
  ejector: '--c1',
  battery: '--c2',
  valve: '--c3',
  reservoir: '--c4',
  cylinder: '--c1',
  co2: '--c1',
  regulator: '--c4',
  fitting: '--c5',
  tubing: '--c6',
  manifold: '--c5',
  check_valve: '--c5',
};

const colourOf = ({ family }: { family: string }) => `var(${familyColour[family] ?? '--c6'})`;

export function Facts({ design }: { design: Design }) {
  const facts = axes.flatMap((axis): Fact[] => {
    const value = axis.of(design);
    if (value === null || axis.id === 'estimated') return [];
    return [[axis.label, amountText(axis, value, axis.id === 'mass' ? 4 : 3), axisUnit(axis)]];
  });
  return <FactList facts={facts} />;
}

export function PartsPanel({ design }: { design: Design }) {
  const total = design.totals.mass_kg;
  const rows = [...design.parts].sort((a, b) => b.mass_kg - a.mass_kg);
  const isPriced = rows.some((row) => row.cost_eur !== null);
  return (
    <Panel title="Parts and masses">
      <div
        class="stack"
        role="img"
        aria-label={`Mass: ${rows.map((r) => `${r.family} ${percent(r.mass_kg / total, 0)}`).join(', ')}`}
      >
        {rows.map((row) => (
          <span
            key={`${row.id}${row.group}`}
            style={{ width: `${(100 * row.mass_kg) / total}%`, background: colourOf(row) }}
            data-tip={`${row.family} ${percent(row.mass_kg / total)}`}
          />
        ))}
      </div>
      <Table
        label="Parts"
        heads={[
          'part',
          number('quantity'),
          number('mass', 'kg'),
          number('of all', '%'),
          ...(isPriced ? [number('cost', '€')] : []),
        ]}
        foot={
          <tr>
            <th scope="row" colSpan={2}>
              all together
            </th>
            <td class="num">
              <b>{significant(total, 4)}</b>
            </td>
            <td />
            {isPriced && <td class="num">{significant(design.totals.cost_eur)}</td>}
          </tr>
        }
      >
        {rows.map((row) => (
          <tr key={`${row.id}${row.group}`}>
            <th scope="row" class="part-cell">
              <i class="swatch" style={{ background: colourOf(row) }} />
              {row.id === 'custom' ? (
                `${row.manufacturer} ${row.part_number}`
              ) : (
                <a href={link(['catalogue', row.family], { part: row.id })}>
                  {row.manufacturer} {row.part_number}
                </a>
              )}{' '}
              <small class="muted">
                {row.family.replace('_', ' ')}
                {row.group !== null && ` for ${row.group}`}
              </small>
            </th>
            <td class="num">
              {row.unit === 'm' ? `${significant(row.quantity)} m` : row.quantity}
            </td>
            <td class="num">{significant(row.mass_kg)}</td>
            <td class="num">{((100 * row.mass_kg) / total).toFixed(1)}</td>
            {isPriced && <td class="num">{significant(row.cost_eur)}</td>}
          </tr>
        ))}
      </Table>
      <Packs design={design} />
    </Panel>
  );
}

// What is bought of parts that are sold in packs.
export function Packs({ design }: { design: Design }) {
  return (
    <>
      {(design.packs ?? []).map((row) => {
        const unit = row.unit === 'm' ? ' m' : '';
        const part = design.parts.find(({ id }) => id === row.id);
        return (
          <p key={row.id} class="muted">
            Bought: {row.packs} {row.packs === 1 ? 'pack' : 'packs'} of {significant(row.pack)}
            {unit}, {part ? `${part.manufacturer} ${part.part_number}` : row.id}, for{' '}
            {significant(row.cost_eur)} €; {significant(row.left_over)}
            {unit} left over.
          </p>
        );
      })}
    </>
  );
}

export function MarginsPanel({ design, answer }: { design: Design; answer: Answer }) {
  const groups = answer.requirements.actuators;
  const least = Math.min(...design.margins.map((m) => m.relative_margin));
  return (
    <Panel title="Requirements and margins">
      <Table label="Margins" heads={['requirement', number('asked'), number('is'), 'margin']}>
        {design.margins.map((m) => (
          <tr key={m.requirement}>
            <th scope="row">
              {requirementName(m.requirement, groups)}{' '}
              <small class="muted">{requirementUnit(m.requirement)}</small>{' '}
              {m.binding && <Chip kind="bad">binding</Chip>}
            </th>
            <td class="num">
              {sense(m.requirement)} {requirementNumber(m.requirement, m.required)}
            </td>
            <td class="num">{requirementNumber(m.requirement, m.achieved)}</td>
            <td>
              <ShareBar
                share={m.relative_margin}
                mark={m.relative_margin !== least ? '' : m.binding ? 'binding' : 'least'}
              >
                {percent(m.relative_margin)}
              </ShareBar>
            </td>
          </tr>
        ))}
      </Table>
      {design.robustness && (
        <p>
          Meets everything in {percent(design.robustness.probability, 0)} of the draws within the
          parts' tolerances; first in {percent(design.robustness.share_rank_1, 0)}.
        </p>
      )}
    </Panel>
  );
}

export function Estimates({ design }: { design: Design }) {
  const quality = design.data_quality;
  const byFamily = new Map<string, string[]>();
  for (const name of quality.estimated) {
    const [family = '', field = ''] = name.split('.');
    byFamily.set(family, [...(byFamily.get(family) ?? []), fieldName(field).label]);
  }
  return (
    <Panel title="What rests on estimates">
      {byFamily.size === 0 ? (
        <p>Nothing: all numbers are from data sheets or third parties.</p>
      ) : (
        <>
          <p>
            {percent(quality.mass_share_estimated)} of the mass
            {quality.flow_estimated && ' and flow data of the line'}. Measure these parts before you
            rely on the answer.
          </p>
          <ul class="estimates">
            {[...byFamily].map(([family, fields]) => (
              <li key={family}>
                <b>{family.replace('_', ' ')}</b> {fields.join(', ')}
              </li>
            ))}
          </ul>
        </>
      )}
    </Panel>
  );
}
