#!/usr/bin/env python3
"""A service with all its limits filled at once: how long do small requests take, who is refused?

usage: bench/service/full_limits.py [MINUTES] [PLENUM]     (default 2 build/release/plenum)

Greedy clients, each with a token, keep every limit of /v1/limits at its end: the queues of jobs and
of sweeps, waiting requests, event streams, connections with half a head, large pages, large
bodies, imports, simulations. An honest client with a token of its own meanwhile asks for /healthz,
/readyz and a part, and now and then for what takes a place: a short list, a simulation, a design.
Prints the times of each and every answer that is no success. A second part has one greedy client
and nine honest ones share the workers, and prints the least share of an honest one.
"""
import http.client
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
import time

MINUTES = float(sys.argv[1]) if len(sys.argv) > 1 else 2.0
PLENUM = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "build/release/plenum")
JSON = {"Content-Type": "application/json"}
EXAMPLES = pathlib.Path("examples")


class Service:
    def __init__(self, clients):
        self.folder = tempfile.TemporaryDirectory()
        self.catalog = shutil.copy("catalog.db", self.folder.name)
        self.tokens = [self.token(f"client {i}") for i in range(clients)]
        self.process = subprocess.Popen(
            [PLENUM, "serve", "--port", "0", "--no-log", "--catalog", self.catalog,
             "--allow-host", "plenum.example"], stderr=subprocess.PIPE, text=True)
        self.port = int(self.process.stderr.readline().rsplit(":", 1)[1].strip("/\n "))
        threading.Thread(target=self.process.stderr.read, daemon=True).start()

    def token(self, name):
        return subprocess.run([PLENUM, "token", "create", name, "--scope", "write", "--catalog",
                               self.catalog], check=True, capture_output=True, text=True).stdout.strip()

    def headers(self, client, more=None):
        return {"Authorization": "Bearer " + self.tokens[client], **(more or {})}

    def ask(self, client, method, path, body=None, headers=None, timeout=60):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=timeout)
        start = time.monotonic()
        try:
            connection.request(method, path, body, self.headers(client, headers))
            answer = connection.getresponse()
            return answer.status, answer.read(), time.monotonic() - start
        finally:
            connection.close()

    def megabytes(self):
        return int(pathlib.Path(f"/proc/{self.process.pid}/statm").read_text().split()[1]) / 256

    def stop(self):
        self.process.kill()
        self.process.wait()
        self.folder.cleanup()


def slow_design(seconds):
    design = json.loads((EXAMPLES / "exosuit.json").read_text())
    design["ranking"] = {"count": 100, "time_limit_s": seconds, "list": "combinations"}
    design["objective"] = {"minimize": "volume_l"}
    return design


class Greedy:
    """Fills what it can and begins anew whatever ends."""

    def __init__(self, service):
        self.service = service
        self.over = False
        self.open = []
        self.limits = json.loads(service.ask(0, "GET", "/v1/limits")[1])["limits"]

    def again(self, act, pause=0.0):
        def loop():
            while not self.over:
                try:
                    act()
                except (OSError, http.client.HTTPException):
                    pass
                time.sleep(pause)
        threading.Thread(target=loop, daemon=True).start()

    def send(self, client, head, body=b""):
        connection = socket.create_connection(("127.0.0.1", self.service.port))
        token = f"Host: localhost\r\nAuthorization: Bearer {self.service.tokens[client]}\r\n"
        connection.sendall(head.replace("\r\n", "\r\n" + token, 1).encode() + body)
        self.open.append(connection)

    def queues(self):
        # As many greedy clients as it takes to fill the queue of all.
        body = json.dumps(slow_design(600)).encode()
        last = None
        for client in range(len(self.service.tokens) - 1):
            for _ in range(self.limits["jobs_queued_per_client_max"] + 4):
                status, answer, _ = self.service.ask(client, "POST", "/v1/designs", body, JSON)
                last = json.loads(answer)["id"] if status == 202 else last
            sweep = {"schema": "sweep/1", "requirements": slow_design(600),
                     "patches": [{"name": str(i), "merge": {}} for i in range(256)]}
            for _ in range(3):
                self.service.ask(client, "POST", "/v1/sweeps?priority=-10", json.dumps(sweep), JSON)
        return last

    def fill(self):
        job = self.queues()
        for _ in range(self.limits["event_streams_max"]):
            self.send(0, f"GET /v1/designs/{job}/events HTTP/1.1\r\n\r\n")
        body = json.dumps(slow_design(600)).encode()
        for i in range(self.limits["waiting_max"]):
            self.send(0, "POST /v1/designs HTTP/1.1\r\nContent-Type: application/json\r\n"
                      f"Prefer: wait=300\r\nIdempotency-Key: {i % 5}\r\n"
                      f"Content-Length: {len(body)}\r\n\r\n", body)
        ask = self.service.ask
        padded = json.dumps(slow_design(600)) + " " * (300 << 10)
        simulation = (EXAMPLES / "simulation_effects.json").read_text()
        table = ask(0, "GET", "/v1/parts/export?family=valve")[1] * 20
        for _ in range(9):
            self.again(lambda: ask(1, "GET", "/v1/parts?limit=1000&facets=true"))
            self.again(lambda: ask(1, "POST", "/v1/designs?validate_only=true", padded, JSON))
        for _ in range(12):
            self.again(lambda: ask(2, "POST", "/v1/simulations", simulation, JSON))
        for _ in range(2):
            self.again(lambda: ask(2, "POST", "/v1/parts/import?family=valve&dry_run=true", table,
                                   {"Content-Type": "text/csv"}))
        self.again(self.heads, 5.0)

    def heads(self):
        for _ in range(400):
            self.send(0, "GET /v1/parts HTTP/1.1\r\nX-Slow: ")
        del self.open[320:max(320, len(self.open) - 1500)]


def measure(service, client, seconds, seen):
    part = json.loads(service.ask(client, "GET", "/v1/parts?limit=1")[1])["parts"][0]["id"]
    simulation = (EXAMPLES / "simulation_effects.json").read_text()
    quick = json.dumps(slow_design(0.1))
    paths = [("GET", "/healthz"), ("GET", "/readyz"), ("GET", "/v1/parts/" + part)]
    others = [("GET", "/v1/parts?limit=20&family=valve", None), ("POST", "/v1/simulations", simulation),
              ("POST", "/v1/designs", quick)]
    end, turn = time.monotonic() + seconds, 0
    while time.monotonic() < end:
        for method, path in paths:
            status, _, took = service.ask(client, method, path)
            seen.setdefault(path, []).append((took, status))
        if turn % 40 == 0:
            method, path, body = others[turn // 40 % 3]
            status, _, took = service.ask(client, method, path, body, JSON)
            seen.setdefault(path, []).append((took, status))
        turn += 1
        time.sleep(0.02)


def tell(seen):
    for path, answers in seen.items():
        times = sorted(took for took, _ in answers)
        statuses = {status: sum(s == status for _, s in answers) for status in {s for _, s in answers}}
        print(f"{path:40} {len(times):6} asked, median {1e3 * times[len(times) // 2]:6.1f} ms, "
              f"99 % {1e3 * times[int(len(times) * 0.99)]:6.1f} ms, most {1e3 * times[-1]:6.1f} ms, "
              f"{statuses}", flush=True)


def limits():
    service = Service(18)
    greedy = Greedy(service)
    try:
        greedy.fill()
        time.sleep(3)
        queue = json.loads(service.ask(17, "GET", "/v1/queue")[1])
        print("queue", queue, "load", *os.getloadavg(), flush=True)
        seen = {}
        # In a process of its own, so that the greedy threads do not hold it up.
        if os.fork() == 0:
            measure(service, 17, 60 * MINUTES, seen)
            tell(seen)
            os._exit(0)
        os.wait()
        print(f"memory {service.megabytes():.0f} MB, open connections of the greedy {len(greedy.open)}")
    finally:
        greedy.over = True
        service.stop()


def shares():
    service = Service(10)
    body, done = json.dumps(slow_design(1.0)), [0] * 10
    refused, over = [0] * 10, threading.Event()

    def loop(client):
        while not over.is_set():
            try:
                status, _, _ = service.ask(client, "POST", "/v1/designs", body,
                                           {**JSON, "Prefer": "wait=120"}, 200)
            except (OSError, http.client.HTTPException):  # the service was stopped
                return
            if over.is_set():
                return
            done[client] += status == 200
            refused[client] += status == 429
            if status == 429:
                time.sleep(0.5)

    for client in range(10):
        for _ in range(60 if client == 0 else 2):
            threading.Thread(target=loop, args=(client,), daemon=True).start()
    time.sleep(60 * MINUTES)
    over.set()
    print(f"jobs done: greedy {done[0]}, honest {done[1:]}; refused: greedy {refused[0]}, honest "
          f"{sum(refused[1:])}; least share of an honest one {min(done[1:]) / (sum(done) / 10):.2f}")
    service.stop()


if __name__ == "__main__":
    limits()
    shares()
