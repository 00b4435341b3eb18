// The groups of equal actuators, one block of fields each.
import { edit, errorAt, numbers, requirements } from '../lib/requirements';
import type { Group } from '../lib/types';
import { areEvacuated, haveVacuumRail, isEvacuated } from '../lib/vacuum';
import { TextField } from '../ui/controls';
import { RequirementField } from './requirement_field';
import { GaitFields } from './gait_fields';
import { VolumeFields } from './volume_fields';

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

// Actuators under pressure that stay above ambient need no vacuum; others have pumps by default.
function fitVacuum() {
  if (areEvacuated(requirements.value) || haveVacuumRail(requirements.value)) return;
  edit(['supply', 'vacuum'], undefined);
}

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
  const path = (name: keyof Group) => ['actuators', index, name];
  const groups = requirements.value.actuators;
  const evacuated = isEvacuated(numbers.value.actuators[index] ?? group);
  return (
    <fieldset class="group">
      <legend>{group.name || `group ${index + 1}`}</legend>
      <div class="fields">
        <TextField
          label="Group"
          value={group.name}
          error={errorAt(`${at}/name`)}
          pointer={`${at}/name`}
          onChange={(v) => edit(['actuators', index, 'name'], v)}
        />
        <RequirementField label="Actuators" path={path('count')} range={[1, 64]} />
        <VolumeFields group={group} index={index} />
        <RequirementField
          label="Operating pressure"
          kind="pressure"
          path={path('operating_pressure_kpa_gauge')}
          range={[-99, 1e4]}
          hint="below 0: evacuated"
        />
        {(!evacuated || group.low_pressure_kpa_gauge !== undefined) && (
          <RequirementField
            label="Low pressure"
            placeholder="0"
            hint="below 0: pulled there by a vacuum"
            kind="pressure"
            optional
            path={path('low_pressure_kpa_gauge')}
            range={[-99, 0]}
            then={fitVacuum}
          />
        )}
        {(evacuated || group.pressure_kpa_gauge_min !== undefined) && (
          <RequirementField
            label="Pressure, at least"
            placeholder="1.05 ×"
            hint="1.05 × operating if empty"
            kind="pressure"
            optional
            path={path('pressure_kpa_gauge_min')}
          />
        )}
        {(!evacuated || group.pressure_kpa_gauge_max !== undefined) && (
          <RequirementField
            label="Pressure, at most"
            placeholder="1.05 ×"
            hint="1.05 × operating if empty"
            kind="pressure"
            optional
            path={path('pressure_kpa_gauge_max')}
          />
        )}
        <RequirementField
          label="Rise time, at most"
          unit="s"
          optional
          path={path('rise_time_s_max')}
        />
        <RequirementField
          label="Fall time, at most"
          unit="s"
          optional
          path={path('fall_time_s_max')}
        />
        <RequirementField
          label="Tube length"
          unit="m"
          path={path('tube_length_m')}
          range={[0.01, 100]}
        />
        <RequirementField
          label="Fittings per line"
          path={path('fittings_per_line')}
          usual={2}
          range={[0, 5]}
        />
      </div>
      <GaitFields group={group} index={index} />
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
