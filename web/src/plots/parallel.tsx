// All designs as lines over parallel axes. A range brushed on an axis filters the whole view.
import { scaleLinear } from 'd3-scale';
import { useEffect, useRef } from 'preact/hooks';

import { type Axis, axisUnit } from '../lib/amounts';
import { digitsApart, isSame, short, significant } from '../lib/format';
import { pageScale } from '../lib/page_scale';
import { colour, palette } from '../lib/theme';
import type { Design } from '../lib/types';
import { toShown } from '../lib/units';
import { Scroll } from '../ui/scroll';
import { Picture } from './picture';
import { useWidth } from './width';

export type Brushes = Record<string, [number, number]>;

const height = 268;
const top = 42;
const bottom = 18;
const inset = 34;
const nameWidth = (axis: Axis): number => (6.6 * axis.label.length) / 2; // a half

export function Parallel(props: {
  designs: Design[];
  axes: Axis[];
  brushes: Brushes;
  inBrush: (design: Design) => boolean;
  baseline: number;
  onBrush: (axis: string, range: [number, number] | null) => void;
}) {
  const { ref, width } = useWidth();
  const canvas = useRef<HTMLCanvasElement>(null);
  const paint = palette.value;
  const shown = props.axes.map((axis) => {
    const values = props.designs.map((d) => axis.of(d)).filter((v): v is number => v !== null);
    const [low, high] = [Math.min(...values), Math.max(...values)];
    const single = isSame(low, high);
    const pad = !single ? 0 : Math.abs(high) * 0.05 || 1;
    return { axis, single, scale: scaleLinear([low - pad, high + pad], [height - bottom, top]) };
  });
  // The names of neighbours do not meet.
  const room = Math.max(
    68,
    ...shown.slice(1).map(({ axis }, i) => nameWidth(axis) + nameWidth(shown[i]!.axis) + 8),
  );
  const xOf = (i: number) => inset + (i * (width - 2 * inset)) / Math.max(1, shown.length - 1);

  useEffect(() => {
    const element = canvas.current;
    const ctx = element?.getContext('2d');
    if (!element || !ctx || width === 0) return;
    const ratio = devicePixelRatio * pageScale.value;
    element.width = width * ratio;
    element.height = height * ratio;
    ctx.scale(ratio, ratio);
    ctx.clearRect(0, 0, width, height);
    const trace = (design: Design) => {
      let pen = false;
      shown.forEach(({ axis, scale }, i) => {
        const value = axis.of(design);
        if (value === null) {
          pen = false;
          return;
        }
        if (pen) ctx.lineTo(xOf(i), scale(value));
        else ctx.moveTo(xOf(i), scale(value));
        pen = true;
      });
    };
    // One stroke for all lines of a colour: many short ones cost frames.
    const draw = (designs: Design[], ink: string, thickness: number, alpha: number) => {
      ctx.strokeStyle = colour(ink);
      ctx.lineWidth = thickness;
      ctx.globalAlpha = alpha;
      ctx.beginPath();
      designs.forEach(trace);
      ctx.stroke();
    };
    const inside = props.designs.map(props.inBrush);
    draw(
      props.designs.filter((_, i) => !inside[i]),
      '--faint-line',
      1,
      1,
    );
    draw(
      props.designs.filter((_, i) => inside[i]),
      '--c1',
      1,
      props.designs.length > 100 ? 0.5 : 0.8,
    );
    draw(
      props.designs.filter((design) => design.rank === props.baseline),
      '--c2',
      2.2,
      1,
    );
  });
  void paint;

  return (
    <figure
      class="plot parallel"
      aria-label="Designs over parallel axes; drag along an axis to filter"
    >
      <figcaption>
        <strong>All amounts</strong>
        <span class="legend">
          <span class="legend-item">
            <i class="dash c1" />
            designs
          </span>
          <span class="legend-item">
            <i class="dash c2" />
            baseline
          </span>
          <span class="legend-item">drag along an axis to filter</span>
        </span>
      </figcaption>
      <Scroll label="Axes">
        <div
          ref={ref}
          class="parallel-box"
          style={{
            height: `${height / 10}rem`,
            minWidth: `${(2 * inset + (shown.length - 1) * room) / 10}rem`,
          }}
        >
          {width > 0 && (
            <>
              <canvas
                ref={canvas}
                style={{ width: `${width / 10}rem`, height: `${height / 10}rem` }}
                aria-hidden="true"
              />
              <Picture width={width} height={height}>
                {shown.map(({ axis, scale, single }, i) => (
                  <BrushAxis
                    key={axis.id}
                    axis={axis}
                    x={xOf(i)}
                    scale={scale}
                    range={props.brushes[axis.id]}
                    single={single}
                    onBrush={(range) => props.onBrush(axis.id, range)}
                  />
                ))}
              </Picture>
            </>
          )}
        </div>
      </Scroll>
    </figure>
  );
}

function BrushAxis(props: {
  axis: Axis;
  x: number;
  scale: ReturnType<typeof scaleLinear<number, number>>;
  range?: [number, number];
  single: boolean; // one value only
  onBrush: (range: [number, number] | null) => void;
}) {
  const { axis, x, scale } = props;
  const from = useRef<number | null>(null);
  const [low, high] = scale.domain() as [number, number];
  const pointer = (event: PointerEvent) => {
    const box = (event.currentTarget as Element).ownerDocument
      .querySelector('.parallel-box')!
      .getBoundingClientRect();
    const y = Math.min(Math.max((event.clientY - box.top) / pageScale.value, top), height - bottom);
    return scale.invert(y);
  };
  const frame = useRef(0);
  const move = (event: PointerEvent) => {
    if (from.current === null) return;
    const [start, to] = [from.current, pointer(event)];
    cancelAnimationFrame(frame.current);
    frame.current = requestAnimationFrame(() =>
      props.onBrush([Math.min(start, to), Math.max(start, to)]),
    );
  };
  const nudge = (event: KeyboardEvent) => {
    const step = (high - low) / 20;
    const [a, b] = props.range ?? [low, high];
    const by: Record<string, [number, number]> = {
      ArrowDown: [a, Math.max(a, b - step)],
      ArrowUp: [a, Math.min(high, b + step)],
      ArrowRight: [Math.min(b, a + step), b],
      ArrowLeft: [Math.max(low, a - step), b],
    };
    const next = by[event.key];
    if (event.key === 'Escape' || event.key === 'Delete') props.onBrush(null);
    else if (next) props.onBrush(next[0] <= low && next[1] >= high ? null : next);
    else return;
    event.preventDefault();
  };
  const digits = Math.max(3, digitsApart(toShown(axis.kind, low), toShown(axis.kind, high)) - 1);
  const text = (value: number) => significant(toShown(axis.kind, value), digits);
  const range = props.range;
  return (
    <g
      class="brush-axis"
      tabindex={0}
      role="slider"
      aria-orientation="vertical"
      aria-label={`Filter by ${axis.label}: arrows up and down move the upper end, left and right the lower, Escape clears`}
      aria-valuemin={low}
      aria-valuemax={high}
      aria-valuenow={range?.[1] ?? high}
      aria-valuetext={range ? `${text(range[0])} to ${text(range[1])} ${axisUnit(axis)}` : 'all'}
      onKeyDown={nudge}
    >
      <line x1={x} x2={x} y1={top} y2={height - bottom} />
      {range && (
        <rect
          class="brush"
          x={x - 6}
          width={12}
          y={scale(range[1])}
          height={Math.max(2, scale(range[0]) - scale(range[1]))}
        />
      )}
      <rect
        class="grab"
        x={x - 14}
        width={28}
        y={top}
        height={height - top - bottom}
        onPointerDown={(event) => {
          (event.currentTarget as Element).setPointerCapture(event.pointerId);
          from.current = pointer(event);
        }}
        onPointerMove={move}
        onPointerUp={(event) => {
          const end = pointer(event);
          if (from.current !== null && Math.abs(scale(end) - scale(from.current)) < 4) {
            cancelAnimationFrame(frame.current);
            props.onBrush(null);
          }
          from.current = null;
        }}
      />
      <text x={x} y={10} class="name">
        {axis.label}
      </text>
      <text x={x} y={22} class="unit">
        {axisUnit(axis)}
      </text>
      <text x={x} y={props.single ? (top + height - bottom) / 2 - 5 : top - 5} class="end">
        {props.single ? short(toShown(axis.kind, (low + high) / 2), 4) : text(high)}
      </text>
      {!props.single && (
        <text x={x} y={height - 5} class="end">
          {text(low)}
        </text>
      )}
    </g>
  );
}
