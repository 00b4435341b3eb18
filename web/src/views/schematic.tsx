// A design as a drawing: its parts by number, from the source to the actuators.
import { quantityOf } from '../lib/amounts';
import { rowOf } from '../lib/rig';
import type { Design, PartRow, Requirements } from '../lib/types';
import { shown } from '../lib/format';
import { unitOf } from '../lib/units';
import { feedOf } from '../lib/pumps';
import { goesBelow, hasReservoir, hasTank, isDirect, isVacuum } from '../lib/vacuum';
import { Actuator, place, Regulator, Reservoir, SourceSign, Valve } from './drawing';

const lineChars = 22;
const lineHeight = 13;

// A text in lines of at most `lineChars`; words that are longer are cut.
function inLines(text: string): string[] {
  const lines: string[] = [];
  for (const word of text.split(' ').flatMap((w) => w.match(/.{1,22}/g) ?? [])) {
    const last = lines.at(-1);
    if (last !== undefined && last.length + word.length < lineChars)
      lines[lines.length - 1] = `${last} ${word}`;
    else lines.push(word);
  }
  return lines;
}

const partText = (row: PartRow | undefined): string =>
  row ? `${quantityOf(row)} ${row.manufacturer} ${row.part_number}` : '';

function Label(props: { x: number; y: number; texts: (string | undefined)[] }) {
  const lines = props.texts.flatMap((text) => (text ? inLines(text) : []));
  return (
    <text x={props.x} y={props.y}>
      {lines.map((line, i) => (
        <tspan key={i} x={props.x} dy={i === 0 ? 0 : lineHeight}>
          {line}
        </tspan>
      ))}
    </text>
  );
}

// The vacuum that valves empty into, beside a pressure: its pumps and reservoir, or the wall.
function Rail({ design, y, valves }: { design: Design; y: number; valves: number[] }) {
  const { vacuum_kpa_gauge, vacuum_stop_kpa_gauge } = design.settings;
  if (vacuum_kpa_gauge === undefined) return null;
  const pump = rowOf(design, 'vacuum_pump');
  const reservoir = rowOf(design, 'reservoir');
  const told = (kpa: number) => `${shown('pressure', kpa)} ${unitOf('pressure')}`;
  return (
    <>
      <path class="pipe vacuum" d={`M${at.source} ${y} H${at.rail}`} />
      {valves.map((valve) => (
        <path key={valve} class="pipe vacuum" d={`M${at.rail} ${y} V${valve + 9} H${at.valve}`} />
      ))}
      <g transform={place(at.source, y)} class="sign source">
        <SourceSign kind={pump ? 'vacuum_pump' : 'mains'} />
      </g>
      {reservoir && (
        <g transform={place(at.store, y)} class="sign">
          <Reservoir />
        </g>
      )}
      <Label x={at.source} y={y + 30} texts={[pump ? partText(pump) : 'vacuum of the wall']} />
      <Label
        x={at.store}
        y={y + 30}
        texts={[
          partText(reservoir),
          told(vacuum_kpa_gauge) + (vacuum_stop_kpa_gauge === undefined ? '' : ' at the weakest'),
          vacuum_stop_kpa_gauge === undefined
            ? undefined
            : `pump stops at ${told(vacuum_stop_kpa_gauge)}`,
        ]}
      />
    </>
  );
}

const at = {
  rail: 360,
  source: 80,
  ownBus: 170,
  store: 240,
  bus: 320,
  valve: 400,
  tube: 560,
  actuator: 720,
};
const groupHeight = 130;

export function Schematic({
  design,
  requirements,
}: {
  design: Design;
  requirements: Requirements;
}) {
  const groups = requirements.actuators;
  const { configuration, settings } = design;
  const below = groups.flatMap((group, i) => (goesBelow(group) ? [i] : []));
  const railHeight = below.length > 0 ? 150 : 0;
  const above = Math.max(260, groups.length * groupHeight + 60);
  const height = above + railHeight;
  const middle = above / 2 - 30;
  const yOf = (i: number) => middle + (i - (groups.length - 1) / 2) * groupHeight;
  const source =
    rowOf(design, 'compressor') ??
    (isVacuum(configuration) ? rowOf(design, 'vacuum_pump') : undefined) ??
    rowOf(design, 'ejector') ??
    rowOf(design, 'cylinder') ??
    rowOf(design, 'co2');
  const reservoir = rowOf(design, 'reservoir');
  const regulator = rowOf(design, 'regulator');
  const groupPressures = settings.group_pressure_kpa_gauge; // behind a regulator of each group
  const ownPumps = isDirect(configuration) && feedOf(requirements) !== 'shared'; // no bus
  const each = feedOf(requirements) === 'per_actuator' ? 'to each actuator' : 'to each group';
  const bus = groupPressures ? at.ownBus : ownPumps ? at.source : at.bus;
  const battery = rowOf(design, 'battery');
  const joints = design.parts.filter(
    ({ family }) => family === 'manifold' || family === 'check_valve',
  );
  const setting = `${shown('pressure', settings.source_pressure_kpa_gauge)} ${unitOf('pressure')}`;
  const isTank = hasTank(configuration);
  return (
    <svg
      class="drawing schematic"
      viewBox={`0 0 800 ${height}`}
      role="img"
      aria-label={`Schematic: ${design.parts.map(partText).join(', ')}`}
    >
      <path
        class="pipe"
        d={
          ownPumps
            ? ''
            : `M${at.source} ${middle} H${bus} M${bus} ${yOf(0)} V${yOf(groups.length - 1)}`
        }
      />
      {!ownPumps && (
        <g transform={place(at.source, middle)} class="sign source">
          <SourceSign kind={configuration} />
        </g>
      )}
      <Label
        x={at.source}
        y={(ownPumps ? yOf(groups.length - 1) : middle) + 30}
        texts={
          isTank
            ? [partText(reservoir), source && `filled by ${partText(source)}`]
            : [source ? partText(source) : 'wall supply', ownPumps ? each : undefined]
        }
      />
      {!isDirect(configuration) &&
        (hasReservoir(configuration) || regulator) &&
        !groupPressures && (
          <g transform={place(at.store, middle)} class="sign">
            {hasReservoir(configuration) ? <Reservoir /> : <Regulator />}
          </g>
        )}
      {!groupPressures && (
        <Label
          x={at.store}
          y={middle + 30}
          texts={[
            isDirect(configuration)
              ? undefined
              : partText(hasReservoir(configuration) ? reservoir : regulator),
            setting,
          ]}
        />
      )}
      <Label x={ownPumps ? at.store : bus} y={24} texts={joints.map(partText)} />
      {railHeight > 0 && <Rail design={design} y={above - 40} valves={below.map(yOf)} />}
      {battery && (
        <>
          <path class="wire" d={`M${at.source} ${height - 48} V${height - 70} H${at.valve}`} />
          <rect class="cell" x={at.source - 14} y={height - 48} width="28" height="14" />
          <Label x={at.source} y={height - 18} texts={[partText(battery)]} />
          <text x={at.valve + 4} y={height - 66} class="beside">
            to{' '}
            {design.parts.some(({ family }) => ['compressor', 'vacuum_pump'].includes(family))
              ? 'pump and '
              : ''}
            valves
          </text>
        </>
      )}
      {groups.map((group, i) => {
        const y = yOf(i);
        return (
          <g key={group.name}>
            <path class="pipe" d={`M${bus} ${y} H${at.actuator}`} />
            {ownPumps && (
              <g transform={place(at.source, y)} class="sign source">
                <SourceSign kind={configuration} />
              </g>
            )}
            {groupPressures && (
              <>
                <g transform={place(at.store, y)} class="sign">
                  <Regulator />
                </g>
                <Label
                  x={at.store}
                  y={y + 30}
                  texts={[
                    partText(rowOf(design, 'regulator', group.name)),
                    `${shown('pressure', groupPressures[i]!)} ${unitOf('pressure')}`,
                  ]}
                />
              </>
            )}
            <g transform={place(at.valve, y)} class="sign">
              <Valve />
            </g>
            <Label
              x={at.valve}
              y={y + 28}
              texts={[
                partText(rowOf(design, 'valve', group.name)),
                ownPumps && feedOf(requirements) === 'per_actuator'
                  ? 'vents, beside the line'
                  : undefined,
              ]}
            />
            <path class="tube" d={`M${at.tube - 32} ${y} q8 -12 16 0 t16 0 t16 0 t16 0`} />
            <Label
              x={at.tube}
              y={y + 28}
              texts={[
                partText(rowOf(design, 'tubing', group.name)),
                partText(rowOf(design, 'fitting', group.name)),
              ]}
            />
            <g transform={place(at.actuator, y)} class="sign actuator">
              <Actuator group={group} largest={group.rest_volume_ml ?? 1} />
            </g>
            <Label
              x={at.actuator}
              y={y + 40}
              texts={[
                `${group.count} × ${group.name}`,
                `${shown('pressure', group.operating_pressure_kpa_gauge)} ${unitOf('pressure')}`,
              ]}
            />
          </g>
        );
      })}
    </svg>
  );
}
