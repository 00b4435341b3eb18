"""Flow and current of a pump between the numbers of its sheet.

A sheet gives the free flow and the highest pressure or deepest vacuum, at best a range of power. The
flow runs straight between the two ends, as that of the measured diaphragm pumps does on average, but
never so that the air's isothermal work needs more than the power at the best efficiency that pumps
reach. The power goes with the air's work from the low end of its range to the high one, and never
falls as the pressure rises.
"""
import math

from tables import curve, is_known, number

AMBIENT = 100.0  # kPa; a sheet's free air is counted there
STEPS = 10


def ends(row):
    """Free flow in L/min and the end of the pressure scale in kPa gauge (below 0 for suction)."""
    points = curve(row)
    flow = max(p[1] for p in points)
    far = max((p[0] for p in points), key=abs)
    return flow, far


def work(pressure, flow):
    """Isothermal power in W of `flow` L/min from ambient to the pressure, or from it to ambient."""
    ratio = (AMBIENT + pressure) / AMBIENT
    return AMBIENT * flow / 60.0 * abs(math.log(ratio)) if flow > 0 and ratio > 0 else 0.0


def straight(flow, far, pressure):
    return flow * max(0.0, 1.0 - pressure / far)


def hardest(flow, far):
    """Greatest isothermal work along the straight line."""
    if far == 0:
        return 0.0
    return max(work(far * i / 100.0, straight(flow, far, far * i / 100.0)) for i in range(100))


def most_work(row):
    """Greatest isothermal work along the row's own curve."""
    return max(work(p, q) for p, q, _ in curve(row))


def is_measured(row):
    points = curve(row)
    return (len(points) > 2 and row["free_air.provenance"] != "estimated"
            and row["current.provenance"] != "estimated" and row["manufacturer"] != "generic")


def peak_efficiency(row):
    volts = number(row, "voltage_v")
    return max(work(p, q) / (volts * i) for p, q, i in curve(row))


def off_the_line(row):
    """Logarithms of measured flow over the straight line, away from the far end."""
    flow, far = ends(row)
    return [math.log(q / straight(flow, far, p)) for p, q, _ in curve(row)
            if 0 < p < 0.85 * far and q > 0]


def is_piston(row):
    return row["type"] == "piston" and row["series"].split(" ")[0] != "JSG"


def shape(points):
    """A measured curve as shares of its two ends."""
    return [(p / points[-1][0], q / points[0][1]) for p, q, _ in points]


def along(pairs, x):
    for (x1, y1), (x2, y2) in zip(pairs, pairs[1:]):
        if x1 <= x <= x2:
            return y1 + (y2 - y1) * (x - x1) / (x2 - x1)
    return pairs[-1][1]


def fill_curve(row, low, high, efficiency, piston_shape):
    """Points from the ends of the row's curve; `low` and `high` are electrical power in W. True where
    the power cuts the flow."""
    flow, far = ends(row)
    volts = number(row, "voltage_v")
    if far == 0:  # only the free flow is known
        row["curve"] = f"0:{flow:.5g}:{high / volts:.5g}"
        return False
    known_flow = row["free_air.provenance"] != "estimated"
    given = sorted(curve(row)) if known_flow else []
    at = [p for p, _, _ in given] if known_flow and len(given) > 1 else [
        far * i / STEPS for i in range(STEPS + 1)]
    at = sorted(at, key=abs)
    flows, last, cut = [], math.inf, False
    for pressure in at:
        if known_flow:
            q = along([(p, f) for p, f, _ in given], pressure)
        elif is_piston(row):
            q = flow * along(piston_shape, pressure / far)
        else:
            q = straight(flow, far, pressure)
        if not known_flow and pressure != 0:
            most = efficiency * high / work(pressure, 1.0)
            cut |= most < q
            q = min(q, most, last)
        last = q
        flows.append(q)
    hardest_work = max(map(work, at, flows))
    points, power = [], low
    for pressure, q in zip(at, flows):
        power = max(power, low + (high - low) * work(pressure, q) / hardest_work)
        points.append((pressure, q, power / volts))
    if far < 0:
        points.reverse()
    row["curve"] = ";".join(f"{p:.6g}:{q:.5g}:{i:.5g}" for p, q, i in points)
    return cut


def printed_power(row):
    """Low and high end in W where the sheet gives them."""
    high = number(row, "power_max_w") if is_known(row, "power_max_w") else None
    low = number(row, "power_min_w") if is_known(row, "power_min_w") else None
    return low, high
