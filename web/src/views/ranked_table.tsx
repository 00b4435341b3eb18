// The table of the ranked list, of which only the rows in sight are drawn.
import { signal } from '@preact/signals';

import {
  amountText,
  type Axis,
  axisOf,
  axisUnit,
  leastMargin,
  objectiveName,
  quantityOf,
  requirementName,
  supplyWord,
} from '../lib/amounts';
import { change, digitsApart, isSame, percent } from '../lib/format';
import { signature } from '../lib/list_changes';
import { link, setQuery } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { hasTank } from '../lib/vacuum';
import { Chip } from '../ui/controls';
import { type Head, LongTable, number, SortHead } from '../ui/table';
import { identity } from './kinds';

export const picked = signal<number[]>([]);

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
  axis.id === 'mass'
    ? Math.min(5, Math.max(4, digitsApart(...extentOf(axis, designs))))
    : Math.min(4, digitsApart(...extentOf(axis, designs)));

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
        ['compressor', 'vacuum_pump', 'ejector', 'cylinder', 'co2', 'regulator', 'valve'].includes(
          p.family,
        ) ||
        (p.family === 'reservoir' && hasTank(design.configuration))),
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
  awaited: string[]; // columns that are being worked out
}) {
  const { answer, rows, baseline, sort, awaited } = props;
  const { designs } = answer;
  const some = columns.filter(
    (axis) => awaited.includes(axis.id) || designs.some((design) => axis.of(design) !== null),
  );
  const alike = designs.length > 1 ? some.filter((axis) => isAlike(axis, designs)) : [];
  const used = some
    .filter((axis) => !alike.includes(axis))
    .map((axis) => ({ axis, digits: digitsOf(axis, designs) }));
  const kinds = new Set(designs.map((design) => design.configuration));
  const same = [
    ...(designs.length > 1 && kinds.size === 1 ? [`supply ${supplyWord(designs[0]!)}`] : []),
    ...alike.map(
      (axis) => `${axis.label} ${amountText(axis, axis.of(designs[0]!))} ${axisUnit(axis)}`,
    ),
  ];
  const hasSupply = designs.length === 1 || kinds.size > 1;
  const base = designs.find((design) => design.rank === baseline);
  const head = (name: string, head: Head, tip?: string) => (
    <SortHead
      key={name}
      name={name}
      head={head}
      sort={sort}
      tip={tip}
      onSort={(next) => setQuery({ sort: next === 'rank' ? undefined : next })}
    />
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
      {same.length > 0 && <p class="alike muted">The same in all: {same.join(', ')}.</p>}
      <LongTable
        label="Ranked designs"
        class="ranked"
        rowHeight={36}
        inSight={34}
        rows={rows}
        head={
          <>
            <th scope="col">
              <span class="only-heard">compare</span>
            </th>
            {head('rank', { text: '#' }, 'Pump or bottle, and valves')}
            {hasSupply && head('configuration', { text: 'supply' })}
            {used.map(({ axis }) =>
              head(axis.id, number(axis.label, axisUnit(axis)), axis.meaning),
            )}
            {head(
              'margin',
              { text: 'margins' },
              'One bar a requirement, full at 50 %; the least one is marked, red where it binds',
            )}
            {head(
              'estimated',
              number('estimated'),
              'How much of the mass rests on estimates; ~ where flow data are estimates, too',
            )}
            <th
              scope="col"
              class="num"
              data-tip={`Difference in ${objectiveName(answer.requirements)}, which is ranked by`}
            >
              to #{baseline}
            </th>
            <th scope="col">other parts than #{baseline}</th>
            {props.before && (
              <th scope="col" class="num">
                before
              </th>
            )}
          </>
        }
        row={(design, i) => (
          <tr
            key={design.rank}
            aria-rowindex={i + 2}
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
            <th
              scope="row"
              class="nowrap"
              data-tip={design.parts
                .map((p) => `${quantityOf(p)} ${p.manufacturer} ${p.part_number}`)
                .join('; ')}
            >
              <a href={link(['designs', props.id, String(design.rank)])}>{design.rank}</a>
              <Identity design={design} />
            </th>
            {hasSupply && <td class="nowrap">{supplyWord(design)}</td>}
            {used.map(({ axis, digits }) => (
              <td key={axis.id} class="num">
                {awaited.includes(axis.id) ? '…' : amountText(axis, axis.of(design), digits)}
              </td>
            ))}
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
              <td class="num nowrap">{was(props.before.get(signature(design)), design.rank)}</td>
            )}
          </tr>
        )}
      />
    </>
  );
}

function Identity({ design }: { design: Design }) {
  const { source, valves } = identity(design);
  return (
    <span class="identity">
      <span>{source}</span> <span class="muted">{valves}</span>
    </span>
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
      <svg viewBox={`0 0 ${width} 20`} style={{ width: `${width / 10}rem` }} aria-hidden="true">
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
