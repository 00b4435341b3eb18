// The panels of the requirements beside the actuators and the objective: duty, supply, conditions.
import { edit, errorAt, requirements } from '../lib/requirements';
import type { Configuration } from '../lib/types';
import { Check, NumberField, Panel, Segmented } from '../ui/controls';

const configurations: { value: Configuration; label: string }[] = [
  { value: 'compressor', label: 'Compressor and reservoir' },
  { value: 'cylinder', label: 'Compressed air cylinder' },
  { value: 'co2', label: 'Liquid CO₂' },
  { value: 'mains', label: 'Wall supply' },
];

export function Supply() {
  const supply = requirements.value.supply ?? {};
  const chosen = supply.configurations ?? ['cylinder', 'co2', 'compressor'];
  const toggle = (name: Configuration, on: boolean) => {
    const next = configurations
      .map((c) => c.value)
      .filter((c) => (c === name ? on : chosen.includes(c)));
    edit(['supply', 'configurations'], next);
    if (name === 'mains')
      edit(
        ['supply', 'mains'],
        on ? { pressure_kpa_gauge: 600, flow_l_per_min_anr_max: 200 } : undefined,
      );
  };
  const limit = (name: string, value: number | null) => edit(['supply', name], value ?? undefined);
  const mains = supply.mains;
  const wrong = errorAt('/supply/configurations') ?? errorAt('/supply/mains');
  return (
    <Panel title="Supply">
      <div class="checks" role="group" aria-label="Kinds of supply to consider">
        {configurations.map((c) => (
          <Check
            key={c.value}
            label={c.label}
            checked={chosen.includes(c.value)}
            onChange={(on) => toggle(c.value, on)}
          />
        ))}
      </div>
      {wrong && <p class="error">{wrong}</p>}
      <div class="fields">
        {mains && (
          <>
            <NumberField
              label="Wall pressure"
              kind="pressure"
              value={mains.pressure_kpa_gauge}
              range={[1, 10000]}
              pointer="/supply/mains/pressure_kpa_gauge"
              error={errorAt('/supply/mains/pressure_kpa_gauge')}
              onChange={(v) => edit(['supply', 'mains', 'pressure_kpa_gauge'], v)}
            />
            <NumberField
              label="Wall flow, at most"
              unit="L/min ANR"
              optional
              value={mains.flow_l_per_min_anr_max}
              pointer="/supply/mains/flow_l_per_min_anr_max"
              error={errorAt('/supply/mains/flow_l_per_min_anr_max')}
              onChange={(v) => edit(['supply', 'mains', 'flow_l_per_min_anr_max'], v ?? undefined)}
            />
          </>
        )}
        <NumberField
          label="Source pressure, at most"
          kind="pressure"
          optional
          value={supply.source_pressure_kpa_gauge_max}
          pointer="/supply/source_pressure_kpa_gauge_max"
          error={errorAt('/supply/source_pressure_kpa_gauge_max')}
          onChange={(v) => limit('source_pressure_kpa_gauge_max', v)}
        />
        <NumberField
          label="Mass, at most"
          unit="kg"
          optional
          value={supply.mass_kg_max}
          error={errorAt('/supply/mass_kg_max')}
          pointer="/supply/mass_kg_max"
          onChange={(v) => limit('mass_kg_max', v)}
        />
        <NumberField
          label="Volume, at most"
          kind="volume_l"
          optional
          value={supply.volume_l_max}
          error={errorAt('/supply/volume_l_max')}
          pointer="/supply/volume_l_max"
          onChange={(v) => limit('volume_l_max', v)}
        />
        <NumberField
          label="Cost, at most"
          unit="€"
          optional
          value={supply.cost_eur_max}
          error={errorAt('/supply/cost_eur_max')}
          pointer="/supply/cost_eur_max"
          hint="parts without a price drop out"
          onChange={(v) => limit('cost_eur_max', v)}
        />
      </div>
    </Panel>
  );
}

export function Duty() {
  const { duty, rise, fall } = requirements.value;
  return (
    <Panel title="Duty">
      <div class="fields">
        <NumberField
          label="Frequency"
          unit="Hz"
          value={duty.frequency_hz}
          range={[1e-4, 100]}
          pointer="/duty/frequency_hz"
          error={errorAt('/duty/frequency_hz')}
          onChange={(v) => edit(['duty', 'frequency_hz'], v)}
        />
        <NumberField
          label="Actuations"
          value={duty.actuations}
          hint="without refill or recharge"
          pointer="/duty/actuations"
          error={errorAt('/duty/actuations')}
          onChange={(v) => edit(['duty', 'actuations'], v)}
        />
        <NumberField
          label="Rise counts to"
          unit="of operating"
          value={rise?.to_fraction ?? 0.95}
          range={[0, 1]}
          error={errorAt('/rise/to_fraction')}
          onChange={(v) => edit(['rise'], { to_fraction: v })}
        />
        <NumberField
          label="Fall counts to"
          unit="of operating"
          value={fall?.to_fraction ?? 0.05}
          range={[0, 1]}
          error={errorAt('/fall/to_fraction')}
          onChange={(v) => edit(['fall'], { to_fraction: v })}
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
  const { ambient, limits, exclude, require } = requirements.value;
  const most = [
    ['compressors_max', 'Compressors', 2],
    ['batteries_max', 'Batteries', 4],
    ['cylinders_max', 'Cylinders', 4],
    ['co2_max', 'CO₂ cartridges', 4],
    ['reservoirs_max', 'Reservoirs', 2],
  ] as const;
  const conditions = ambient ?? { pressure_kpa_abs: 100, temperature_k: 293.15 };
  return (
    <details class="panel">
      <summary>Ambient, numbers of parts, left out parts</summary>
      <div class="fields">
        <NumberField
          label="Ambient pressure"
          unit="kPa abs"
          value={conditions.pressure_kpa_abs}
          range={[20, 200]}
          error={errorAt('/ambient/pressure_kpa_abs')}
          onChange={(v) => edit(['ambient'], { ...conditions, pressure_kpa_abs: v })}
        />
        <NumberField
          label="Ambient temperature"
          unit="K"
          value={conditions.temperature_k}
          range={[200, 350]}
          error={errorAt('/ambient/temperature_k')}
          onChange={(v) => edit(['ambient'], { ...conditions, temperature_k: v })}
        />
        {most.map(([name, label, usual]) => (
          <NumberField
            key={name}
            label={`${label}, at most`}
            value={limits?.[name] ?? usual}
            range={[1, 16]}
            error={errorAt(`/limits/${name}`)}
            onChange={(v) => edit(['limits', name], v)}
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
          label={`Only these of ${family}`}
          ids={ids}
          onChange={(next) => edit(['require', family], next.length ? next : undefined)}
        />
      ))}
      <p class="hint">Parts are left out or required on their page in the catalogue.</p>
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
