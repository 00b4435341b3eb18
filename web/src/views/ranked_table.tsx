// The table of the ranked list, of which only the rows in sight are drawn.
import { signal } from '@preact/signals';

import { type Axis, axisOf, axisUnit, leastMargin, requirementName } from '../lib/amounts';
import { change, digitsApart, isSame, percent, significant } from '../lib/format';
import { link, setQuery } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { toShown } from '../lib/units';
import { Chip } from '../ui/controls';
import { useWindow } from '../ui/window';

const rowHeight = 36;

export const picked = signal<number[]>([]);

// Designs are the same when they have the same parts in the same numbers.
export const signature = (design: Design): string =>
  design.parts
    .map((p) => `${p.id}×${p.unit === 'm' ? '' : p.quantity}@${p.group ?? ''}`)
    .sort()
    .join('|');

const columns = [
  'mass',
  'volume',
  'cost',
  'energy',
  'source',
  'reservoir',
  'duty',
  'rise',
  'fall',
  'sustained',
  'probability',
].map((name) => axisOf(name)!);

function extentOf(axis: Axis, designs: Design[]): [number, number] {
  const values = designs.map(axis.of).filter((value): value is number => value !== null);
  return [Math.min(...values), Math.max(...values)];
}

// Enough digits to tell the designs apart, within reason.
const digitsOf = (axis: Axis, designs: Design[]): number =>
  Math.min(axis.id === 'mass' ? 5 : 4, digitsApart(...extentOf(axis, designs)));

export const isAlike = (axis: Axis, designs: Design[]): boolean =>
  designs.every((design) => axis.of(design) !== null) && isSame(...extentOf(axis, designs));

// What of a design's parts is other than in the baseline; of the baseline the source.
export function partsInShort(design: Design, base: Design | undefined): string {
  const key = (p: Design['parts'][number]) => `${p.id} ${p.group} ${p.quantity}`;
  const known = new Set(design === base ? [] : base?.parts.map(key));
  const rows = design.parts.filter(
    (p) =>
      !known.has(key(p)) &&
      (design !== base ||
        ['compressor', 'cylinder', 'co2', 'regulator', 'valve'].includes(p.family)),
  );
  return rows
    .map((p) =>
      p.id === 'custom' ? `${p.family} made to measure` : `${p.family} ${p.part_number}`,
    )
    .join(', ');
}

export function Table(props: {
  answer: Answer;
  rows: Design[];
  id: string;
  baseline: number;
  sort: string;
  before?: Map<string, number>;
}) {
  const { answer, rows, baseline, sort } = props;
  const sight = useWindow(rowHeight, rows.length, 34);
  const visible = rows.slice(sight.start, sight.end);
  const some = columns.filter((axis) => answer.designs.some((design) => axis.of(design) !== null));
  const alike =
    answer.designs.length > 1 ? some.filter((axis) => isAlike(axis, answer.designs)) : [];
  const used = some
    .filter((axis) => !alike.includes(axis))
    .map((axis) => ({ axis, digits: digitsOf(axis, answer.designs) }));
  const base = answer.designs.find((design) => design.rank === baseline);
  const sortBy = (name: string) =>
    setQuery({ sort: sort === name ? `-${name}` : name === 'rank' ? undefined : name });
  const head = (name: string, text: string, unit = '', tip?: string) => (
    <th
      key={name}
      scope="col"
      class={name === 'configuration' || name === 'margin' ? '' : 'num'}
      aria-sort={sort === name ? 'ascending' : sort === `-${name}` ? 'descending' : 'none'}
    >
      <button type="button" onClick={() => sortBy(name)} data-tip={tip}>
        {text}
        {unit && <small> {unit}</small>}
        <i>{sort === name ? '▲' : sort === `-${name}` ? '▼' : ''}</i>
      </button>
    </th>
  );
  const toggle = (rank: number) => {
    const next = picked.value.includes(rank)
      ? picked.value.filter((r) => r !== rank)
      : [...picked.value, rank].slice(-4);
    picked.value = next;
    setQuery({ pick: next.join(',') });
  };
  return (
    <>
      {alike.length > 0 && (
        <p class="alike muted">
          The same in all:{' '}
          {alike
            .map(
              (axis) =>
                `${axis.label} ${significant(toShown(axis.kind, axis.of(answer.designs[0]!)!))} ${axisUnit(axis)}`,
            )
            .join(', ')}
          .
        </p>
      )}
      <div
        class="scroll ranked"
        tabIndex={0}
        role="region"
        aria-label="Ranked designs"
        onScroll={sight.onScroll}
      >
        <table aria-rowcount={rows.length + 1}>
          <thead>
            <tr>
              <th scope="col">
                <span class="only-heard">compare</span>
              </th>
              {head('rank', '#')}
              {head('configuration', 'supply')}
              {used.map(({ axis }) => head(axis.id, axis.label, axisUnit(axis)))}
              {head(
                'margin',
                'margins',
                '',
                'One bar a requirement, full at 50 %; the least one is marked',
              )}
              {head(
                'estimated',
                'data',
                '',
                'How much of the mass rests on estimates; ~ flow data are estimates, too',
              )}
              <th scope="col" class="num">
                to #{baseline}
              </th>
              <th scope="col">other parts than #{baseline}</th>
              {props.before && (
                <th scope="col" class="num">
                  before
                </th>
              )}
            </tr>
          </thead>
          <tbody>
            {sight.above > 0 && (
              <tr aria-hidden="true" class="spacer" style={{ height: `${sight.above}px` }} />
            )}
            {visible.map((design, i) => (
              <tr
                key={design.rank}
                aria-rowindex={sight.start + i + 2}
                class={design.rank === baseline ? 'baseline' : ''}
              >
                <td>
                  <input
                    type="checkbox"
                    aria-label={`Compare design ${design.rank}`}
                    checked={picked.value.includes(design.rank)}
                    onChange={() => toggle(design.rank)}
                  />
                </td>
                <th scope="row" class="num">
                  <a href={link(['designs', props.id, String(design.rank)])}>{design.rank}</a>
                </th>
                <td
                  class="nowrap"
                  data-tip={design.parts
                    .map((p) => `${p.quantity} × ${p.manufacturer} ${p.part_number}`)
                    .join('; ')}
                >
                  {design.configuration}
                </td>
                {used.map(({ axis, digits }) => {
                  const value = axis.of(design);
                  return (
                    <td key={axis.id} class="num">
                      {value === null ? '–' : significant(toShown(axis.kind, value), digits)}
                    </td>
                  );
                })}
                <td>
                  <Margins design={design} answer={answer} />
                </td>
                <td class="num nowrap">
                  <Quality design={design} />
                </td>
                <td class="num nowrap">
                  {base && design !== base ? change(design.objective / base.objective - 1) : '–'}
                </td>
                <Others text={partsInShort(design, base)} />
                {props.before && (
                  <td class="num nowrap">
                    {was(props.before.get(signature(design)), design.rank)}
                  </td>
                )}
              </tr>
            ))}
            {sight.below > 0 && (
              <tr aria-hidden="true" class="spacer" style={{ height: `${sight.below}px` }} />
            )}
          </tbody>
        </table>
      </div>
    </>
  );
}

const Others = ({ text }: { text: string }) => (
  <td class="others" data-tip={text}>
    {text}
  </td>
);

function was(rank: number | undefined, now: number) {
  if (rank === undefined) return <Chip kind="good">new</Chip>;
  if (rank === now) return `#${rank}`;
  return `#${rank} ${rank > now ? '▲' : '▼'}`;
}

function Quality({ design }: { design: Design }) {
  const quality = design.data_quality;
  const tip = quality.estimated.length
    ? `Estimates: ${percent(quality.mass_share_estimated, 0)} of the mass${quality.flow_estimated ? ', flow data' : ''}. ${quality.estimated.length} fields rest on estimates`
    : 'All numbers are from data sheets or third parties';
  return (
    <span class="quality" data-tip={tip}>
      {quality.flow_estimated && <b>~</b>} {percent(quality.mass_share_estimated, 0)}
    </span>
  );
}

// One bar a requirement; the least margin says its number and name.
export function Margins({ design, answer }: { design: Design; answer: Answer }) {
  const groups = answer.requirements.actuators;
  const least = leastMargin(design);
  const width = design.margins.length * 7;
  const tip = design.margins
    .map((m) => `${requirementName(m.requirement, groups)} ${percent(m.relative_margin)}`)
    .join(' · ');
  const tightest = design.margins.find((m) => m.relative_margin === least);
  return (
    <span class="margins" data-tip={tip}>
      <svg width={width} height="20" aria-hidden="true">
        {design.margins.map((m, i) => {
          const h = Math.max(1.5, Math.min(1, Math.max(0, m.relative_margin) / 0.5) * 20);
          return (
            <rect
              key={m.requirement}
              x={i * 7}
              y={20 - h}
              width="5"
              height={h}
              class={m.relative_margin === least ? (m.binding ? 'binding' : 'least') : ''}
            />
          );
        })}
      </svg>
      <span>{percent(least)}</span>
      <span class="muted">{tightest ? requirementName(tightest.requirement, groups) : ''}</span>
    </span>
  );
}
