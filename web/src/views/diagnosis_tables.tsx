// The tables of a diagnosis: errors, effects, residuals by phase, candidates; the next experiment.
import { fieldName, significant } from '../lib/format';
import { type Diagnosis, effectName, type ErrorReport, type Estimate } from '../lib/measurement';
import { toShown, unitOf } from '../lib/units';
import { Chip, Panel } from '../ui/controls';

export function Errors({ d }: { d: Diagnosis }) {
  const rows: [string, ErrorReport | undefined][] = [
    ['as declared', d.declared],
    ['re-fitted', d.before],
    ['with effects', d.after],
  ];
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
          {rows.map(
            ([label, report]) =>
              report && (
                <tr key={label}>
                  <th scope="row">{label}</th>
                  <td class="num">{significant(report.rms_kpa)}</td>
                  <td class="num">{significant(report.rms_percent)}</td>
                  <td class="num">{significant(report.peak_kpa)}</td>
                  <td class="num">{significant(report.holdout_rms_kpa)}</td>
                </tr>
              ),
          )}
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

const interval = (e: Estimate): string =>
  e.ci95 ? `${significant(e.ci95[0])} … ${significant(e.ci95[1])}` : '–';

function EstimateRow({ name, value }: { name: string; value: Estimate | string }) {
  const { label, unit } = fieldName(name);
  return (
    <tr>
      <td>{label}</td>
      {typeof value === 'string' ? (
        <td class="num" colSpan={2}>
          {value}
        </td>
      ) : (
        <>
          <td class="num">
            {significant(value.value)} {unit}
          </td>
          <td class="num">
            {value.identified === false ? 'not fixed by the data' : interval(value)}
          </td>
        </>
      )}
    </tr>
  );
}

export function Effects({ d }: { d: Diagnosis }) {
  const fitted = Object.entries(d.fitted ?? {});
  return (
    <Panel title="What the model gets">
      {d.effects.length === 0 && (
        <p>
          {d.verdict === 'tie'
            ? 'Nothing yet: the tie has to be decided first.'
            : 'No effect was established.'}
        </p>
      )}
      {d.effects.map((effect) => (
        <div key={effect.id}>
          <h3>
            {effectName(effect.id)} <code>{effect.id}</code>
          </h3>
          <table>
            <thead>
              <tr>
                <th scope="col">parameter</th>
                <th scope="col" class="num">
                  value
                </th>
                <th scope="col" class="num">
                  95 %
                </th>
              </tr>
            </thead>
            <tbody>
              {Object.entries(effect.parameters).map(([name, value]) => (
                <EstimateRow key={name} name={name} value={value} />
              ))}
            </tbody>
          </table>
        </div>
      ))}
      {fitted.length > 0 && (
        <>
          <h3>Declared numbers, re-fitted</h3>
          <table>
            <thead>
              <tr>
                <th scope="col">number</th>
                <th scope="col" class="num">
                  value
                </th>
                <th scope="col" class="num">
                  95 %
                </th>
              </tr>
            </thead>
            <tbody>
              {fitted.map(([name, value]) => (
                <EstimateRow key={name} name={name} value={value} />
              ))}
            </tbody>
          </table>
        </>
      )}
    </Panel>
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
                  <span class="swing-track">
                    <i
                      class={p.mean_kpa > 0 ? 'slower' : 'faster'}
                      style={{
                        width: `${(Math.abs(p.mean_kpa) / most) * 50}%`,
                        left:
                          p.mean_kpa > 0 ? '50%' : `${50 - (Math.abs(p.mean_kpa) / most) * 50}%`,
                      }}
                    />
                  </span>
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
                  {c.effects.map(effectName).join(' + ') || 'base model'}{' '}
                  {tied.has(c.effects.join()) && <Chip kind="warn">tied</Chip>}
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

export function NextExperiment({ d }: { d: Diagnosis }) {
  const next = d.next_experiment!;
  return (
    <Panel title="The experiment that would tell">
      {next.why && <p>{next.why}</p>}
      <dl class="facts">
        {next.source_pressure_kpa_gauge !== undefined && (
          <div>
            <dt>source</dt>
            <dd>
              {significant(toShown('pressure', next.source_pressure_kpa_gauge))}{' '}
              <small>{unitOf('pressure')}</small>
            </dd>
          </div>
        )}
        <div>
          <dt>actuator</dt>
          <dd>{next.blocked ? 'blocked' : 'free'}</dd>
        </div>
        {next.t_end_s !== undefined && (
          <div>
            <dt>for</dt>
            <dd>
              {significant(next.t_end_s)} <small>s</small>
            </dd>
          </div>
        )}
        {next.expected_difference_kpa !== undefined && (
          <div>
            <dt>expected difference</dt>
            <dd>
              {significant(next.expected_difference_kpa)} <small>kPa</small>
            </dd>
          </div>
        )}
      </dl>
      <p>
        Valve:{' '}
        {(next.valve ?? [])
          .map((command) => `${command.state} at ${significant(command.t_s)} s`)
          .join(', ') || '–'}
        .{' '}
        {next.measure && `Measure ${next.measure.map((name) => fieldName(name).label).join(', ')}.`}
      </p>
    </Panel>
  );
}
