// What is best, how many designs, what else to find out, and the model that ranks.
import { models } from '../lib/models';
import { edit, errorAt, requirements } from '../lib/requirements';
import type { Amount } from '../lib/types';
import { Check, Panel, Segmented, Select } from '../ui/controls';
import { RequirementField } from './requirement_field';

const amounts: { value: Amount; label: string }[] = [
  { value: 'mass_kg', label: 'mass' },
  { value: 'volume_l', label: 'volume' },
  { value: 'cost_eur', label: 'cost' },
  { value: 'energy_wh', label: 'energy' },
];

export function Objective() {
  const { objective, ranking, robust, explain, guarantee, model, supply, prices } =
    requirements.value;
  const pareto = objective?.pareto;
  const minimize = typeof objective?.minimize === 'string' ? objective.minimize : 'mass_kg';
  const weights = typeof objective?.minimize === 'object' ? objective.minimize : undefined;
  const mode = pareto ? 'front' : weights ? 'weighted' : 'least';
  const setMode = (next: 'least' | 'weighted' | 'front') =>
    edit(
      ['objective'],
      next === 'front'
        ? { pareto: ['mass_kg', 'volume_l'] }
        : next === 'weighted'
          ? { minimize: { mass_kg: 1, volume_l: 0.3 } }
          : { minimize: 'mass_kg' },
    );
  const setPareto = (amount: Amount, on: boolean) =>
    edit(['objective'], {
      pareto: amounts.map((a) => a.value).filter((a) => (a === amount ? on : pareto?.includes(a))),
    });
  return (
    <Panel title="Objective and ranking">
      <Segmented
        label="Rank by"
        value={mode}
        onChange={setMode}
        options={[
          { value: 'least', label: 'least' },
          { value: 'weighted', label: 'weighted sum' },
          { value: 'front', label: 'Pareto front' },
        ]}
      />
      {mode === 'least' && (
        <Segmented
          label="of"
          options={amounts}
          value={minimize}
          onChange={(v) => edit(['objective'], { minimize: v })}
        />
      )}
      {mode === 'front' && (
        <div
          class="checks"
          role="group"
          aria-label="Amounts of the front"
          data-pointer="/objective/pareto"
          tabIndex={-1}
        >
          {amounts.map((a) => (
            <Check
              key={a.value}
              label={a.label}
              checked={pareto?.includes(a.value) ?? false}
              onChange={(on) => setPareto(a.value, on)}
            />
          ))}
        </div>
      )}
      {errorAt('/objective/pareto') && <p class="error">{errorAt('/objective/pareto')}</p>}
      <div class="fields">
        {mode === 'weighted' &&
          amounts.map((a) => (
            <RequirementField
              key={a.value}
              label={`Weight of ${a.label}`}
              path={['objective', 'minimize', a.value]}
              usual={0}
            />
          ))}
        <RequirementField
          label="Designs to list"
          path={['ranking', 'count']}
          usual={20}
          range={[1, 500]}
        />
        {robust && mode !== 'front' && (
          <RequirementField
            label="Probability, at least"
            optional
            placeholder="any"
            path={['ranking', 'probability_min']}
            range={[0, 1]}
          />
        )}
        <RequirementField
          label="Time limit"
          unit="s"
          path={['ranking', 'time_limit_s']}
          usual={30}
          range={[0.01, 3600]}
        />
        {mode !== 'front' && (
          <Select
            label="List"
            value={ranking?.list ?? 'kinds'}
            options={[
              { value: 'kinds', label: 'the best of each kind' },
              { value: 'combinations', label: 'all combinations alike' },
            ]}
            onChange={(v) => edit(['ranking', 'list'], v === 'kinds' ? undefined : v)}
          />
        )}
        <Select
          label="Parts"
          value={supply?.parts ?? 'any'}
          options={[
            { value: 'any', label: 'any of the catalogue' },
            { value: 'orderable', label: 'products to order alone' },
          ]}
          onChange={(v) => edit(['supply', 'parts'], v === 'any' ? undefined : v)}
        />
        <Select
          label="Unknown prices"
          value={prices ?? 'known'}
          options={[
            { value: 'known', label: 'rank what has all prices' },
            { value: 'lower_bound', label: 'count as 0' },
          ]}
          onChange={(v) => edit(['prices'], v === 'known' ? undefined : v)}
        />
        <Select
          label="Solver of settings"
          value={ranking?.solver ?? 'ipopt'}
          options={[
            { value: 'ipopt', label: 'Ipopt' },
            { value: 'nlopt', label: 'NLopt (second opinion)' },
          ]}
          onChange={(v) => edit(['ranking', 'solver'], v === 'ipopt' ? undefined : v)}
        />
      </div>
      <div class="checks">
        <Check
          label="Probability of meeting everything within the parts' tolerances"
          checked={robust !== undefined}
          onChange={(on) => edit(['robust'], on ? {} : undefined)}
        />
        {mode !== 'front' && (
          <Check
            label="Guarantee: everything is met with every number of the parts within its tolerance"
            checked={guarantee !== undefined && guarantee !== false}
            onChange={(on) => edit(['guarantee'], on ? true : undefined)}
          />
        )}
        {errorAt('/guarantee') && <p class="error">{errorAt('/guarantee')}</p>}
        {mode !== 'front' && (
          <Check
            label="What each requirement costs"
            checked={explain !== undefined}
            onChange={(on) => edit(['explain'], on ? { prices: true, ranks: 4 } : undefined)}
          />
        )}
      </div>
      {models.value.length > 0 && (
        <Select
          label="Model"
          value={model ?? 'nominal'}
          options={[
            { value: 'nominal', label: 'nominal' },
            ...models.value.map((m) => ({ value: m.name, label: m.name })),
          ]}
          onChange={(v) => edit(['model'], v === 'nominal' ? undefined : v)}
        />
      )}
      {errorAt('/model') && <p class="error">{errorAt('/model')}</p>}
    </Panel>
  );
}
