// Actuators that are evacuated, and the designs that do it.
import type { Configuration, Group, Requirements } from './types';

export const isEvacuated = (group: Group): boolean =>
  Number(group.operating_pressure_kpa_gauge) < 0;
export const areEvacuated = ({ actuators }: Requirements): boolean => actuators.some(isEvacuated);

export const isVacuum = (configuration: Configuration): boolean =>
  configuration === 'vacuum_pump' || configuration === 'direct_vacuum_pump';
// Pumps without a reservoir have no setting.
export const isDirect = (configuration: Configuration): boolean =>
  configuration === 'direct_pump' || configuration === 'direct_vacuum_pump';
export const hasReservoir = (configuration: Configuration): boolean =>
  configuration === 'compressor' || configuration === 'vacuum_pump';

// What a request may be answered with, as far as it says.
export const kindsAsked = (requirements: Requirements): Configuration[] =>
  areEvacuated(requirements)
    ? ['vacuum_pump', 'direct_vacuum_pump']
    : (requirements.supply?.configurations ?? ['cylinder', 'co2', 'compressor']);
