// The rig that a CSV was measured on.
import { measurement, measurementErrors, type Rig } from '../lib/measurement';
import { namesUnit } from '../lib/understood';
import { Check, NumberField, Panel, Select } from '../ui/controls';

export function RigForm() {
  const data = measurement.value!;
  const { supply } = data.rig;
  const set = (rig: Partial<Rig>) =>
    (measurement.value = { ...data, rig: { ...data.rig, ...rig } });
  // Of one block of the rig, by name.
  const field = (block: 'actuator' | 'line', name: string) => {
    const put = (v: number | string | null) =>
      set({ [block]: { ...data.rig[block], [name]: v ?? undefined } });
    return {
      value: (data.rig[block] as Record<string, number | string | undefined>)[name],
      error: errorAt(`/rig/${block}/${name}`),
      pointer: `/rig/${block}/${name}`,
      takesUnits: namesUnit(name),
      onChange: put,
      onText: put,
    };
  };
  const errorAt = (pointer: string) =>
    measurementErrors.value.find((e) => e.pointer === pointer)?.detail;
  const source = data.runs[0]?.source_pressure_kpa_gauge;
  const sourcesDiffer = data.runs.some((run) => run.source_pressure_kpa_gauge !== source);
  // Of one run, or of all.
  const putSource = (alone?: number) => (v: number | string | null) =>
    (measurement.value = {
      ...data,
      runs: data.runs.map((run, i) =>
        i === (alone ?? i) ? { ...run, source_pressure_kpa_gauge: v ?? undefined } : run,
      ),
    });
  const sigma = data.relative_uncertainty ?? {};
  const putSigma = (name: string) => (v: number | string | null) => {
    const { [name]: _, ...others } = sigma;
    measurement.value = {
      ...data,
      relative_uncertainty: v === null ? others : { ...others, [name]: v },
    };
  };
  const uncertain = (name: string) => ({
    value: sigma[name] === 'unknown' ? null : sigma[name],
    error: errorAt(`/relative_uncertainty/${name}`),
    pointer: `/relative_uncertainty/${name}`,
    onChange: putSigma(name),
    onText: putSigma(name),
    unit: '1 σ, share',
    optional: true,
    placeholder: 'exact',
    isShare: true,
    hint: 'such as 0.03 or 3 %',
  });
  return (
    <Panel title="The rig it was measured on">
      <p class="hint">A CSV holds no numbers of its rig: write those of yours.</p>
      <div class="fields">
        <NumberField
          label="Volume at rest"
          kind="volume_ml"
          hint="of the actuator without pressure"
          {...field('actuator', 'rest_volume_ml')}
        />
        <NumberField
          label="Expansion"
          unit="× at operating"
          hint="volume at operating pressure by volume at rest; 1 is rigid"
          {...field('actuator', 'expansion_ratio')}
        />
        <NumberField
          label="Operating pressure"
          kind="pressure"
          {...field('actuator', 'operating_pressure_kpa_gauge')}
        />
        <NumberField
          label="Conductance C of the line"
          unit="dm³/(s·bar)"
          hint="of valve, fittings and tube in series"
          {...field('line', 'sonic_conductance_dm3_per_s_bar')}
        />
        <NumberField
          label="Critical ratio b"
          hint="of the line; 0.3 is usual"
          {...field('line', 'critical_ratio')}
        />
        <NumberField label="C uncertain by" {...uncertain('sonic_conductance')} />
        <NumberField label="Volume uncertain by" {...uncertain('rest_volume')} />
        {supply.kind === 'regulated' && (
          <NumberField
            label="Source pressure"
            kind="pressure"
            value={sourcesDiffer ? undefined : source}
            optional={sourcesDiffer}
            placeholder="by run, below"
            hint={data.runs.length > 1 ? 'of the regulator, in all runs' : 'of the regulator'}
            error={errorAt('/runs/0/source_pressure_kpa_gauge')}
            pointer="/runs/0/source_pressure_kpa_gauge"
            takesUnits
            onChange={putSource()}
            onText={putSource()}
          />
        )}
      </div>
      {supply.kind === 'regulated' && data.runs.length > 1 && (
        <details open={sourcesDiffer}>
          <summary>Another source pressure in some runs</summary>
          <div class="fields">
            {data.runs.slice(0, 20).map((run, i) => (
              <NumberField
                key={run.id}
                label={`Source in ${run.id}`}
                kind="pressure"
                value={run.source_pressure_kpa_gauge}
                error={errorAt(`/runs/${i}/source_pressure_kpa_gauge`)}
                pointer={`/runs/${i}/source_pressure_kpa_gauge`}
                takesUnits
                onChange={putSource(i)}
                onText={putSource(i)}
              />
            ))}
          </div>
        </details>
      )}
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
