// Up to four designs side by side: deltas to the first, responses over each other.
import {
  amountText,
  axes,
  type Axis,
  axisUnit,
  quantityOf,
  requirementName,
  supplyWord,
} from '../lib/amounts';
import { change, percent, signed } from '../lib/format';
import { link, route, setQuery } from '../lib/route';
import { seriesColours } from '../lib/theme';
import { traceName } from '../lib/rig';
import type { Answer, Design } from '../lib/types';
import { pressuresShown, unitOf } from '../lib/units';
import { type Line, Lines } from '../plots/lines';
import { Chip, Notice, Panel, Segmented } from '../ui/controls';
import { Scroll } from '../ui/scroll';

export function ComparePanel({ answer, id }: { answer: Answer; id: string }) {
  const ranks = (route.value.query.get('ranks') ?? '').split(',').map(Number);
  const designs = ranks
    .map((rank) => answer.designs.find((design) => design.rank === rank))
    .filter((design): design is Design => design !== undefined)
    .slice(0, 4);
  const back = <a href={link(['designs', id])}>{answer.name || 'Designs'}</a>;
  if (designs.length < 2)
    return (
      <Notice kind="info">Mark two to four designs in the list {back} to compare them.</Notice>
    );
  return (
    <>
      <div class="headline">
        <div class="toolbar">
          <h1>{back} › compare</h1>
        </div>
      </div>
      <Panel title="Amounts" aside={<span class="muted">difference to #{designs[0]!.rank}</span>}>
        <Amounts designs={designs} answer={answer} id={id} />
      </Panel>
      <Panel title="Parts">
        <PartsSideBySide designs={designs} />
      </Panel>
      <Responses designs={designs} />
    </>
  );
}

function Heads({ designs, id }: { designs: Design[]; id?: string }) {
  return (
    <>
      {designs.map((design, i) => (
        <th key={design.rank} scope="col">
          <i class="swatch" style={{ background: `var(${seriesColours[i]})` }} />{' '}
          {id ? (
            <a href={link(['designs', id, String(design.rank)])}>
              #{design.rank} {supplyWord(design)}
            </a>
          ) : (
            `#${design.rank} ${supplyWord(design)}`
          )}
        </th>
      ))}
    </>
  );
}

function Amounts({ designs, answer, id }: { designs: Design[]; answer: Answer; id: string }) {
  const first = designs[0]!;
  const used = axes.filter((axis) => designs.some((design) => axis.of(design) !== null));
  return (
    <Scroll label="Amounts side by side">
      <table class="compare">
        <thead>
          <tr>
            <th scope="col">amount</th>
            <Heads designs={designs} id={id} />
          </tr>
        </thead>
        <tbody>
          {used.map((axis) => {
            const base = axis.of(first);
            return (
              <tr key={axis.id}>
                <th scope="row">
                  {axis.label} <small class="muted">{axisUnit(axis)}</small>
                </th>
                {designs.map((design) => {
                  const value = axis.of(design);
                  return (
                    <td key={design.rank}>
                      {amountText(axis, value, axis.id === 'mass' ? 4 : 3)}{' '}
                      {design !== first && <Delta axis={axis} value={value} base={base} />}
                    </td>
                  );
                })}
              </tr>
            );
          })}
          {first.margins.map((margin) => (
            <tr key={margin.requirement}>
              <th scope="row">
                margin of {requirementName(margin.requirement, answer.requirements.actuators)}
              </th>
              {designs.map((design) => {
                const own = design.margins.find((m) => m.requirement === margin.requirement);
                return (
                  <td key={design.rank}>
                    {percent(own?.relative_margin)}{' '}
                    {own?.binding && <Chip kind="bad">binding</Chip>}
                  </td>
                );
              })}
            </tr>
          ))}
        </tbody>
      </table>
    </Scroll>
  );
}

// Of shares the difference in points, of other amounts the relative one.
function Delta(props: { axis: Axis; value: number | null; base: number | null }) {
  const { axis, value, base } = props;
  if (value === null || base === null) return null;
  const isShare = axis.unit === '%';
  const delta = isShare ? value - base : base === 0 ? 0 : value / base - 1;
  if (Math.abs(delta) < (isShare ? 5e-3 : 5e-5)) return null;
  const isBetter = (axis.better === 'low') === delta < 0;
  return (
    <span class={isBetter ? 'delta better' : 'delta worse'}>
      {isShare ? signed(delta, 2) : change(delta)}
    </span>
  );
}

function PartsSideBySide({ designs }: { designs: Design[] }) {
  const keys = [
    ...new Set(designs.flatMap((d) => d.parts.map((p) => `${p.family}|${p.group ?? ''}`))),
  ];
  const text = (design: Design, key: string) =>
    design.parts
      .filter((p) => `${p.family}|${p.group ?? ''}` === key)
      .map((p) => `${quantityOf(p)} ${p.manufacturer} ${p.part_number}`)
      .join(', ');
  return (
    <Scroll label="Parts side by side">
      <table class="compare">
        <thead>
          <tr>
            <th scope="col">family</th>
            <Heads designs={designs} />
          </tr>
        </thead>
        <tbody>
          {keys.map((key) => {
            const [family, group] = key.split('|');
            const texts = designs.map((design) => text(design, key));
            return (
              <tr key={key}>
                <th scope="row">
                  {family} {group && <small class="muted">{group}</small>}
                </th>
                {texts.map((t, i) => (
                  <td key={i} class={t !== texts[0] ? 'differs' : ''}>
                    {t || '–'}
                  </td>
                ))}
              </tr>
            );
          })}
        </tbody>
      </table>
    </Scroll>
  );
}

function Responses({ designs }: { designs: Design[] }) {
  const names = [...designs[0]!.response.groups.map(traceName), 'source'];
  const asked = route.value.query.get('show');
  const name = asked && names.includes(asked) ? asked : names[0]!;
  const x = designs[0]!.response.t_s;
  const lines: Line[] = designs.map((design, i) => {
    const { t_s, groups, source_pressure_kpa_gauge } = design.response;
    const values =
      name === 'source'
        ? source_pressure_kpa_gauge
        : (groups.find((g) => traceName(g) === name)?.pressure_kpa_gauge ?? []);
    const shown = t_s.length === x.length ? pressuresShown(values) : x.map(() => null);
    return {
      label: `#${design.rank} ${supplyWord(design)}`,
      values: shown,
      colour: seriesColours[i]!,
      dash: i > 0 ? [7 - i, 2 + i] : undefined,
    };
  });
  return (
    <Panel
      title="One cycle of the periodic state"
      aside={
        <Segmented
          label="of"
          options={names}
          value={name}
          onChange={(v) => setQuery({ show: v === names[0] ? undefined : v })}
        />
      }
    >
      <Lines
        title={`Pressure of ${name}`}
        x={x}
        xLabel="time, s"
        yLabel={`pressure, ${unitOf('pressure')}`}
        lines={lines}
        height={300}
        yFromZero
      />
    </Panel>
  );
}
