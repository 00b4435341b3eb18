#!/usr/bin/env python3
"""Tables of what run.py wrote: usage: table.py FILE.jsonl...

Shares by class of request, times of verify, and all that is wrong, with its seeds.
"""
import collections
import json
import math
import statistics
import sys

CLASSES = ("groups", "timing", "configuration", "objective")
COLUMNS = ("drawn", "optimal", "infeasible", "feasible", "empty", "proved ≤ 1 s", "proved ≤ 10 s", "overruns",
           "broken")
BROKEN = ("contradiction", "empty")  # kinds of findings


def read_lines(paths):
    """The newest line of each seed and mode."""
    lines = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for text in file:
                line = json.loads(text)
                lines[line["mode"], line["seed"]] = line
    return list(lines.values())


def proved(line):
    return line["status"] in ("optimal", "infeasible")


def has_finding(line, *kinds):
    return any(finding["kind"] in kinds for finding in line["findings"])


def share(lines, condition):
    count = sum(map(condition, lines))
    return f"{count} ({100 * count / len(lines):.0f} %)" if lines else "–"


def row_of(lines):
    return [str(len(lines)),
            share(lines, lambda line: line["status"] == "optimal"),
            share(lines, lambda line: line["status"] == "infeasible"),
            share(lines, lambda line: line["status"] == "feasible" and line["designs"] > 0),
            share(lines, lambda line: line["status"] == "feasible" and line["designs"] == 0),
            share(lines, lambda line: proved(line) and line["cpu_s"] <= 1.0),
            share(lines, lambda line: proved(line) and line["cpu_s"] <= 10.0),
            str(sum(has_finding(line, "overrun") for line in lines)),
            str(sum(has_finding(line, *BROKEN) for line in lines))]


def table_of_classes(lines):
    """Of answered requests."""
    print("| class |", " | ".join(COLUMNS), "|")
    print("| --- |" + " ---: |" * len(COLUMNS))
    print("| all |", " | ".join(row_of(lines)), "|")
    for name in CLASSES:
        values = sorted({line[name] for line in lines}, key=str)
        for value in values:
            label = f"{name}: {value}"
            print(f"| {label} |", " | ".join(row_of([line for line in lines if line[name] == value])), "|")


def quantile(values, share_below):
    return sorted(values)[max(0, math.ceil(share_below * len(values)) - 1)]


def table_of_verify(lines):
    runs = [line["verify"] for line in lines if "verify" in line]
    if not runs:
        return
    times = [run["cpu_s"] for run in runs]
    accepted, stopped = sum(run["exit_code"] == 0 for run in runs), sum(run["stopped"] for run in runs)
    print(f"\nVerify: {len(runs)} answers, {accepted} accepted, {stopped} out of time; CPU median "
          f"{statistics.median(times):.2f} s, p90 {quantile(times, 0.9):.2f} s, max {max(times):.1f} s; "
          f"more than 10 s {sum(time > 10.0 for time in times)}")


def table_of_relations(lines):
    """How often each relation applied; its findings stand in the list below."""
    applied = collections.Counter(name for line in lines for name in line.get("relations", []))
    if applied:
        print("\nRelations that applied:", ", ".join(f"{name} {count}" for name, count in sorted(applied.items())))


def list_findings(lines):
    found = [(finding["kind"], finding["relation"], line, finding["what"])
             for line in lines for finding in line["findings"]]
    print(f"\nFindings: {len(found)}")
    for kind, relation, line, what in sorted(found, key=lambda one: (one[0], one[1], one[2]["seed"])):
        print(f"* {kind}, {relation}, seed {line['seed']} of {line['mode']}: {what}")


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    lines = read_lines(sys.argv[1:])
    answered = [line for line in lines if line["status"]]
    table_of_classes(answered)
    for line in lines:
        if not line["status"]:
            print(f"\nSeed {line['seed']} of {line['mode']} has no answer (exit status {line['exit_code']}): {line['error']}")
    short = [line for line in answered if line["status"] == "feasible" and line["cpu_s"] < 0.8 * line["limit_s"]]
    print(f"\nStopped by the clock with less than 0.8 of the limit in CPU: {len(short)}")
    table_of_verify(answered)
    table_of_relations(answered)
    list_findings(lines)


if __name__ == "__main__":
    main()
