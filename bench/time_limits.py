#!/usr/bin/env python3
"""How well `plenum design` keeps its time limit: random limits over examples and objectives.

usage: bench/time_limits.py [RUNS] [PLENUM]     (default 200 build/release/plenum)
Prints every run that is more than 0.1 s over, and the worst. Start-up (reading the catalogue) counts.
"""
import json
import pathlib
import random
import subprocess
import sys
import time

RUNS = int(sys.argv[1]) if len(sys.argv) > 1 else 200
PLENUM = sys.argv[2] if len(sys.argv) > 2 else "build/release/plenum"
LIMITS_S = [0.05, 0.2, 0.5, 1.0, 2.0, 3.0]
OBJECTIVES = [
    {"minimize": "mass_kg"}, {"minimize": "volume_l"}, {"minimize": "cost_eur"},
    {"minimize": "energy_wh"}, {"minimize": {"mass_kg": 1.0, "energy_wh": 0.02}},
    {"pareto": ["mass_kg", "energy_wh"]}, {"pareto": ["mass_kg", "volume_l", "cost_eur"]},
]


def vary(request, draw):
    request["objective"] = draw.choice(OBJECTIVES)
    minimize = "minimize" in request["objective"]
    kind = draw.random()
    if kind < 0.15:  # out of reach: the conflict takes the time
        request["actuators"][0]["rise_time_s_max"] = 0.02
    elif kind < 0.25 and minimize:
        request["robust"] = {"draws": 200, "seed": 1, "time_limit_s": draw.choice(LIMITS_S)}
    elif kind < 0.35 and minimize:
        request["explain"] = {"prices": True, "ranks": 4, "time_limit_s": draw.choice(LIMITS_S)}
    if len(request["actuators"]) > 1 and draw.random() < 0.5:
        request["duty"]["simultaneous"] = True
    configurations = ["cylinder", "co2", "compressor"]
    request["supply"]["configurations"] = draw.choice([configurations, ["compressor"], ["cylinder"]])
    request["ranking"] = {"count": draw.choice([1, 5, 20]), "time_limit_s": draw.choice(LIMITS_S)}
    return request


def requirements():
    return [p for p in sorted(pathlib.Path("examples").glob("*.json"))
            if json.loads(p.read_text()).get("schema") == "requirements/1"]


def main():
    examples = requirements()
    draw = random.Random(1)
    worst, statuses = 0.0, {}
    for run in range(RUNS):
        example = draw.choice(examples)
        request = vary(json.loads(example.read_text()), draw)
        limit = sum(request.get(part, {}).get("time_limit_s", 0.0)
                    for part in ("ranking", "robust", "explain"))
        start = time.monotonic()
        done = subprocess.run([PLENUM, "design", "-", "--json"], input=json.dumps(request), text=True,
                              capture_output=True)
        over = time.monotonic() - start - limit
        status = (json.loads(done.stdout)["status"] if done.returncode == 0
                  else f"exit {done.returncode} {done.stderr.strip()[:200]}")
        if done.returncode != 0:
            print(f"run {run}: {json.dumps(request)}", flush=True)
        statuses[status] = statuses.get(status, 0) + 1
        worst = max(worst, over)
        if over > 0.1:
            extra = [k for k in ("robust", "explain") if k in request]
            print(f"run {run}: {over:+.3f} s over {limit} s, {example.name}, {request['objective']}, {extra}, {request['supply']['configurations']}, simultaneous {request['duty'].get('simultaneous', True)}, {status}", flush=True)
    print(f"{RUNS} runs, worst {worst:+.3f} s; {statuses}")


if __name__ == "__main__":
    main()
