#!/usr/bin/env python3
"""How well design jobs keep their time limits over HTTP, and whether what they have then is valid.

usage: bench/service/time_limits.py [JOBS] [PLENUM] [WORKERS] [FIRST]
       (default 1000 build/release/plenum 2 0)

As many clients as the service has workers post requests of bench/time_limits.py with limits of 0.1
to 5 s and wait for the answer; a job takes from the POST to the answer. Every tenth answer is
checked by `plenum verify`. Prints each job that is more than 0.25 s over, then the spread. From the
limit to the answer it also counts how long the service computed and how long its threads were ready
but had no core: with one client, what a job is late by itself is the time over less that wait.
"""
import concurrent.futures
import http.client
import json
import math
import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent))
import time_limits as examples  # noqa: E402

JOBS = int(sys.argv[1]) if len(sys.argv) > 1 else 1000
PLENUM = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "build/release/plenum")
CLIENTS = int(sys.argv[3]) if len(sys.argv) > 3 else 2
FIRST = int(sys.argv[4]) if len(sys.argv) > 4 else 0
PARTS = ("ranking", "robust", "explain")


def request(number):
    draw = random.Random(number)
    document = examples.vary(json.loads(draw.choice(examples.requirements()).read_text()), draw)
    for part in PARTS:
        if part in document:
            document[part]["time_limit_s"] = round(math.exp(draw.uniform(math.log(0.1), math.log(5))), 2)
    return document


def verified(number, answer, folder):
    result = folder / f"{number}.json"
    result.write_text(json.dumps(answer))
    done = subprocess.run([PLENUM, "verify", result], cwd=folder, capture_output=True, text=True)
    result.unlink()
    return "" if done.returncode == 0 else done.stderr.strip()[:300]


def scheduled(pid):
    """Seconds that the threads of a process ran, and that they waited for a core."""
    ran = waited = 0
    for task in pathlib.Path(f"/proc/{pid}/task").glob("*/schedstat"):
        try:
            fields = task.read_text().split()
        except OSError:  # the thread has ended
            continue
        ran, waited = ran + int(fields[0]), waited + int(fields[1])
    return ran / 1e9, waited / 1e9


def job(number, port, folder, pid):
    document = request(number)
    limit = sum(document[part]["time_limit_s"] for part in PARTS if part in document)
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=120)
    start = time.monotonic()
    connection.request("POST", "/v1/designs", json.dumps(document),
                       {"Content-Type": "application/json", "Prefer": "wait=60"})
    at_limit = []
    timer = threading.Timer(limit - (time.monotonic() - start), lambda: at_limit.append(scheduled(pid)))
    timer.start()
    answer = connection.getresponse()
    text = answer.read()
    over = time.monotonic() - start - limit
    after = scheduled(pid)
    timer.cancel()
    body = json.loads(text)
    ran, waited = (b - a for a, b in zip(at_limit[0], after)) if at_limit else (0.0, 0.0)
    connection.close()
    what = f"{number} {document['name']} {document['objective']} {[p for p in PARTS if p in document]}"
    if answer.status != 200:
        return over, limit, what, f"{answer.status} {body}", "", ran, waited
    # Lists that ask for a probability cannot be judged by verify.
    wrong = ""
    if number % 10 == 0 and body.get("designs") and "robust" not in document:
        wrong = verified(number, body, folder)
    status = body["status"] + ("" if body.get("designs") else " without designs")
    return over, limit, what, status, wrong, ran, waited


def attempt(number, port, folder, pid):
    """What job gives, or nothing where the service is gone."""
    try:
        return job(number, port, folder, pid)
    except (http.client.RemoteDisconnected, OSError) as error:
        print(f"no answer to {number}: {error}: {json.dumps(request(number))}", flush=True)
        return None


def main():
    print("load", *os.getloadavg(), flush=True)
    folder = pathlib.Path(tempfile.mkdtemp())
    shutil.copy("catalog.db", folder)
    server = subprocess.Popen([PLENUM, "serve", "--port", "0"], cwd=folder, stderr=subprocess.PIPE,
                              text=True)
    port = int(server.stderr.readline().rsplit(":", 1)[1].rstrip("/\n"))
    log = []
    threading.Thread(target=lambda: log.extend(server.stderr), daemon=True).start()
    overs, own, statuses, late, wrong = [], [], {}, 0, 0
    with concurrent.futures.ThreadPoolExecutor(CLIENTS) as pool:
        for answered in pool.map(lambda n: attempt(n, port, folder, server.pid),
                                range(FIRST, FIRST + JOBS)):
            if answered is None:
                sys.exit(f"the service ended with {server.wait()}: {''.join(log[-5:])}")
            over, limit, what, status, fault, ran, waited = answered
            overs.append(over)
            own.append(over - waited)
            statuses[status] = statuses.get(status, 0) + 1
            if over > 0.25:
                late += 1
                print(f"{over:+.3f} s over {limit:.2f} s (computed {ran:.3f} s, waited {waited:.3f} s for a "
                      f"core): {what}, {status}; load {os.getloadavg()[0]:.1f}", flush=True)
            if fault:
                wrong += 1
                print(f"refused by verify: {what}: {fault}", flush=True)
    server.terminate()
    server.wait()
    shutil.rmtree(folder)
    overs.sort()
    print(f"{JOBS} jobs, {late} more than 0.25 s over; worst {overs[-1]:+.3f} s, "
          f"99 % {overs[int(0.99 * len(overs))]:+.3f} s; less the wait for a core worst "
          f"{max(own):+.3f} s; {wrong} refused by verify; {statuses}")
    print("load", *os.getloadavg())


main()
