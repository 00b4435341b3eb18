// The ranked list: plots that filter, and a table of which only the rows in sight are drawn.
import { computed, signal, useComputed } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { type Axis, axes, axisOf, axisUnit, leastMargin, requirementName } from '../lib/amounts';
import { change, digitsApart, isSame, percent, significant } from '../lib/format';
import { jobList, refreshJobs } from '../lib/jobs';
import { go, link, route, setQuery } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { toShown } from '../lib/units';
import { type Brushes, Parallel } from '../plots/parallel';
import { Scatter } from '../plots/scatter';
import { Chip, Panel, Select } from '../ui/controls';
import { csv, saveFile } from '../ui/files';
import { useWindow } from '../ui/window';
import { useJob } from './designs';

const rowHeight = 36;
const query = computed(() => route.value.query);

export const picked = signal<number[]>([]);

const sortValue = (design: Design, by: string): number | string => {
  if (by === 'configuration') return design.configuration;
  return axisOf(by)?.of(design) ?? (by === 'rank' ? design.rank : Infinity);
};

function brushesOf(text: string | null): Brushes {
  const brushes: Brushes = {};
  for (const item of (text ?? '').split('~').filter(Boolean)) {
    const [id, low, high] = item.split(':');
    const range: [number, number] = [Number(low), Number(high)];
    if (id && range.every(Number.isFinite)) brushes[id] = range;
  }
  return brushes;
}

// Designs are the same when they have the same parts in the same numbers.
const signature = (design: Design): string =>
  design.parts.map((p) => `${p.id}×${p.unit === 'm' ? '' : p.quantity}@${p.group ?? ''}`).sort().join('|');

export function Ranked({ answer, id }: { answer: Answer; id: string }) {
  const q = query.value;
  const brushes = useComputed(() => brushesOf(query.value.get('brush'))).value;
  const other = useJob(q.get('with') ?? undefined)?.job?.result;
  useEffect(() => {
    void refreshJobs().catch(() => undefined);
    picked.value = (query.peek().get('pick') ?? '').split(',').map(Number).filter(Boolean);
  }, [id]);

  const usable = axes.filter((axis) => answer.designs.some((design) => axis.of(design) !== null));
  const x = axisOf(q.get('x')) ?? axisOf('mass')!;
  const y = axisOf(q.get('y')) ?? axisOf('volume')!;
  const baseline = Number(q.get('base')) || 1;
  const sort = q.get('sort') ?? 'rank';
  const ranges = Object.entries(brushes).map(([name, range]) => [axisOf(name), range] as const);
  const inBrush = (design: Design) =>
    ranges.every(([axis, [low, high]]) => {
      const value = axis?.of(design) ?? null;
      return value !== null && value >= low * (1 - 1e-12) && value <= high * (1 + 1e-12);
    });
  const onBrush = (axis: string, range: [number, number] | null) => {
    const next: Brushes = { ...brushes };
    if (range) next[axis] = [Number(range[0].toPrecision(6)), Number(range[1].toPrecision(6))];
    else delete next[axis];
    setQuery({ brush: Object.entries(next).map(([name, [a, b]]) => `${name}:${a}:${b}`).join('~') });
  };
  const descending = sort.startsWith('-');
  const by = sort.replace('-', '');
  const rows = answer.designs.filter(inBrush).sort((a, b) => {
    const [u, v] = [sortValue(a, by), sortValue(b, by)];
    const order = u < v ? -1 : u > v ? 1 : a.rank - b.rank;
    return descending ? -order : order;
  });
  const before = other ? new Map(other.designs.map((design) => [signature(design), design.rank])) : undefined;
  const jobs = (jobList.value ?? []).filter((job) => job.id !== id && job.status === 'done');
  return (
    <>
      <div class="plots">
        <div class="panel">
          <Scatter
            designs={answer.designs} inBrush={inBrush} x={x} y={y} baseline={baseline}
            onAxes={(nextX, nextY) => setQuery({ x: nextX === 'mass' ? undefined : nextX, y: nextY === 'volume' ? undefined : nextY })}
            onOpen={(rank) => go(['designs', id, String(rank)])}
          />
        </div>
        <div class="panel">
          <Parallel designs={answer.designs} axes={usable.filter((axis) => axis.id !== 'estimated' && !(answer.designs.length > 1 && isAlike(axis, answer.designs)))} brushes={brushes} inBrush={inBrush} baseline={baseline} onBrush={onBrush} />
        </div>
      </div>
      <Panel
        title={rows.length === answer.designs.length ? `${rows.length} designs` : `${rows.length} of ${answer.designs.length} designs`}
        aside={
          <>
            {ranges.length > 0 && (
              <button type="button" onClick={() => setQuery({ brush: undefined })}>Show all</button>
            )}
            <Select
              label="Baseline" value={String(baseline)} onChange={(v) => setQuery({ base: v === '1' ? undefined : v })}
              options={answer.designs.slice(0, 500).map((d) => ({ value: String(d.rank), label: `#${d.rank}` }))}
            />
            {jobs.length > 0 && (
              <Select
                label="Before" value={q.get('with') ?? ''} onChange={(v) => setQuery({ with: v })}
                options={[{ value: '', label: 'no other search' }, ...jobs.map((job) => ({ value: job.id, label: `${job.name || 'unnamed'} ${job.id.slice(0, 6)}` }))]}
              />
            )}
            <button type="button" disabled={picked.value.length < 2} onClick={() => go(['designs', id, 'compare'], { ranks: picked.value.join(',') })}>
              Compare {picked.value.length || ''}
            </button>
            <button type="button" onClick={() => saveFile(`${answer.name || id}-designs.csv`, listCsv(rows), 'text/csv')}>CSV</button>
          </>
        }
      >
        {before && other && <Changes answer={answer} other={other} before={before} />}
        <Table answer={answer} rows={rows} id={id} baseline={baseline} sort={sort} before={before} />
      </Panel>
    </>
  );
}

function Changes({ answer, other, before }: { answer: Answer; other: Answer; before: Map<string, number> }) {
  const fresh = answer.designs.filter((design) => !before.has(signature(design)));
  const now = new Set(answer.designs.map(signature));
  const gone = other.designs.filter((design) => !now.has(signature(design)));
  const [first, was] = [answer.designs[0], other.designs[0]];
  return (
    <p class="changes" role="status">
      {fresh.length === 0 && gone.length === 0 ? 'The same designs as before. ' : `${fresh.length} new, ${gone.length} no longer listed. `}
      {first && was && `Best mass ${significant(was.totals.mass_kg, 4)} → ${significant(first.totals.mass_kg, 4)} kg (${percent(first.totals.mass_kg / was.totals.mass_kg - 1)}).`}
    </p>
  );
}

const listCsv = (rows: Design[]): string =>
  csv([
    ['rank', 'configuration', 'mass_kg', 'volume_l', 'cost_eur', 'energy_wh', 'source_pressure_kpa_gauge', 'reservoir_volume_ml', 'rise_time_s', 'fall_time_s', 'least_margin', 'parts'],
    ...rows.map((d) => [
      d.rank, d.configuration, d.totals.mass_kg, d.totals.volume_l, d.totals.cost_eur, d.totals.energy_wh,
      d.settings.source_pressure_kpa_gauge, d.settings.reservoir_volume_ml, axisOf('rise')!.of(d), axisOf('fall')!.of(d),
      leastMargin(d), d.parts.map((p) => `${p.quantity} ${p.id}`).join('; '),
    ]),
  ]);

const columns = ['mass', 'volume', 'cost', 'energy', 'source', 'reservoir', 'duty', 'rise', 'fall', 'sustained', 'probability'].map(
  (name) => axisOf(name)!,
);

function extentOf(axis: Axis, designs: Design[]): [number, number] {
  const values = designs.map(axis.of).filter((value): value is number => value !== null);
  return [Math.min(...values), Math.max(...values)];
}

// Enough digits to tell the designs apart, within reason.
const digitsOf = (axis: Axis, designs: Design[]): number =>
  Math.min(axis.id === 'mass' ? 5 : 4, digitsApart(...extentOf(axis, designs)));

const isAlike = (axis: Axis, designs: Design[]): boolean =>
  designs.every((design) => axis.of(design) !== null) && isSame(...extentOf(axis, designs));

// What of a design's parts is other than in the baseline; of the baseline the source.
function partsInShort(design: Design, base: Design | undefined): string {
  const key = (p: Design['parts'][number]) => `${p.id} ${p.group} ${p.quantity}`;
  const known = new Set(design === base ? [] : base?.parts.map(key));
  const rows = design.parts.filter((p) => !known.has(key(p)) && (design !== base || ['compressor', 'cylinder', 'co2', 'regulator', 'valve'].includes(p.family)));
  return rows.map((p) => (p.id === 'custom' ? `${p.family} made to measure` : `${p.family} ${p.part_number}`)).join(', ');
}

function Table(props: {
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
  const alike = answer.designs.length > 1 ? some.filter((axis) => isAlike(axis, answer.designs)) : [];
  const used = some.filter((axis) => !alike.includes(axis)).map((axis) => ({ axis, digits: digitsOf(axis, answer.designs) }));
  const base = answer.designs.find((design) => design.rank === baseline);
  const sortBy = (name: string) => setQuery({ sort: sort === name ? `-${name}` : name === 'rank' ? undefined : name });
  const head = (name: string, text: string, unit = '', tip?: string) => (
    <th key={name} scope="col" class={name === 'configuration' || name === 'margin' ? '' : 'num'} aria-sort={sort === name ? 'ascending' : sort === `-${name}` ? 'descending' : 'none'}>
      <button type="button" onClick={() => sortBy(name)} data-tip={tip}>
        {text}
        {unit && <small> {unit}</small>}
        <i>{sort === name ? '▲' : sort === `-${name}` ? '▼' : ''}</i>
      </button>
    </th>
  );
  const toggle = (rank: number) => {
    const next = picked.value.includes(rank) ? picked.value.filter((r) => r !== rank) : [...picked.value, rank].slice(-4);
    picked.value = next;
    setQuery({ pick: next.join(',') });
  };
  return (
    <>
      {alike.length > 0 && (
        <p class="alike muted">
          The same in all: {alike.map((axis) => `${axis.label} ${significant(toShown(axis.kind, axis.of(answer.designs[0]!)!))} ${axisUnit(axis)}`).join(', ')}.
        </p>
      )}
      <div class="scroll ranked" tabIndex={0} role="region" aria-label="Ranked designs" onScroll={sight.onScroll}>
        <table aria-rowcount={rows.length + 1}>
          <thead>
            <tr>
              <th scope="col"><span class="only-heard">compare</span></th>
              {head('rank', '#')}
              {head('configuration', 'supply')}
              {used.map(({ axis }) => head(axis.id, axis.label, axisUnit(axis)))}
              {head('margin', 'margins', '', 'One bar a requirement, full at 50 %; the least one is marked')}
              {head('estimated', 'data', '', 'How much of the mass rests on estimates; ~ flow data are estimates, too')}
              <th scope="col" class="num">to #{baseline}</th>
              <th scope="col">other parts than #{baseline}</th>
              {props.before && <th scope="col" class="num">before</th>}
            </tr>
          </thead>
          <tbody>
            {sight.above > 0 && <tr aria-hidden="true" class="spacer" style={{ height: `${sight.above}px` }} />}
            {visible.map((design, i) => (
              <tr key={design.rank} aria-rowindex={sight.start + i + 2} class={design.rank === baseline ? 'baseline' : ''}>
                <td>
                  <input type="checkbox" aria-label={`Compare design ${design.rank}`} checked={picked.value.includes(design.rank)} onChange={() => toggle(design.rank)} />
                </td>
                <th scope="row" class="num">
                  <a href={link(['designs', props.id, String(design.rank)])}>{design.rank}</a>
                </th>
                <td class="nowrap" data-tip={design.parts.map((p) => `${p.quantity} × ${p.manufacturer} ${p.part_number}`).join('; ')}>{design.configuration}</td>
                {used.map(({ axis, digits }) => {
                  const value = axis.of(design);
                  return <td key={axis.id} class="num">{value === null ? '–' : significant(toShown(axis.kind, value), digits)}</td>;
                })}
                <td><Margins design={design} answer={answer} /></td>
                <td class="num nowrap">
                  <Quality design={design} />
                </td>
                <td class="num nowrap">{base && design !== base ? change(design.objective / base.objective - 1) : '–'}</td>
                <Others text={partsInShort(design, base)} />
                {props.before && <td class="num nowrap">{was(props.before.get(signature(design)), design.rank)}</td>}
              </tr>
            ))}
            {sight.below > 0 && <tr aria-hidden="true" class="spacer" style={{ height: `${sight.below}px` }} />}
          </tbody>
        </table>
      </div>
    </>
  );
}

const Others = ({ text }: { text: string }) => <td class="others" data-tip={text}>{text}</td>;

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
          return <rect key={m.requirement} x={i * 7} y={20 - h} width="5" height={h} class={m.relative_margin === least ? (m.binding ? 'binding' : 'least') : ''} />;
        })}
      </svg>
      <span>{percent(least)}</span>
      <span class="muted">{tightest ? requirementName(tightest.requirement, groups) : ''}</span>
    </span>
  );
}
