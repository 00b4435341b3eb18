// What a tenth more of each number does to the full strokes.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, post } from '../lib/api';
import { change as changeOf } from '../lib/format';
import { asDesigned, type Change, missingPart, type Parts, simulationOf, strokesOf, type StrokeTimes } from '../lib/rig';
import type { Design, Requirements, Response } from '../lib/types';
import { Notice, Panel } from '../ui/controls';

const step = 0.1;
const cycles = 2;

interface Row {
  label: string;
  rise: number | null;
  fall: number | null;
}

const worst = (strokes: StrokeTimes[], name: keyof StrokeTimes): number | null => {
  const values = strokes.map((stroke) => stroke[name]);
  return values.some((v) => v === null) ? null : Math.max(...(values as number[]));
};

export function Sensitivities({ design, requirements, parts }: { design: Design; requirements: Requirements; parts: Parts }) {
  const rows = useSignal<Row[] | null>(null);
  const problem = useSignal('');
  useEffect(() => {
    if (missingPart(design, parts)) return;
    const start = asDesigned(design);
    const more: [string, Partial<Change>][] = [
      ['source pressure', { source_kpa: start.source_kpa * (1 + step) }],
      ['tube length', { tube: 1 + step }],
      ['actuator volume', { rest_volume: 1 + step }],
      ['operating pressure', { operating: 1 + step }],
    ];
    if (start.reservoir_ml !== null) more.splice(1, 0, ['reservoir', { reservoir_ml: start.reservoir_ml * (1 + step) }]);
    const run = async (change: Change) => {
      // The target moves with a changed operating pressure.
      const asked = { ...requirements, actuators: requirements.actuators.map((g) => ({ ...g, operating_pressure_kpa_gauge: g.operating_pressure_kpa_gauge * change.operating })) };
      return strokesOf(await post<Response>('/v1/simulations', simulationOf(design, requirements, parts, change, cycles, 6000)), asked, cycles);
    };
    const load = async () => {
      const base = await run(start);
      const share = (now: number | null, was: number | null) => (now === null || was === null ? null : now / was - 1);
      const found: Row[] = [];
      for (const [label, patch] of more) {
        const response = await run({ ...start, ...patch });
        found.push({
          label,
          rise: share(worst(response, 'rise_s'), worst(base, 'rise_s')),
          fall: share(worst(response, 'fall_s'), worst(base, 'fall_s')),
        });
      }
      rows.value = found;
    };
    load().catch((error) => (problem.value = asProblem(error).message));
  }, [design, parts]);
  const most = Math.max(0.01, ...(rows.value ?? []).flatMap((r) => [Math.abs(r.rise ?? 0), Math.abs(r.fall ?? 0)]));
  return (
    <Panel title="Sensitivities" aside={<span class="muted">for 10 % more</span>}>
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {rows.value && (
        <table class="tornado">
          <thead>
            <tr><th scope="col">of</th><th scope="col">rise time</th><th scope="col">fall time</th></tr>
          </thead>
          <tbody>
            {rows.value.map((row) => (
              <tr key={row.label}>
                <th scope="row">{row.label}</th>
                <td><Swing share={row.rise} most={most} /></td>
                <td><Swing share={row.fall} most={most} /></td>
              </tr>
            ))}
          </tbody>
        </table>
      )}
      <p class="hint">The slowest stroke of two cycles from the full source, simulated again with each number 10 % greater.</p>
    </Panel>
  );
}

function Swing({ share, most }: { share: number | null; most: number }) {
  if (share === null) return <span>never reached</span>;
  const size = (Math.abs(share) / most) * 50;
  return (
    <span class="swing">
      <span class="swing-track">
        <i class={share > 0 ? 'slower' : 'faster'} style={{ width: `${size}%`, left: share > 0 ? '50%' : `${50 - size}%` }} />
      </span>
      <span class="num">{changeOf(share)}</span>
    </span>
  );
}
