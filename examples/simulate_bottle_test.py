#!/usr/bin/env python3
"""Simulates the recording of a bottle test, for trying out plenum without a bench.

The rig is a bottle behind one part; what the part is in truth is given here, not what its data
sheet says. Gas is filled from a regulated source and let out through the part (ISO 6358), exchanges
heat with the bottle's wall, and is read with noise and rounding.

    plenum protocol PART --template template.json
    examples/simulate_bottle_test.py template.json 0.21 0.28 > recording.csv
    plenum diagnose recording.csv --rig template.json --save-part PART

Of a pump: --pump 0:2.1,50:1.6,100:0.9,150:0, its free air in L/min at pressures in kPa above ambient.
"""
import argparse
import csv
import json
import math
import random
import sys

AMBIENT_PA, AMBIENT_K = 1e5, 293.15
RHO_0, P_0 = 1.188, 1e5  # ISO 8778
R, KAPPA = 287.06, 1.4
STEP_S = 1e-3


def mass_flow(conductance, ratio, upstream_pa, downstream_pa, upstream_k):
    """ISO 6358, kg/s; conductance in m3/(s Pa)."""
    if upstream_pa <= downstream_pa:
        return 0.0
    choked = conductance * RHO_0 * upstream_pa * math.sqrt(293.15 / upstream_k)
    over = downstream_pa / upstream_pa
    if over <= ratio:
        return choked
    return choked * math.sqrt(max(0.0, 1.0 - ((over - ratio) / (1.0 - ratio)) ** 2))


def end_slope(near, far, first, second):
    """Of a table at its end: widths and slopes of the last two pieces."""
    slope = ((2.0 * near + far) * first - near * second) / (near + far)
    if slope * first <= 0.0:
        return 0.0
    return 3.0 * first if first * second <= 0.0 and abs(slope) > 3.0 * abs(first) else slope


def slopes_of(points):
    """Of a curve through the points that is monotone where they are (Fritsch and Carlson)."""
    widths = [b[0] - a[0] for a, b in zip(points, points[1:])]
    secants = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(points, points[1:])]
    if len(points) < 3:
        return secants * 2
    inner = []
    for k in range(1, len(points) - 1):
        first, second = 2.0 * widths[k] + widths[k - 1], widths[k] + 2.0 * widths[k - 1]
        turns = secants[k - 1] * secants[k] <= 0.0
        inner.append(0.0 if turns else
                     (first + second) / (first / secants[k - 1] + second / secants[k]))
    return [end_slope(widths[0], widths[1], secants[0], secants[1]), *inner,
            end_slope(widths[-1], widths[-2], secants[-1], secants[-2])]


def delivery(points, gauge_pa):
    """Free air of a pump, m3/s, smooth between the points (Pa, m3/s, slope), nothing beyond them."""
    if gauge_pa >= points[-1][0]:
        return 0.0
    for (low_pa, low, low_slope), (high_pa, high, high_slope) in zip(points, points[1:]):
        if gauge_pa <= high_pa:
            width = high_pa - low_pa
            t = max(0.0, (gauge_pa - low_pa) / width)
            s = 1.0 - t
            return (s * s * ((1.0 + 2.0 * t) * low + t * width * low_slope)
                    + t * t * ((1.0 + 2.0 * s) * high - s * width * high_slope))
    return 0.0


def read_pump(text):
    if not text:
        return []
    pairs = [item.split(":") for item in text.split(",")]
    points = [(1e3 * float(kpa), float(l_per_min) / 6e4) for kpa, l_per_min in pairs]
    return [(*point, slope) for point, slope in zip(points, slopes_of(points))]


def volume_of(template, run):
    """Of the run's bottle, with the tube and the space behind a pump, m3."""
    rig = template["rig"]
    volume_ml = {**rig["actuator"], **run.get("rig", {}).get("actuator", {})}["rest_volume_ml"]
    volume_ml += float(str(rig["supply"].get("reservoir_volume_ml", 0.0)).split()[0])
    for element in rig["line"]["elements"]:
        tube = element.get("tube", {"inner_diameter_mm": 0.0, "length_m": 0.0})
        volume_ml += math.pi / 4.0 * tube["inner_diameter_mm"] ** 2 * tube["length_m"]
    return 1e-6 * volume_ml


def rates(mass_kg, energy_j, state, rig):
    """Change of mass and inner energy of the bottle's gas."""
    pressure_pa = (KAPPA - 1.0) * energy_j / rig["volume_m3"]
    gas_k = pressure_pa * rig["volume_m3"] / (mass_kg * R)
    inflow = outflow = 0.0
    if state == "inflate" and rig["pump"]:
        inflow = RHO_0 * delivery(rig["pump"], pressure_pa - AMBIENT_PA)
    elif state == "inflate":
        inflow = mass_flow(*rig["fill"], rig["source_pa"], pressure_pa, AMBIENT_K)
    if state == "deflate":
        outflow = mass_flow(*rig["exhaust"], pressure_pa, AMBIENT_PA, gas_k)
    c_p = KAPPA * R / (KAPPA - 1.0)
    heat_w = rig["wall_w_per_k"] * (AMBIENT_K - gas_k)
    return inflow - outflow, c_p * (inflow * AMBIENT_K - outflow * gas_k) + heat_w


def advance(mass_kg, energy_j, state, rig, step_s):
    """One step of classical Runge-Kutta."""
    k1 = rates(mass_kg, energy_j, state, rig)
    k2 = rates(mass_kg + 0.5 * step_s * k1[0], energy_j + 0.5 * step_s * k1[1], state, rig)
    k3 = rates(mass_kg + 0.5 * step_s * k2[0], energy_j + 0.5 * step_s * k2[1], state, rig)
    k4 = rates(mass_kg + step_s * k3[0], energy_j + step_s * k3[1], state, rig)
    move = [step_s * (a + 2 * b + 2 * c + d) / 6 for a, b, c, d in zip(k1, k2, k3, k4)]
    return mass_kg + move[0], energy_j + move[1]


def record(run, rig, sampling_hz, end_s):
    """Times, valve states and pressures above ambient, Pa."""
    switches = [(command["t_s"], command["state"]) for command in run["valve"]]
    mass_kg = AMBIENT_PA * rig["volume_m3"] / (R * AMBIENT_K)
    energy_j = AMBIENT_PA * rig["volume_m3"] / (KAPPA - 1.0)
    now_s, samples = 0.0, []
    for k in range(int(end_s * sampling_hz) + 1):
        sample_s = k / sampling_hz
        while now_s < sample_s - 1e-12:
            state = [name for t_s, name in switches if t_s <= now_s + 1e-12][-1]
            turns = [t_s for t_s, _ in switches if t_s > now_s + 1e-12]
            step_s = min([STEP_S, sample_s - now_s] + [t_s - now_s for t_s in turns])
            mass_kg, energy_j = advance(mass_kg, energy_j, state, rig, step_s)
            now_s += step_s
        state = [name for t_s, name in switches if t_s <= sample_s + 1e-9][-1]
        pressure_pa = (KAPPA - 1.0) * energy_j / rig["volume_m3"]
        samples.append((sample_s, state, pressure_pa - AMBIENT_PA))
    return samples


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("template", help="the file of plenum protocol --template")
    parser.add_argument("fill_c", type=float, nargs="?", default=0.0,
                        help="true C when filling, dm3/(s bar)")
    parser.add_argument("fill_b", type=float, nargs="?", default=0.3, help="true b when filling")
    parser.add_argument("--pump", help="true free air of a pump, KPA:L_PER_MIN,...")
    parser.add_argument("--exhaust-c", type=float, help="true C when emptying; fill_c without it")
    parser.add_argument("--exhaust-b", type=float, help="true b when emptying; fill_b without it")
    parser.add_argument("--noise-kpa", type=float, default=0.2)
    parser.add_argument("--resolution-kpa", type=float, default=0.1)
    parser.add_argument("--sampling-hz", type=float, default=50.0)
    parser.add_argument("--volume-error", type=float, default=0.001, help="of the first bottle as it was weighed")
    parser.add_argument("--heat-s", type=float, default=12.0, help="time constant of the wall")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    with open(options.template, encoding="utf-8") as file:
        template = json.load(file)
    draw = random.Random(options.seed)
    actuator = template["rig"]["actuator"]
    highest_pa = AMBIENT_PA + 1e3 * actuator["operating_pressure_kpa_gauge"]
    first_m3 = volume_of(template, template["runs"][0]) * (1.0 + options.volume_error)
    first_w_per_k = highest_pa * first_m3 / ((KAPPA - 1.0) * AMBIENT_K * options.heat_s)
    rig = {"pump": read_pump(options.pump),
           "fill": (1e-8 * options.fill_c, options.fill_b),
           "exhaust": (1e-8 * (options.exhaust_c or options.fill_c),
                       options.fill_b if options.exhaust_b is None else options.exhaust_b)}
    print("# simulated by examples/simulate_bottle_test.py, not measured", file=sys.stderr)
    rows = csv.writer(sys.stdout, lineterminator="\n")
    rows.writerow(["run", "t_s", "valve", "pressure_kpa_gauge"])
    for run in template["runs"]:
        rig["volume_m3"] = volume_of(template, run)
        if "rig" not in run:  # another bottle is as large as it was weighed
            rig["volume_m3"] *= 1.0 + options.volume_error
        rig["wall_w_per_k"] = first_w_per_k * (rig["volume_m3"] / first_m3) ** (2.0 / 3.0)
        rig["source_pa"] = AMBIENT_PA + 1e3 * run.get("source_pressure_kpa_gauge", 0.0)
        end_s = run["valve"][-1]["t_s"] + 5.0
        for t_s, state, gauge_pa in record(run, rig, options.sampling_hz, end_s):
            read_kpa = gauge_pa / 1e3 + draw.gauss(0.0, options.noise_kpa)
            if options.resolution_kpa > 0.0:
                read_kpa = round(read_kpa / options.resolution_kpa) * options.resolution_kpa
            rows.writerow([run["id"], f"{t_s:.4f}", state, f"{read_kpa:.4f}"])


if __name__ == "__main__":
    main()
