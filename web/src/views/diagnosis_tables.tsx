// The tables of a diagnosis: errors, residuals by phase, candidates.
import { significant } from '../lib/format';
import { type Diagnosis, effectNames } from '../lib/measurement';
import { Chip, Panel } from '../ui/controls';
import { Swing } from '../ui/swing';

export function Errors({ d }: { d: Diagnosis }) {
  const rows: [string, Partial<Diagnosis['after']>][] = [
    ['as declared', d.declared],
    ['re-fitted, no effects', d.before],
    ...(d.verdict === 'adequate'
      ? []
      : [['with effects', d.after] as [string, Diagnosis['after']]]),
  ];
  if (d.discrepancy?.learned)
    rows.push([
      'with the learned term',
      {
        rms_kpa: d.discrepancy.rms_after_kpa ?? undefined,
        holdout_rms_kpa: d.discrepancy.holdout_after_kpa,
      },
    ]);
  return (
    <div class="scroll" tabIndex={0} role="region" aria-label="Errors of the model">
      <table>
        <thead>
          <tr>
            <th scope="col">model</th>
            <th scope="col" class="num">
              RMS <small>kPa</small>
            </th>
            <th scope="col" class="num">
              of operating <small>%</small>
            </th>
            <th scope="col" class="num">
              peak <small>kPa</small>
            </th>
            <th scope="col" class="num">
              held out <small>kPa</small>
            </th>
          </tr>
        </thead>
        <tbody>
          {rows.map(([label, report]) => (
            <tr key={label}>
              <th scope="row">{label}</th>
              <td class="num">{significant(report.rms_kpa)}</td>
              <td class="num">{significant(report.rms_percent)}</td>
              <td class="num">{significant(report.peak_kpa)}</td>
              <td class="num">{significant(report.holdout_rms_kpa)}</td>
            </tr>
          ))}
          <tr>
            <td>noise of the readings</td>
            <td class="num">{significant(d.noise_kpa)}</td>
            <td />
            <td />
            <td />
          </tr>
        </tbody>
      </table>
    </div>
  );
}

export function Phases({ d }: { d: Diagnosis }) {
  const { phases, white, independent_of_inputs } = d.residual;
  const most = Math.max(1e-9, ...phases.map((p) => Math.abs(p.mean_kpa)));
  return (
    <Panel title="What is left, by phase" aside={<span class="muted">after the best fit</span>}>
      <p>
        <Chip kind={white ? 'good' : 'warn'}>{white ? 'white' : 'not white'}</Chip>{' '}
        <Chip kind={independent_of_inputs ? 'good' : 'warn'}>
          {independent_of_inputs ? 'independent of the inputs' : 'follows the inputs'}
        </Chip>
        {d.unexplained_fraction > 0 && (
          <span>
            {' '}
            {significant(100 * d.unexplained_fraction, 2)} % of its variance is more than noise.
          </span>
        )}
      </p>
      <div class="scroll phases" tabIndex={0} role="region" aria-label="Residuals by phase">
        <table>
          <thead>
            <tr>
              <th scope="col">run</th>
              <th scope="col">phase</th>
              <th scope="col" class="num">
                mean <small>kPa</small>
              </th>
              <th scope="col">
                <span class="only-heard">bar</span>
              </th>
              <th scope="col" class="num">
                trend <small>kPa/s</small>
              </th>
            </tr>
          </thead>
          <tbody>
            {phases.map((p, i) => (
              <tr key={i}>
                <td>{p.run}</td>
                <td>{p.phase}</td>
                <td class="num">{significant(p.mean_kpa, 2)}</td>
                <td>
                  <Swing share={p.mean_kpa / most} isGood={p.mean_kpa < 0} />
                </td>
                <td class="num">{significant(p.trend_kpa_per_s, 2)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </Panel>
  );
}

export function Candidates({ d }: { d: Diagnosis }) {
  const tied = new Set(d.tied.map((set) => set.join()));
  return (
    <Panel
      title="Candidates"
      aside={<span class="muted">less BIC is better; below 10 is close</span>}
    >
      <div class="scroll phases" tabIndex={0} role="region" aria-label="Candidate models">
        <table>
          <thead>
            <tr>
              <th scope="col">effects</th>
              <th scope="col" class="num">
                ΔBIC
              </th>
              <th scope="col" class="num">
                RMS <small>kPa</small>
              </th>
              <th scope="col" class="num">
                held out <small>kPa</small>
              </th>
            </tr>
          </thead>
          <tbody>
            {d.candidates.map((c, i) => (
              <tr key={i} class={i === 0 ? 'baseline' : ''}>
                <th scope="row">
                  {effectNames(c.effects, c.laws)}{' '}
                  {tied.has(c.effects.join()) && <Chip kind="warn">tied</Chip>}
                  {!c.converged && <Chip>did not converge</Chip>}
                </th>
                <td class="num">{significant(c.delta_bic)}</td>
                <td class="num">{significant(c.rms_kpa)}</td>
                <td class="num">{significant(c.holdout_rms_kpa)}</td>
              </tr>
            ))}
          </tbody>
        </table>
      </div>
    </Panel>
  );
}
