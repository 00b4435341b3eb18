// Facts, parts, margins and estimates of a design.
import {
  axes,
  axisUnit,
  requirementName,
  requirementNumber,
  requirementUnit,
} from '../lib/amounts';
import { fieldName, percent, significant } from '../lib/format';
import { link } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { toShown } from '../lib/units';
import { Chip, Panel } from '../ui/controls';
import { type Fact, FactList } from '../ui/facts';

const familyColour: Record<string, string> = {
  compressor: '--c1',
  battery: '--c2',
  valve: '--c3',
  reservoir: '--c4',
  cylinder: '--c1',
  co2: '--c1',
  regulator: '--c4',
  fitting: '--c5',
  tubing: '--c6',
};

export function Facts({ design }: { design: Design }) {
  const facts = axes.flatMap((axis): Fact[] => {
    const value = axis.of(design);
    if (value === null || axis.id === 'estimated') return [];
    const text = significant(toShown(axis.kind, value), axis.id === 'mass' ? 4 : 3);
    return [[axis.label, text, axisUnit(axis)]];
  });
  return <FactList facts={facts} />;
}

export function PartsPanel({ design }: { design: Design }) {
  const total = design.totals.mass_kg;
  const rows = [...design.parts].sort((a, b) => b.mass_kg - a.mass_kg);
  const width = (row: { mass_kg: number }) => `${(100 * row.mass_kg) / Math.max(total, 1e-12)}%`;
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
            style={{ width: width(row), background: `var(${familyColour[row.family] ?? '--c6'})` }}
            data-tip={`${row.family} ${percent(row.mass_kg / total)}`}
          />
        ))}
      </div>
      <div class="scroll" tabIndex={0} role="region" aria-label="Parts">
        <table>
          <thead>
            <tr>
              <th scope="col">part</th>
              <th scope="col">for</th>
              <th scope="col" class="num">
                quantity
              </th>
              <th scope="col" class="num">
                mass <small>kg</small>
              </th>
              <th scope="col" class="num">
                of all
              </th>
              <th scope="col" class="num">
                cost <small>€</small>
              </th>
            </tr>
          </thead>
          <tbody>
            {rows.map((row) => (
              <tr key={`${row.id}${row.group}`}>
                <th scope="row" class="part-cell">
                  <i
                    class="swatch"
                    style={{ background: `var(${familyColour[row.family] ?? '--c6'})` }}
                  />
                  <span>
                    {row.id === 'custom' ? (
                      `${row.manufacturer} ${row.part_number}`
                    ) : (
                      <a href={link(['catalogue', row.family], { part: row.id })}>
                        {row.manufacturer} {row.part_number}
                      </a>
                    )}
                    <small class="muted"> {row.family}</small>
                  </span>
                </th>
                <td>{row.group ?? 'all'}</td>
                <td class="num">
                  {row.unit === 'm' ? `${significant(row.quantity)} m` : row.quantity}
                </td>
                <td class="num">{significant(row.mass_kg)}</td>
                <td class="num">{percent(row.mass_kg / total)}</td>
                <td class="num">{significant(row.cost_eur)}</td>
              </tr>
            ))}
          </tbody>
          <tfoot>
            <tr>
              <th scope="row" colSpan={3}>
                all together
              </th>
              <td class="num">
                <b>{significant(total, 4)}</b>
              </td>
              <td />
              <td class="num">{significant(design.totals.cost_eur)}</td>
            </tr>
          </tfoot>
        </table>
      </div>
    </Panel>
  );
}

export function MarginsPanel({ design, answer }: { design: Design; answer: Answer }) {
  const groups = answer.requirements.actuators;
  const least = Math.min(...design.margins.map((m) => m.relative_margin));
  return (
    <Panel title="Requirements and margins">
      <div class="scroll" tabIndex={0} role="region" aria-label="Margins">
        <table>
          <thead>
            <tr>
              <th scope="col">requirement</th>
              <th scope="col" class="num">
                asked
              </th>
              <th scope="col" class="num">
                is
              </th>
              <th scope="col">
                <span class="only-heard">unit</span>
              </th>
              <th scope="col">margin</th>
            </tr>
          </thead>
          <tbody>
            {design.margins.map((m) => (
              <tr key={m.requirement}>
                <th scope="row">{requirementName(m.requirement, groups)}</th>
                <td class="num">{requirementNumber(m.requirement, m.required)}</td>
                <td class="num">{requirementNumber(m.requirement, m.achieved)}</td>
                <td class="unit">{requirementUnit(m.requirement)}</td>
                <td>
                  <span class="margin-bar">
                    <span class="track">
                      <span
                        class={m.relative_margin === least ? (m.binding ? 'binding' : 'least') : ''}
                        style={{ width: `${Math.min(100, 100 * Math.max(0, m.relative_margin))}%` }}
                      />
                    </span>
                    {percent(m.relative_margin)} {m.binding && <Chip kind="bad">binding</Chip>}
                  </span>
                </td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
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
                <b>{family}</b> {fields.join(', ')}
              </li>
            ))}
          </ul>
        </>
      )}
    </Panel>
  );
}
