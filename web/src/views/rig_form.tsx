// The rig that a CSV was measured on.
import { measurement, measurementErrors, type Rig } from '../lib/measurement';
import { Check, NumberField, Panel, Select } from '../ui/controls';

export function RigForm() {
  const data = measurement.value!;
  const { actuator, line, supply } = data.rig;
  const set = (rig: Partial<Rig>) =>
    (measurement.value = { ...data, rig: { ...data.rig, ...rig } });
  const setActuator = (name: keyof Rig['actuator']) => (v: number | null) =>
    set({ actuator: { ...actuator, [name]: v } });
  const setLine = (name: keyof Rig['line']) => (v: number | null) =>
    set({ line: { ...line, [name]: v } });
  const errorAt = (pointer: string) =>
    measurementErrors.value.find((e) => e.pointer === pointer)?.detail;
  const source = data.runs[0]?.source_pressure_kpa_gauge;
  const sigma = data.relative_uncertainty ?? {};
  const setSigma = (name: string) => (v: number | null) =>
    (measurement.value = {
      ...data,
      relative_uncertainty: { ...sigma, ...(v === null ? {} : { [name]: v }) },
    });
  return (
    <Panel title="The rig it was measured on">
      <div class="fields">
        <NumberField
          label="Volume at rest"
          kind="volume_ml"
          value={actuator.rest_volume_ml}
          error={errorAt('/rig/actuator/rest_volume_ml')}
          onChange={setActuator('rest_volume_ml')}
        />
        <NumberField
          label="Expansion"
          unit="× at operating"
          value={actuator.expansion_ratio}
          error={errorAt('/rig/actuator/expansion_ratio')}
          onChange={setActuator('expansion_ratio')}
        />
        <NumberField
          label="Operating pressure"
          kind="pressure"
          value={actuator.operating_pressure_kpa_gauge}
          error={errorAt('/rig/actuator/operating_pressure_kpa_gauge')}
          onChange={setActuator('operating_pressure_kpa_gauge')}
        />
        <NumberField
          label="Conductance C of the line"
          unit="dm³/(s·bar)"
          value={line.sonic_conductance_dm3_per_s_bar}
          error={errorAt('/rig/line/sonic_conductance_dm3_per_s_bar')}
          onChange={setLine('sonic_conductance_dm3_per_s_bar')}
        />
        <NumberField
          label="Critical ratio b"
          value={line.critical_ratio}
          error={errorAt('/rig/line/critical_ratio')}
          onChange={setLine('critical_ratio')}
        />
        <NumberField
          label="C uncertain by"
          unit="1 σ, share"
          value={typeof sigma.sonic_conductance === 'number' ? sigma.sonic_conductance : null}
          optional
          placeholder="exact"
          onChange={setSigma('sonic_conductance')}
        />
        <NumberField
          label="Volume uncertain by"
          unit="1 σ, share"
          value={typeof sigma.rest_volume === 'number' ? sigma.rest_volume : null}
          optional
          placeholder="exact"
          onChange={setSigma('rest_volume')}
        />
        {supply.kind === 'regulated' && (
          <NumberField
            label="Source pressure"
            kind="pressure"
            value={source}
            error={errorAt('/runs/0/source_pressure_kpa_gauge')}
            onChange={(v) =>
              (measurement.value = {
                ...data,
                runs: data.runs.map((run) => ({
                  ...run,
                  source_pressure_kpa_gauge: v ?? undefined,
                })),
              })
            }
          />
        )}
      </div>
      <div class="toolbar">
        <Select
          label="Supply"
          value={supply.kind}
          onChange={(kind) => set({ supply: { kind } })}
          options={[
            { value: 'regulated', label: 'regulated' },
            { value: 'measured', label: 'as measured (source column)' },
            { value: 'none', label: 'none: a closed or emptying chamber' },
          ]}
        />
        <span class="checks" role="group" aria-label="Runs with a blocked actuator">
          {data.runs.slice(0, 20).map((run, i) => (
            <Check
              key={run.id}
              label={`${run.id} blocked`}
              checked={run.blocked ?? false}
              onChange={(blocked) =>
                (measurement.value = {
                  ...data,
                  runs: data.runs.map((r, j) => (i === j ? { ...r, blocked } : r)),
                })
              }
            />
          ))}
        </span>
      </div>
    </Panel>
  );
}
