#!/usr/bin/env python3
"""Attacks on the memory of the service, each sent straight to a fresh one.

usage: memory_attacks.py build/release/plenum catalog.db

Prints for each attack how far the highest resident size (VmHWM) rose above that of a service that
has answered one of each kind of request, and whether honest requests were answered meanwhile. Exit
status 1 if one of them takes more than 64 MB or stops honest clients.
"""
import gzip, http.client, json, os, shutil, signal, socket, subprocess, sys, tempfile, threading, time

LIMIT_MB = 64
MIB = 1 << 20


class Service:
    def __init__(self, binary, catalog):
        self.folder = tempfile.TemporaryDirectory()
        copy = shutil.copy(catalog, self.folder.name)
        self.process = subprocess.Popen(
            [binary, "serve", "--port", "0", "--no-log", "--catalog", copy],
            stderr=subprocess.PIPE, text=True)
        self.port = int(self.process.stderr.readline().rsplit(":", 1)[1].strip("/\n"))
        self.get("/v1/parts?limit=1000")
        self.get("/openapi.json")
        self.base = self.peak_mb()

    def peak_mb(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            return next(int(line.split()[1]) for line in status if line.startswith("VmHWM")) / 1024

    def get(self, path):
        connection = http.client.HTTPConnection("127.0.0.1", self.port, timeout=10)
        connection.request("GET", path)
        answer = connection.getresponse()
        answer.read()
        connection.close()
        return answer.status

    def connect(self):
        client = socket.create_connection(("127.0.0.1", self.port), timeout=30)
        return client

    def stop(self):
        self.process.send_signal(signal.SIGINT)
        self.process.wait(60)
        self.folder.cleanup()


def head(path, headers, method="POST"):
    kind = "text/csv" if "/import" in path else "application/json"
    lines = [f"{method} {path} HTTP/1.1", "Host: localhost", f"Content-Type: {kind}"] + headers
    return ("\r\n".join(lines) + "\r\n\r\n").encode()


def send_all(client, chunks):
    try:
        for chunk in chunks:
            client.sendall(chunk)
        return client.recv(4096)
    except OSError:
        return b""


def in_parallel(service, count, attack):
    threads = [threading.Thread(target=attack, args=(service,), daemon=True) for _ in range(count)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join(40)


def chunked_without_end(service):
    client = service.connect()
    piece = b"100000\r\n" + b" " * MIB + b"\r\n"
    send_all(client, [head("/v1/designs", ["Transfer-Encoding: chunked"])] + [piece] * 256)


def tiny_chunks(service):
    client = service.connect()
    send_all(client, [head("/v1/designs", ["Transfer-Encoding: chunked"])] +
             [b"1\r\n \r\n" * 100000] * 64)


def gzip_bomb(service):
    bomb = gzip.compress(b" " * (512 * MIB), 9)
    client = service.connect()
    send_all(client, [head("/v1/designs", ["Content-Encoding: gzip",
                                           f"Content-Length: {len(bomb)}"]), bomb])


def header_line_without_end(service):
    client = service.connect()
    send_all(client, [b"GET /healthz HTTP/1.1\r\nHost: localhost\r\nX: "] + [b"a" * MIB] * 128)


def header_flood(service):
    client = service.connect()
    send_all(client, [b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n"] +
             [b"".join(b"X-%d: y\r\n" % i for i in range(50000))] * 64)


def unfinished_heads(service):
    clients = [service.connect() for _ in range(1500)]
    for client in clients:
        send_quietly(client, b"GET / HTTP/1.1\r\nHost: localhost\r\nX: " + b"a" * 15000)
    time.sleep(2)


def send_quietly(client, data):
    try:
        client.settimeout(5)
        client.sendall(data)
    except OSError:
        pass


def unfinished_bodies(service):
    clients = [service.connect() for _ in range(100)]
    for client in clients:
        send_quietly(client, head("/v1/designs", [f"Content-Length: {8 * MIB}"]) + b" " * (7 * MIB))
    time.sleep(2)


def body(text, path="/v1/diagnoses"):
    def attack(service):
        client = service.connect()
        data = text if isinstance(text, bytes) else text.encode()
        send_all(client, [head(path, [f"Content-Length: {len(data)}"]), data])
    return attack


def readers_that_do_not_read(service):
    clients = [service.connect() for _ in range(400)]
    for client in clients:
        client.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, 4096)
        send_quietly(client, head("/v1/parts?limit=1000", [], "GET") * 4)
    time.sleep(4)


def jobs(service):
    run = {"id": "r", "blocked": True, "source_pressure_kpa_gauge": 200.0,
           "valve": [{"t_s": 0, "state": "inflate"}],
           "t_s": [i / 1000 for i in range(200000)],
           "pressure_kpa_gauge": [100 * (1 - 0.999 ** i) for i in range(200000)]}
    document = json.dumps({
        "schema": "measurement/1", "rig": {
            "actuator": {"rest_volume_ml": 50, "expansion_ratio": 1, "operating_pressure_kpa_gauge": 100},
            "line": {"sonic_conductance_dm3_per_s_bar": 0.05, "critical_ratio": 0.3},
            "supply": {"kind": "regulated"}}, "runs": [run]})[: 8 * MIB]
    for _ in range(60):
        body(document)(service)


REPEATED = "0," * (4 * MIB - 8)
ATTACKS = {
    "chunked body without end": (chunked_without_end, 8),
    "body in chunks of one byte": (tiny_chunks, 8),
    "gzip bomb of 512 MB": (gzip_bomb, 4),
    "header line without end": (header_line_without_end, 8),
    "flood of headers": (header_flood, 8),
    "1500 unfinished heads of 15 kB": (unfinished_heads, 1),
    "100 unfinished bodies of 7 MB": (unfinished_bodies, 1),
    "nested a million deep": (body("[" * (8 * MIB - 8)), 16),
    "4 million numbers": (body("[" + REPEATED + "0]"), 16),
    "3 million empty lists": (body("[" + "[]," * 2700000 + "0]"), 16),
    "a million unknown fields": (body("{" + ",".join(f'"f{i}":0' for i in range(700000)) + "}"), 16),
    "100000 unknown parts": (body(json.dumps({"schema": "requirements/1", "exclude": [
        f"no-such-part-{i}" for i in range(100000)]}), "/v1/designs"), 4),
    "one text of 8 MB": (body('{"schema": "' + "x" * (8 * MIB - 100) + '"}'), 16),
    "CSV of 8 MB": (body("id," + "x," * (4 * MIB - 100), "/v1/parts/import?family=valve"), 16),
    "400 readers that do not read": (readers_that_do_not_read, 1),
    "a queue full of large measurements": (jobs, 1),
}


def main():
    binary, catalog = sys.argv[1:3]
    wanted = sys.argv[3:]
    failed = False
    print(f"{'attack':38} {'clients':>7} {'MB above base':>13} {'honest ms':>9} {'seconds':>7}")
    for name, (attack, count) in ATTACKS.items():
        if wanted and not any(word in name for word in wanted):
            continue
        service = Service(binary, catalog)
        slowest, over = [0.0], threading.Event()

        def honest():
            while not over.wait(0.05):
                start = time.monotonic()
                try:
                    ok = service.get("/healthz") == 200
                except OSError:
                    ok = False
                slowest[0] = max(slowest[0], time.monotonic() - start if ok else 1e3)

        watcher = threading.Thread(target=honest)
        watcher.start()
        start = time.monotonic()
        in_parallel(service, count, attack)
        seconds = time.monotonic() - start
        over.set()
        watcher.join()
        rise = service.peak_mb() - service.base
        alive = service.process.poll() is None
        print(f"{name:38} {count:7} {rise:13.1f} {1e3 * slowest[0]:9.0f} {seconds:7.1f}"
              f"{'' if alive else '  DIED'}", flush=True)
        failed |= rise > LIMIT_MB or slowest[0] > 5 or not alive
        service.stop()
    sys.exit(failed)


main()
