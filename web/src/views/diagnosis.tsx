// What a diagnosis found: the verdict, measured against model before and after, residuals, what is
// left, the candidates, the next experiment; and the revised model, saved and used.
import { significant } from '../lib/format';
import { effectName, inWords } from '../lib/effect_words';
import { type Diagnosis, type Measurement, type Shade } from '../lib/measurement';
import { pressuresShown, toShown, unitOf } from '../lib/units';
import { runTitle, verdictWord } from '../lib/words';
import { Lines } from '../plots/lines';
import { Chip, Notice, Panel } from '../ui/controls';
import { saveFile } from '../ui/files';
import { Effects, EstimateTable } from './diagnosis_effects';
import { Candidates, Errors, Phases, Stability } from './diagnosis_tables';
import { MeasuredNumbers } from './measured_numbers';
import { NextExperiment } from './next_experiment';
import { NumbersOfRuns } from './run_numbers';
import { PhaseKey, pickRun, RunPicker } from './runs';
import { SaveModel } from './save_model';

export function DiagnosisView({
  diagnosis: d,
  id,
  data,
  settle,
}: {
  diagnosis: Diagnosis;
  id: string;
  data: Measurement | null;
  settle: (assume: string) => void;
}) {
  const word = verdictWord[d.verdict];
  return (
    <>
      <Panel
        title={
          <>
            <Chip kind={word.kind}>{word.text}</Chip> {inWords(d.sentence)}
          </>
        }
        aside={
          <button
            type="button"
            onClick={() =>
              saveFile(`${d.name || id}-diagnosis.json`, `${JSON.stringify(d, null, 2)}\n`)
            }
          >
            Save JSON
          </button>
        }
      >
        {(d.slips?.length ?? 0) > 0 && (
          <div class="toolbar">
            {[...d.slips!.map((slip) => slip.assume), 'as_written'].map((assume) => (
              <button key={assume} type="button" onClick={() => settle(assume)}>
                {assume === 'as_written' ? 'It is as written' : `Read it as ${assume}`}
              </button>
            ))}
          </div>
        )}
        <Errors d={d} />
        {[...new Set(d.warnings)].map((warning) => (
          <Notice key={warning} kind="warn">
            {inWords(warning)}
          </Notice>
        ))}
      </Panel>
      {(d.measured?.length ?? 0) > 0 && <MeasuredNumbers d={d} data={data} />}
      {d.series.length > 0 && <Curves d={d} />}
      {d.next_experiment && <NextExperiment d={d} data={data} />}
      {d.tied.length > 0 && d.reason && <Notice kind="warn">No next run: {d.reason}.</Notice>}
      <div class="plots even">
        <Effects d={d} />
        <Phases d={d} />
      </div>
      {d.discrepancy && <Learned d={d} />}
      <Candidates d={d} />
      <Stability d={d} />
      <NumbersOfRuns d={d} />
      {d.revision && <SaveModel key={id} id={id} diagnosis={d} model={d.revision} />}
    </>
  );
}

const phaseColours: Record<string, string> = { rise: 'inflate', fall: 'deflate' };

// Shades behind a run: the phases that the diagnosis saw.
function shadesOfSeries({ t_s, phase }: Diagnosis['series'][number]): Shade[] {
  const shades: Shade[] = [];
  phase.forEach((name, i) => {
    const colour = `--phase-${phaseColours[name] ?? 'hold'}`;
    const last = shades[shades.length - 1];
    if (last?.colour === colour) last.to = t_s[i]!;
    else {
      if (last) last.to = t_s[i]!;
      shades.push({ from: t_s[i]!, to: t_s[i]!, colour });
    }
  });
  return shades;
}

function Curves({ d }: { d: Diagnosis }) {
  const ids = d.series.map((series) => series.run);
  const series = d.series.find((s) => s.run === pickRun(ids))!;
  const bands = shadesOfSeries(series);
  const rest = (model: (number | null)[]) =>
    series.measured_kpa.map((v, i) =>
      v === null || model[i] == null ? null : toShown('difference', v - model[i]!),
    );
  const plot = { x: series.t_s, xLabel: 'time, s', bands, sync: 'diagnosis' };
  return (
    <Panel title="Measured against model" aside={<RunPicker ids={ids} value={series.run} />}>
      <Lines
        {...plot}
        title={`${runTitle(series.run)}${series.held_out ? ', held out of all fits' : ''}`}
        yLabel={`pressure, ${unitOf('pressure')}`}
        height={280}
        lines={[
          {
            label: 'measured',
            values: pressuresShown(series.measured_kpa),
            colour: '--c6',
            width: 3.2,
          },
          {
            label: 'model before',
            values: pressuresShown(series.before_kpa),
            colour: '--c2',
            dash: [6, 3],
          },
          { label: 'model after', values: pressuresShown(series.after_kpa), colour: '--c1' },
        ]}
      />
      <Lines
        {...plot}
        title="Residual: measured less model"
        yLabel={`residual, ${unitOf('difference')}`}
        height={180}
        lines={[
          { label: 'before', values: rest(series.before_kpa), colour: '--c2', width: 1 },
          { label: 'after', values: rest(series.after_kpa), colour: '--c1', width: 1 },
        ]}
      />
      <PhaseKey />
    </Panel>
  );
}

const equations: Record<string, string> = {
  chamber: 'gas leaving or entering the actuator',
  line: 'flow through the line',
  volume: 'volume over pressure',
  sensor: 'what the sensor shows',
};

// What no known effect accounts for: where it lives, and the term learned in its place.
function Learned({ d }: { d: Diagnosis }) {
  const { equation, features, learned, places, effects = [] } = d.discrepancy!;
  return (
    <Panel
      title="What no known effect accounts for"
      aside={<Chip kind="warn">learned, not known physics</Chip>}
    >
      <div class="plots even">
        <div>
          <h3>Where it lives</h3>
          <p>
            In the equation of the {equation}
            {equations[equation] && ` (${equations[equation]})`}, over {features.join(' and ')}.
          </p>
          <ul class="history">
            {places.map((p) => (
              <li key={p.axis + p.where}>
                {p.axis}: {p.where}, {significant(100 * p.share, 2)} % of it
              </li>
            ))}
          </ul>
        </div>
        <div>
          {learned ? (
            <>
              <h3>
                {effectName(learned.id, String(learned.parameters.law ?? ''))}{' '}
                <code>{learned.id}</code>
              </h3>
              <EstimateTable
                name={learned.id}
                of="parameter"
                rows={Object.entries(learned.parameters).filter(([name]) => name !== 'law')}
              />
              {effects.map((effect) => (
                <div key={effect.id}>
                  <h3>
                    Beside it: {effectName(effect.id, String(effect.parameters.law ?? ''))}{' '}
                    <code>{effect.id}</code>
                  </h3>
                  <EstimateTable
                    name={effect.id}
                    of="parameter"
                    rows={Object.entries(effect.parameters).filter(([name]) => name !== 'law')}
                  />
                </div>
              ))}
            </>
          ) : (
            <p>No term was learned: none made other runs come out better.</p>
          )}
        </div>
      </div>
    </Panel>
  );
}
