"""Runs `plenum diagnose --json` on every case of a folder, two at a time.

usage: run_cases.py PLENUM FOLDER [EXTEND_CASE | --halved]
Writes FOLDER/answers/NNNN.json with the answer as printed and FOLDER/times/NNNN.json with the
seconds that it took; what is there already is kept. Where the answer is a tie with a proposed
experiment, EXTEND_CASE carries it out on the true rig and the diagnosis is made again, to
FOLDER/decided/NNNN.json. With --halved, where the answer names something, the diagnosis is made again
of every second reading, to FOLDER/halved/NNNN.json.
"""

import concurrent.futures
import json
import pathlib
import subprocess
import sys
import time

LIMIT_S = 1800


def diagnose(plenum, measurement, answer):
    begun = time.monotonic()
    try:
        run = subprocess.run([plenum, "diagnose", measurement, "--json"], capture_output=True,
                             timeout=LIMIT_S)
    except subprocess.TimeoutExpired:
        return {"seconds": LIMIT_S, "status": "timeout"}
    seconds = time.monotonic() - begun
    if run.returncode == 0:
        document = json.loads(run.stdout)
        document.pop("series", None)
        answer.write_text(json.dumps(document))
    return {"seconds": seconds, "status": run.returncode, "error": run.stderr.decode()[-500:]}


def decide(plenum, extend_case, folder, name):
    answer = folder / "answers" / name
    if not answer.exists() or json.loads(answer.read_text()).get("next_experiment") is None:
        return
    measurement = folder / "extended" / name
    subprocess.run([extend_case, folder / "truth" / name, answer, measurement], check=True)
    diagnose(plenum, measurement, folder / "decided" / name)


def halve(plenum, folder, name):
    """Again, of every second reading of each run, where runs have readings enough for that."""
    path = folder / "answers" / name
    if not path.exists():
        return
    answer = json.loads(path.read_text())
    case = json.loads((folder / "cases" / name).read_text())
    readings = min(sum(p is not None for p in run["pressure_kpa_gauge"][::2])
                   for run in case["runs"])
    if readings < 8 or not (answer["effects"] or answer.get("numbers")):
        return
    for run in case["runs"]:
        for lists in (run, run.get("channels", {})):
            for field, value in lists.items():
                if isinstance(value, list) and field != "valve":
                    lists[field] = value[::2]
    measurement = folder / "extended" / name
    measurement.write_text(json.dumps(case))
    diagnose(plenum, measurement, folder / "halved" / name)


def work(plenum, extend_case, folder, name):
    if not (folder / "times" / name).exists():
        record = diagnose(plenum, folder / "cases" / name, folder / "answers" / name)
        (folder / "times" / name).write_text(json.dumps(record))
    if extend_case == "--halved":
        if not (folder / "halved" / name).exists():
            halve(plenum, folder, name)
    elif extend_case and not (folder / "decided" / name).exists():
        decide(plenum, extend_case, folder, name)


def main():
    plenum, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    extend_case = sys.argv[3] if len(sys.argv) > 3 else None
    for part in ("answers", "times", "extended", "decided", "halved"):
        (folder / part).mkdir(exist_ok=True)
    names = sorted(path.name for path in (folder / "cases").glob("*.json"))
    with concurrent.futures.ThreadPoolExecutor(2) as pool:
        done = [pool.submit(work, plenum, extend_case, folder, name) for name in names]
        for future in concurrent.futures.as_completed(done):
            if future.exception():
                print(future.exception(), file=sys.stderr)


main()
