// A measurement of a rig that creeps, simulated by the service itself with noise added, and
// diagnoses of it in the contract's form, for views whose verdict must be the one asked for.
const rig = {
  actuator: { rest_volume_ml: 50, expansion_ratio: 2, operating_pressure_kpa_gauge: 100 },
  line: { sonic_conductance_dm3_per_s_bar: 0.05, critical_ratio: 0.3 },
  supply: { kind: 'regulated' },
};
const valve = [
  { t_s: 0, state: 'hold' },
  { t_s: 0.3, state: 'inflate' },
  { t_s: 1.4, state: 'hold' },
  { t_s: 6, state: 'deflate' },
];

const simulate = async (service, effects, blocked) => {
  const answer = await service.post('/v1/simulations', {
    schema: 'simulation/1',
    actuators: [{ name: 'a', ...rig.actuator, line: rig.line, blocked }],
    source: { kind: 'regulated', source_pressure_kpa_gauge: 200 },
    valve,
    effects,
    t_end_s: 9,
    sample_hz: 50,
  });
  return { t_s: answer.t_s, p: answer.groups[0].pressure_kpa_gauge };
};

// Numbers between −1 and 1 that are the same every time.
function noise(seed) {
  let state = seed;
  return () => {
    state = (state * 1103515245 + 12345) % 2147483648;
    return (2 * state) / 2147483648 - 1;
  };
}

export async function makeMeasurement(service) {
  const creep = [{ id: 'creep', parameters: { fraction: 0.15, time_constant_s: 2 } }];
  const runs = [];
  for (const [id, blocked] of [
    ['r1', false],
    ['r2', true],
  ]) {
    const { t_s, p } = await simulate(service, creep, blocked);
    const random = noise(id.charCodeAt(1));
    runs.push({
      id,
      blocked,
      source_pressure_kpa_gauge: 200,
      valve,
      t_s,
      pressure_kpa_gauge: p.map((v) => v + 0.35 * random()),
    });
  }
  return {
    schema: 'measurement/1',
    name: 'pneunet bench',
    rig,
    relative_uncertainty: { sonic_conductance: 0.03 },
    runs,
  };
}

export const toCsv = (measurement) => {
  const stateAt = (t) => valve.filter((command) => command.t_s <= t).at(-1).state;
  const rows = measurement.runs.flatMap((run) =>
    run.t_s.map((t, i) => `${run.id},${t},${stateAt(t)},${run.pressure_kpa_gauge[i].toFixed(4)}`),
  );
  return `run,t_s,valve,pressure_kpa_gauge\n${rows.join('\n')}\n`;
};

const rms = (values) => Math.sqrt(values.reduce((sum, v) => sum + v * v, 0) / values.length);

export async function makeDiagnosis(service, measurement, verdict = 'explained') {
  const creep = { id: 'creep', parameters: { fraction: 0.149, time_constant_s: 2.03 } };
  const series = [];
  for (const run of measurement.runs) {
    const before = await simulate(service, [], run.blocked);
    const after = await simulate(service, [creep], run.blocked);
    const phase = run.t_s.map((t) =>
      t < 0.3 ? 'rest' : t < 1.4 ? 'rise' : t < 6 ? 'hold' : 'fall',
    );
    series.push({
      run: run.id,
      phase,
      t_s: run.t_s,
      measured_kpa: run.pressure_kpa_gauge,
      before_kpa: before.p,
      after_kpa: after.p,
    });
  }
  const report = (model) => {
    const rest = series.map((s) => s.measured_kpa.map((v, i) => v - s[model][i]));
    const all = rest.flat();
    return {
      rms_kpa: rms(all),
      rms_percent: rms(all),
      peak_kpa: Math.max(...all.map(Math.abs)),
      holdout_rms_kpa: null,
      runs: Object.fromEntries(series.map((s, i) => [s.run, rms(rest[i])])),
    };
  };
  const phases = series.flatMap((s) =>
    ['rise', 'hold', 'fall'].map((name) => {
      const rest = s.measured_kpa
        .map((v, i) => v - s.after_kpa[i])
        .filter((_, i) => s.phase[i] === name);
      return {
        run: s.run,
        phase: name,
        mean_kpa: rest.reduce((a, b) => a + b, 0) / rest.length,
        trend_kpa_per_s: 0.003,
      };
    }),
  );
  const tie = verdict === 'tie';
  return {
    schema: 'diagnosis/1',
    verdict,
    noise_kpa: 0.2,
    sentence: tie
      ? 'Creep of the wall and a leak explain the measurement equally well.'
      : 'The wall creeps: 15 % of its expansion comes late, within 2 s; with that the model agrees within the noise.',
    before: report('before_kpa'),
    after: report('after_kpa'),
    effects: tie
      ? []
      : [
          {
            id: 'creep',
            parameters: {
              fraction: { value: 0.149, ci95: [0.146, 0.152] },
              time_constant_s: { value: 2.03, ci95: [1.93, 2.12] },
            },
          },
        ],
    candidates: [
      { effects: ['creep'], bic: -2891.2, delta_bic: 0, rms_kpa: 0.203, holdout_rms_kpa: null },
      {
        effects: ['leak'],
        bic: tie ? -2889.9 : -1904.4,
        delta_bic: tie ? 1.3 : 986.8,
        rms_kpa: tie ? 0.204 : 0.81,
        holdout_rms_kpa: null,
      },
      {
        effects: ['creep', 'leak'],
        bic: -2884.4,
        delta_bic: 6.8,
        rms_kpa: 0.203,
        holdout_rms_kpa: null,
      },
      { effects: [], bic: -640.1, delta_bic: 2251.1, rms_kpa: 2.9, holdout_rms_kpa: null },
    ].sort((a, b) => a.bic - b.bic),
    tied: tie ? [['creep'], ['leak']] : [],
    next_experiment: tie
      ? {
          id: 'next',
          blocked: true,
          source_pressure_kpa_gauge: 200,
          valve,
          t_end_s: 20,
          sample_hz: 50,
          measure: ['pressure_kpa_gauge'],
          expected_difference_kpa: 4.2,
          why: 'With a blocked actuator a leak goes on and creep does not.',
        }
      : null,
    residual: { white: true, independent_of_inputs: true, phases },
    fitted: { sonic_conductance: { value: 0.0502, ci95: [0.0499, 0.0505] } },
    unexplained_fraction: 0,
    warnings: [],
    series,
  };
}

// Answers diagnoses in place of the service.
export async function standIn(page, service, verdict = 'explained') {
  const json = (body, status = 200) => ({
    status,
    contentType: 'application/json',
    body: JSON.stringify(body),
  });
  const self = '/v1/diagnoses/d1';
  let measurement;
  await page.route('**/v1/diagnoses', async (route) => {
    measurement = route.request().postDataJSON();
    await route.fulfill(
      json({ id: 'd1', status: 'queued', links: { self, events: `${self}/events` } }, 202),
    );
  });
  await page.route(`**${self}`, async (route) => {
    const result = await makeDiagnosis(service, measurement, verdict);
    await route.fulfill(
      json({ id: 'd1', name: 'pneunet bench', status: 'done', progress: null, result, links: {} }),
    );
  });
}
