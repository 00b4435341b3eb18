// How a design's parts do at settings and requirements of one's own, as the service evaluates it.
import { post } from './api';
import { loadPart, numberOf } from './catalogue';
import type { Design, Margin, PartRow, Requirements } from './types';
import { isEvacuated } from './vacuum';

export interface Evaluation {
  works: boolean | null; // null: not known
  detail?: string; // why not
  source_pressure_range_kpa_gauge: [number, number | null] | null;
  totals?: Design['totals'];
  performance?: Design['performance'];
  margins?: Margin[];
  why_not_first?: { words: string[] } | null;
}

// The group that a row of a list of parts serves.
const groupOf = (requirements: Requirements, name: string | null) =>
  requirements.actuators.find((g, i) => (g.name ?? `group ${i + 1}`) === name)!;

// A design with some of its parts exchanged: for each place in the list of parts the id of another.
export const placeOf = (row: PartRow): string => `${row.family} ${row.group ?? ''}`;

// The vacuum that pumps keep beside a pressure is a setting.
const railSettings = ({ settings }: Design) =>
  settings.vacuum_stop_kpa_gauge === undefined
    ? {}
    : { vacuum_kpa_gauge: settings.vacuum_kpa_gauge };

export async function exchanged(
  design: Design,
  requirements: Requirements,
  ids: Record<string, string>,
): Promise<object> {
  const parts = await Promise.all(
    design.parts.map(async (row) => {
      const id = ids[placeOf(row)] ?? row.id;
      const place = { family: row.family, id, ...(row.group !== null && { group: row.group }) };
      if (row.family !== 'valve' || id === row.id) return { ...place, quantity: row.quantity };
      const channels = numberOf((await loadPart(id)).part, 'channels') || 1;
      return {
        ...place,
        quantity: Math.ceil((groupOf(requirements, row.group).count ?? 1) / channels),
      };
    }),
  );
  const { source_pressure_kpa_gauge, reservoir_volume_ml, tank_fill_kpa_gauge } = design.settings;
  const { group_pressure_kpa_gauge } = design.settings;
  const made = parts.some(({ family, id }) => family === 'reservoir' && id === 'custom');
  return {
    configuration: design.configuration,
    parts,
    settings: {
      source_pressure_kpa_gauge,
      ...(group_pressure_kpa_gauge && { group_pressure_kpa_gauge }),
      ...railSettings(design),
      ...(made && { reservoir_volume_ml }),
      ...(Object.keys(ids).length === 0 && { tank_fill_kpa_gauge }),
    },
  };
}

// Why a design is not before another, at its settings and at those that suit its parts best.
export const compareWith = (
  first: Design,
  design: object,
  requirements: Requirements,
): Promise<Evaluation> =>
  post<Evaluation>('/v1/evaluations', {
    schema: 'evaluation/1',
    requirements,
    design,
    beside: first,
  });

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
        expansion_ratio: isEvacuated(group)
          ? Math.min(1, Math.max(0.01, group.expansion_ratio * change.expansion))
          : Math.max(1, group.expansion_ratio * change.expansion),
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
      ...(group.pressure_kpa_gauge_min && {
        pressure_kpa_gauge_min: group.pressure_kpa_gauge_min * change.operating,
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
  const group = groupOf(requirements, name);
  return (group.count ?? 1) * group.tube_length_m;
};

// Regulators of groups are turned in step with the source.
export const groupPressures = (design: Design, change: Change): number[] | undefined => {
  const { group_pressure_kpa_gauge, source_pressure_kpa_gauge } = design.settings;
  const factor = change.source_kpa / source_pressure_kpa_gauge;
  return group_pressure_kpa_gauge?.map((kpa) => kpa * factor);
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
        group_pressure_kpa_gauge: groupPressures(design, change),
        reservoir_volume_ml: change.reservoir_ml,
        ...railSettings(design),
      },
    },
  });
