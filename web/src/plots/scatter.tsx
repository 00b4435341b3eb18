// Two amounts of all designs: the Pareto front as a line, dominated designs grey.
import { scaleLinear } from 'd3-scale';
import { useMemo } from 'preact/hooks';

import { axes, type Axis, axisUnit, paretoFront, supplyWord } from '../lib/amounts';
import { shown } from '../lib/format';
import type { Design } from '../lib/types';
import { toShown } from '../lib/units';
import { Select } from '../ui/controls';
import { Axes, roomAtLeft } from './axes';
import { Picture } from './picture';
import { useWidth } from './width';

const height = 260;
const space = { left: 52, right: 26, top: 10, bottom: 36 };

interface Point {
  design: Design;
  x: number;
  y: number;
  tip: string;
}

const options = (list: Axis[]) => list.map((axis) => ({ value: axis.id, label: axis.label }));

export function Scatter(props: {
  designs: Design[];
  inBrush: (design: Design) => boolean;
  x: Axis;
  y: Axis;
  baseline: number;
  onAxes: (x: string, y: string) => void;
  onOpen: (rank: number) => void;
}) {
  const { ref, width } = useWidth();
  const { x, y } = props;
  const units = `${axisUnit(x)} ${axisUnit(y)}`;
  const { points, front } = useMemo(() => {
    const found: Point[] = [];
    for (const design of props.designs) {
      const [px, py] = [x.of(design), y.of(design)];
      if (px === null || py === null) continue;
      const tip = `#${design.rank} ${supplyWord(design)}: ${x.label} ${shown(x.kind, px, 4)} ${axisUnit(x)}, ${y.label} ${shown(y.kind, py, 4)} ${axisUnit(y)}`;
      found.push({ design, x: px, y: py, tip });
    }
    return { points: found, front: paretoFront(found, x, y) };
  }, [props.designs, x, y, units]);
  const extent = (values: number[]): [number, number] => {
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const pad = (high - low) * 0.06 || Math.abs(high) * 0.05 || 1;
    return [low - pad, high + pad];
  };
  const sy = scaleLinear(extent(points.map((p) => toShown(y.kind, p.y))), [
    height - space.bottom,
    space.top,
  ]);
  const left = roomAtLeft(sy, space.left);
  const sx = scaleLinear(extent(points.map((p) => toShown(x.kind, p.x))), [
    left,
    width - space.right,
  ]);
  const px = (value: number) => sx(toShown(x.kind, value));
  const py = (value: number) => sy(toShown(y.kind, value));
  const line = points
    .filter((_, i) => front[i])
    .sort((a, b) => a.x - b.x || (y.better === 'low' ? b.y - a.y : a.y - b.y))
    .map((p, i) => `${i ? 'L' : 'M'}${px(p.x)} ${py(p.y)}`)
    .join('');
  const usable = axes.filter((axis) => props.designs.some((design) => axis.of(design) !== null));
  return (
    <figure class="plot scatter" aria-label={`Designs by ${x.label} and ${y.label}`}>
      <figcaption>
        <strong>Designs by</strong>
        <Select
          label="Across"
          hideLabel
          value={x.id}
          options={options(usable)}
          onChange={(id) => props.onAxes(id, y.id)}
        />
        <span>and</span>
        <Select
          label="Upwards"
          hideLabel
          value={y.id}
          options={options(usable)}
          onChange={(id) => props.onAxes(x.id, id)}
        />
        <span class="legend">
          <span class="legend-item">
            <i class="dot front" />
            not dominated
          </span>
          <span class="legend-item">
            <i class="dot" />
            dominated
          </span>
        </span>
      </figcaption>
      <div ref={ref} style={{ height: `${height / 10}rem` }}>
        {width > 0 && points.length > 0 && (
          <Picture width={width} height={height}>
            <Axes
              hasGrid
              frame={{ width, height, ...space, left }}
              x={sx}
              y={sy}
              xLabel={[x.label, axisUnit(x)].filter(Boolean).join(', ')}
              yLabel={[y.label, axisUnit(y)].filter(Boolean).join(', ')}
            />
            <path class="front-line" d={line} />
            {points.map((p, i) => (
              <circle
                key={p.design.rank}
                cx={px(p.x)}
                cy={py(p.y)}
                r={p.design.rank === props.baseline ? 6 : 4}
                class={`point ${front[i] ? 'front' : ''} ${props.inBrush(p.design) ? '' : 'out'} ${p.design.rank === props.baseline ? 'baseline' : ''}`}
                data-tip={p.tip}
                onClick={() => props.onOpen(p.design.rank)}
              />
            ))}
          </Picture>
        )}
      </div>
    </figure>
  );
}
