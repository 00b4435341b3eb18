// The system as a small drawing that follows the requirements: sources, bus, one line per group.
import { short } from '../lib/format';
import type { Configuration, Group, Requirements } from '../lib/types';
import { toShown, unitOf } from '../lib/units';
import { feedOf } from '../lib/pumps';
import { hasReservoir, isDirect, isEvacuated, kindsAsked } from '../lib/vacuum';

const names: Record<Configuration, string> = {
  compressor: 'compressor',
  cylinder: 'cylinder',
  co2: 'CO₂',
  mains: 'wall',
  tank: 'tank',
  tank_and_pump: 'tank, pump',
  direct_pump: 'pump',
  vacuum_pump: 'vacuum',
  direct_vacuum_pump: 'vacuum',
  ejector: 'ejector',
  direct_ejector: 'ejector',
};

// Signs in the manner of ISO 1219, 30 × 30 around the middle.
export function SourceSign({ kind }: { kind: Configuration }) {
  switch (kind) {
    case 'compressor':
    case 'direct_pump':
      return (
        <>
          <circle r="13" />
          <path d="M-13 0 L11 -7 M-13 0 L11 7" />
        </>
      );
    case 'vacuum_pump':
    case 'direct_vacuum_pump':
      return (
        <>
          <circle r="13" />
          <path d="M13 0 L-11 -7 M13 0 L-11 7" />
        </>
      );
    case 'ejector':
    case 'direct_ejector':
      return <path d="M-13 -9 L0 -3 L13 -9 V9 L0 3 L-13 9 Z M0 13 V3" />;
    case 'cylinder':
      return <path d="M-13 -8 H6 Q13 -8 13 0 Q13 8 6 8 H-13 Z" />;
    case 'co2':
      return (
        <>
          <path d="M-13 -8 H6 Q13 -8 13 0 Q13 8 6 8 H-13 Z" />
          <path d="M-13 2 H12" stroke-dasharray="2 2" />
        </>
      );
    case 'tank':
      return <Reservoir />;
    case 'tank_and_pump':
      return (
        <>
          <Reservoir />
          <path d="M-13 0 L11 -7 M-13 0 L11 7" />
        </>
      );
    case 'mains':
      return (
        <>
          <path d="M-9 -13 V13" />
          <path d="M-9 0 L6 -8 V8 Z" />
        </>
      );
  }
}

export const Regulator = () => (
  <>
    <rect x="-10" y="-10" width="20" height="20" />
    <path d="M-6 4 H6 M3 1 L6 4 L3 7" />
  </>
);

export const Reservoir = () => <rect x="-16" y="-9" width="32" height="18" rx="9" />;

export const Valve = () => (
  <>
    <rect x="-18" y="-9" width="36" height="18" />
    <path d="M0 -9 V9 M-14 5 L-4 -5 M-4 -5 h-4 M-4 -5 v4 M5 0 H13 M5 -4 V4 M13 -4 V4" />
  </>
);

// Also of a form that is half written.
const volumeOf = (group: Group): number =>
  Math.max(group.rest_volume_ml ?? group.pressure_volume?.[0]?.volume_ml ?? 0, 1e-3);

export function Actuator({ group, largest }: { group: Group; largest: number }) {
  const rest = 5 + 10 * Math.cbrt(volumeOf(group) / largest);
  const ratio = group.expansion_ratio ?? 1;
  const grown = rest * Math.cbrt(isEvacuated(group) ? ratio : Math.min(Math.max(ratio, 1), 8));
  return (
    <>
      <ellipse rx={grown * 1.15} ry={grown} class="grown" />
      <ellipse rx={rest * 1.15} ry={rest} />
    </>
  );
}

const clip = (name: string): string => (name.length > 14 ? `${name.slice(0, 13)}…` : name);

export const place = (x: number, y: number) => `translate(${x} ${y})`;

export function Drawing({ requirements }: { requirements: Requirements }) {
  const kinds = kindsAsked(requirements);
  const own = feedOf(requirements) !== 'shared' && kinds.length === 1; // pumps in each row
  const groups = requirements.actuators;
  const rows = Math.max(kinds.length, groups.length, 1);
  const step = 92;
  const height = rows * step + 10;
  const width = 372;
  const yOf = (i: number, n: number) => height / 2 + (i - (n - 1) / 2) * step;
  const bus = 146;
  const largest = Math.max(...groups.map(volumeOf));
  const ends = own
    ? []
    : [
        ...kinds.map((_, i) => yOf(i, kinds.length)),
        ...groups.map((_, i) => yOf(i, groups.length)),
      ];
  return (
    <svg
      class="drawing"
      viewBox={`0 0 ${width} ${height}`}
      role="img"
      aria-label={describe(kinds, groups)}
    >
      {ends.length > 0 && (
        <path class="pipe" d={`M${bus} ${Math.min(...ends)} V${Math.max(...ends)}`} />
      )}
      {(own ? [] : kinds).map((kind, i) => {
        const y = yOf(i, kinds.length);
        return (
          <g key={kind}>
            <path class="pipe" d={`M34 ${y} H${bus}`} />
            <g transform={place(34, y)} class="sign source">
              <SourceSign kind={kind} />
            </g>
            {!isDirect(kind) && (
              <g transform={place(104, y)} class="sign">
                {hasReservoir(kind) ? <Reservoir /> : <Regulator />}
              </g>
            )}
            <text x="34" y={y + 27}>
              {names[kind]}
            </text>
            {!isDirect(kind) && (
              <text x="104" y={y + 27}>
                {hasReservoir(kind) ? 'reservoir' : 'regulator'}
              </text>
            )}
          </g>
        );
      })}
      {groups.map((group, i) => {
        const y = yOf(i, groups.length);
        const rise = group.rise_time_s_max;
        const fall = group.fall_time_s_max;
        return (
          <g key={i}>
            <path class="pipe" d={`M${own ? 34 : bus} ${y} H330`} />
            {own && (
              <>
                <g transform={place(34, y)} class="sign source">
                  <SourceSign kind={kinds[0]!} />
                </g>
                <text x="34" y={y + 27}>
                  {feedOf(requirements) === 'per_actuator' ? 'pump each' : names[kinds[0]!]}
                </text>
              </>
            )}
            <g transform={place(178, y)} class="sign">
              <Valve />
            </g>
            <path class="tube" d={`M208 ${y} q8 -12 16 0 t16 0 t16 0 t16 0`} />
            <g transform={place(326, y)} class="sign actuator">
              <Actuator group={group} largest={largest} />
            </g>
            <text x="178" y={y + 27}>
              {own && feedOf(requirements) === 'per_actuator' ? 'vent valve' : 'valve'}
            </text>
            <text x="240" y={y + 27}>
              {short(group.tube_length_m)} m
            </text>
            <text x="240" y={y - 16}>
              {short(toShown('pressure', group.operating_pressure_kpa_gauge), 4)}{' '}
              {unitOf('pressure')}
            </text>
            <text x="326" y={y + 38} class="name">
              {group.count} × {clip(group.name)}
            </text>
            <text x="326" y={y + 51}>
              {[rise && `↑ ${short(rise)} s`, fall && `↓ ${short(fall)} s`]
                .filter(Boolean)
                .join('  ')}
            </text>
          </g>
        );
      })}
    </svg>
  );
}

const describe = (kinds: Configuration[], groups: Group[]): string =>
  `Supply from ${kinds.map((k) => names[k]).join(' or ') || 'nothing'} to ${groups
    .map((g) => `${g.count} ${g.name} through valve and ${short(g.tube_length_m)} m of tube`)
    .join(', and to ')}`;
