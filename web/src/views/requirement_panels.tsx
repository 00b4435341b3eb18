// The panels of the requirements beside the actuators and the objective: duty, supply, conditions.
import { edit, errorAt, numbers, requirements } from '../lib/requirements';
import type { Configuration, PowerKind, PumpFeed, Regulation } from '../lib/types';
import { areEvacuated, hasTank, haveVacuumRail, isRailPumped, vacuumSources } from '../lib/vacuum';
import { familyWord } from '../lib/words';
import { Check, Panel, Segmented } from '../ui/controls';
import { RequirementField } from './requirement_field';

const configurations: { value: Configuration; label: string }[] = [
  { value: 'compressor', label: 'Compressor and reservoir' },
  { value: 'cylinder', label: 'Compressed air cylinder' },
  { value: 'co2', label: 'Liquid CO₂' },
  { value: 'mains', label: 'Wall supply' },
  { value: 'tank', label: 'Tank filled beforehand' },
  { value: 'tank_and_pump', label: 'Tank filled beforehand, with a pump' },
  { value: 'direct_pump', label: 'Pump without a reservoir' },
];

// A design without such a part takes none of them.
const onlyThese = (family: string): string =>
  family === 'tubing'
    ? 'Only one of these tubes'
    : `If there is a ${familyWord(family)}${family === 'co2' ? ' bottle' : ''}, only one of these`;

const giveWall = (on: boolean): void =>
  edit(
    ['supply', 'mains'],
    on ? { pressure_kpa_gauge: 600, flow_l_per_min_anr_max: 200 } : undefined,
  );

export function Supply() {
  const supply = requirements.value.supply ?? {};
  const chosen = supply.configurations ?? ['cylinder', 'co2', 'compressor'];
  const toggle = (name: Configuration, on: boolean) => {
    const next = configurations
      .map((c) => c.value)
      .filter((c) => (c === name ? on : chosen.includes(c)));
    edit(['supply', 'configurations'], next);
    if (name === 'mains') giveWall(on);
    if (!next.some(hasTank)) edit(['supply', 'tank_fill_kpa_gauge_max'], undefined);
    if (name === 'direct_pump' && !on) {
      edit(['supply', 'pumps'], undefined);
      edit(['supply', 'hold_on'], undefined);
    }
  };
  const leaveDirect = () => {
    if (areEvacuated(numbers.value)) return;
    edit(['supply', 'configurations'], ['direct_pump']);
    edit(['supply', 'mains'], undefined);
    edit(['supply', 'tank_fill_kpa_gauge_max'], undefined);
  };
  const wrong =
    errorAt('/supply/configurations') ??
    errorAt('/supply/mains') ??
    errorAt('/supply/pumps') ??
    errorAt('/supply/hold_on') ??
    errorAt('/supply/vacuum');
  const vacuum = areEvacuated(numbers.value);
  const rail = !vacuum && haveVacuumRail(requirements.value);
  const evacuating = vacuumSources(requirements.value);
  const evacuateBy = (source: string, on: boolean) => {
    const { mains, ...rest } = supply.vacuum ?? {};
    const sources = ['pump', 'ejector', 'mains'].filter((one) =>
      one === source ? on : evacuating.includes(one),
    );
    edit(['supply', 'vacuum'], {
      ...rest,
      configurations: sources,
      ...(sources.includes('mains') && { mains: mains ?? { pressure_kpa_gauge: -80 } }),
    });
    if (source === 'ejector') giveWall(on);
  };
  return (
    <Panel title="Supply">
      {vacuum && (
        <>
          <p class="hint">
            Operating pressures below ambient: vacuum pumps or ejectors, with a reservoir or
            straight to the actuators, or a vacuum from the wall. Ejectors take compressed air all
            the while.
          </p>
          <div
            class="checks"
            role="group"
            aria-label="Kinds of vacuum to consider"
            data-pointer="/supply/vacuum/configurations"
            tabIndex={-1}
          >
            <Check
              label="Vacuum pump"
              checked={evacuating.includes('pump')}
              onChange={(on) => evacuateBy('pump', on)}
            />
            <Check
              label="Ejector on the wall's compressed air"
              checked={evacuating.includes('ejector')}
              onChange={(on) => evacuateBy('ejector', on)}
            />
            <Check
              label="Vacuum from the wall"
              checked={evacuating.includes('mains')}
              onChange={(on) => evacuateBy('mains', on)}
            />
          </div>
        </>
      )}
      {!vacuum && (
        <div
          class="checks"
          role="group"
          aria-label="Kinds of supply to consider"
          data-pointer="/supply/configurations"
          tabIndex={-1}
        >
          {configurations.map((c) => (
            <Check
              key={c.value}
              label={c.label}
              checked={chosen.includes(c.value)}
              onChange={(on) => toggle(c.value, on)}
            />
          ))}
        </div>
      )}
      {rail && (
        <Segmented<'pump' | 'mains'>
          label="Vacuum beside the pressure"
          options={[
            { value: 'pump', label: 'a vacuum pump' },
            { value: 'mains', label: 'from the wall' },
          ]}
          value={isRailPumped(requirements.value) ? 'pump' : 'mains'}
          onChange={(source) =>
            edit(
              ['supply', 'vacuum'],
              source === 'mains'
                ? { configurations: ['mains'], mains: { pressure_kpa_gauge: -80 } }
                : { configurations: ['pump'] },
            )
          }
        />
      )}
      {wrong && <p class="error">{wrong}</p>}
      {(vacuum || chosen.includes('direct_pump')) && (
        <>
          <Segmented<PumpFeed>
            label="Pumps without a reservoir"
            options={[
              { value: 'shared', label: 'for all' },
              { value: 'per_group', label: 'for each group' },
              { value: 'per_actuator', label: 'for each actuator' },
            ]}
            value={supply.pumps ?? 'shared'}
            onChange={(pumps) => {
              edit(['supply', 'pumps'], pumps === 'shared' ? undefined : pumps);
              if (pumps !== 'shared') leaveDirect();
            }}
          />
          <Check
            label="Pumps run on while actuators hold"
            checked={supply.hold_on ?? false}
            onChange={(on) => {
              edit(['supply', 'hold_on'], on || undefined);
              if (on) leaveDirect();
            }}
          />
        </>
      )}
      <Segmented<PowerKind>
        label="Power from"
        options={[
          { value: 'battery', label: 'a battery' },
          { value: 'wall', label: 'the wall' },
          { value: 'robot', label: 'the robot' },
        ]}
        value={supply.power?.kind ?? 'battery'}
        onChange={(kind) =>
          edit(
            ['supply', 'power'],
            kind === 'battery' ? undefined : kind === 'wall' ? { kind } : { kind, voltage_v: 24 },
          )
        }
      />
      {requirements.value.actuators.length > 1 && !vacuum && (
        <Segmented<Regulation>
          label="Regulators"
          options={[
            { value: 'shared', label: 'one for all' },
            { value: 'per_group', label: 'one a group' },
            { value: 'any', label: 'either' },
          ]}
          value={supply.regulation ?? 'shared'}
          onChange={(regulation) =>
            edit(['supply', 'regulation'], regulation === 'shared' ? undefined : regulation)
          }
        />
      )}
      <div class="fields">
        {supply.power?.kind === 'robot' && (
          <>
            <RequirementField
              label="Voltage of the robot"
              unit="V"
              path={['supply', 'power', 'voltage_v']}
              range={[0.1, 1000]}
            />
            <RequirementField
              label="Its energy, at most"
              unit="Wh"
              optional
              path={['supply', 'power', 'energy_wh_max']}
            />
            <RequirementField
              label="Its current, at most"
              unit="A"
              optional
              path={['supply', 'power', 'current_a_max']}
            />
          </>
        )}
        {supply.mains && (
          <>
            <RequirementField
              label="Wall pressure"
              kind="pressure"
              path={['supply', 'mains', 'pressure_kpa_gauge']}
              range={[1, 10000]}
            />
            <RequirementField
              label="Wall flow, at most"
              unit="L/min ANR"
              optional
              path={['supply', 'mains', 'flow_l_per_min_anr_max']}
              hint="at 100 kPa and 20 °C"
            />
          </>
        )}
        {supply.vacuum?.mains && (
          <>
            <RequirementField
              label="Vacuum of the wall"
              kind="pressure"
              path={['supply', 'vacuum', 'mains', 'pressure_kpa_gauge']}
              range={[-100, -1]}
            />
          </>
        )}
        {(vacuum || (rail && isRailPumped(requirements.value))) && (
          <RequirementField
            label="Vacuum, no deeper than"
            kind="pressure"
            optional
            path={['supply', 'vacuum', 'vacuum_kpa_gauge_min']}
            range={[-100, -1]}
          />
        )}
        {!vacuum && (
          <RequirementField
            label="Source pressure, at most"
            kind="pressure"
            optional
            path={['supply', 'source_pressure_kpa_gauge_max']}
            range={[1, 50000]}
          />
        )}
        {chosen.some(hasTank) && (
          <RequirementField
            label="Tank filled to, at most"
            kind="pressure"
            optional
            path={['supply', 'tank_fill_kpa_gauge_max']}
            range={[1, 50000]}
            hint="and never above its rating"
          />
        )}
        <RequirementField
          label="Mass, at most"
          unit="kg"
          optional
          path={['supply', 'mass_kg_max']}
        />
        <RequirementField
          label="Volume, at most"
          kind="volume_l"
          optional
          path={['supply', 'volume_l_max']}
        />
        <RequirementField
          label="Cost, at most"
          unit="€"
          optional
          path={['supply', 'cost_eur_max']}
          hint="parts without a price drop out"
        />
      </div>
    </Panel>
  );
}

export function Duty() {
  const { duty } = requirements.value;
  return (
    <Panel title="Duty">
      <div class="fields">
        <RequirementField
          label="Frequency"
          unit="Hz"
          path={['duty', 'frequency_hz']}
          range={[1e-4, 100]}
          hint="or every 3 s"
        />
        <RequirementField
          label="Actuations"
          path={['duty', 'actuations']}
          hint="without refill or recharge, or for how long: 2 h"
        />
        <RequirementField
          label="Rise counts up to"
          unit="of operating"
          path={['rise', 'to_fraction']}
          usual={0.95}
          range={[0, 1]}
        />
        <RequirementField
          label="Fall counts down to"
          unit="of operating"
          path={['fall', 'to_fraction']}
          usual={0.05}
          range={[0, 1]}
        />
      </div>
      <Segmented
        label="Groups act"
        options={[
          { value: 'together', label: 'together' },
          { value: 'staggered', label: 'evenly staggered' },
        ]}
        value={duty.simultaneous === false ? 'staggered' : 'together'}
        onChange={(v) => edit(['duty', 'simultaneous'], v === 'together')}
      />
    </Panel>
  );
}

export function Conditions() {
  const { exclude, require, own } = requirements.value;
  const most = [
    ['compressors_max', 'Compressors', 2],
    ['batteries_max', 'Batteries', 4],
    ['cylinders_max', 'Cylinders', 4],
    ['co2_max', 'CO₂ cartridges', 4],
    ['reservoirs_max', 'Reservoirs', 2],
  ] as const;
  return (
    <details class="panel">
      <summary>Ambient, numbers of parts, left out parts</summary>
      <div class="fields">
        <RequirementField
          label="Ambient pressure"
          kind="absolute"
          path={['ambient', 'pressure_kpa_abs']}
          usual={100}
          range={[20, 200]}
        />
        <RequirementField
          label="Ambient temperature"
          unit="K"
          path={['ambient', 'temperature_k']}
          usual={293.15}
          range={[200, 350]}
        />
        {most.map(([name, label, usual]) => (
          <RequirementField
            key={name}
            label={`${label}, at most`}
            path={['limits', name]}
            usual={usual}
            range={[1, 16]}
          />
        ))}
      </div>
      <IdList
        label="Left out parts"
        ids={exclude ?? []}
        onChange={(ids) => edit(['exclude'], ids.length ? ids : undefined)}
      />
      {Object.entries(require ?? {}).map(([family, ids]) => (
        <IdList
          key={family}
          label={onlyThese(family)}
          ids={ids}
          onChange={(next) => edit(['require', family], next.length ? next : undefined)}
        />
      ))}
      <IdList
        label="At hand, free"
        ids={own ?? []}
        onChange={(ids) => edit(['own'], ids.length ? ids : undefined)}
      />
      <p class="hint">
        Parts are left out, required or said to be at hand on their page in the catalogue.
      </p>
    </details>
  );
}

const IdList = (props: { label: string; ids: string[]; onChange: (ids: string[]) => void }) =>
  props.ids.length === 0 ? null : (
    <p class="id-list">
      {props.label}:
      {props.ids.map((id) => (
        <button
          key={id}
          type="button"
          class="chip"
          aria-label={`Remove ${id}`}
          onClick={() => props.onChange(props.ids.filter((other) => other !== id))}
        >
          {id} ✕
        </button>
      ))}
    </p>
  );
