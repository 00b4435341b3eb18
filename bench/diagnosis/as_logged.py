"""Cases as a log has them whose rows tell what the valve is told: each command at the first row after it.

usage: as_logged.py FOLDER LOGGED
Writes LOGGED/cases from the cases of FOLDER (make_cases); truth stays as it is. A state that lasts less
than a row is lost. run_cases.py and judge_real.py take the folder as any other.
"""

import bisect
import json
import pathlib
import shutil
import sys


def logged(run):
    valve = []
    for command in run["valve"]:
        row = bisect.bisect_left(run["t_s"], command["t_s"])
        if row == len(run["t_s"]):
            continue
        if valve and valve[-1]["t_s"] == run["t_s"][row]:
            valve.pop()
        valve.append({"t_s": run["t_s"][row], "state": command["state"]})
    return {**run, "valve": valve}


def main():
    folder, new = map(pathlib.Path, sys.argv[1:3])
    (new / "cases").mkdir(parents=True, exist_ok=True)
    shutil.copytree(folder / "truth", new / "truth", dirs_exist_ok=True)
    for path in (folder / "cases").glob("*.json"):
        case = json.loads(path.read_text())
        case["runs"] = [logged(run) for run in case["runs"]]
        (new / "cases" / path.name).write_text(json.dumps(case))


main()
