#!/usr/bin/env python3
"""Reading and writing while a large table is imported, straight or through deploy/nginx.conf.

usage: large_tables.py [PARTS] [PLENUM] [--nginx]     (default 100000 build/release/plenum)

Imports a table of so many parts twice, the second time with other prices, above the 8 MiB that other
bodies may have. Meanwhile readers ask for a page, a part and the models, each over a connection of
its own, and a writer adds parts. Prints how long they took and what they were answered; exit status
1 if a read failed or the table is not there in the end.
"""
import collections
import http.client
import json
import os
import shutil
import signal
import ssl
import subprocess
import sys
import tempfile
import threading
import time

import front
from catalogue import table

NUMBERS = [word for word in sys.argv[1:] if not word.startswith("--")]
PARTS = int(NUMBERS[0]) if NUMBERS else 100_000
PLENUM = os.path.abspath(NUMBERS[1] if len(NUMBERS) > 1 else "build/release/plenum")
BEHIND_NGINX = "--nginx" in sys.argv
READS = ["/v1/parts?limit=20", "/v1/parts/bench-000007", "/v1/models"]
FITTING = {"family": "fitting", "manufacturer": "m", "part_number": "n", "tube_outer_diameter_mm": 4.0,
           "sonic_conductance_dm3_per_s_bar": 0.5, "critical_ratio": 0.4, "mass_kg": 0.01,
           "body_volume_ml": 0.7, "pressure_max_kpa_gauge": 800.0, "thread": "M5"}

folder = tempfile.mkdtemp()
catalog = shutil.copy("catalog.db", folder)
headers = {"Host": "localhost"}
arguments = [PLENUM, "serve", "--port", "0", "--no-log", "--catalog", catalog]
if BEHIND_NGINX:
    token = subprocess.check_output([PLENUM, "token", "create", "bench", "--scope", "write", "--catalog",
                                     catalog], text=True, stderr=subprocess.DEVNULL).strip()
    headers = {"Host": front.HOST, "Authorization": f"Bearer {token}"}
    arguments += ["--allow-host", front.HOST]
service = subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True)
port = int(service.stderr.readline().rsplit(":", 1)[1].strip("/\n"))
nginx = None
if BEHIND_NGINX:
    nginx, port = front.start(folder, port)
tls = ssl.create_default_context()
tls.check_hostname, tls.verify_mode = False, ssl.CERT_NONE


def connect():
    client = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
    if BEHIND_NGINX:
        client.connect()
        client.sock = tls.wrap_socket(client.sock, server_hostname=front.HOST)
    return client


def ask(client, method, path, body=None, kind="application/json"):
    client.request(method, path, body, {**headers, **({"Content-Type": kind} if body else {})})
    answer = client.getresponse()
    return answer.status, answer.read()


over = threading.Event()
times, statuses = collections.defaultdict(list), collections.defaultdict(collections.Counter)


def keep(name, request, pause):
    client = connect()
    while not over.is_set():
        start = time.monotonic()
        status, _ = ask(client, *request())
        times[name].append(time.monotonic() - start)
        statuses[name][status] += 1
        time.sleep(pause)


def write():
    write.count += 1
    return "POST", "/v1/parts", json.dumps({**FITTING, "id": f"written-{write.count}"})


write.count = 0
client = connect()
text = table(PARTS)
failed = False
for prices in (text, text.replace(",1.5 W,", ",1.6 W,")):
    threads = [threading.Thread(target=keep, args=(path, lambda path=path: ("GET", path), 0.02))
               for path in READS] + [threading.Thread(target=keep, args=("a write", write, 0.2))]
    over.clear()
    if prices is not text:
        for thread in threads:
            thread.start()
    start = time.monotonic()
    status, answer = ask(client, "POST", "/v1/parts/import?family=valve", prices, "text/csv")
    print(f"table of {len(prices) / 2**20:.1f} MiB: {status}, {time.monotonic() - start:.1f} s", flush=True)
    failed |= status != 200
    over.set()
    for thread in threads:
        if thread.ident:
            thread.join()
for name, took in times.items():
    took.sort()
    failed |= name != "a write" and set(statuses[name]) != {200}
    print(f"{name:26} {len(took):5} times, median {1e3 * took[len(took) // 2]:6.1f} ms, 99 % "
          f"{1e3 * took[int(0.99 * len(took))]:6.1f} ms, slowest {1e3 * took[-1]:6.0f} ms, "
          f"{dict(statuses[name])}")
with open(f"/proc/{service.pid}/status") as status:
    print("plenum took", int(next(line.split()[1] for line in status if line.startswith("VmHWM"))) // 1024,
          "MB at most; load", *os.getloadavg())
if nginx:
    nginx.send_signal(signal.SIGQUIT)
service.send_signal(signal.SIGINT)
service.wait(60)
shutil.rmtree(folder, ignore_errors=True)
sys.exit(failed)
