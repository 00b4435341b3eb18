#!/usr/bin/env python3
"""The service under bursts of faults at system calls (faults.cc): it lives, serves fully within a second after a burst,
has every write that it acknowledged, and none that is half done.
usage: faults_test.py CHECKOUT PROGRAM LIBRARY; PLENUM_FAULTS_TOTAL (300) says how many faults, PLENUM_FAULTS_SEED which"""
import collections
import http.client
import json
import mmap
import os
import pathlib
import random
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import threading
import time

TOTAL = int(os.environ.get("PLENUM_FAULTS_TOTAL", "300"))
SEED = int(os.environ.get("PLENUM_FAULTS_SEED", "1"))
KINDS = ("input", "output", "files", "synced", "accepted", "memory")
ONE_IN, ONE_IN_MEMORY = 15, 8000
BURST_S, RECOVERY_S, CLIENTS, ROWS = 0.06, 1.0, 4, 8
HEADINGS = ("id,manufacturer,part_number,tube_outer_diameter_mm,sonic_conductance_dm3_per_s_bar,critical_ratio,mass_kg,"
            "body_volume_ml,pressure_max_kpa_gauge,thread\n")


class Control:
    """What the test and the library share."""

    def __init__(self, path):
        path.write_bytes(b"\0" * 64)
        with path.open("r+b") as file:
            self.memory = mmap.mmap(file.fileno(), 64)

    def set(self, one_in, one_in_memory, seed):
        self.memory[8:12] = struct.pack("I", seed)
        self.memory[0:8] = struct.pack("II", one_in, one_in_memory)

    def faults(self):
        return dict(zip(KINDS, struct.unpack("6I", self.memory[16:40])))


class Service:
    def __init__(self, program, folder, library):
        self.control = Control(folder / "faults")
        self.process = subprocess.Popen(
            [program, "serve", "--catalog", folder / "catalog.db", "--port", "0"], cwd=folder, stderr=subprocess.PIPE,
            text=True, env={**os.environ, "LD_PRELOAD": str(library), "PLENUM_FAULTS": str(folder / "faults")})
        self.port = int(re.search(r":(\d+)/", self.process.stderr.readline()).group(1))
        self.log = collections.deque(maxlen=20)
        threading.Thread(target=lambda: self.log.extend(self.process.stderr), daemon=True).start()
        while self.ask("GET", "/v1/parts?limit=1")[0] != 200:  # until it has begun
            time.sleep(0.01)

    def ask(self, method, path, body=None, kind="application/json", key=None, timeout=10):
        """(status, body, Location) of one answer on a connection of its own; (0, ...) where none came."""
        headers = {"Content-Type": kind, "If-Match": "*", **({"Idempotency-Key": key} if key else {})}
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        try:
            connection.request(method, path, body, headers)
            answer = connection.getresponse()
            return answer.status, answer.read().decode(), answer.headers.get("Location")
        except (OSError, http.client.HTTPException):
            return 0, "", None
        finally:
            connection.close()


def part(name, grams):
    return json.dumps({"id": name, "family": "fitting", "manufacturer": "bench", "part_number": "F1",
                       "tube_outer_diameter_mm": 4, "sonic_conductance_dm3_per_s_bar": 0.31, "critical_ratio": 0.4,
                       "mass_kg": grams / 1000, "body_volume_ml": 0.7, "pressure_max_kpa_gauge": 800, "thread": "M5"})


class Writer:
    """Writes of one client: what was acknowledged, and what may have been done."""

    def __init__(self, service, name):
        self.service, self.name, self.random = service, name, random.Random(f"{SEED} {name}")
        self.count, self.adds, self.imports, self.removed = 0, {}, {}, {}

    def write(self):
        self.count += 1
        name, grams = f"{self.name}-{self.count}", self.random.randint(1, 400)
        if self.random.random() < 0.2:
            table = HEADINGS + "".join(f"{name}-{row},bench,F1,4,0.31,0.4,{grams} g,0.7,800,M5\n" for row in range(ROWS))
            status, _, _ = self.service.ask("POST", "/v1/parts/import?family=fitting", table, "text/csv", name)
            self.imports[name] = (grams, status == 200, table)
        elif self.adds and self.random.random() < 0.2:
            gone = self.random.choice(list(self.adds))
            status, _, _ = self.service.ask("DELETE", f"/v1/parts/{gone}")
            del self.adds[gone]
            self.removed[gone] = status == 204
        else:
            status, _, _ = self.service.ask("POST", "/v1/parts", part(name, grams), key=name)
            self.adds[name] = (grams, status == 201)

    def run(self, until):
        while time.monotonic() < until:
            self.write()
            self.service.ask("GET", f"/v1/parts/{self.name}-{self.random.randint(1, self.count)}")
            self.service.ask("GET", "/v1/parts?limit=20")

    def complaints(self, stored):
        for name, (grams, acknowledged) in self.adds.items():
            if stored.get(name, None if acknowledged else grams) != grams:
                yield f"{name}: {stored.get(name)} g, not {grams}; acknowledged: {acknowledged}"
        for name, (grams, acknowledged, _) in self.imports.items():
            rows = [stored.get(f"{name}-{row}") for row in range(ROWS)]
            if rows != [grams] * ROWS and (acknowledged or rows != [None] * ROWS):
                yield f"{name}: rows {rows}; acknowledged: {acknowledged}"
        for name, acknowledged in self.removed.items():
            if acknowledged and name in stored:
                yield f"{name} is back"

    def ask_again(self):
        """What got no answer: with its key it acts once."""
        for name, (grams, acknowledged) in self.adds.items():
            if not acknowledged:
                yield name, self.service.ask("POST", "/v1/parts", part(name, grams), key=name)[0], 201
        for name, (grams, acknowledged, table) in self.imports.items():
            if not acknowledged:
                yield name, self.service.ask("POST", "/v1/parts/import?family=fitting", table, "text/csv", name)[0], 200
        self.adds = {name: (grams, True) for name, (grams, _) in self.adds.items()}
        self.imports = {name: (grams, True, table) for name, (grams, _, table) in self.imports.items()}


def stored_fittings(service):
    status, table, _ = service.ask("GET", "/v1/parts/export?family=fitting", timeout=30)
    lines = [line.split(",") for line in table.splitlines()]
    ids, masses = lines[0].index("id"), lines[0].index("mass_kg")
    return {line[ids]: round(float(line[masses]) * 1000) for line in lines[1:] if line[ids].startswith("w")} if status else {}


def burst(service, writers, number, jobs):
    service.control.set(ONE_IN, ONE_IN_MEMORY, SEED * 1000 + number)
    until = time.monotonic() + BURST_S
    threads = [threading.Thread(target=writer.run, args=(until,)) for writer in writers]
    for thread in threads:
        thread.start()
    if number % 4 == 0:
        status, _, location = service.ask("POST", "/v1/designs", jobs["request"], key=f"job {number}")
        if status == 202:
            jobs["acknowledged"].append(location)
    time.sleep(max(0.0, until - time.monotonic()))
    service.control.set(0, 0, 0)
    ended = time.monotonic()
    for thread in threads:
        thread.join()
    return ended


def check_recovery(service, number, ended):
    """Everything works within a second after the faults."""
    for method, path, body, wanted in (("GET", "/healthz", None, 200), ("GET", "/readyz", None, 200),
                                       ("POST", "/v1/parts", part(f"after-{number}", 5), 201),
                                       ("GET", f"/v1/parts/after-{number}", None, 200),
                                       ("DELETE", f"/v1/parts/after-{number}", None, 204),
                                       ("GET", "/v1/designs", None, 200)):
        while (got := service.ask(method, path, body))[0] != wanted and time.monotonic() - ended < RECOVERY_S:
            time.sleep(0.01)
        if got[0] != wanted:
            yield f"burst {number}: {method} {path} is {got[0]} a second after the faults: {got[1][:200]}"


def check_jobs(service, jobs):
    for location in jobs["acknowledged"]:
        for _ in range(600):
            status, body, _ = service.ask("GET", location)
            if status != 200 or json.loads(body)["status"] not in ("queued", "running"):
                break
            time.sleep(0.1)
        if status != 200 or json.loads(body)["status"] not in ("done", "failed"):
            yield f"the job {location} is lost: {status} {body[:200]}"


def run_bursts(service, root):
    request = json.loads((root / "examples/gripper.json").read_text(encoding="utf-8"))
    request["ranking"] = {"count": 1, "time_limit_s": 2.0}
    jobs = {"request": json.dumps(request), "acknowledged": []}
    writers = [Writer(service, f"w{number}") for number in range(CLIENTS)]
    number = 0
    while sum(service.control.faults().values()) < TOTAL:
        number += 1
        ended = burst(service, writers, number, jobs)
        if service.process.poll() is not None:
            return [f"the service ended with {service.process.returncode} in burst {number}: {''.join(service.log)}"]
        complaints = list(check_recovery(service, number, ended))
        if complaints:
            return complaints + list(service.log)
    stored = stored_fittings(service)
    complaints = [complaint for writer in writers for complaint in writer.complaints(stored)]
    complaints += [f"{name}: asked again it is {got}" for writer in writers for name, got, wanted in writer.ask_again()
                   if got != wanted]
    complaints += list(check_jobs(service, jobs))
    stored = stored_fittings(service)
    complaints += [complaint for writer in writers for complaint in writer.complaints(stored)]
    written = sum(len(writer.adds) + len(writer.imports) + len(writer.removed) for writer in writers)
    print(f"{number} bursts, {written} writes, {len(jobs['acknowledged'])} jobs, faults {service.control.faults()}")
    return complaints


def main(checkout, program, library):
    root, program = pathlib.Path(checkout), pathlib.Path(program).resolve()
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        shutil.copy(root / "catalog.db", folder / "catalog.db")
        service = Service(program, folder, pathlib.Path(library).resolve())
        try:
            complaints = run_bursts(service, root)
        finally:
            service.process.terminate()
            service.process.wait()
        check = subprocess.run([program, "catalog", "check", "--catalog", folder / "catalog.db"], capture_output=True,
                               text=True, check=False)
        if check.returncode != 0:
            complaints.append(check.stdout + check.stderr)
    print(*complaints, sep="\n")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
