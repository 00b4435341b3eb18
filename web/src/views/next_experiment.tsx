// The run that would decide a tie: what to do, what to expect, and a file to fill in.
import { fieldName, shown, significant } from '../lib/format';
import {
  type Diagnosis,
  effectNames,
  inWords,
  type Measurement,
  shadesOf,
} from '../lib/measurement';
import { toShown, unitOf } from '../lib/units';
import { Panel } from '../ui/controls';
import { type Fact, FactList } from '../ui/facts';
import { saveFile } from '../ui/files';
import { PhaseKey } from './runs';

export function NextExperiment({ d, data }: { d: Diagnosis; data: Measurement | null }) {
  const next = d.next_experiment!;
  const valve = (next.valve ?? []).filter((v, i, all) => v.state !== all[i - 1]?.state);
  const end = next.t_end_s ?? valve[valve.length - 1]?.t_s ?? 1;
  const save = () => {
    const { id, blocked, source_pressure_kpa_gauge, initial, t_s } = next;
    const run = { id, blocked, source_pressure_kpa_gauge, initial, valve, t_s };
    const pressure_kpa_gauge = (t_s ?? []).map(() => null);
    const document = {
      schema: 'measurement/1',
      name: `${d.name ?? 'bench'} ${id}`,
      ...(data && { rig: data.rig, relative_uncertainty: data.relative_uncertainty }),
      runs: [{ ...run, pressure_kpa_gauge }],
    };
    saveFile(`${d.name ?? 'bench'}-${id}.json`, `${JSON.stringify(document, null, 2)}\n`);
  };
  const facts: Fact[] = [
    ['actuator', next.blocked ? 'blocked' : 'free', ''],
    ...(next.source_pressure_kpa_gauge === undefined || !valve.some((v) => v.state === 'inflate')
      ? []
      : [
          [
            'source',
            significant(toShown('pressure', next.source_pressure_kpa_gauge)),
            unitOf('pressure'),
          ] as Fact,
        ]),
    ['for', significant(end), 's'],
    ['measure', (next.measure ?? []).map((name) => fieldName(name).label).join(', '), ''],
    [
      'expected difference',
      shown('difference', next.expected_difference_kpa),
      `${unitOf('difference')} RMS`,
    ],
    ['expected ΔBIC', significant(next.expected_delta_bic), '10 decides'],
  ];
  return (
    <Panel
      title="The experiment that would tell"
      aside={
        <button type="button" onClick={save}>
          Save as a run to fill in
        </button>
      }
    >
      <p>
        Equally good so far:{' '}
        {d.tied.map((ids, i) => (
          <span key={i}>
            {i > 0 && ', or '}
            <b>{effectNames(ids, d.tied_laws[i])}</b>
          </span>
        ))}
        . {inWords(next.why ?? '')}
      </p>
      <FactList facts={facts} />
      <div
        class="schedule"
        role="img"
        aria-label={`Valve: ${valve.map((v) => `${v.state} at ${significant(v.t_s)} s`).join(', ')}`}
      >
        {shadesOf(valve, end).map((shade, i) => (
          <span
            key={i}
            style={{
              width: `${(100 * (shade.to - shade.from)) / end}%`,
              background: `var(${shade.colour})`,
            }}
            data-tip={`${valve[i]!.state} from ${significant(shade.from)} to ${significant(shade.to)} s`}
          />
        ))}
      </div>
      <p class="hint schedule-end">
        <span>0 s</span> <span>{significant(end)} s</span>
      </p>
      <PhaseKey />
      <p>
        Valve:{' '}
        {valve
          .slice(0, 12)
          .map((command) => `${command.state} at ${significant(command.t_s)} s`)
          .join(', ')}
        {valve.length > 12 && ` and ${valve.length - 12} more commands`}. Then add the run with “Add
        runs…” and ask again.
      </p>
    </Panel>
  );
}
