"""Tables of what `rivals` and `rivals_scipy.py` wrote.

usage: rivals_table.py FILE
Not 0 where plenum missed an optimum or did not prove it.
"""

import collections
import math
import statistics
import sys

TIE = 1e-6
PROVERS = 100.0  # plenum should be this many times faster than the fastest that proves
# Solvers as a user of them would feed them, with the cuts that monotony alone gives; the lifted cuts
# look for the strongest cut by calling the march for each, as the search does.
LIFTED = "lifted cuts"


def median(values):
    return statistics.median(values) if values else math.nan


def seconds(value):
    return "–" if math.isnan(value) else f"{value:.2g} s" if value >= 1 else f"{1e3 * value:.2g} ms"


def main():
    with open(sys.argv[1]) as file:
        lines = [line.rstrip("\n").split("\t") for line in file]
    runs = collections.defaultdict(dict)  # (size, rival) -> seed -> run
    rivals = [line[1:] for line in lines if line[0] == "rival"]
    for line in lines:
        if line[0] != "run":
            continue
        _, rival, size, seed, claimed, feasible, mass, find_s, total_s, note = line
        runs[int(size), rival][int(seed)] = (claimed == "1", feasible == "1", float(mass),
                                             float(find_s), float(total_s), note)
    sizes = sorted({size for size, _ in runs})
    for name, formulation, options in rivals:
        print(f"* {name}: {formulation}; {options}.")
    status = 0
    for size in sizes:
        # The least feasible mass that anyone knows; by brute force where that is possible.
        truth = {}
        for (other, rival), by_seed in runs.items():
            if other == size:
                for seed, run in by_seed.items():
                    if run[1]:
                        truth[seed] = min(truth.get(seed, math.inf), run[2])
        known = "by brute force" if (size, "brute force") in runs else "the best that anyone found"
        print(f"\n{size} parts a family, {len(truth)} instances, optimum {known}\n")
        print("| | found the optimum | said so wrongly | claimed optimal | time to find | "
              "time to the end | times plenum's |")
        print("| --- | ---: | ---: | ---: | ---: | ---: | ---: |")
        plenum = median([run[4] for run in runs[size, "plenum"].values()])
        for name, _, _ in rivals:
            by_seed = runs.get((size, name), {})
            if not by_seed:
                continue
            right = [run[1] and run[2] <= truth[seed] * (1 + TIE) for seed, run in by_seed.items()]
            claimed = [run[0] for run in by_seed.values()]
            wrong = sum(c and not r for c, r in zip(claimed, right))
            found = median([run[3] for run, r in zip(by_seed.values(), right) if r])
            total = median([run[4] for run in by_seed.values()])
            print(f"| {name} | {sum(right)} of {len(right)} | {wrong} | {sum(claimed)} | "
                  f"{seconds(found)} | {seconds(total)} | {total / plenum:,.0f} |")
            if name == "plenum" and (not all(right) or not all(claimed)):
                status = 1
        for lifted in (False, True):
            provers = [median([run[4] for run in by_seed.values()])
                       for (other, name), by_seed in runs.items()
                       if other == size and name not in ("plenum", "brute force")
                       and any(run[0] for run in by_seed.values()) and (LIFTED in name) == lifted]
            if not provers:
                continue
            ratio = min(provers) / plenum
            aim = "" if lifted else (f", {PROVERS:.0f} or more are wanted"
                                     f"{'' if ratio >= PROVERS else ': missed'}")
            print(f"\nThe fastest other that claims a proof{', of those with lifted cuts,' if lifted else ''}"
                  f" takes {ratio:,.0f} times plenum's time{aim}.")
    sys.exit(status)


main()
