// The response over cycles, and the same with other source pressure, tubes, reservoir.
import { useComputed, useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';

import { asProblem, post, type Problem } from '../lib/api';
import { asDesigned, type Change, evaluate, type Evaluation } from '../lib/evaluation';
import { joined, missingPart, type Parts, simulationsOf } from '../lib/rig';
import { route, setQuery } from '../lib/route';
import type { Design, Effect, Requirements, Response } from '../lib/types';
import { Notice, Panel, Segmented } from '../ui/controls';
import { Met, ResponsePlot, Slider } from './what_if_views';
import { isDirect, areEvacuated } from '../lib/vacuum';

type Cycles = '1' | '3' | '10';

interface Tried {
  response: Response;
  evaluation: Evaluation;
}

// What is tried, in the address: source, reservoir, tube and volume.
const toText = (c: Change): string =>
  [c.source_kpa, c.reservoir_ml ?? '', c.tube, c.rest_volume]
    .map((v) => (v === '' ? '' : Number(Number(v).toPrecision(6))))
    .join(':');

function fromText(start: Change, text: string | null): Change {
  const [source, reservoir, tube, volume] = (text ?? '').split(':').map(Number);
  if (!source || !tube || !volume) return start;
  return {
    ...start,
    source_kpa: source,
    reservoir_ml: start.reservoir_ml === null ? null : reservoir || start.reservoir_ml,
    tube,
    rest_volume: volume,
  };
}

export function WhatIf({
  design,
  requirements,
  parts,
  effects,
}: {
  design: Design;
  requirements: Requirements;
  parts: Parts;
  effects?: Effect[];
}) {
  const start = asDesigned(design);
  const asked = route.peek().query;
  const change = useSignal<Change>(fromText(start, asked.get('try')));
  const cycles = useSignal<Cycles>(
    asked.get('cycles') === '1' ? '1' : asked.get('cycles') === '10' ? '10' : '3',
  );
  const base = useSignal<Tried | null>(null);
  const tried = useSignal<Tried | null>(null);
  const took = useSignal<number | null>(null);
  const problem = useSignal<Problem | null>(null);
  const running = useRef(false);
  const waiting = useRef<Change | null>(null);
  const missing = missingPart(design, parts);
  const isChanged = useComputed(() => JSON.stringify(change.value) !== JSON.stringify(start));
  const run = async (what: Change): Promise<Tried> => {
    const asked = simulationsOf(design, requirements, parts, what, Number(cycles.peek()), effects);
    const [evaluation, ...responses] = await Promise.all([
      evaluate(design, requirements, what),
      ...asked.map((request) => post<Response>('/v1/simulations', request)),
    ]);
    return { response: joined(responses), evaluation };
  };

  useEffect(() => {
    if (missing) return;
    problem.value = null;
    run(start).then(
      (found) => (base.value = found),
      (error) => (problem.value = asProblem(error)),
    );
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

  const [lowest, highest] = base.value?.evaluation.source_pressure_range_kpa_gauge ?? [null, null];
  const trial = isChanged.value ? tried.value : null;
  return (
    <Panel
      title="Response and what if"
      aside={
        <Segmented
          label="cycles"
          options={['1', '3', '10'] as const}
          value={cycles.value}
          onChange={(v) => {
            cycles.value = v;
            setQuery({ cycles: v === '3' ? undefined : v });
          }}
        />
      }
    >
      {missing && <Notice kind="warn">It cannot be simulated: {missing}.</Notice>}
      {problem.value && <Notice kind="bad">{problem.value.sentence}</Notice>}
      <div class="what-if">
        <div>
          {base.value && (
            <ResponsePlot
              base={base.value.response}
              trial={trial?.response ?? null}
              requirements={requirements}
            />
          )}
        </div>
        {/* Not before it is known how far they go: a source the design cannot have says nothing. */}
        <fieldset class="sliders" disabled={base.value === null}>
          {!isDirect(design.configuration) && (
            <Slider
              label="Source pressure"
              kind="pressure"
              value={change.value.source_kpa}
              low={
                areEvacuated(requirements)
                  ? Math.min(highest ?? start.source_kpa, start.source_kpa)
                  : Math.min(lowest ?? start.source_kpa, start.source_kpa)
              }
              high={
                areEvacuated(requirements)
                  ? Math.max(lowest ?? start.source_kpa, start.source_kpa)
                  : Math.min(highest ?? Infinity, Math.max(3 * start.source_kpa, 300))
              }
              onInput={(v) => set({ source_kpa: v })}
            />
          )}
          <Slider
            label={requirements.actuators.length > 1 ? 'Tube length, times' : 'Tube length'}
            unit={requirements.actuators.length > 1 ? '×' : 'm'}
            value={change.value.tube}
            low={0.1}
            high={4}
            scale={requirements.actuators.length > 1 ? 1 : requirements.actuators[0]!.tube_length_m}
            onInput={(v) => set({ tube: v })}
          />
          {start.reservoir_ml !== null && (
            <Slider
              label="Reservoir"
              kind="volume_ml"
              value={change.value.reservoir_ml!}
              low={start.reservoir_ml * 0.1}
              high={start.reservoir_ml * 4}
              onInput={(v) => set({ reservoir_ml: v })}
            />
          )}
          <Slider
            label="Actuator volume"
            unit="×"
            value={change.value.rest_volume}
            low={0.25}
            high={4}
            onInput={(v) => set({ rest_volume: v })}
          />
          <p class="hint" role="status">
            {took.value === null
              ? 'The plot begins with a full source. Move a slider to try.'
              : `Simulated in ${Math.round(took.value)} ms.`}{' '}
            {isChanged.value && (
              <button type="button" class="quiet small" onClick={reset}>
                As designed
              </button>
            )}
          </p>
        </fieldset>
        {base.value && trial && (
          <Met base={base.value.evaluation} trial={trial.evaluation} requirements={requirements} />
        )}
      </div>
    </Panel>
  );
}
