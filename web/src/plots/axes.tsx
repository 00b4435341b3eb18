// Ticks and names of the two axes of a plot drawn as SVG.
import type { ScaleLinear } from 'd3-scale';

import { short } from '../lib/format';

const yTicks = 5;

// What the labels of the ticks and the title take at the left, at least `least`.
export const roomAtLeft = (y: ScaleLinear<number, number>, least: number): number =>
  Math.max(least, 25 + 6.2 * Math.max(...y.ticks(yTicks).map((tick) => short(tick, 7).length)));

export interface Frame {
  width: number;
  height: number;
  left: number;
  right: number;
  top: number;
  bottom: number;
}

export function Axes(props: {
  frame: Frame;
  x: ScaleLinear<number, number>;
  y: ScaleLinear<number, number>;
  xLabel: string;
  yLabel: string;
  hasGrid?: boolean;
}) {
  const { x, y, hasGrid } = props;
  const { width, height, left, right, top, bottom } = props.frame;
  const floor = height - bottom;
  const mark = hasGrid ? 'grid' : 'mark';
  return (
    <>
      {x.ticks(Math.max(3, width / 90)).map((tick) => (
        <g key={tick}>
          <line class={mark} x1={x(tick)} x2={x(tick)} y1={hasGrid ? top : floor + 4} y2={floor} />
          <text x={x(tick)} y={floor + 15} text-anchor="middle">
            {short(tick, 7)}
          </text>
        </g>
      ))}
      {y.ticks(yTicks).map((tick) => (
        <g key={tick}>
          <line
            class={mark}
            x1={hasGrid ? width - right : left - 4}
            x2={left}
            y1={y(tick)}
            y2={y(tick)}
          />
          <text x={left - 7} y={y(tick) + 3.5} text-anchor="end">
            {short(tick, 7)}
          </text>
        </g>
      ))}
      <text class="axis" x={(left + width - right) / 2} y={height - 4} text-anchor="middle">
        {props.xLabel}
      </text>
      <text
        class="axis"
        transform={`translate(11 ${(top + floor) / 2}) rotate(-90)`}
        text-anchor="middle"
      >
        {props.yLabel}
      </text>
    </>
  );
}
