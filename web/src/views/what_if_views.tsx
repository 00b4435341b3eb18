// What the trial of a design shows: its sliders, curves and times.
import { useId } from 'preact/hooks';

import { change as changeOf, short, significant } from '../lib/format';
import { strokesOf } from '../lib/rig';
import { seriesColours } from '../lib/theme';
import type { Requirements, Response } from '../lib/types';
import { type Kind, toShown, unitOf } from '../lib/units';
import { type Line, Lines } from '../plots/lines';

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
  const show = (values: (number | null)[]) =>
    values.map((v) => (v === null ? null : toShown('pressure', v)));
  const lines: Line[] = [];
  base.groups.forEach((group, i) =>
    lines.push({
      label: group.name,
      values: show(group.pressure_kpa_gauge),
      colour: seriesColours[i % 5]!,
    }),
  );
  lines.push({ label: 'source', values: show(base.source_pressure_kpa_gauge), colour: '--c6' });
  if (trial && trial.t_s.length === base.t_s.length) {
    trial.groups.forEach((group, i) =>
      lines.push({
        label: `${group.name}, what if`,
        values: show(group.pressure_kpa_gauge),
        colour: seriesColours[i % 5]!,
        dash: [5, 3],
      }),
    );
    lines.push({
      label: 'source, what if',
      values: show(trial.source_pressure_kpa_gauge),
      colour: '--c6',
      dash: [5, 3],
    });
  }
  const guides = requirements.actuators.map((group) => ({
    value: toShown('pressure', group.operating_pressure_kpa_gauge),
    label: `operating ${group.name}`,
  }));
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

export function Times({
  base,
  trial,
  requirements,
  cycles,
}: {
  base: Response | null;
  trial: Response | null;
  requirements: Requirements;
  cycles: number;
}) {
  if (!base) return null;
  const was = strokesOf(base, requirements, cycles);
  const now = trial && strokesOf(trial, requirements, cycles);
  const cell = (before: number | null, after: number | null | undefined, limit?: number | null) => (
    <td class="num">
      <span
        class={
          limit && ((after === undefined ? before : after) ?? Infinity) > limit * 1.0005
            ? 'over'
            : ''
        }
      >
        {significant(after === undefined ? before : after)}
      </span>
      {after !== undefined && before !== null && after !== null && (
        <small class="muted"> {changeOf(after / before - 1)}</small>
      )}
    </td>
  );
  return (
    <table class="times">
      <thead>
        <tr>
          <th scope="col">slowest stroke</th>
          <th scope="col" class="num">
            rise <small>s</small>
          </th>
          <th scope="col" class="num">
            fall <small>s</small>
          </th>
        </tr>
      </thead>
      <tbody>
        {requirements.actuators.map((group, i) => (
          <tr key={group.name}>
            <th scope="row">{group.name}</th>
            {cell(was[i]!.rise_s, now?.[i]!.rise_s, group.rise_time_s_max)}
            {cell(was[i]!.fall_s, now?.[i]!.fall_s, group.fall_time_s_max)}
          </tr>
        ))}
        <tr class="muted">
          <td>asked</td>
          <td class="num">
            {requirements.actuators
              .map((g) => (g.rise_time_s_max ? `≤ ${short(g.rise_time_s_max)}` : '–'))
              .join(', ')}
          </td>
          <td class="num">
            {requirements.actuators
              .map((g) => (g.fall_time_s_max ? `≤ ${short(g.fall_time_s_max)}` : '–'))
              .join(', ')}
          </td>
        </tr>
      </tbody>
    </table>
  );
}
