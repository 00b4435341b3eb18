// How much a group's actuator holds: as numbers, as a measured table or by what it is.
import { short } from '../lib/format';
import { edit, errorAt, numbers, understood } from '../lib/requirements';
import type { Group } from '../lib/types';
import { rodSide, type Shape, shapeOf, shapes } from '../lib/understood';
import { toShown, unitOf } from '../lib/units';
import { Select } from '../ui/controls';
import { RequirementField } from './requirement_field';
import { ShapeDrawing } from './shape_drawing';
import { isEvacuated } from '../lib/vacuum';

type Way = 'numbers' | 'table' | Shape;

const labels: Record<Way, string> = {
  numbers: 'volume and expansion',
  table: 'measured table',
  cylinder: 'cylinder',
  muscle: 'McKibben muscle',
  pouch: 'pouch',
  body: 'growing body',
};

const usual: Record<Shape, Record<string, number>> = {
  cylinder: { bore_mm: 16, stroke_mm: 50, dead_volume_ml: 1 },
  muscle: { length_mm: 150, diameter_mm: 10, contraction: 0.2 },
  pouch: { width_mm: 40, length_mm: 80 },
  body: { diameter_mm: 50, length_m: 1 },
};

interface Measure {
  name: string;
  label: string;
  unit?: string;
  range: [number, number];
  optional?: string; // what stands where nothing is given
}
const measures: Record<Shape, Measure[]> = {
  cylinder: [
    { name: 'bore_mm', label: 'Bore', unit: 'mm', range: [0.5, 1000] },
    { name: 'stroke_mm', label: 'Stroke', unit: 'mm', range: [1, 1e5] },
    {
      name: 'dead_volume_ml',
      label: 'Dead volume',
      unit: 'mL',
      range: [1e-4, 1e6],
      optional: '5 % of the stroke',
    },
  ],
  muscle: [
    { name: 'length_mm', label: 'Length', unit: 'mm', range: [1, 1e5] },
    { name: 'diameter_mm', label: 'Diameter', unit: 'mm', range: [0.5, 1000] },
    { name: 'braid_angle_deg', label: 'Braid angle', unit: '°', range: [5, 54], optional: '25' },
    { name: 'contraction', label: 'Contraction', unit: 'of the length', range: [0, 0.42] },
  ],
  pouch: [
    { name: 'width_mm', label: 'Width', unit: 'mm', range: [1, 1e5] },
    { name: 'length_mm', label: 'Length', unit: 'mm', range: [1, 1e5] },
    { name: 'cells', label: 'Cells', range: [1, 1000], optional: '1' },
  ],
  body: [
    { name: 'diameter_mm', label: 'Diameter', unit: 'mm', range: [0.5, 2000] },
    { name: 'length_m', label: 'Length', unit: 'm', range: [1e-3, 1e3] },
  ],
};

const wayOf = (group: Group): Way =>
  shapeOf(group) ?? (group.pressure_volume ? 'table' : 'numbers');

// The rows of what the shape of a group came to, by name.
function volumesOf(index: number, shape: Shape) {
  const rows = understood.value.filter((row) => row.pointer === `/actuators/${index}/${shape}`);
  const of = (name: string) => rows.find((row) => row.name === name);
  const rest = of('rest_volume_ml');
  const grown = of('operating_volume_ml');
  const ratio = of('expansion_ratio');
  return rest && grown && ratio ? { rest, grown, ratio } : undefined;
}

function change(group: Group, index: number, way: Way): void {
  const { rest_volume_ml, expansion_ratio, pressure_volume, ...others } = group;
  const next: Group = others;
  const shape = shapeOf(group);
  const volumes = shape && volumesOf(index, shape);
  for (const name of shapes) delete next[name];
  if (way === 'numbers') {
    next.rest_volume_ml = rest_volume_ml ?? volumes?.rest.value ?? pressure_volume?.[0]?.volume_ml;
    next.rest_volume_ml ??= 50;
    next.expansion_ratio = expansion_ratio ?? volumes?.ratio.value ?? 1;
  } else if (way !== 'table') {
    next[way] = usual[way];
  } else {
    next.pressure_volume = pressure_volume;
  }
  edit(['actuators', index], next);
}

export function VolumeFields({ group, index }: { group: Group; index: number }) {
  const way = wayOf(group);
  const ways = (Object.keys(labels) as Way[]).filter(
    (name) => name !== 'table' || group.pressure_volume,
  );
  const shape = shapeOf(group);
  return (
    <>
      <Select
        label="Volume by"
        value={way}
        options={ways.map((value) => ({ value, label: labels[value] }))}
        onChange={(next) => change(group, index, next)}
      />
      {way === 'numbers' && (
        <>
          <RequirementField
            label="Volume at rest"
            kind="volume_ml"
            path={['actuators', index, 'rest_volume_ml']}
            range={[0.01, 1e6]}
          />
          <RequirementField
            label={
              isEvacuated(numbers.value.actuators[index] ?? group) ? 'Contraction' : 'Expansion'
            }
            unit="× at operating"
            path={['actuators', index, 'expansion_ratio']}
            range={isEvacuated(numbers.value.actuators[index] ?? group) ? [0.01, 1] : [1, 1000]}
            hint="1 is rigid"
          />
        </>
      )}
      {way === 'table' && (
        <div class="field">
          <span class="label">Volume law</span>
          <span class="hint">measured, {group.pressure_volume!.length} points</span>
        </div>
      )}
      {shape && <ShapeFields shape={shape} index={index} />}
      {shape === 'cylinder' && <ActingFields group={group} index={index} />}
    </>
  );
}

// One chamber, or one on each side of the piston.
function ActingFields({ group, index }: { group: Group; index: number }) {
  const cylinder = (group.cylinder ?? {}) as Record<string, unknown>;
  const double = cylinder.acting === 'double';
  const rod = understood.value.find(
    (row) => row.pointer === `/actuators/${index}/cylinder` && row.name === rodSide,
  );
  return (
    <>
      <Select
        label="Acting"
        value={double ? 'double' : 'single'}
        options={[
          { value: 'single', label: 'one side' },
          { value: 'double', label: 'both sides in turns' },
        ]}
        onChange={(acting) => {
          const { acting: _, rod_mm, ...others } = cylinder;
          edit(
            ['actuators', index, 'cylinder'],
            acting === 'double' ? { ...others, rod_mm: rod_mm ?? 6, acting } : others,
          );
        }}
      />
      {double && (
        <>
          <RequirementField
            label="Rod"
            unit="mm"
            path={['actuators', index, 'cylinder', 'rod_mm']}
            range={[0.1, 1000]}
            optional
            placeholder="0"
          />
          {rod && (
            <span class="hint" title={rod.formula}>
              {short(toShown('volume_ml', rod.value))} {unitOf('volume_ml')} on the side of the rod
            </span>
          )}
        </>
      )}
    </>
  );
}

function ShapeFields({ shape, index }: { shape: Shape; index: number }) {
  const volumes = volumesOf(index, shape);
  const wrong = errorAt(`/actuators/${index}/${shape}`);
  const volume = (ml: number) => `${short(toShown('volume_ml', ml))} ${unitOf('volume_ml')}`;
  return (
    <>
      {measures[shape].map(({ name, label, unit, range, optional }) => (
        <RequirementField
          key={shape + name}
          label={label}
          {...(unit !== undefined && { unit })}
          path={['actuators', index, shape, name]}
          range={range}
          {...(optional !== undefined && { optional: true, placeholder: optional })}
        />
      ))}
      <div class="field shape-volumes">
        <ShapeDrawing shape={shape} />
        {wrong && (
          <span class="error" role="alert">
            {wrong}
          </span>
        )}
        {volumes && (
          <span class="hint" title={`${volumes.rest.formula}; ${volumes.grown.formula}`}>
            {volume(volumes.rest.value)} at rest, {volume(volumes.grown.value)} at the operating
            pressure: × {short(volumes.ratio.value)}. {volumes.grown.formula}; at rest{' '}
            {volumes.rest.formula}.
          </span>
        )}
      </div>
    </>
  );
}
