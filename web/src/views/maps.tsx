// Where a design sits on the maps of normalised rise and fall times.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem } from '../lib/api';
import { short, significant } from '../lib/format';
import { type GroupMaps, mapsOf, type Place } from '../lib/maps';
import { missingPart, type Parts } from '../lib/rig';
import { route, setQuery } from '../lib/route';
import type { Design, Requirements } from '../lib/types';
import { ContourMap } from '../plots/contour';
import { toShown, unitOf } from '../lib/units';
import { Notice, Segmented } from '../ui/controls';

const levels = [0.2, 0.5, 1, 2, 5, 10];

const here = (place: Place, without = ''): string =>
  place.normalised === null
    ? 'Never reached by this design'
    : `This design: ${significant(place.normalised)}${place.seconds === null ? '' : `, which is ${significant(place.seconds)} s${without}`}`;

export function Maps({
  design,
  requirements,
  parts,
}: {
  design: Design;
  requirements: Requirements;
  parts: Parts | null;
}) {
  const last = requirements.actuators.length - 1;
  const index = Math.min(last, Math.max(0, Number(route.value.query.get('group')) || 0));
  const maps = useSignal<GroupMaps | null>(null);
  const problem = useSignal('');
  const group = requirements.actuators[index]!;
  useEffect(() => {
    if (!parts || missingPart(design, parts)) return;
    mapsOf(design, requirements, parts, group).then(
      (found) => {
        maps.value = found;
        problem.value = '';
      },
      (error) => (problem.value = asProblem(error).message),
    );
  }, [design, parts, group]);
  const now = maps.value;
  const toFraction = requirements.rise?.to_fraction ?? 0.95;
  return (
    <>
      {requirements.actuators.length > 1 && (
        <div class="across">
          <Segmented
            label="group"
            value={String(index)}
            onChange={(v) => setQuery({ group: v === '0' ? undefined : v })}
            options={requirements.actuators.map((g, i) => ({ value: String(i), label: g.name }))}
          />
        </div>
      )}
      <div class="panel">
        {problem.value && <Notice kind="bad">{problem.value}</Notice>}
        {now && (
          <ContourMap
            title="Rise time × C·P₀/V₀"
            subtitle="source of constant pressure"
            data={now.rise.data}
            levels={levels}
            xLabel="source pressure / ambient"
            yLabel="operating pressure / ambient"
            border={(source) => 1 + (source - 1) / toFraction}
            at={now.rise.at}
            note={`${here(now.rise, design.configuration === 'compressor' ? '' : ' without the regulator')}. C ${significant(now.conductance)} dm³/(s·bar) and b ${significant(now.critical)} of the line, V₀ volume at rest, P₀ ${short(toShown('absolute', 100), 3)} ${unitOf('absolute')}, expansion ${significant(now.expansion)}.`}
          />
        )}
      </div>
      {now?.pump && (
        <div class="panel">
          <ContourMap
            title="Rise time × C·P₀/V₀"
            subtitle="pump and reservoir"
            data={now.pump.data}
            levels={levels}
            hasNever
            xLabel="reservoir / V₀"
            yLabel="pump flow / (C·P₀)"
            at={now.pump.at}
            note={`${here(now.pump)}. ${group.count} at once from ${significant(now.source)} × ambient; the pump's flow at its stop pressure.`}
          />
        </div>
      )}
      <div class="panel">
        {now && (
          <ContourMap
            title="Fall time × C·P₀/V₀"
            subtitle="to ambient"
            data={now.fall.data}
            levels={levels}
            xLabel="operating pressure / ambient"
            yLabel="expansion ratio"
            at={now.fall.at}
            note={`${here(now.fall)}. b ${significant(now.criticalOut)} of the way out.`}
          />
        )}
      </div>
    </>
  );
}
