// Lines over a common axis with uPlot: title, units, legend with the values under the cursor.
import 'uplot/dist/uPlot.min.css';

import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import uPlot from 'uplot';

import { short, significant } from '../lib/format';
import { pageScale } from '../lib/page_scale';
import { colour, palette } from '../lib/theme';

export interface Line {
  label: string;
  values: (number | null)[];
  colour: string; // custom property
  dash?: number[];
  width?: number;
  points?: boolean;
}

export interface Guide {
  value: number;
  label: string;
}

// A moment, with a line from top to bottom.
export interface Mark {
  value: number;
  label: string;
  isLimit?: boolean;
}

export interface Band {
  from: number;
  to: number;
  colour: string;
}

const fontOf = (size: number): string =>
  `${size}px -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif`;

// Where the labels of lines stand, by their heights, so that none covers another: a line by itself
// has its label above, or below where a curve rises to it; of lines that are near each other the
// lowest has it below, and those of the others stand one above the other over the highest.
function labelPlaces(heights: number[], isLeft: boolean, top: number, room: number) {
  const places = heights.map((y) => ({ y, isBelow: isLeft || y - top < room }));
  const order = heights.map((_, i) => i).sort((i, j) => heights[i]! - heights[j]!);
  for (let first = 0; first < order.length;) {
    let last = first;
    while (last + 1 < order.length && heights[order[last + 1]!]! - heights[order[last]!]! < room)
      ++last;
    const highest = heights[order[first]!]!;
    for (let i = first; i < last; ++i)
      places[order[i]!] = { y: highest - (last - 1 - i) * 0.8 * room, isBelow: false };
    if (last > first) places[order[last]!]!.isBelow = true;
    first = last + 1;
  }
  return places;
}

function drawGuides(plot: uPlot, guides: Guide[], ink: string, isLeft: boolean) {
  const { ctx, bbox } = plot;
  ctx.save();
  ctx.strokeStyle = ink;
  ctx.fillStyle = ink;
  ctx.font = fontOf(10 * pageScale.peek() * devicePixelRatio);
  ctx.textAlign = isLeft ? 'left' : 'right';
  ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
  const heights = guides.map((guide) => plot.valToPos(guide.value, 'y', true));
  const room = 14 * pageScale.peek() * devicePixelRatio;
  const places = labelPlaces(heights, isLeft, bbox.top, room);
  for (const [i, guide] of guides.entries()) {
    const y = heights[i]!;
    if (y < bbox.top || y > bbox.top + bbox.height) continue;
    ctx.beginPath();
    ctx.moveTo(bbox.left, y);
    ctx.lineTo(bbox.left + bbox.width, y);
    ctx.stroke();
    const place = places[i]!;
    ctx.textBaseline = place.isBelow ? 'top' : 'bottom';
    ctx.fillText(
      guide.label,
      isLeft ? bbox.left + 3 : bbox.left + bbox.width - 3,
      place.isBelow ? place.y + 2 : place.y - 2,
    );
  }
  ctx.restore();
}

// Labels stand beside their lines, one below the other, and inside the plot.
function drawMarks(plot: uPlot, marks: Mark[], atTop: boolean) {
  const { ctx, bbox } = plot;
  const size = 10 * pageScale.peek() * devicePixelRatio;
  ctx.save();
  ctx.font = fontOf(size);
  ctx.textBaseline = 'top';
  const first = atTop ? bbox.top + 4 : bbox.top + bbox.height - 1.4 * size * marks.length;
  marks.forEach((mark, i) => {
    const x = plot.valToPos(mark.value, 'x', true);
    if (x < bbox.left || x > bbox.left + bbox.width) return;
    ctx.strokeStyle = ctx.fillStyle = colour(mark.isLimit ? '--bad' : '--c1');
    ctx.setLineDash(mark.isLimit ? [] : [3 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    const isLeft = x + ctx.measureText(mark.label).width + 6 > bbox.left + bbox.width;
    ctx.textAlign = isLeft ? 'right' : 'left';
    ctx.fillText(mark.label, x + (isLeft ? -4 : 4), first + 1.4 * size * i);
  });
  ctx.restore();
}

function drawBands(plot: uPlot, bands: Band[]) {
  const { ctx, bbox } = plot;
  ctx.save();
  for (const band of bands) {
    const left = Math.max(bbox.left, plot.valToPos(band.from, 'x', true));
    const right = Math.min(bbox.left + bbox.width, plot.valToPos(band.to, 'x', true));
    if (right <= left) continue;
    ctx.fillStyle = colour(band.colour);
    ctx.fillRect(left, bbox.top, right - left, bbox.height);
  }
  ctx.restore();
}

export function Lines(props: {
  title: string;
  x: number[];
  xLabel: string;
  yLabel: string;
  lines: Line[];
  height?: number;
  guides?: Guide[];
  guidesAtLeft?: boolean; // their labels, below them, where a curve rises to them
  marks?: Mark[];
  marksAtTop?: boolean; // their labels
  bands?: Band[];
  yFromZero?: boolean;
  xUnit?: string;
  sync?: string;
  onPick?: (x: number) => void; // a click on the plot, at the nearest value
}) {
  const box = useRef<HTMLDivElement>(null);
  const plot = useRef<uPlot | null>(null);
  const at = useSignal<number | null>(null);
  const pick = useRef(props.onPick);
  pick.current = props.onPick;
  const size = pageScale.value;
  const height = Math.round((props.height ?? 220) * size);
  const paint = palette.value;
  // What the plot is made of but its values; a change makes a new one.
  const shape = JSON.stringify([
    props.title,
    props.xLabel,
    props.yLabel,
    height,
    props.guides,
    props.marks,
    props.bands,
    props.yFromZero,
    paint,
    size,
    props.lines.map((line) => [line.label, line.colour, line.dash, line.width, line.points]),
  ]);
  const data = [props.x, ...props.lines.map((line) => line.values)] as uPlot.AlignedData;

  useEffect(() => {
    const holder = box.current;
    if (!holder) return;
    const ink = colour('--muted');
    const grid = { stroke: colour('--grid'), width: 1 };
    const font = fontOf(11 * size);
    const axis = {
      stroke: ink,
      font,
      labelFont: font,
      grid,
      ticks: { ...grid, size: 4 * size },
      labelSize: 16 * size,
      labelGap: 0,
    };
    const made = new uPlot(
      {
        width: holder.clientWidth,
        height,
        legend: { show: false },
        cursor: {
          y: false,
          points: { size: 6 },
          drag: { x: true, y: false },
          ...(props.sync ? { sync: { key: props.sync } } : {}),
        },
        scales: {
          x: { time: false },
          y: props.yFromZero
            ? {
                range: (_, low, high) => [
                  Math.min(0, low),
                  high + 0.06 * (high - Math.min(0, low)) || 1,
                ],
              }
            : {},
        },
        axes: [
          { ...axis, label: props.xLabel, size: 30 * size, space: 60 * size },
          {
            ...axis,
            label: props.yLabel,
            size: (_, ticks) =>
              Math.max(46, 12 + 6.4 * Math.max(0, ...(ticks ?? []).map((t) => t.length))) * size,
            space: 30 * size,
            values: (_, ticks) => ticks.map((tick) => (tick === null ? '' : short(tick))),
          },
        ],
        series: [
          {},
          ...props.lines.map((line) => ({
            label: line.label,
            stroke: colour(line.colour),
            width: (line.width ?? 1.6) * size,
            dash: line.dash,
            points: line.points
              ? { show: true, size: 3, fill: colour(line.colour) }
              : { show: false },
          })),
        ],
        hooks: {
          drawClear: [(u) => drawBands(u, props.bands ?? [])],
          draw: [
            (u) => drawGuides(u, props.guides ?? [], ink, props.guidesAtLeft ?? false),
            (u) => drawMarks(u, props.marks ?? [], props.marksAtTop ?? false),
          ],
          setCursor: [(u) => (at.value = u.cursor.idx ?? null)],
        },
      },
      data,
      holder,
    );
    plot.current = made;
    made.over.addEventListener('click', () => {
      const index = made.cursor.idx;
      const x = index === null || index === undefined ? null : made.data[0][index];
      if (x !== null && x !== undefined) pick.current?.(x);
    });
    const observer = new ResizeObserver(() => made.setSize({ width: holder.clientWidth, height }));
    observer.observe(holder);
    return () => {
      observer.disconnect();
      made.destroy();
      plot.current = null;
    };
  }, [shape]);

  useEffect(() => {
    plot.current?.setData(data);
  }, [props.x, ...props.lines.map((line) => line.values)]);

  const index = at.value;
  return (
    <figure class="plot" aria-label={`${props.title}: ${props.yLabel} over ${props.xLabel}`}>
      <figcaption>
        <strong>{props.title}</strong>
        <span class="legend">
          {props.lines.map((line) => (
            <span key={line.label} class="legend-item">
              <svg width="18" height="8" aria-hidden="true">
                <line
                  x1="0"
                  y1="4"
                  x2="18"
                  y2="4"
                  stroke={`var(${line.colour})`}
                  stroke-width="2"
                  stroke-dasharray={line.dash?.join(' ')}
                />
              </svg>
              {line.label}
              {index !== null && (
                <span class="legend-value">{significant(line.values[index] ?? null, 4)}</span>
              )}
            </span>
          ))}
          {index !== null && (
            <span class="legend-item legend-at">
              at {significant(props.x[index] ?? null, 4)} {props.xUnit ?? 's'}
            </span>
          )}
        </span>
      </figcaption>
      <div ref={box} style={{ height: `${height}px` }} />
    </figure>
  );
}
