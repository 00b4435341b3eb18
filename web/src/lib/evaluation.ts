// How a design's parts do at settings and requirements of one's own, as the service evaluates it.
import { post } from './api';
import type { Design, Margin, Requirements } from './types';

export interface Evaluation {
  works: boolean | null; // null: not known
  detail?: string; // why not
  source_pressure_range_kpa_gauge: [number, number | null] | null;
  totals?: Design['totals'];
  performance?: Design['performance'];
  margins?: Margin[];
}

// What may be tried on a design; 1 or the design's own value changes nothing.
export interface Change {
  source_kpa: number;
  reservoir_ml: number | null; // null: as designed, none or one that is bought
  tube: number; // factors
  rest_volume: number;
  expansion: number;
  operating: number;
  frequency: number;
  actuations: number;
}

const isMade = (design: Design): boolean =>
  design.parts.some(({ family, id }) => family === 'reservoir' && id === 'custom');

export const asDesigned = (design: Design): Change => ({
  source_kpa: design.settings.source_pressure_kpa_gauge,
  reservoir_ml: isMade(design) ? design.settings.reservoir_volume_ml : null,
  tube: 1,
  rest_volume: 1,
  expansion: 1,
  operating: 1,
  frequency: 1,
  actuations: 1,
});

// The requirements as they are with the change. Limits on a pressure move with the pressure.
export function changed(requirements: Requirements, change: Change): Requirements {
  return {
    ...requirements,
    actuators: requirements.actuators.map((group) => ({
      ...group,
      tube_length_m: Math.min(100, Math.max(0.01, group.tube_length_m * change.tube)),
      ...(group.rest_volume_ml !== undefined && {
        rest_volume_ml: group.rest_volume_ml * change.rest_volume,
      }),
      ...(group.expansion_ratio !== undefined && {
        expansion_ratio: Math.max(1, group.expansion_ratio * change.expansion),
      }),
      ...(group.pressure_volume && {
        pressure_volume: group.pressure_volume.map((p) => ({
          ...p,
          volume_ml: p.volume_ml * change.rest_volume,
        })),
      }),
      operating_pressure_kpa_gauge: group.operating_pressure_kpa_gauge * change.operating,
      ...(group.pressure_kpa_gauge_max && {
        pressure_kpa_gauge_max: group.pressure_kpa_gauge_max * change.operating,
      }),
    })),
    duty: {
      ...requirements.duty,
      frequency_hz: requirements.duty.frequency_hz * change.frequency,
      actuations: Math.max(1, Math.round(requirements.duty.actuations * change.actuations)),
    },
  };
}

// Metres of tube that a group needs.
const tubeOf = (requirements: Requirements, name: string | null): number => {
  const group = requirements.actuators.find((g, i) => (g.name ?? `group ${i + 1}`) === name)!;
  return (group.count ?? 1) * group.tube_length_m;
};

export const evaluate = (
  design: Design,
  requirements: Requirements,
  change: Change,
): Promise<Evaluation> =>
  post<Evaluation>('/v1/evaluations', {
    schema: 'evaluation/1',
    requirements: changed(requirements, change),
    design: {
      configuration: design.configuration,
      parts: design.parts.map(({ family, id, group, quantity }) => ({
        family,
        id,
        ...(group !== null && { group }),
        quantity: family === 'tubing' ? tubeOf(changed(requirements, change), group) : quantity,
      })),
      settings: {
        source_pressure_kpa_gauge: change.source_kpa,
        reservoir_volume_ml: change.reservoir_ml,
      },
    },
  });
