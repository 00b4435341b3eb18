// Measurements of a rig that the service itself simulated, with noise added: the diagnoses of them
// are its own. What is true is known: a wall that creeps, a leak too short to be told from creep,
// and a leak that opens above a pressure, which no known effect describes.
const rig = {
  actuator: { rest_volume_ml: 50, expansion_ratio: 2, operating_pressure_kpa_gauge: 100 },
  line: { sonic_conductance_dm3_per_s_bar: 0.05, critical_ratio: 0.3 },
  supply: { kind: 'regulated' },
};
const commands = (...list) => list.map(([t_s, state]) => ({ t_s, state }));
const long = commands([0, 'hold'], [0.3, 'inflate'], [1.4, 'hold'], [6, 'deflate']);
const brief = commands([0, 'hold'], [0.1, 'inflate'], [0.8, 'hold']);
const middle = commands([0, 'hold'], [0.3, 'inflate'], [1.4, 'hold'], [3, 'deflate']);

// Numbers between −1 and 1 that are the same every time (mulberry32).
function noise(seed) {
  let state = seed;
  return () => {
    state = (state + 0x6d2b79f5) | 0;
    let mixed = Math.imul(state ^ (state >>> 15), 1 | state);
    mixed = (mixed + Math.imul(mixed ^ (mixed >>> 7), 61 | mixed)) ^ mixed;
    return ((mixed ^ (mixed >>> 14)) >>> 0) / 2 ** 31 - 1;
  };
}

async function measure(service, effects, run) {
  const answer = await service.post('/v1/simulations', {
    schema: 'simulation/1',
    actuators: [{ name: 'a', ...rig.actuator, line: rig.line, blocked: run.blocked ?? false }],
    source: { kind: 'regulated', source_pressure_kpa_gauge: run.source },
    valve: run.valve,
    effects,
    t_end_s: run.end,
    sample_hz: run.hz,
  });
  const random = noise(run.id.charCodeAt(run.id.length - 1));
  return {
    id: run.id,
    blocked: run.blocked ?? false,
    source_pressure_kpa_gauge: run.source,
    valve: run.valve,
    t_s: answer.t_s,
    pressure_kpa_gauge: answer.groups[0].pressure_kpa_gauge.map((p) => p + 0.35 * random()),
  };
}

const truths = {
  creep: {
    effects: [{ id: 'creep', parameters: { fraction: 0.15, time_constant_s: 2 } }],
    relative_uncertainty: { sonic_conductance: 0.03 },
    runs: [
      { id: 'r1', source: 200, valve: long, end: 9, hz: 50 },
      { id: 'r2', source: 200, valve: long, end: 9, hz: 50, blocked: true },
    ],
  },
  tie: {
    effects: [
      { id: 'leak', parameters: { sonic_conductance_dm3_per_s_bar: 0.001, critical_ratio: 0.3 } },
    ],
    relative_uncertainty: { critical_ratio: 0.03 },
    runs: [
      { id: 'r1', source: 200, valve: brief, end: 1.1, hz: 100 },
      { id: 'r2', source: 160, valve: brief, end: 1.1, hz: 100 },
    ],
  },
  seam: {
    effects: [
      {
        id: 'learned_leak',
        parameters: { law: 'opening', rate_per_s: 0.5, centre: 0.8, width: 0.05 },
      },
    ],
    relative_uncertainty: { sonic_conductance: 0.03 },
    runs: [
      { id: 'r1', source: 200, valve: middle, end: 4.5, hz: 30 },
      { id: 'r2', source: 240, valve: middle, end: 4.5, hz: 30 },
    ],
  },
  nothing: {
    effects: [],
    relative_uncertainty: { sonic_conductance: 0.03 },
    runs: [{ id: 'r1', source: 200, valve: long, end: 9, hz: 30 }],
  },
};

export async function makeMeasurement(service, truth = 'creep') {
  const { effects, relative_uncertainty, runs } = truths[truth];
  return {
    schema: 'measurement/1',
    name: 'pneunet bench',
    rig,
    relative_uncertainty,
    runs: await Promise.all(runs.map((run) => measure(service, effects, run))),
  };
}

// The run that a tie asks for, done on the rig with its leak.
export const makeProposed = (service, { valve, blocked, source_pressure_kpa_gauge, t_end_s }) =>
  measure(service, truths.tie.effects, {
    id: 'r3',
    source: source_pressure_kpa_gauge,
    valve,
    blocked,
    end: t_end_s,
    hz: 100,
  });

export const toCsv = (measurement) => {
  const rows = measurement.runs.flatMap((run) =>
    run.t_s.map((t, i) => {
      const { state } = run.valve.filter((command) => command.t_s <= t).at(-1);
      return `${run.id},${t},${state},${run.pressure_kpa_gauge[i].toFixed(4)}`;
    }),
  );
  return `run,t_s,valve,pressure_kpa_gauge\n${rows.join('\n')}\n`;
};
