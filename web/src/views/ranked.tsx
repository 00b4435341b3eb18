// The ranked list: plots that filter, and a table of which only the rows in sight are drawn.
import { computed, useComputed } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { axes, axisOf, leastMargin, usualAxes } from '../lib/amounts';
import { jobList, refreshJobs } from '../lib/jobs';
import { signature } from '../lib/list_changes';
import { go, route, setQuery } from '../lib/route';
import type { Answer, Design } from '../lib/types';
import { type Brushes, Parallel } from '../plots/parallel';
import { Scatter } from '../plots/scatter';
import { Panel, Select } from '../ui/controls';
import { counted } from '../lib/words';
import { csv, saveFile } from '../ui/files';
import { AgainstNominal } from './against_nominal';
import { isAlike, picked, Table } from './ranked_table';

const query = computed(() => route.value.query);

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

export function Ranked({
  answer,
  id,
  since,
  awaited,
}: {
  answer: Answer;
  id: string;
  since: { id: string | null; answer: Answer | undefined }; // the list that it is compared with
  awaited: string[]; // columns that are being worked out
}) {
  const q = query.value;
  const brushes = useComputed(() => brushesOf(query.value.get('brush'))).value;
  useEffect(() => {
    void refreshJobs().catch(() => undefined);
    picked.value = (query.peek().get('pick') ?? '').split(',').map(Number).filter(Boolean);
  }, [id]);

  const usable = axes.filter((axis) => answer.designs.some((design) => axis.of(design) !== null));
  const [usualX, usualY] = usualAxes(answer.requirements);
  const x = axisOf(q.get('x') ?? usualX)!;
  const y = axisOf(q.get('y') ?? usualY)!;
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
    setQuery({
      brush: Object.entries(next)
        .map(([name, [a, b]]) => `${name}:${a}:${b}`)
        .join('~'),
    });
  };
  const descending = sort.startsWith('-');
  const by = sort.replace('-', '');
  const rows = answer.designs.filter(inBrush).sort((a, b) => {
    const [u, v] = [sortValue(a, by), sortValue(b, by)];
    const order = u < v ? -1 : u > v ? 1 : a.rank - b.rank;
    return descending ? -order : order;
  });
  const nominal = answer.against_nominal;
  // Which rank a design had, by its parts: with the nominal model, or in the search chosen.
  const before = nominal
    ? new Map(
        nominal.designs.flatMap((d) =>
          d.nominal_rank === null
            ? []
            : [[signature(answer.designs[d.rank - 1]!), d.nominal_rank] as const],
        ),
      )
    : since.answer
      ? new Map(since.answer.designs.map((design) => [signature(design), design.rank]))
      : undefined;
  const jobs = (jobList.value ?? []).filter((job) => job.id !== id && job.status === 'done');
  return (
    <>
      <div class="plots">
        <div class="panel">
          <Scatter
            designs={answer.designs}
            inBrush={inBrush}
            x={x}
            y={y}
            baseline={baseline}
            onAxes={(nextX, nextY) =>
              setQuery({
                x: nextX === usualX ? undefined : nextX,
                y: nextY === usualY ? undefined : nextY,
              })
            }
            onOpen={(rank) => go(['designs', id, String(rank)])}
          />
        </div>
        <div class="panel">
          <Parallel
            designs={answer.designs}
            axes={usable.filter(
              (axis) =>
                axis.id !== 'estimated' &&
                !(answer.designs.length > 1 && isAlike(axis, answer.designs)),
            )}
            brushes={brushes}
            inBrush={inBrush}
            baseline={baseline}
            onBrush={onBrush}
          />
        </div>
      </div>
      <Panel
        title={
          rows.length === answer.designs.length
            ? counted(rows.length, 'design')
            : `${rows.length} of ${counted(answer.designs.length, 'design')}`
        }
        aside={
          <>
            {ranges.length > 0 && (
              <button type="button" onClick={() => setQuery({ brush: undefined })}>
                Show all
              </button>
            )}
            <Select
              label="Baseline"
              value={String(baseline)}
              onChange={(v) => setQuery({ base: v === '1' ? undefined : v })}
              options={answer.designs
                .slice(0, 500)
                .map((d) => ({ value: String(d.rank), label: `#${d.rank}` }))}
            />
            {jobs.length > 0 && (
              <Select
                label="Changes since"
                value={since.id ?? 'none'}
                onChange={(v) => setQuery({ with: v })}
                options={[
                  { value: 'none', label: 'no search chosen' },
                  ...jobs.map((job) => ({
                    value: job.id,
                    label: `${job.name || 'unnamed'} ${job.id.slice(0, 6)}`,
                  })),
                ]}
              />
            )}
            <button
              type="button"
              disabled={picked.value.length < 2}
              onClick={() => go(['designs', id, 'compare'], { ranks: picked.value.join(',') })}
            >
              {picked.value.length < 2 ? 'Mark two to compare' : `Compare ${picked.value.length}`}
            </button>
            <button
              type="button"
              onClick={() =>
                saveFile(`${answer.name || id}-designs.csv`, listCsv(rows), 'text/csv')
              }
            >
              CSV
            </button>
          </>
        }
      >
        {nominal && <AgainstNominal answer={answer} />}
        <Table
          answer={answer}
          rows={rows}
          id={id}
          baseline={baseline}
          sort={sort}
          before={before}
          awaited={awaited}
        />
      </Panel>
    </>
  );
}

const listCsv = (rows: Design[]): string =>
  csv([
    [
      'rank',
      'configuration',
      'mass_kg',
      'volume_l',
      'cost_eur',
      'energy_wh',
      'source_pressure_kpa_gauge',
      'reservoir_volume_ml',
      'tank_fill_kpa_gauge',
      'pump_stop_kpa_gauge',
      'group_pressure_kpa_gauge',
      'vacuum_kpa_gauge',
      'vacuum_stop_kpa_gauge',
      'vacuum_duty',
      'rise_time_s',
      'fall_time_s',
      'least_margin',
      'parts',
    ],
    ...rows.map((d) => [
      d.rank,
      d.configuration,
      d.totals.mass_kg,
      d.totals.volume_l,
      d.totals.cost_eur,
      d.totals.energy_wh,
      d.settings.source_pressure_kpa_gauge,
      d.settings.reservoir_volume_ml,
      d.settings.tank_fill_kpa_gauge ?? null,
      d.settings.pump_stop_kpa_gauge ?? null,
      d.settings.group_pressure_kpa_gauge?.join('; ') ?? null,
      d.settings.vacuum_kpa_gauge ?? null,
      d.settings.vacuum_stop_kpa_gauge ?? null,
      d.settings.vacuum_duty ?? null,
      axisOf('rise')!.of(d),
      axisOf('fall')!.of(d),
      leastMargin(d),
      d.parts.map((p) => `${p.quantity} ${p.id}`).join('; '),
    ]),
  ]);
