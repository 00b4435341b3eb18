"""SciPy's solve_ivp on the rigs of rigs.csv; adds its rows to rise.csv. usage: rise_scipy.py DIR

Same right-hand side, rigs, error bound and sweep of tolerances as plenum_bench; events by SciPy
itself. Only the first rigs are timed.
"""

import csv
import math
import statistics
import sys
import time

from scipy.integrate import solve_ivp

TIMED_RIGS = 1000
ERROR_MAX = 1e-6
REPETITIONS = 5
# Each as it is faster: stopping helps DOP853, whose order the kink at the switch spoils.
METHODS = (("RK45", "RK45", False),
           ("DOP853, stops at switch", "DOP853", True),
           ("LSODA", "LSODA", False))


class Leg:
    """dp/dt from one pressure to another, set up before the clock starts."""

    def __init__(self, rate, start_pa, end_pa, time_at_most_s):
        def excess(_, y):
            return y[0] - end_pa

        excess.terminal = True
        self.rate = rate
        self.excess = excess
        self.start = [start_pa]
        self.span_s = (0.0, 2.0 * time_at_most_s)

    def time_s(self, method, tolerance):
        result = solve_ivp(self.rate, self.span_s, self.start, method=method, events=self.excess,
                           rtol=tolerance, atol=0.0)
        return result.t_events[0][0] if result.status == 1 else math.nan


class Rise:
    """The legs of one rig's rise: one, or two with a stop at the switch from choked flow."""

    def __init__(self, row, stop_at_switch):
        ambient = row["ambient_pa"]
        source = row["source_pa"]
        target = row["target_pa"]
        critical = row["critical_ratio"] * source
        growth = (row["expansion_ratio"] - 1.0) / (row["operating_pa"] - ambient)
        w0 = row["rest_volume_m3"] * (1.0 - growth * ambient)
        w1 = 2.0 * row["rest_volume_m3"] * growth
        choked_flow = 1e5 * row["conductance_m3_per_s_pa"] * source
        inverse_span = 1.0 / (source - critical)
        sqrt = math.sqrt

        def choked(_, y):
            return [choked_flow / (w0 + w1 * y[0])]

        def subsonic(_, y):
            p = y[0]
            z = (p - critical) * inverse_span
            return [choked_flow * sqrt(1.0 - z * z) / (w0 + w1 * p) if z < 1.0 else 0.0]

        def both(_, y):
            p = y[0]
            z = (p - critical) * inverse_span
            if z <= 0.0:
                return [choked_flow / (w0 + w1 * p)]
            return [choked_flow * sqrt(1.0 - z * z) / (w0 + w1 * p) if z < 1.0 else 0.0]

        # The flow never falls below its value at the target.
        content = (target - ambient) * (w0 + 0.5 * w1 * (target + ambient))
        time_at_most_s = content / (both(0.0, [target])[0] * (w0 + w1 * target))
        if stop_at_switch and ambient < critical < target:
            self.legs = [Leg(choked, ambient, critical, time_at_most_s),
                         Leg(subsonic, critical, target, time_at_most_s)]
        else:
            self.legs = [Leg(both, ambient, target, time_at_most_s)]
        self.reference_s = row["reference_s"]

    def time_s(self, method, tolerance):
        return sum(leg.time_s(method, tolerance) for leg in self.legs)

    def error(self, method, tolerance):
        error = abs(self.time_s(method, tolerance) / self.reference_s - 1.0)
        return math.inf if math.isnan(error) else error


def loosest_tolerance(rises, method):
    """With the errors at it; None where every tolerance fails."""
    hardest_first = list(rises)
    for eighth in range(89):
        tolerance = 10.0 ** (-2.0 - eighth / 8.0)
        errors = []
        for i, rise in enumerate(hardest_first):
            errors.append(rise.error(method, tolerance))
            if errors[-1] > ERROR_MAX:
                hardest_first.insert(0, hardest_first.pop(i))
                break
        else:
            return tolerance, errors
    return None


def seconds_per_rig(rises, method, tolerance):
    start = time.perf_counter()
    for rise in rises:
        rise.time_s(method, tolerance)
    return (time.perf_counter() - start) / len(rises)


def main(directory):
    with open(f"{directory}/rigs.csv", newline="") as file:
        rows = [{key: float(value) for key, value in row.items()} for row in csv.DictReader(file)]
    print(f"SciPy: errors over all rigs, time over the first {TIMED_RIGS}, "
          f"median of {REPETITIONS} repetitions")
    missed = 0
    with open(f"{directory}/rise.csv", "a") as file:
        for name, method, stop_at_switch in METHODS:
            rises = [Rise(row, stop_at_switch) for row in rows]
            found = loosest_tolerance(rises, method)
            if found is None:
                print(f"SciPy {name} misses {ERROR_MAX} at every tolerance", file=sys.stderr)
                missed += 1
                continue
            tolerance, errors = found
            seconds = statistics.median(
                seconds_per_rig(rises[:TIMED_RIGS], method, tolerance) for _ in range(REPETITIONS))
            file.write(f"SciPy {name};{len(rises)};{tolerance:g};{max(errors):g};"
                       f"{statistics.median(errors):g};{seconds:g}\n")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
