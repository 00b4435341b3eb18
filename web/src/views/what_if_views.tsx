// What the trial of a design shows: its sliders, curves and times.
import { useId } from 'preact/hooks';

import { requirementName, requirementNumber, requirementUnit, sense } from '../lib/amounts';
import type { Evaluation } from '../lib/evaluation';
import { change as changeOf, pressuresInUnit, shown, significant } from '../lib/format';
import { seriesColours } from '../lib/theme';
import type { Requirements, Response } from '../lib/types';
import { type Kind, pressuresShown, toShown, unitOf } from '../lib/units';
import { type Guide, type Line, Lines } from '../plots/lines';
import { Notice } from '../ui/controls';
import { number, Table } from '../ui/table';

export function Slider(props: {
  label: string;
  value: number;
  low: number;
  high: number;
  kind?: Kind;
  unit?: string;
  scale?: number;
  onInput: (value: number) => void;
}) {
  const id = useId();
  const kind = props.kind ?? 'plain';
  const text = `${significant(toShown(kind, props.value * (props.scale ?? 1)))} ${unitOf(kind, props.unit)}`;
  return (
    <div class="slider">
      <label for={id}>{props.label}</label>
      <output for={id}>{text}</output>
      <input
        id={id}
        type="range"
        min={props.low}
        max={props.high}
        step={(props.high - props.low) / 200}
        value={props.value}
        aria-valuetext={text}
        onInput={(event) => props.onInput(Number(event.currentTarget.value))}
      />
    </div>
  );
}

export function ResponsePlot({
  base,
  trial,
  requirements,
}: {
  base: Response;
  trial: Response | null;
  requirements: Requirements;
}) {
  const lines: Line[] = [];
  base.groups.forEach((group, i) =>
    lines.push({
      label: group.name,
      values: pressuresShown(group.pressure_kpa_gauge),
      colour: seriesColours[i % 5]!,
    }),
  );
  lines.push({
    label: 'source',
    values: pressuresShown(base.source_pressure_kpa_gauge),
    colour: '--c6',
  });
  if (trial && trial.t_s.length === base.t_s.length) {
    trial.groups.forEach((group, i) =>
      lines.push({
        label: `${group.name}, what if`,
        values: pressuresShown(group.pressure_kpa_gauge),
        colour: seriesColours[i % 5]!,
        dash: [5, 3],
      }),
    );
    lines.push({
      label: 'source, what if',
      values: pressuresShown(trial.source_pressure_kpa_gauge),
      colour: '--c6',
      dash: [5, 3],
    });
  }
  const at = (value: number | null | undefined, label: string): Guide[] =>
    value ? [{ value: toShown('pressure', value), label }] : [];
  const guides = requirements.actuators.flatMap((group) => [
    ...at(group.operating_pressure_kpa_gauge, `operating ${group.name}`),
    ...at(group.pressure_kpa_gauge_max, `at most ${group.name}`),
  ]);
  return (
    <Lines
      title="Pressures"
      x={base.t_s}
      xLabel="time, s"
      yLabel={`pressure, ${unitOf('pressure')}`}
      lines={lines}
      guides={guides}
      height={300}
      yFromZero
    />
  );
}

// Every requirement in the periodic state, as designed and as tried.
export function Met({
  base,
  trial,
  requirements,
}: {
  base: Evaluation;
  trial: Evaluation;
  requirements: Requirements;
}) {
  const rows = [
    ...(base.margins ?? []).map((margin) => {
      const then = trial.margins?.find((m) => m.requirement === margin.requirement);
      const { requirement, required, achieved } = margin;
      return {
        name: requirementName(requirement, requirements.actuators),
        unit: requirementUnit(requirement),
        asked: `${sense(requirement)} ${requirementNumber(requirement, required)}`,
        was: requirementNumber(requirement, achieved),
        is: then ? requirementNumber(requirement, then.achieved) : '–',
        share: then && achieved !== 0 ? then.achieved / achieved - 1 : null,
        isMissed: then !== undefined && then.relative_margin < -1e-9,
      };
    }),
    ...(
      [
        ['energy', 'Wh', base.totals?.energy_wh, trial.totals?.energy_wh],
        ['mass', 'kg', base.totals?.mass_kg, trial.totals?.mass_kg],
      ] as const
    )
      .filter(([name]) => !base.margins?.some((m) => m.requirement === `/supply/${name}_kg_max`))
      .map(([name, unit, was, is]) => ({
        name,
        unit,
        asked: '',
        was: significant(was, 4),
        is: significant(is, 4),
        share: is === undefined || !was ? null : is / was - 1,
        isMissed: false,
      })),
  ];
  const [low, high] = trial.source_pressure_range_kpa_gauge ?? [];
  return (
    <div class="met">
      {!trial.works && (
        <Notice kind="warn">
          {trial.works === null
            ? `It is not known whether it works: ${pressuresInUnit(trial.detail ?? '')}.`
            : low === undefined
              ? 'A part is no longer in the catalogue.'
              : `It does not work: a stroke takes longer than half of the period, or the source is outside ${shown('pressure', low)} to ${shown('pressure', high)} ${unitOf('pressure')}.`}
        </Notice>
      )}
      <Table
        label="Requirements with the change"
        class="times"
        boxClass="met"
        heads={[
          'in the periodic state',
          number('asked'),
          number('as designed'),
          number('what if'),
          number('change'),
        ]}
      >
        {rows.map((row) => (
          <tr key={row.name}>
            <th scope="row">
              {row.name} <small class="muted">{row.unit}</small>
            </th>
            <td class="num muted">{row.asked}</td>
            <td class="num">{row.was}</td>
            <td class="num">
              <span class={row.isMissed ? 'over' : ''}>
                {row.is} {row.isMissed && 'missed'}
              </span>
            </td>
            <td class="num muted">{row.share !== null && changeOf(row.share)}</td>
          </tr>
        ))}
      </Table>
    </div>
  );
}
