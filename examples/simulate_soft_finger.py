#!/usr/bin/env python3
"""Simulates the recording of a finger of two chambers in a row, for trying out plenum without a bench.

A base of 40 mL behind the valve and a tip of 15 mL behind a narrow passage, each with its gauge; the
tip leaks. Masses of gas are integrated (isothermal, ISO 6358, Runge-Kutta) and read with noise.

    examples/simulate_soft_finger.py > examples/soft_finger_simulated.json
    plenum diagnose examples/soft_finger_simulated.json
"""
import json
import math
import random

AMBIENT_PA, OPERATING_PA = 1e5, 2e5
R_T, RHO_0 = 287.05 * 293.15, 1e5 / (287.05 * 293.15)
STEP_S, SAMPLE_S, NOISE_KPA = 5e-4, 0.03, 0.1

VALVE, PASSAGE, LEAK = (0.05e-8, 0.3), (0.006e-8, 0.25), (1.5e-12, 0.3)  # C in m3/(s Pa), b
CHAMBERS = [(40e-6, 1.8), (15e-6, 1.4)]  # rest volume, expansion ratio


def flow(element, high_pa, low_pa):
    """ISO 6358, kg/s, with a straight line to zero near equal pressures."""
    conductance, ratio = element
    over = low_pa / high_pa
    if over <= ratio:
        share = 1.0
    else:
        at = min(over, 0.999)
        share = math.sqrt(1.0 - ((at - ratio) / (1.0 - ratio)) ** 2)
        share *= (1.0 - over) / 1e-3 if over > 0.999 else 1.0
    return conductance * RHO_0 * high_pa * share


def both_ways(element, a_pa, b_pa):
    return flow(element, a_pa, b_pa) if a_pa >= b_pa else -flow(element, b_pa, a_pa)


def pressure(chamber, mass):
    """Of p V(p) = m R T with V linear in p."""
    rest, ratio = chamber
    slope = rest * (ratio - 1.0) / (OPERATING_PA - AMBIENT_PA)
    at_zero = rest - slope * AMBIENT_PA
    content = mass * R_T
    return 2.0 * content / (at_zero + math.sqrt(at_zero * at_zero + 4.0 * slope * content))


def slopes(masses, state, source_pa):
    base, tip = (pressure(c, m) for c, m in zip(CHAMBERS, masses))
    valve = {"inflate": lambda: flow(VALVE, source_pa, base), "hold": lambda: 0.0,
             "deflate": lambda: -flow(VALVE, base, AMBIENT_PA)}[state]()
    passed = both_ways(PASSAGE, base, tip)
    return [valve - passed, passed - both_ways(LEAK, tip, AMBIENT_PA)]


def step(masses, state, source_pa, h):
    def beside(k, share):
        return [m + share * h * d for m, d in zip(masses, k)]
    a = slopes(masses, state, source_pa)
    b = slopes(beside(a, 0.5), state, source_pa)
    c = slopes(beside(b, 0.5), state, source_pa)
    d = slopes(beside(c, 1.0), state, source_pa)
    return [m + h / 6.0 * (w + 2.0 * x + 2.0 * y + z) for m, w, x, y, z in zip(masses, a, b, c, d)]


def record(name, source_kpa, rise_s, noise):
    valve = [(0.0, "hold"), (0.3, "inflate"), (0.3 + rise_s, "hold"), (3.6, "deflate")]
    masses = [AMBIENT_PA * rest / R_T for rest, _ in CHAMBERS]
    t_s, readings = [], [[], []]
    steps = round(SAMPLE_S / STEP_S)
    for k in range(160 * steps + 1):
        now = k * STEP_S
        if k % steps == 0:
            t_s.append(round(now, 6))
            for chamber, mass, column in zip(CHAMBERS, masses, readings):
                kpa = (pressure(chamber, mass) - AMBIENT_PA) / 1e3
                column.append(round(kpa + noise.gauss(0.0, NOISE_KPA), 2))
        state = [s for at, s in valve if at <= now + 1e-9][-1]
        masses = step(masses, state, AMBIENT_PA + 1e3 * source_kpa, STEP_S)
    return {"id": name, "source_pressure_kpa_gauge": source_kpa, "initial": {"pressure_kpa_gauge": 0.0},
            "valve": [{"t_s": at, "state": s} for at, s in valve],
            "t_s": t_s, "pressure_kpa_gauge": readings[0], "channels": {"chambers": {"tip": readings[1]}}}


def main():
    noise = random.Random(7)
    line = {"sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3}
    passage = {"sonic_conductance_dm3_per_s_bar": 0.006, "critical_ratio": 0.25}
    document = {
        "schema": "measurement/1", "name": "finger of two chambers",
        "note": "simulated by examples/simulate_soft_finger.py; the tip leaks",
        "rig": {"line": line,
                "chambers": [{"name": "base", "rest_volume_ml": 40.0, "expansion_ratio": 1.8,
                              "operating_pressure_kpa_gauge": 100.0},
                             {"name": "tip", "rest_volume_ml": 15.0, "expansion_ratio": 1.4,
                              "operating_pressure_kpa_gauge": 100.0, "line": passage}],
                "supply": {"kind": "regulated"}, "ambient": {"pressure_kpa_abs": 100.0, "temperature_k": 293.15}},
        "relative_uncertainty": {"rest_volume": 0.02, "sonic_conductance": 0.02},
        "runs": [record("r1", 150.0, 1.0, noise), record("r2", 220.0, 0.6, noise),
                 record("r3", 180.0, 0.8, noise)],
        "holdout": ["r3"]}
    runs = document.pop("runs")
    text = json.dumps(document, indent=2)[:-2]
    print(text + ',\n  "runs": [\n    ' + ",\n    ".join(json.dumps(run) for run in runs) + "\n  ]\n}")


if __name__ == "__main__":
    main()
