// The response over cycles, and the same with other source pressure, tubes, reservoir.
import { useComputed, useSignal } from '@preact/signals';
import { useEffect, useId, useRef } from 'preact/hooks';

import { asProblem, post, type Problem } from '../lib/api';
import { change as changeOf, short, significant } from '../lib/format';
import { asDesigned, type Change, missingPart, type Parts, simulationOf, strokesOf } from '../lib/rig';
import { route, setQuery } from '../lib/route';
import { seriesColours } from '../lib/theme';
import type { Design, Requirements, Response } from '../lib/types';
import { type Kind, toShown, unitOf } from '../lib/units';
import { type Line, Lines } from '../plots/lines';
import { Notice, Panel, Segmented } from '../ui/controls';

type Cycles = '1' | '3' | '10';

// What is tried, in the address: source, reservoir, tube and volume.
const toText = (c: Change): string => [c.source_kpa, c.reservoir_ml ?? '', c.tube, c.rest_volume].map((v) => (v === '' ? '' : Number(Number(v).toPrecision(6)))).join(':');

function fromText(start: Change, text: string | null): Change {
  const [source, reservoir, tube, volume] = (text ?? '').split(':').map(Number);
  if (!source || !tube || !volume) return start;
  return { ...start, source_kpa: source, reservoir_ml: start.reservoir_ml === null ? null : reservoir || start.reservoir_ml, tube, rest_volume: volume };
}

export function WhatIf({ design, requirements, parts }: { design: Design; requirements: Requirements; parts: Parts }) {
  const start = asDesigned(design);
  const asked = route.peek().query;
  const change = useSignal<Change>(fromText(start, asked.get('try')));
  const cycles = useSignal<Cycles>(asked.get('cycles') === '1' ? '1' : asked.get('cycles') === '10' ? '10' : '3');
  const base = useSignal<Response | null>(null);
  const tried = useSignal<Response | null>(null);
  const took = useSignal<number | null>(null);
  const problem = useSignal<Problem | null>(null);
  const running = useRef(false);
  const waiting = useRef<Change | null>(null);
  const missing = missingPart(design, parts);
  const isChanged = useComputed(() => JSON.stringify(change.value) !== JSON.stringify(start));
  const run = (what: Change) => post<Response>('/v1/simulations', simulationOf(design, requirements, parts, what, Number(cycles.peek())));

  useEffect(() => {
    if (missing) return;
    problem.value = null;
    run(start).then((response) => (base.value = response), (error) => (problem.value = asProblem(error)));
    if (isChanged.peek()) void attempt(change.peek());
  }, [cycles.value, design, missing]);

  // One request at a time; what was dragged to meanwhile is asked for next.
  const attempt = async (what: Change): Promise<void> => {
    if (running.current) {
      waiting.current = what;
      return;
    }
    running.current = true;
    const began = performance.now();
    try {
      tried.value = await run(what);
      took.value = performance.now() - began;
      problem.value = null;
    } catch (error) {
      problem.value = asProblem(error);
    }
    running.current = false;
    const next = waiting.current;
    waiting.current = null;
    if (next) await attempt(next);
  };
  const set = (patch: Partial<Change>) => {
    change.value = { ...change.value, ...patch };
    setQuery({ try: toText(change.value) });
    void attempt(change.value);
  };
  const reset = () => {
    change.value = start;
    setQuery({ try: undefined });
    tried.value = null;
    took.value = null;
  };

  const lowest = 1.02 * Math.max(...requirements.actuators.map((g) => g.operating_pressure_kpa_gauge));
  const highest = Math.max(requirements.supply?.source_pressure_kpa_gauge_max ?? 0, 1.5 * start.source_kpa);
  const trial = isChanged.value ? tried.value : null;
  return (
    <Panel
      title="Response and what if"
      aside={<Segmented label="cycles" options={['1', '3', '10'] as const} value={cycles.value} onChange={(v) => { cycles.value = v; setQuery({ cycles: v === '3' ? undefined : v }); }} />}
    >
      {missing && <Notice kind="warn">It cannot be simulated: {missing}.</Notice>}
      {problem.value && <Notice kind="bad">{problem.value.message} {problem.value.errors.map((e) => `${e.pointer} ${e.detail}`).join('; ')}</Notice>}
      <div class="what-if">
        <div>{base.value && <ResponsePlot base={base.value} trial={trial} requirements={requirements} />}</div>
        <div class="sliders">
          <Slider label="Source pressure" kind="pressure" value={change.value.source_kpa} low={Math.min(lowest, start.source_kpa)} high={highest} onInput={(v) => set({ source_kpa: v })} />
          <Slider
            label={requirements.actuators.length > 1 ? 'Tube length, times' : 'Tube length'} unit={requirements.actuators.length > 1 ? '×' : 'm'}
            value={change.value.tube} low={0.1} high={4} scale={requirements.actuators.length > 1 ? 1 : requirements.actuators[0]!.tube_length_m}
            onInput={(v) => set({ tube: v })}
          />
          {start.reservoir_ml !== null && (
            <Slider label="Reservoir" kind="volume_ml" value={change.value.reservoir_ml!} low={start.reservoir_ml * 0.1} high={start.reservoir_ml * 4} onInput={(v) => set({ reservoir_ml: v })} />
          )}
          <Slider label="Actuator volume" unit="×" value={change.value.rest_volume} low={0.25} high={4} onInput={(v) => set({ rest_volume: v })} />
          <Times base={base.value} trial={trial} requirements={requirements} cycles={Number(cycles.value)} />
          <p class="hint" role="status">
            {took.value === null ? 'From the full source on. Move a slider to try.' : `Simulated in ${Math.round(took.value)} ms.`}{' '}
            {isChanged.value && <button type="button" class="quiet small" onClick={reset}>As designed</button>}
          </p>
        </div>
      </div>
    </Panel>
  );
}

function Slider(props: {
  label: string; value: number; low: number; high: number; kind?: Kind; unit?: string; scale?: number; onInput: (value: number) => void;
}) {
  const id = useId();
  const kind = props.kind ?? 'plain';
  const text = `${significant(toShown(kind, props.value * (props.scale ?? 1)))} ${unitOf(kind, props.unit)}`;
  return (
    <div class="slider">
      <label for={id}>{props.label}</label>
      <output for={id}>{text}</output>
      <input
        id={id} type="range" min={props.low} max={props.high} step={(props.high - props.low) / 200} value={props.value} aria-valuetext={text}
        onInput={(event) => props.onInput(Number(event.currentTarget.value))}
      />
    </div>
  );
}

function ResponsePlot({ base, trial, requirements }: { base: Response; trial: Response | null; requirements: Requirements }) {
  const show = (values: (number | null)[]) => values.map((v) => (v === null ? null : toShown('pressure', v)));
  const lines: Line[] = [];
  base.groups.forEach((group, i) => lines.push({ label: group.name, values: show(group.pressure_kpa_gauge), colour: seriesColours[i % 5]! }));
  lines.push({ label: 'source', values: show(base.source_pressure_kpa_gauge), colour: '--c6' });
  if (trial && trial.t_s.length === base.t_s.length) {
    trial.groups.forEach((group, i) =>
      lines.push({ label: `${group.name}, what if`, values: show(group.pressure_kpa_gauge), colour: seriesColours[i % 5]!, dash: [5, 3] }));
    lines.push({ label: 'source, what if', values: show(trial.source_pressure_kpa_gauge), colour: '--c6', dash: [5, 3] });
  }
  const guides = requirements.actuators.map((group) => ({
    value: toShown('pressure', group.operating_pressure_kpa_gauge), label: `operating ${group.name}`,
  }));
  return (
    <Lines
      title="Pressures" x={base.t_s} xLabel="time, s" yLabel={`pressure, ${unitOf('pressure')}`} lines={lines} guides={guides} height={300} yFromZero
    />
  );
}

function Times({ base, trial, requirements, cycles }: { base: Response | null; trial: Response | null; requirements: Requirements; cycles: number }) {
  if (!base) return null;
  const was = strokesOf(base, requirements, cycles);
  const now = trial && strokesOf(trial, requirements, cycles);
  const cell = (before: number | null, after: number | null | undefined, limit?: number | null) => (
    <td class="num">
      <span class={limit && ((after === undefined ? before : after) ?? Infinity) > limit * 1.0005 ? 'over' : ''}>{significant(after === undefined ? before : after)}</span>
      {after !== undefined && before !== null && after !== null && <small class="muted"> {changeOf(after / before - 1)}</small>}
    </td>
  );
  return (
    <table class="times">
      <thead>
        <tr><th scope="col">slowest stroke</th><th scope="col" class="num">rise <small>s</small></th><th scope="col" class="num">fall <small>s</small></th></tr>
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
          <td class="num">{requirements.actuators.map((g) => (g.rise_time_s_max ? `≤ ${short(g.rise_time_s_max)}` : '–')).join(', ')}</td>
          <td class="num">{requirements.actuators.map((g) => (g.fall_time_s_max ? `≤ ${short(g.fall_time_s_max)}` : '–')).join(', ')}</td>
        </tr>
      </tbody>
    </table>
  );
}
