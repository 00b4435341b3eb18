// Where a design sits on the maps of normalised rise and fall times.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { asProblem, post } from '../lib/api';
import { numberOf } from '../lib/catalogue';
import { short, significant } from '../lib/format';
import type { Parts } from '../lib/rig';
import type { Design, Group, Requirements } from '../lib/types';
import { ContourMap, type MapData } from '../plots/contour';
import { Notice, Segmented } from '../ui/controls';

const levels = [0.2, 0.5, 1, 2, 5, 10];

const steps = (from: number, to: number, n: number): number[] =>
  Array.from({ length: n }, (_, i) => from + ((to - from) * i) / (n - 1));

function expansionOf(group: Group): number {
  if (!group.pressure_volume) return group.expansion_ratio ?? 1;
  const table = group.pressure_volume;
  const at = table.findIndex((p) => p.pressure_kpa_gauge >= group.operating_pressure_kpa_gauge);
  return table[Math.max(at, 0)]!.volume_ml / table[0]!.volume_ml;
}

interface Row {
  rise_time_normalised: number | null;
  fall_time_normalised: number | null;
}

async function grid(request: Record<string, unknown>): Promise<Row[]> {
  return (await post<{ rows: Row[] }>('/v1/maps', { schema: 'map/1', ...request })).rows;
}

export function Maps({ design, requirements, parts }: { design: Design; requirements: Requirements; parts: Parts | null }) {
  const index = useSignal(0);
  const rise = useSignal<MapData | null>(null);
  const fall = useSignal<MapData | null>(null);
  const problem = useSignal('');
  const ambient = requirements.ambient?.pressure_kpa_abs ?? 100;
  const group = requirements.actuators[index.value]!;
  const valve = parts?.get(design.parts.find((p) => p.family === 'valve' && p.group === group.name)?.id ?? '');
  const ratio = (kpaGauge: number) => (kpaGauge + ambient) / ambient;
  const source = ratio(design.settings.source_pressure_kpa_gauge);
  const operating = ratio(group.operating_pressure_kpa_gauge);
  const expansion = expansionOf(group);
  const critical = (valve && numberOf(valve, 'critical_ratio_fill')) ?? 0.3;

  useEffect(() => {
    if (!parts) return;
    const fractions = { rise: requirements.rise ?? { to_fraction: 0.95 }, fall: requirements.fall ?? { to_fraction: 0.05 } };
    const sources = steps(1.1, Math.max(2 * source - 1, source + 1, 4), 56);
    const operatings = steps(1.05, Math.max(2 * operating - 1, 3), 44);
    const expansions = steps(1, Math.max(2 * expansion - 1, 3), 32);
    const load = async () => {
      const up = await grid({ ...fractions, source_pressure_ratio: sources, operating_pressure_ratio: operatings, expansion_ratio: [expansion], critical_ratio: [critical] });
      // Rows come with the source outermost; the plot wants them by operating pressure.
      const values = operatings.flatMap((_, j) => sources.map((__, i) => up[i * operatings.length + j]!.rise_time_normalised));
      for (let k = sources.length; k < values.length; ++k) values[k] ??= values[k - sources.length]!; // hidden behind the border
      rise.value = { x: sources, y: operatings, values };
      const down = await grid({ ...fractions, source_pressure_ratio: [1000], operating_pressure_ratio: operatings, expansion_ratio: expansions, critical_ratio: [critical] });
      const fallen = expansions.flatMap((_, j) => operatings.map((__, i) => down[i * expansions.length + j]!.fall_time_normalised));
      fall.value = { x: operatings, y: expansions, values: fallen };
    };
    load().then(() => (problem.value = ''), (error) => (problem.value = asProblem(error).message));
  }, [design, parts, index.value]);

  const pick = requirements.actuators.length > 1 && (
    <Segmented
      label="group" value={String(index.value)} onChange={(v) => (index.value = Number(v))}
      options={requirements.actuators.map((g, i) => ({ value: String(i), label: g.name }))}
    />
  );
  return (
    <>
      <div class="panel">
        {pick}
        {problem.value && <Notice kind="bad">{problem.value}</Notice>}
        {rise.value && (
          <ContourMap
            title="Rise time × C·P₀/V₀" data={rise.value} levels={levels} xLabel="source pressure / ambient" yLabel="operating pressure / ambient"
            border={(ratioOfSource) => 1 + (ratioOfSource - 1) / (requirements.rise?.to_fraction ?? 0.95)}
            at={{ x: source, y: operating, label: `Source ${significant(source)}, operating ${significant(operating)}; expansion ${short(expansion)}, b ${short(critical)} (valve), constant source` }}
          />
        )}
      </div>
      <div class="panel">
        {fall.value && (
          <ContourMap
            title="Fall time × C·P₀/V₀" data={fall.value} levels={levels} xLabel="operating pressure / ambient" yLabel="expansion ratio"
            at={{ x: operating, y: expansion, label: `Operating ${significant(operating)}, expansion ${short(expansion)}; b ${short(critical)} (valve)` }}
          />
        )}
      </div>
    </>
  );
}
