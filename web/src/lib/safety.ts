// What can hurt in a design, in sentences with its own numbers.
import { numberOf } from './catalogue';
import { percent, shown, significant } from './format';
import type { Parts } from './rig';
import type { Design, Part, PartRow, Requirements } from './types';
import { unitOf } from './units';
import { entriesOf } from './understood';
import { isVacuum } from './vacuum';

const gamma = 1.4; // of air
const co2Density = 1.81; // kg/m³ at 100 kPa and 20 °C
const roomM3 = 30; // a small workshop

const pressure = (kpa: number | null): string => `${shown('pressure', kpa)} ${unitOf('pressure')}`;
const volume = (ml: number): string => `${shown('volume_ml', ml)} ${unitOf('volume_ml')}`;

// What gas in a vessel gives off when it bursts, expanding to ambient without heat:
// p·V/(γ−1)·[1 − (p_a/p)^((γ−1)/γ)], in J; pressures absolute.
export function storedEnergyJ(gauge_kpa: number, volume_ml: number, ambient_kpa: number): number {
  const ratio = ambient_kpa / (gauge_kpa + ambient_kpa);
  const product = (gauge_kpa + ambient_kpa) * 1e3 * volume_ml * 1e-6;
  return (product / (gamma - 1)) * (1 - ratio ** ((gamma - 1) / gamma));
}

const nameOf = (row: PartRow): string => `${row.manufacturer} ${row.part_number}`;

// The highest pressure that the catalogue allows a part, and whether that is an estimate.
function ratingOf(part: Part | undefined, field: string): string {
  const highest = part ? numberOf(part, field) : null;
  if (highest === null) return 'The catalogue does not say what pressure it may hold.';
  const isGuess = part!.provenance[field]?.kind === 'estimated';
  return `It may hold ${pressure(highest)}${isGuess ? '; that number is an estimate' : ''}.`;
}

function vesselNotes(design: Design, parts: Parts, ambient_kpa: number): string[] {
  const row = design.parts.find(({ family }) => family === 'reservoir');
  const size = design.settings.reservoir_volume_ml;
  if (row && (isVacuum(design.configuration) || design.settings.vacuum_stop_kpa_gauge))
    return [`${nameOf(row)} is evacuated: it must not buckle. Do not use a thin bottle.`];
  if (!row || size === null) return [];
  const { tank_fill_kpa_gauge, source_pressure_kpa_gauge } = design.settings;
  const held = tank_fill_kpa_gauge ?? source_pressure_kpa_gauge;
  const part = parts.get(row.id);
  const energy = significant(storedEnergyJ(held, size, ambient_kpa), 2);
  const known =
    row.id === 'custom'
      ? 'It is made to measure: have it rated for more than that.'
      : ratingOf(part, 'pressure_max_kpa_gauge');
  const notes = [
    `${nameOf(row)} holds ${volume(size)} at up to ${pressure(held)}: ${energy} J if it bursts. ${known}`,
    'Fit a relief valve that opens below what the vessel may hold. No relief valve is on this list.',
  ];
  if (String(part?.material).includes('PET'))
    notes.push(
      'A PET bottle is no pressure vessel: it ages and may burst without warning. Test it full of water at one and a half times its pressure, keep it behind a shield and away from heat and sun, and replace it when it is scratched, dented or cloudy.',
    );
  return notes;
}

function bottleNotes(design: Design, parts: Parts): string[] {
  return design.parts.flatMap((row) => {
    const part = parts.get(row.id);
    if (row.family === 'cylinder')
      return [
        `${nameOf(row)} is filled to ${pressure(part ? numberOf(part, 'fill_pressure_kpa_gauge') : null)}. Fill it no further than its marking says, keep it from falling, and have it inspected when its marking asks for it.`,
      ];
    if (row.family !== 'co2') return [];
    const mass = row.quantity * ((part ? numberOf(part, 'co2_mass_kg') : null) ?? 0);
    const share = mass / co2Density / roomM3;
    return [
      `The CO₂ is ${significant(mass)} kg, ${significant((1e3 * mass) / co2Density)} L as gas: in a closed room of ${roomM3} m³ it adds ${percent(share)} to the air. Open a window.`,
      'Keep CO₂ below 50 °C: its pressure rises steeply. Regulator and hoses become cold enough to freeze skin.',
    ];
  });
}

function lineNotes(design: Design, requirements: Requirements): string[] {
  const { source_pressure_kpa_gauge, group_pressure_kpa_gauge } = design.settings;
  const entries = entriesOf(requirements.actuators);
  const notes = requirements.actuators.flatMap((group, g) => {
    const source = group_pressure_kpa_gauge?.[g] ?? source_pressure_kpa_gauge;
    const entry = entries.indexOf(group.name.replace(/, (cap|rod) side$/, ''));
    const margin = design.margins.find(
      ({ requirement }) => requirement === `/actuators/${entry}/pressure_kpa_gauge_max`,
    );
    const highest = group.pressure_kpa_gauge_max ?? margin?.required;
    if (!highest || source <= highest) return [];
    return [
      `${group_pressure_kpa_gauge ? 'Its regulator' : 'The source'} is at ${pressure(source)}, ${group.name} may have ${pressure(highest)}: a valve that sticks open, or a command that comes late, passes that limit. Let a sensor or a relief valve end it.`,
    ];
  });
  const regulators = design.parts.filter(({ family }) => family === 'regulator');
  return [
    ...notes,
    ...regulators.map(
      (row) =>
        `If ${nameOf(row)} fails, the lines${row.group === null ? '' : ` of ${row.group}`} have the pressure of the source before it: fit a relief valve behind it.`,
    ),
  ];
}

function electricalNotes(design: Design, parts: Parts): string[] {
  const notes: string[] = [];
  const battery = design.parts.find(({ family }) => family === 'battery');
  if (battery)
    notes.push(
      `${nameOf(battery)}: fuse it near its poles, use a protection circuit that suits its cells, and charge it with a charger made for them.`,
    );
  const pump = design.parts.find(({ family }) => ['compressor', 'vacuum_pump'].includes(family));
  const duty = design.settings.compressor_duty ?? design.settings.vacuum_duty ?? null;
  if (pump && duty !== null) {
    const limit = numberOf(parts.get(pump.id) ?? ({} as Part), 'duty_max');
    notes.push(
      `${nameOf(pump)} runs ${percent(duty, 0)} of the time${limit === null ? '' : ` of at most ${percent(limit, 0)}`}: its housing becomes hot. Let air reach it.`,
    );
  }
  return notes;
}

export const safetyNotes = (design: Design, requirements: Requirements, parts: Parts): string[] => [
  ...vesselNotes(design, parts, requirements.ambient?.pressure_kpa_abs ?? 100),
  ...bottleNotes(design, parts),
  ...lineNotes(design, requirements),
  ...electricalNotes(design, parts),
  'Let the pressure out before you open a joint, and wear eye protection.',
];
