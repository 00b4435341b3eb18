// The groups of equal actuators, one block of fields each.
import { edit, errorAt, requirements } from '../lib/requirements';
import type { Group } from '../lib/types';
import { NumberField, TextField } from '../ui/controls';

const blank = (n: number): Group => ({
  name: `group ${n}`,
  count: 1,
  rest_volume_ml: 50,
  expansion_ratio: 1.5,
  operating_pressure_kpa_gauge: 100,
  tube_length_m: 0.5,
  fittings_per_line: 2,
  rise_time_s_max: 0.5,
  fall_time_s_max: 0.6,
});

export function Groups() {
  const groups = requirements.value.actuators;
  return (
    <>
      {groups.map((group, i) => (
        <GroupFields key={i} group={group} index={i} alone={groups.length === 1} />
      ))}
      <button
        type="button"
        class="quiet"
        onClick={() => edit(['actuators'], [...groups, blank(groups.length + 1)])}
      >
        + Add a group
      </button>
    </>
  );
}

function GroupFields({ group, index, alone }: { group: Group; index: number; alone: boolean }) {
  const at = `/actuators/${index}`;
  const set = (name: keyof Group) => (value: number | null) =>
    edit(['actuators', index, name], value ?? (name.endsWith('_max') ? undefined : null));
  const field = (name: keyof Group) => ({
    value: group[name] as number | null | undefined,
    onChange: set(name),
    pointer: `${at}/${name}`,
    error: errorAt(`${at}/${name}`),
  });
  const groups = requirements.value.actuators;
  return (
    <fieldset class="group">
      <legend>{group.name || `group ${index + 1}`}</legend>
      <div class="fields">
        <TextField
          label="Group"
          value={group.name}
          error={errorAt(`${at}/name`)}
          onChange={(v) => edit(['actuators', index, 'name'], v)}
        />
        <NumberField label="Actuators" {...field('count')} range={[1, 64]} />
        {group.pressure_volume ? (
          <div class="field">
            <span class="label">Volume law</span>
            <span class="hint">
              measured, {group.pressure_volume.length} points{' '}
              <button
                type="button"
                class="quiet small"
                onClick={() =>
                  edit(['actuators', index], {
                    ...group,
                    pressure_volume: undefined,
                    rest_volume_ml: group.pressure_volume![0]!.volume_ml,
                    expansion_ratio: 1,
                  })
                }
              >
                use a ratio
              </button>
            </span>
          </div>
        ) : (
          <>
            <NumberField
              label="Volume at rest"
              kind="volume_ml"
              {...field('rest_volume_ml')}
              range={[0.01, 1e6]}
            />
            <NumberField
              label="Expansion"
              unit="× at operating"
              {...field('expansion_ratio')}
              range={[1, 50]}
              hint="1 is rigid"
            />
          </>
        )}
        <NumberField
          label="Operating pressure"
          kind="pressure"
          {...field('operating_pressure_kpa_gauge')}
          range={[1, 1e4]}
        />
        <NumberField
          label="Pressure, at most"
          placeholder="1.05 × operating"
          kind="pressure"
          optional
          {...field('pressure_kpa_gauge_max')}
        />
        <NumberField label="Rise time, at most" unit="s" optional {...field('rise_time_s_max')} />
        <NumberField label="Fall time, at most" unit="s" optional {...field('fall_time_s_max')} />
        <NumberField label="Tube length" unit="m" {...field('tube_length_m')} range={[0.01, 100]} />
        <NumberField
          label="Fittings per line"
          {...field('fittings_per_line')}
          value={group.fittings_per_line ?? 2}
          range={[0, 13]}
        />
      </div>
      {!alone && (
        <button
          type="button"
          class="quiet small remove"
          onClick={() =>
            edit(
              ['actuators'],
              groups.filter((_, i) => i !== index),
            )
          }
        >
          Remove {group.name || 'group'}
        </button>
      )}
    </fieldset>
  );
}
