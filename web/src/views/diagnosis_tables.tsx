// The tables of a diagnosis: errors, residuals by phase, candidates.
import { beside, shown, significant } from '../lib/format';
import { effectNames, inWords } from '../lib/effect_words';
import { type Diagnosis } from '../lib/measurement';
import { toShown, unitOf } from '../lib/units';
import { Chip, Panel } from '../ui/controls';
import { Swing } from '../ui/swing';
import { extra, heard, number, Table } from '../ui/table';

export function Errors({ d }: { d: Diagnosis }) {
  const rows: [string, Partial<Diagnosis['after']>][] = [
    ['as declared', d.declared],
    ['re-fitted, no effects', d.before],
    ...(d.effects.length > 0 || d.numbers?.length
      ? [['with what is named', d.after] as [string, Diagnosis['after']]]
      : d.tied.length > 0
        ? [['with the best of those tied', d.after] as [string, Diagnosis['after']]]
        : []),
  ];
  if (d.learned) rows.push(['with the learned term', d.learned]);
  return (
    <Table
      label="Errors of the model"
      heads={[
        'model',
        number('RMS', unitOf('difference')),
        extra(number('of operating', '%')),
        number('peak', unitOf('difference')),
        number('held out', unitOf('difference')),
      ]}
    >
      {rows.map(([label, report]) => (
        <tr key={label}>
          <th scope="row">{label}</th>
          <td class="num">{shown('difference', report.rms_kpa)}</td>
          <td class="num extra">{significant(report.rms_percent)}</td>
          <td class="num">{shown('difference', report.peak_kpa)}</td>
          <td class="num">{shown('difference', report.holdout_rms_kpa)}</td>
        </tr>
      ))}
      <tr>
        <td>noise of the readings</td>
        <td class="num">{shown('difference', d.noise_kpa)}</td>
        <td class="extra" />
        <td />
        <td />
      </tr>
    </Table>
  );
}

// Tests are left out where the time ran out: null.
function Test(p: { passed: boolean | null; yes: string; no: string; untested: string }) {
  if (p.passed === null) return <Chip>{p.untested}</Chip>;
  return <Chip kind={p.passed ? 'good' : 'warn'}>{p.passed ? p.yes : p.no}</Chip>;
}

export function Phases({ d }: { d: Diagnosis }) {
  const { phases, white, independent_of_inputs } = d.residual;
  const most = Math.max(d.noise_kpa, ...phases.map((p) => Math.abs(p.mean_kpa)), 1e-9);
  return (
    <Panel title="What is left, by phase" aside={<span class="muted">after the best fit</span>}>
      <p>
        <Test
          passed={white}
          yes="white: noise alone"
          no="not white: structure is left"
          untested="not tested for whiteness"
        />{' '}
        <Test
          passed={independent_of_inputs}
          yes="uncorrelated with the valve commands"
          no="correlates with the valve commands"
          untested="not tested against the valve commands"
        />
        {d.unexplained_fraction > 0 && (
          <span>
            {' '}
            {d.unexplained_fraction < 1e-3
              ? 'Less than 0.1'
              : significant(100 * d.unexplained_fraction, 2)}{' '}
            % of its variance is more than noise.
          </span>
        )}
      </p>
      <Table
        label="Residuals by phase"
        boxClass="phases"
        heads={[
          'run',
          'phase',
          number('mean', unitOf('difference')),
          heard('bar'),
          number('trend', `${unitOf('difference')}/s`),
        ]}
      >
        {phases.map((p, i) => (
          <tr key={i}>
            <td>{p.run}</td>
            <td>{p.phase}</td>
            <td class="num">
              {beside(toShown('difference', d.noise_kpa), toShown('difference', p.mean_kpa))}
            </td>
            <td>
              <Swing share={p.mean_kpa / most} isGood={p.mean_kpa < 0} />
            </td>
            <td class="num">{shown('difference', p.trend_kpa_per_s, 2)}</td>
          </tr>
        ))}
      </Table>
    </Panel>
  );
}

// Whether it is the set of effects that the verdict takes.
function isChosen(d: Diagnosis, c: Diagnosis['candidates'][number]): boolean {
  const key = (id: string, law: unknown) => `${id} ${law ?? ''}`;
  const numbers = (d.numbers ?? []).map(({ name, chamber }) =>
    key(`number:${chamber ? `${name}[${chamber}]` : name}`, ''),
  );
  const effects = d.effects.map(({ id, chamber, parameters }) =>
    key(chamber ? `${id}[${chamber}]` : id, parameters.law),
  );
  const taken = [...new Set([...effects, ...numbers])].sort();
  const own = c.effects.map((id) => key(id, c.laws[id])).sort();
  return d.verdict !== 'undecided' && d.tied.length === 0 && taken.join() === own.join();
}

export function Candidates({ d }: { d: Diagnosis }) {
  const tied = new Set(d.tied.map((set) => set.join()));
  return (
    <Panel
      title="Candidates"
      aside={
        <span class="muted">
          ΔBIC: how far behind the best of these, fit against number of parameters; below 10 is
          close
        </span>
      }
    >
      <Table
        label="Candidate models"
        boxClass="phases"
        heads={[
          'effects',
          number('ΔBIC'),
          number('RMS', unitOf('difference')),
          number('held out', unitOf('difference')),
        ]}
      >
        {d.candidates.map((c, i) => (
          <tr key={i} class={isChosen(d, c) ? 'baseline' : ''}>
            <th scope="row">
              {effectNames(c.effects, c.laws)} {isChosen(d, c) && <Chip kind="good">taken</Chip>}
              {tied.has(c.effects.join()) && <Chip kind="warn">tied</Chip>}
              {!c.converged && <Chip>did not converge</Chip>}
              {c.reason && (
                <div>
                  <small class="muted">not named: {inWords(c.reason)}</small>
                </div>
              )}
            </th>
            <td class="num">{significant(c.delta_bic)}</td>
            <td class="num">{shown('difference', c.rms_kpa)}</td>
            <td class="num">{shown('difference', c.holdout_rms_kpa)}</td>
          </tr>
        ))}
      </Table>
    </Panel>
  );
}

// Whether the names hold when the readings are others.
export function Stability({ d }: { d: Diagnosis }) {
  if (!d.stability?.length) return null;
  return (
    <Panel
      title="Do the names hold?"
      aside={
        <span class="muted">the best sets fitted again to changed readings; −10 is the limit</span>
      }
    >
      <Table
        label="Stability under changes"
        heads={['change', number('best other set, ΔBIC'), 'names']}
      >
        {d.stability.map((s) => (
          <tr key={s.change}>
            <th scope="row">{s.change}</th>
            <td class="num">{s.delta_bic === null ? '–' : significant(s.delta_bic)}</td>
            <td>
              <Chip kind={s.holds ? 'good' : 'warn'}>{s.holds ? 'hold' : 'do not hold'}</Chip>
            </td>
          </tr>
        ))}
      </Table>
    </Panel>
  );
}
