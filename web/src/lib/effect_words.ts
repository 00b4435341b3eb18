// Effects in words for a person.
import { pressuresInUnit } from './format';

const effectWords: Record<string, string> = {
  leak: 'a leak',
  inertia: 'inertia of the wall',
  creep: 'creep of the wall',
  hysteresis: 'hysteresis',
  heat_transfer: 'heat transfer to the wall',
  valve_delay: 'a delay of the valve',
  valve_ramp: 'a slow valve',
  dead_volume: 'dead volume',
  supply_droop: 'a drooping supply',
  exhaust_restriction: 'a restricted exhaust',
  nonlinear_compliance: 'a bent volume law',
  sensor_lag: 'lag of the sensor',
  sensor_offset: 'offset of the sensor',
  sensor_gain: 'gain of the sensor',
  cracking_pressure: 'a cracking pressure',
  line_dynamics: 'dynamics of the line',
  directional_conductance: 'a line that conducts better one way',
  wall_heat: 'heat kept in the wall',
  outgassing: 'gas that comes out of the walls',
  learned_leak: 'a learned leak',
  learned_conductance: 'a learned conductance of the line',
  learned_volume: 'a learned volume law',
  learned_sensor: 'a learned error of the sensor',
  learned_supply: 'a learned error of the supply',
  learned_valve: 'a learned error of the valve',
};

// A learned law says how many knots it has: "pressure_5".
const lawWord = (law: string): string => law.replace(/_(\d+)$/, ', $1 knots').replaceAll('_', ' ');

// A set may hold a declared number that is wrong: "number:source_pressure".
const numberOf = (id: string): string | null =>
  id.startsWith('number:') ? id.slice('number:'.length).replaceAll('_', ' ') : null;

export const effectName = (id: string, law?: string): string => {
  if (numberOf(id) !== null) return `another ${numberOf(id)}`;
  // Of one chamber of several: "leak[tip]".
  const [, alone = id, chamber] = /^(\w+)\[(.*)\]$/.exec(id) ?? [];
  const words = effectWords[alone] ?? alone.replaceAll('_', ' ');
  return `${words}${chamber ? ` of ${chamber}` : ''}${law ? ` (${lawWord(law)})` : ''}`;
};

export const effectNames = (ids: string[], laws: Record<string, string> = {}): string =>
  ids.map((id) => effectName(id, laws[id])).join(' + ') || 'base model';

// A sentence of the service with names for a person in place of ids; what is left of ids are names
// of numbers, as in "leak.critical_ratio".
export const inWords = (sentence: string): string => {
  const text = pressuresInUnit(sentence)
    .replace(/\b([a-z_]+)\.([a-z_]+)\b/g, (whole, id, parameter) =>
      effectWords[id] ? `${parameter} of ${id}` : whole,
    )
    .replace(
      /\b(?:an? )?([a-z_]+)\b/g,
      (whole, id) => effectWords[id] ?? whole.replaceAll('_', ' '),
    );
  return text.charAt(0).toUpperCase() + text.slice(1);
};
