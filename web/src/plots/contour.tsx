// A map of normalised times over two ratios, with the design's place on it.
import { contours } from 'd3-contour';
import { scaleLinear } from 'd3-scale';

import { useId } from 'preact/hooks';

import { short } from '../lib/format';
import { Axes } from './axes';
import { Picture } from './picture';
import { useWidth } from './width';

const height = 270;
const space = { left: 44, right: 12, top: 8, bottom: 36 };

export interface MapData {
  x: number[];
  y: number[];
  values: (number | null)[]; // row by row of y
}

// Stands for a time that is never reached.
const never = 100;

export function ContourMap(props: {
  title: string;
  subtitle: string;
  data: MapData;
  levels: number[];
  xLabel: string;
  yLabel: string;
  at: { x: number; y: number };
  note: string;
  // Above this line the target is never reached.
  border?: (x: number) => number;
  hasNever?: boolean; // some points of the grid are never reached
}) {
  const { ref, width } = useWidth();
  const clip = useId();
  const { x, y, values } = props.data;
  const [x0, x1] = [x[0]!, x[x.length - 1]!];
  const [y0, y1] = [y[0]!, y[y.length - 1]!];
  const sx = scaleLinear([x0, x1], [space.left, Math.max(width, 200) - space.right]);
  const sy = scaleLinear([y0, y1], [height - space.bottom, space.top]);
  // The contour's grid has its samples in the middle of cells.
  const gx = scaleLinear([0.5, x.length - 0.5], sx.range());
  const gy = scaleLinear([0.5, y.length - 0.5], sy.range());
  const shapes = contours()
    .size([x.length, y.length])
    .thresholds([-1, ...props.levels, ...(props.hasNever ? [never / 2] : [])])(
    values.map((v) => v ?? never),
  );
  const shades = props.levels.length + 1;
  const path = (rings: number[][][][]) =>
    rings
      .map((polygon) =>
        polygon
          .map(
            (ring) =>
              `M${ring.map(([a, b]) => `${gx(a!).toFixed(1)} ${gy(b!).toFixed(1)}`).join('L')}Z`,
          )
          .join(''),
      )
      .join('');
  return (
    <figure class="plot contour" aria-label={`${props.title}, ${props.subtitle}: ${props.note}`}>
      <figcaption>
        <strong>{props.title}</strong> <span class="muted">{props.subtitle}</span>
        <span class="legend">
          {[
            `< ${short(props.levels[0]!)}`,
            ...props.levels.map((level, i) =>
              props.levels[i + 1]
                ? `${short(level)}–${short(props.levels[i + 1]!)}`
                : `> ${short(level)}`,
            ),
          ].map((text, i) => (
            <span key={text} class="legend-item">
              <i class="swatch" style={{ '--shade': i / (shades - 1) }} />
              {text}
            </span>
          ))}
          {(props.border || props.hasNever) && (
            <span class="legend-item">
              <i class="swatch never" />
              never
            </span>
          )}
        </span>
      </figcaption>
      <div ref={ref} style={{ height: `${height / 10}rem` }}>
        {width > 0 && (
          <Picture width={width} height={height}>
            <clipPath id={clip}>
              <rect
                x={space.left}
                y={space.top}
                width={width - space.left - space.right}
                height={height - space.top - space.bottom}
              />
            </clipPath>
            <g clip-path={`url("#${clip}")`}>
              {shapes.map((shape, i) => (
                <path
                  key={i}
                  d={path(shape.coordinates)}
                  class={i < shades ? 'level' : 'never'}
                  style={{ '--shade': i / (shades - 1) }}
                />
              ))}
              {props.border && (
                <path
                  class="never"
                  d={`M${x.map((v) => `${sx(v).toFixed(1)} ${sy(props.border!(v)).toFixed(1)}`).join('L')}L${sx(x0)} ${sy(y1) - 999}Z`}
                />
              )}
            </g>
            <Axes
              frame={{ width, height, ...space }}
              x={sx}
              y={sy}
              xLabel={props.xLabel}
              yLabel={props.yLabel}
            />
            <g class="here" transform={`translate(${sx(props.at.x)} ${sy(props.at.y)})`}>
              <circle r="6" />
              <path d="M-11 0 H11 M0 -11 V11" />
            </g>
          </Picture>
        )}
      </div>
      <p class="hint">{props.note}</p>
    </figure>
  );
}
