// Actuators that are evacuated, and the designs that do it.
import { onlyDirect } from './pumps';
import type { Configuration, Group, Requirements } from './types';

export const isEvacuated = (group: Group): boolean =>
  Number(group.operating_pressure_kpa_gauge) < 0;
export const areEvacuated = ({ actuators }: Requirements): boolean => actuators.some(isEvacuated);

// Under pressure, and pulled below ambient by vacuum pumps or by the wall's vacuum.
export const goesBelow = (group: Group): boolean => Number(group.low_pressure_kpa_gauge) < 0;
export const haveVacuumRail = ({ actuators }: Requirements): boolean => actuators.some(goesBelow);

// Whether pumps keep that vacuum: the default.
export const isRailPumped = ({ supply }: Requirements): boolean =>
  !supply?.vacuum?.configurations?.includes('mains');

// Driven by compressed air from the wall.
export const isEjector = (configuration: Configuration): boolean =>
  configuration === 'ejector' || configuration === 'direct_ejector';
export const isVacuum = (configuration: Configuration): boolean =>
  configuration === 'vacuum_pump' ||
  configuration === 'direct_vacuum_pump' ||
  isEjector(configuration);
// Pumps without a reservoir have no setting.
export const isDirect = (configuration: Configuration): boolean =>
  configuration === 'direct_pump' ||
  configuration === 'direct_vacuum_pump' ||
  configuration === 'direct_ejector';
// A reservoir that is filled beforehand.
export const hasTank = (configuration: Configuration): boolean =>
  configuration === 'tank' || configuration === 'tank_and_pump';
export const hasReservoir = (configuration: Configuration): boolean =>
  configuration === 'compressor' || configuration === 'vacuum_pump' || configuration === 'ejector';

// What evacuates, as far as the request says: pumps, ejectors where there is compressed air, the wall.
export const vacuumSources = ({ supply }: Requirements): string[] =>
  supply?.vacuum?.configurations ?? (supply?.mains ? ['pump', 'ejector'] : ['pump']);

// What a request may be answered with, as far as it says.
export function kindsAsked(requirements: Requirements): Configuration[] {
  const { supply } = requirements;
  if (!areEvacuated(requirements))
    return supply?.configurations ?? ['cylinder', 'co2', 'compressor'];
  const direct = onlyDirect(requirements);
  const sources = vacuumSources(requirements);
  const pumps: Configuration[] = direct
    ? ['direct_vacuum_pump']
    : ['vacuum_pump', 'direct_vacuum_pump'];
  const ejectors: Configuration[] = direct ? ['direct_ejector'] : ['ejector', 'direct_ejector'];
  return [
    ...(sources.includes('pump') ? pumps : []),
    ...(sources.includes('ejector') ? ejectors : []),
    ...(sources.includes('mains') ? (['mains'] as Configuration[]) : []),
  ];
}
