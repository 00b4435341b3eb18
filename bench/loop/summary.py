#!/usr/bin/env python3
"""How the engineers of loop_bench did.

usage: summary.py FILE.jsonl...
Prints, of all requests and of each, for each way to buy: the share that meets all requirements in
truth with its 95 % Wilson interval, what was bought over the best that truth allows, with masses as
printed and as drawn, and the number of tests; then how the tests did.
"""
import collections
import json
import math
import statistics
import sys

WAYS = ("nominal", "guaranteed", "random", "loop", "loop and confirmed")


def wilson(hits, count):
    z, p = 1.96, hits / count
    middle = (p + z * z / (2 * count)) / (1 + z * z / count)
    half = z * math.sqrt(p * (1 - p) / count + z * z / (4 * count * count)) / (1 + z * z / count)
    return max(0.0, middle - half), min(1.0, middle + half)


def quantile(values, share):
    values = sorted(values)
    return values[min(len(values) - 1, math.ceil(share * len(values)) - 1)] if values else math.nan


def over_best(lines, mass, best):
    """Of those that meet, relative."""
    return [line[mass] / line[best] - 1.0 for line in lines
            if line["meets"] and line[mass] and line[best]]


def percent(value):
    return "    –" if math.isnan(value) else f"{100 * value:5.1f}"


def missed_of(line):
    """The requirement; what the program refuses to evaluate is a part that does not stand its pressure."""
    if line["missed"].startswith("/design/"):
        return "the pressure that a part stands"
    return {"works": "that it works at all"}.get(line["missed"], line["missed"])


def table(title, lines):
    print(f"\n{title}")
    print(f"  {'':<20}{'meets':>12} {'%':>6} {'95 %':>12}  {'over the best, printed':>24}"
          f"{'as drawn':>16}  {'tests':>10}")
    print(f"  {'':<20}{'':>12} {'':>6} {'':>12}  {'median, p90 (%)':>24}{'median, p90':>16}"
          f"  {'median, most':>12}")
    for way in WAYS:
        of_way = [line for line in lines if line["way"] == way]
        if not of_way:
            continue
        met = sum(line["meets"] for line in of_way)
        low, high = wilson(met, len(of_way))
        printed = over_best(of_way, "printed_mass_kg", "best_printed_kg")
        drawn = over_best(of_way, "mass_kg", "best_kg")
        tests = [len(line["tests"]) for line in of_way]
        print(f"  {way:<20}{met:>6}/{len(of_way):<5} {100 * met / len(of_way):6.1f}"
              f" {100 * low:5.1f}–{100 * high:5.1f}"
              f"  {percent(quantile(printed, .5)):>16} {percent(quantile(printed, .9)):>7}"
              f"{percent(quantile(drawn, .5)):>9} {percent(quantile(drawn, .9)):>6}"
              f"  {statistics.median(tests):>7} {max(tests):>4}")
    missed = collections.Counter(
        (line["way"], missed_of(line)) for line in lines if line["bought"] and not line["meets"])
    for (way, requirement), count in missed.most_common():
        worst = min(line["margin"] for line in lines
                    if line["way"] == way and not line["meets"] and missed_of(line) == requirement)
        by = f", worst by {-100 * worst:.1f} %" if worst < 0.0 else ""
        print(f"    {way} missed {requirement}: {count}{by}")


def table_of_tests(lines):
    tests = [test for line in lines if line["way"] in ("loop and confirmed", "random")
             for test in line["tests"]]
    bottles = [test for test in tests if test["numbers"]]
    refused = collections.Counter(reason for test in bottles for reason in test["refused"])
    print(f"\nTests: {len(tests)}, {len(bottles)} with a recording, "
          f"{sum(bool(test['refused']) for test in bottles)} refused, "
          f"{sum(test['contradicted'] for test in bottles)} off the estimate by more than its width")
    for reason, count in refused.most_common():
        print(f"    {count} × {reason}")
    named = [test for test in tests if test["why"] == "saves" and test["objective"]]
    none = sum(test["objective"] >= test["objective_before"] * (1 - 1e-9) for test in named)
    print(f"  named by the answer: {len(named)}, after which the guaranteed design was no better: "
          f"{none}")
    print("  95 % intervals of saved numbers that hold the truth")
    inside = collections.defaultdict(list)
    for test in bottles:
        for number in test["numbers"]:
            if number["saved"] and number["interval_95"]:
                low, high = number["interval_95"]
                name = number["field"].replace("_dm3_per_s_bar", "")
                inside[f"{test['family']} {name}"].append(low <= number["truth"] <= high)
    for name, flags in sorted(inside.items()):
        low, high = wilson(sum(flags), len(flags))
        print(f"    {name:<40}{sum(flags):>5}/{len(flags):<5}{100 * sum(flags) / len(flags):6.1f} %"
              f"   {100 * low:5.1f}–{100 * high:5.1f}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lines = []
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as file:
            lines += [json.loads(line) for line in file]
    names = list(dict.fromkeys(line["requirements"] for line in lines))
    table(f"All requests: {len({line['world'] for line in lines})} worlds", lines)
    for name in names:
        table(name, [line for line in lines if line["requirements"] == name])
    table_of_tests(lines)


if __name__ == "__main__":
    main()
