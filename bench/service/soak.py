#!/usr/bin/env python3
"""A service under mixed load for as long as you like: does it stay right, quick and small?

usage: bench/service/soak.py [MINUTES] [PLENUM]     (default 10 build/release/plenum)

Clients list, read, add, replace, remove, import and undo parts; others post design jobs, cancel
some and read ended ones; every minute the service is backed up, stopped or killed, and started
again. Ends with 1 at the first answer of 5xx, lost write, failed check, or when the memory of the
idle service has grown by more than 64 MB between its starts.
"""
import http.client
import json
import os
import pathlib
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time

MINUTES = float(sys.argv[1]) if len(sys.argv) > 1 else 10.0
PLENUM = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "build/release/plenum")
ROUND_S = 60.0
PART = {"family": "fitting", "manufacturer": "soak", "part_number": "F1",
        "tube_outer_diameter_mm": 4.0, "sonic_conductance_dm3_per_s_bar": 0.31, "critical_ratio": 0.4,
        "body_volume_ml": 0.7, "pressure_max_kpa_gauge": 800.0, "thread": "M5"}
CSV_HEAD = ("id,manufacturer,part_number,tube_outer_diameter_mm,sonic_conductance_dm3_per_s_bar,"
            "critical_ratio,mass_kg,body_volume_ml,pressure_max_kpa_gauge,thread\n")
faults = []


class Gone(Exception):
    """The service was stopped; what was under way is unknown."""


class Client:
    def __init__(self, number):
        self.draw = random.Random(number)
        self.number = number
        self.port = 0
        self.grams = {}  # of the parts that this client alone writes, as acknowledged
        self.unsure = set()  # ids of a write that was cut off
        self.done = 0
        self.slowest_ms = 0.0

    def ask(self, method, path, body=None, headers=None, allowed=(200, 201, 202, 204)):
        start = time.monotonic()
        try:
            self.connection.request(method, path, body, headers or {})
            answer = self.connection.getresponse()
            data = answer.read()
        except OSError as error:
            raise Gone from error
        except http.client.HTTPException as error:
            raise Gone from error
        if "Prefer" not in (headers or {}):
            self.slowest_ms = max(self.slowest_ms, 1000 * (time.monotonic() - start))
        if answer.status not in allowed:
            faults.append(f"{method} {path}: {answer.status} {data[:300]}")
        self.done += 1
        return answer.status, data

    def run(self):
        self.connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        try:
            while not faults:
                self.step()
        except Gone:
            pass
        finally:
            self.connection.close()


class Writer(Client):
    def step(self):
        draw, ids = self.draw, [f"soak{self.number}-{i}" for i in range(30)]
        part = draw.choice(ids)
        grams = draw.randint(1, 400)
        kind = draw.choice("read list write write remove import undo".split())
        json_type = {"Content-Type": "application/json"}
        if kind == "read":
            return self.read(part)
        if kind == "list":
            return self.ask("GET", f"/v1/parts?family=fitting&mass_kg_max={grams / 1000}&sort=-mass_kg")
        if kind == "import":
            after = {i: draw.randint(1, 400) for i in draw.sample(ids, 10)}
            rows = "".join(f"{i},soak,F1,4,0.31,0.4,{g} g,0.7,8 bar,M5\n" for i, g in after.items())
            return self.write(after, "POST", "/v1/parts/import?family=fitting", CSV_HEAD + rows,
                              {"Content-Type": "text/csv"})
        if kind == "remove" or (kind == "undo" and part in self.grams):
            if part not in self.grams:
                return None
            if kind == "remove":
                return self.write({part: None}, "DELETE", "/v1/parts/" + part, None, {"If-Match": "*"})
            return self.undo(part)
        body = json.dumps(dict(PART, id=part, mass_kg=grams / 1000))
        if part in self.grams:
            return self.write({part: grams}, "PUT", "/v1/parts/" + part, body,
                              dict(json_type, **{"If-Match": "*"}))
        return self.write({part: grams}, "POST", "/v1/parts", body, json_type)

    def write(self, after, *request):
        self.unsure = set(after)
        self.ask(*request)
        self.unsure = set()
        for part, grams in after.items():
            if grams is None:
                self.grams.pop(part, None)
            else:
                self.grams[part] = grams

    def undo(self, part):
        # The newest change of a part of ours; another of ours in the same import may have changed since.
        _, data = self.ask("GET", f"/v1/parts/{part}/history?limit=1")
        change = json.loads(data)["history"][0]["revision"]
        _, data = self.ask("GET", f"/v1/revisions/{change['number']}")
        before = {c["id"]: c["before"] and round(c["before"]["mass_kg"] * 1000)
                  for c in json.loads(data)["changes"]}
        self.unsure = set(before)
        status, _ = self.ask("POST", f"/v1/revisions/{change['number']}/undo", allowed=(200, 409))
        self.unsure = set()
        if status == 200:
            for i, grams in before.items():
                if grams is None:
                    self.grams.pop(i, None)
                else:
                    self.grams[i] = grams

    def read(self, part):
        status, data = self.ask("GET", "/v1/parts/" + part, allowed=(200, 404))
        if part in self.unsure:
            return
        seen = round(json.loads(data)["mass_kg"] * 1000) if status == 200 else None
        if seen != self.grams.get(part):
            faults.append(f"{part} is {seen}, was written as {self.grams.get(part)}")

    def settle(self):
        """After a restart: all that was acknowledged is there; what was cut off is taken as it is."""
        self.connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        for part in [f"soak{self.number}-{i}" for i in range(30)]:
            status, data = self.ask("GET", "/v1/parts/" + part, allowed=(200, 404))
            seen = round(json.loads(data)["mass_kg"] * 1000) if status == 200 else None
            if part not in self.unsure and seen != self.grams.get(part):
                faults.append(f"after a restart {part} is {seen}, was {self.grams.get(part)}")
            if seen is None:
                self.grams.pop(part, None)
            else:
                self.grams[part] = seen
        self.unsure = set()


class Designer(Client):
    jobs = None

    def step(self):
        self.jobs = self.jobs or []
        request = json.loads(pathlib.Path("examples/gripper.json").read_text())
        request["ranking"] = {"count": self.draw.choice([1, 5]), "time_limit_s": 2.0}
        wait = {"Prefer": "wait=5"} if self.draw.random() < 0.5 else {}
        status, data = self.ask("POST", "/v1/designs", json.dumps(request),
                                dict(wait, **{"Content-Type": "application/json"}),
                                allowed=(200, 202, 429))
        if status == 429:
            time.sleep(0.5)
        if status == 202:
            self.jobs.append(json.loads(data)["links"]["self"])
        for job in self.draw.sample(self.jobs, min(2, len(self.jobs))):
            if self.draw.random() < 0.2:
                self.ask("DELETE", job, allowed=(200, 404))
            else:
                status, data = self.ask("GET", job, allowed=(200, 404))
                if status == 200 and json.loads(data)["status"] == "failed":
                    faults.append(f"{job} failed: {data[:500]}")
        self.jobs = self.jobs[-100:]
        time.sleep(0.2)


def memory_mb(pid):
    for line in pathlib.Path(f"/proc/{pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1]) / 1024
    return 0.0


def command(folder, *arguments):
    done = subprocess.run([PLENUM, "catalog", *arguments], cwd=folder, capture_output=True, text=True)
    if done.returncode != 0:
        faults.append(f"catalog {' '.join(arguments)}: {done.stderr[:500]}")


def main():
    folder = pathlib.Path(tempfile.mkdtemp())
    shutil.copy("catalog.db", folder)
    workers = [Writer(n) for n in range(4)] + [Designer(n) for n in range(100, 102)]
    end, rounds, first_mb = time.monotonic() + 60 * MINUTES, 0, None
    while time.monotonic() < end and not faults:
        log = (folder / "log").open("a")
        server = subprocess.Popen([PLENUM, "serve", "--port", "0"], cwd=folder, text=True, stderr=subprocess.PIPE)
        port = int(server.stderr.readline().rsplit(":", 1)[1].rstrip("/\n"))
        threading.Thread(target=shutil.copyfileobj, args=(server.stderr, log), daemon=True).start()
        threads = []
        for worker in workers:
            worker.port = port
            if isinstance(worker, Writer):
                worker.settle()
            thread = threading.Thread(target=worker.run)
            thread.start()
            threads.append(thread)
        time.sleep(min(ROUND_S, max(5.0, end - time.monotonic())) / 2)
        command(folder, "backup", "copy.db")
        command(folder, "check", "--catalog", "copy.db")
        time.sleep(min(ROUND_S, max(5.0, end - time.monotonic())) / 2)
        mb = memory_mb(server.pid)
        first_mb = first_mb or mb
        rounds += 1
        server.send_signal(random.choice([signal.SIGTERM, signal.SIGKILL]))
        code = server.wait()
        for thread in threads:
            thread.join()
        log.close()
        if code not in (0, -signal.SIGKILL):
            faults.append(f"the service ended with {code}")
        if mb > first_mb + 64:
            faults.append(f"the memory grew from {first_mb:.0f} to {mb:.0f} MB")
        command(folder, "check")
        slowest = max(worker.slowest_ms for worker in workers)
        files = sum((folder / name).stat().st_size for name in os.listdir(folder)) / 2**20
        print(f"round {rounds}, ended by {code}: {sum(w.done for w in workers)} answers, slowest "
              f"{slowest:.0f} ms, {mb:.0f} MB of memory, {files:.0f} MB of files, load "
              f"{os.getloadavg()[0]:.1f}", flush=True)
    for fault in faults[:20]:
        print(fault)
    shutil.rmtree(folder)
    sys.exit(1 if faults else 0)


main()
