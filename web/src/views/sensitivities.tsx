// What a tenth more or less of each number does to the design as it stands.
import { useSignal } from '@preact/signals';
import { useEffect } from 'preact/hooks';

import { requirementName } from '../lib/amounts';
import { asProblem } from '../lib/api';
import { asDesigned, type Change, evaluate, type Evaluation } from '../lib/evaluation';
import { change as changeOf, pressuresInUnit } from '../lib/format';
import { route, setQuery } from '../lib/route';
import type { Design, Requirements } from '../lib/types';
import { Notice, Panel, Segmented } from '../ui/controls';
import { Swing } from '../ui/swing';
import { Table } from '../ui/table';
import { isDirect } from '../lib/vacuum';

type By = '-10' | '10';

const fullBar = 0.2; // the change that fills a bar

interface Effect {
  label: string;
  of: (e: Evaluation) => number | null;
  better: 'low' | 'high';
}

const slowest = (e: Evaluation, time: 'rise_time_s' | 'fall_time_s') =>
  Math.max(...e.performance!.groups.map((g) => g[time]));
const achieved = (e: Evaluation, requirement: string) =>
  e.margins!.find((m) => m.requirement === requirement)?.achieved ?? null;

const effects: Effect[] = [
  { label: 'rise time', of: (e) => slowest(e, 'rise_time_s'), better: 'low' },
  { label: 'fall time', of: (e) => slowest(e, 'fall_time_s'), better: 'low' },
  { label: 'sustained', of: (e) => e.performance!.frequency_hz_sustained, better: 'high' },
  { label: 'can actuate', of: (e) => achieved(e, '/duty/actuations'), better: 'high' },
  { label: 'energy', of: (e) => e.totals!.energy_wh, better: 'low' },
  { label: 'mass', of: (e) => e.totals!.mass_kg, better: 'low' },
];

const causes = (design: Design, start: Change, factor: number): [string, Partial<Change>][] => [
  // Without a reservoir it is no setting.
  ...(isDirect(design.configuration)
    ? []
    : [
        ['source pressure', { source_kpa: start.source_kpa * factor }] as [string, Partial<Change>],
      ]),
  ...(start.reservoir_ml === null
    ? []
    : [['reservoir', { reservoir_ml: start.reservoir_ml * factor }] as [string, Partial<Change>]]),
  ['tube length', { tube: factor }],
  ['actuator volume', { rest_volume: factor }],
  ['expansion', { expansion: factor }],
  ['operating pressure', { operating: factor }],
  ['frequency', { frequency: factor }],
  ['actuations', { actuations: factor }],
];

export function Sensitivities({
  design,
  requirements,
}: {
  design: Design;
  requirements: Requirements;
}) {
  const by: By = route.value.query.get('by') === '-10' ? '-10' : '10';
  const base = useSignal<Evaluation | null>(null);
  const rows = useSignal<{ label: string; found: Evaluation | null }[]>([]);
  const problem = useSignal('');
  useEffect(() => {
    const start = asDesigned(design);
    const load = async () => {
      base.value = await evaluate(design, requirements, start);
      rows.value = await Promise.all(
        causes(design, start, 1 + Number(by) / 100).map(async ([label, patch]) => ({
          label,
          // Some changes cannot be asked for: an operating pressure above what its limit allows.
          found: await evaluate(design, requirements, { ...start, ...patch }).catch(() => null),
        })),
      );
      problem.value = '';
    };
    load().catch((error) => (problem.value = asProblem(error).message));
  }, [design, by]);
  const was = base.value?.works ? base.value : null;
  const share = (effect: Effect, found: Evaluation): number | null => {
    const [before, after] = [effect.of(was!), effect.of(found)];
    return before === null || after === null || before === 0 ? null : after / before - 1;
  };
  const used = was ? effects.filter((effect) => effect.of(was) !== null) : [];
  return (
    <Panel
      title="Sensitivities"
      aside={
        <Segmented
          label="each number by"
          value={by}
          onChange={(v) => setQuery({ by: v === '10' ? undefined : v })}
          options={[
            { value: '-10', label: '−10 %' },
            { value: '10', label: '+10 %' },
          ]}
        />
      }
    >
      {problem.value && <Notice kind="bad">{problem.value}</Notice>}
      {was && (
        <Table
          label="Sensitivities"
          class="tornado"
          heads={['of', ...used.map((effect) => effect.label), 'then']}
        >
          {rows.value.map(({ label, found }) => (
            <tr key={label}>
              <th scope="row">{label}</th>
              {found?.works ? (
                used.map((effect) => {
                  const value = share(effect, found);
                  return (
                    <td key={effect.label}>
                      {value === null ? '–' : <Cell share={value} effect={effect} />}
                    </td>
                  );
                })
              ) : (
                <td colSpan={used.length} class="muted">
                  {!found
                    ? 'not possible'
                    : pressuresInUnit(
                        found.detail ?? 'the parts do not stand it, or a stroke does not end',
                      )}
                </td>
              )}
              <td>{found?.works && <Then found={found} requirements={requirements} />}</td>
            </tr>
          ))}
        </Table>
      )}
      <p class="hint">
        Parts and all other settings stay; the periodic state is worked out again for each. Bars:
        blue is better, orange worse, full at 20 %.
      </p>
    </Panel>
  );
}

const Cell = ({ share, effect }: { share: number; effect: Effect }) => (
  <span class="swing">
    <Swing share={share / fullBar} isGood={share < 0 === (effect.better === 'low')} />
    <span class="num">{changeOf(share)}</span>
  </span>
);

// Whether everything asked is still met.
function Then({ found, requirements }: { found: Evaluation; requirements: Requirements }) {
  const missed = found.margins!.filter((m) => m.relative_margin < -1e-9);
  if (missed.length === 0) return <span class="delta better">all met</span>;
  return (
    <span class="over">
      misses {missed.map((m) => requirementName(m.requirement, requirements.actuators)).join(', ')}
    </span>
  );
}
