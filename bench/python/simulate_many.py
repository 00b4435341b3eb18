"""Thousands of rigs by plenum.simulate_many, a share of them by SciPy's solve_ivp with the same equations.

Each rig fills a soft actuator from a regulated source through one line (ISO 6358: sonic conductance C, critical ratio
b), holds and vents it, isothermally, its volume linear in pressure:

    d(pV)/dt = P0·q,   q = ±C·p1·φ(p2/p1),   φ = 1 up to b, √(1 − ((p2/p1 − b)/(1 − b))²) above

(from a ratio of 0.999 on a straight line to zero, as in docs/explanation/simulator.md).

Both give 200 pressures a second for 4 s; the largest difference is printed, and the ratio of the times for a rig.
usage: simulate_many.py [RIGS=10000] [OF_SCIPY=200]
"""
import math
import os
import sys
import time

import numpy as np
from scipy.integrate import solve_ivp

import plenum

AMBIENT_PA, P0_PA, LINEAR = 100e3, 100e3, 0.999
FILL_S, HOLD_S, VENT_S, END_S, SAMPLE_HZ = 0.1, 1.6, 2.0, 4.0, 200


def drawn_rigs(count):
    draw = np.random.default_rng(1)
    return [{"rest_volume_ml": draw.uniform(5, 200), "expansion_ratio": draw.uniform(1, 3),
             "operating_pressure_kpa_gauge": draw.uniform(30, 150), "conductance": draw.uniform(0.02, 0.5),
             "critical_ratio": draw.uniform(0.15, 0.5), "excess": draw.uniform(1.1, 3)} for _ in range(count)]


def source_kpa_gauge(rig):
    return rig["operating_pressure_kpa_gauge"] * rig["excess"]


def request_of(rig):
    return {"schema": "simulation/1",
            "actuators": [{"name": "a", "count": 1, "rest_volume_ml": rig["rest_volume_ml"],
                           "expansion_ratio": rig["expansion_ratio"],
                           "operating_pressure_kpa_gauge": rig["operating_pressure_kpa_gauge"],
                           "line": {"sonic_conductance_dm3_per_s_bar": rig["conductance"],
                                    "critical_ratio": rig["critical_ratio"]}}],
            "source": {"kind": "regulated", "source_pressure_kpa_gauge": source_kpa_gauge(rig)},
            "valve": [{"t_s": 0.0, "state": "hold"}, {"t_s": FILL_S, "state": "inflate"},
                      {"t_s": HOLD_S, "state": "hold"}, {"t_s": VENT_S, "state": "deflate"}],
            "t_end_s": END_S, "sample_hz": SAMPLE_HZ}


def ellipse(ratio, critical):
    return 1.0 if ratio <= critical else math.sqrt(1.0 - ((ratio - critical) / (1.0 - critical)) ** 2)


def flow(conductance, critical, up_pa, down_pa):
    ratio = down_pa / up_pa
    share = ellipse(ratio, critical) if ratio < LINEAR else ellipse(LINEAR, critical) * (1.0 - ratio) / (1.0 - LINEAR)
    return conductance * up_pa * share


def pressures_by_scipy(rig, times_s):
    """Gauge pressures in kPa, phase by phase, so that no step crosses a switch."""
    conductance, critical = rig["conductance"] * 1e-8, rig["critical_ratio"]
    rest_m3, operating_pa = rig["rest_volume_ml"] * 1e-6, rig["operating_pressure_kpa_gauge"] * 1e3
    growth_m3_per_pa = rest_m3 * (rig["expansion_ratio"] - 1) / operating_pa
    source_pa = AMBIENT_PA + source_kpa_gauge(rig) * 1e3

    def rate(state):
        def derivative(_, p):
            pa = p[0]
            volume_m3 = rest_m3 + growth_m3_per_pa * (pa - AMBIENT_PA)
            q = 0.0
            if state == "inflate":
                q = flow(conductance, critical, source_pa, pa) if pa < source_pa else 0.0
            elif state == "deflate":
                q = -flow(conductance, critical, pa, AMBIENT_PA) if pa > AMBIENT_PA else 0.0
            return [P0_PA * q / (volume_m3 + pa * growth_m3_per_pa)]
        return derivative

    pressure_pa, result = AMBIENT_PA, np.empty_like(times_s)
    phases = [(0.0, FILL_S, "hold"), (FILL_S, HOLD_S, "inflate"), (HOLD_S, VENT_S, "hold"), (VENT_S, END_S, "deflate")]
    for begin_s, end_s, state in phases:
        here = (times_s >= begin_s) & (times_s <= end_s)
        solution = solve_ivp(rate(state), (begin_s, end_s), [pressure_pa], method="LSODA", rtol=1e-7, atol=1e-2,
                             t_eval=np.unique(np.append(times_s[here], end_s)))
        result[here] = solution.y[0][: here.sum()]
        pressure_pa = solution.y[0][-1]
    return (result - AMBIENT_PA) / 1e3


def main():
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10000
    of_scipy = min(count, int(sys.argv[2]) if len(sys.argv) > 2 else 200)
    rigs = drawn_rigs(count)
    requests = [request_of(rig) for rig in rigs]

    began = time.perf_counter()
    answers = plenum.simulate_many(requests)
    plenum_s = time.perf_counter() - began

    times_s = answers[0].t_s
    began = time.perf_counter()
    curves = [pressures_by_scipy(rig, times_s) for rig in rigs[:of_scipy]]
    scipy_s = time.perf_counter() - began

    worst = max(np.max(np.abs(curve - answer.pressure_kpa_gauge())) / rig["operating_pressure_kpa_gauge"]
                for curve, answer, rig in zip(curves, answers, rigs))
    threads = len(os.sched_getaffinity(0))
    print(f"plenum: {count} rigs in {plenum_s:.2f} s on {threads} processors, {1e3 * plenum_s / count:.3f} ms each")
    print(f"SciPy:  {of_scipy} rigs in {scipy_s:.2f} s on one, {1e3 * scipy_s / of_scipy:.1f} ms each")
    print(f"largest difference {worst:.1e} of the operating pressure")
    print(f"ratio: {scipy_s / of_scipy / (plenum_s / count):.0f}")
    return 0 if worst < 1e-4 else 1


if __name__ == "__main__":
    sys.exit(main())
