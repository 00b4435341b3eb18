// A small drawing of an actuator that is given by its shape, with the names of its measures.
import type { ComponentChildren } from 'preact';

import type { Shape } from '../lib/understood';

const pictures: Record<Shape, { label: string; picture: ComponentChildren }> = {
  cylinder: {
    label: 'A cylinder: bore across, stroke along, the rod through one end',
    picture: (
      <>
        <rect x="14" y="16" width="112" height="34" />
        <path d="M66 16 V50 M72 16 V50 M72 33 H150" />
        <path class="measure" d="M8 16 V50 M66 60 H126" />
        <text x="8" y="12">
          bore
        </text>
        <text x="96" y="73">
          stroke
        </text>
        <text x="150" y="27">
          rod
        </text>
      </>
    ),
  },
  muscle: {
    label: 'A McKibben muscle at rest and, dashed, contracted: length along, diameter across',
    picture: (
      <>
        <rect x="14" y="24" width="132" height="18" />
        <path d="M22 42 L40 24 M46 42 L64 24 M70 42 L88 24 M94 42 L112 24 M118 42 L136 24" />
        <path
          class="grown"
          d="M14 33 Q22 10 60 10 H84 Q116 10 122 33 Q116 56 84 56 H60 Q22 56 14 33"
        />
        <path class="measure" d="M14 62 H146 M154 24 V42" />
        <text x="80" y="75">
          length
        </text>
        <text x="146" y="18">
          diameter
        </text>
      </>
    ),
  },
  pouch: {
    label: 'A flat pouch and, dashed, its pillow: length along, width across',
    picture: (
      <>
        <rect x="14" y="12" width="120" height="42" />
        <path class="grown" d="M14 12 Q74 22 134 12 Q126 33 134 54 Q74 44 14 54 Q22 33 14 12" />
        <path class="measure" d="M14 62 H134 M142 12 V54" />
        <text x="74" y="75">
          length
        </text>
        <text x="150" y="37">
          width
        </text>
      </>
    ),
  },
  body: {
    label: 'A body that grows from flat: length along, diameter across',
    picture: (
      <>
        <path d="M14 20 H124 Q138 20 138 33 Q138 46 124 46 H14 Z" />
        <path class="grown" d="M124 30 H14 M124 36 H14 M124 30 Q130 33 124 36" />
        <path class="measure" d="M14 56 H138 M148 20 V46" />
        <text x="76" y="70">
          length
        </text>
        <text x="146" y="16">
          diameter
        </text>
      </>
    ),
  },
};

export function ShapeDrawing({ shape }: { shape: Shape }) {
  const { label, picture } = pictures[shape];
  return (
    <svg class="drawing shape" viewBox="-6 0 180 80" role="img" aria-label={label}>
      {picture}
    </svg>
  );
}
