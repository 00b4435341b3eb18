// The slowest rise and fall of each group, large: the pressure that counts, the limits, the times.
import { short, significant } from '../lib/format';
import { type Stroke, strokesOf } from '../lib/strokes';
import type { Design, Requirements } from '../lib/types';
import { pressuresShown, toShown, unitOf } from '../lib/units';
import { type Guide, Lines } from '../plots/lines';
import { Panel } from '../ui/controls';

export function Strokes(props: { design: Design; requirements: Requirements }) {
  const strokes = strokesOf(props.design, props.requirements);
  if (strokes.length === 0) return null;
  return (
    <Panel title="Slowest strokes" aside={<span class="muted">in the periodic state</span>}>
      <div class="plots even">
        {strokes.map((stroke) => (
          <StrokePlot key={`${stroke.name}${stroke.isRise}`} stroke={stroke} />
        ))}
      </div>
    </Panel>
  );
}

function StrokePlot({ stroke }: { stroke: Stroke }) {
  const { group, isRise } = stroke;
  const share = stroke.target_share;
  const way = !isRise && group.low_pressure_kpa_gauge ? 'the way' : 'operating pressure';
  const at = (value: number, label: string): Guide => ({
    value: toShown('pressure', value),
    label,
  });
  const highest = group.pressure_kpa_gauge_max;
  return (
    <Lines
      title={`${isRise ? 'Rise' : 'Fall'} of ${stroke.name}`}
      x={stroke.t_s}
      xLabel="time since the command, s"
      yLabel={`pressure, ${unitOf('pressure')}`}
      height={240}
      yFromZero
      guidesAtLeft={isRise}
      marksAtTop={!isRise}
      lines={[
        {
          label: stroke.name,
          values: pressuresShown(stroke.pressure_kpa_gauge),
          colour: '--c1',
          width: 2,
        },
        ...(isRise
          ? [{ label: 'source', values: pressuresShown(stroke.source_kpa_gauge), colour: '--c6' }]
          : []),
      ]}
      guides={[
        at(stroke.target_kpa_gauge, `${short(100 * share)} % of ${way}`),
        ...(isRise && highest ? [at(highest, 'pressure, at most')] : []),
        ...(stroke.peak_kpa_gauge === null ? [] : [at(stroke.peak_kpa_gauge, 'peak, valve late')]),
      ]}
      marks={[
        { value: stroke.achieved_s, label: `${significant(stroke.achieved_s)} s` },
        ...(stroke.limit_s === null
          ? []
          : [
              {
                value: stroke.limit_s,
                label: `limit ${short(stroke.limit_s)} s`,
                isLimit: true,
              },
            ]),
      ]}
    />
  );
}
