#!/usr/bin/env python3
"""Slow clients against honest ones, straight (200) or through deploy/nginx.conf (2,000).

usage: slow_clients.py build/release/plenum catalog.db [COUNT] [--nginx]

A third of the slow clients sends its head byte by byte, a third its body, a third never reads its
answer. Meanwhile one honest client after the other asks for a part. Prints how long that took; exit
status 1 if an honest one failed or waited more than a second.
"""
import http.client, os, shutil, signal, socket, ssl, subprocess, sys, tempfile, threading, time

import front

HOST = front.HOST
binary, catalog = sys.argv[1:3]
count = int(sys.argv[3]) if len(sys.argv) > 3 else 200
behind_nginx = "--nginx" in sys.argv
folder = tempfile.mkdtemp()
catalog = shutil.copy(catalog, folder)
arguments = [binary, "serve", "--port", "0", "--no-log", "--catalog", catalog]
token = ""
if behind_nginx:
    token = subprocess.check_output(
        [binary, "token", "create", "honest", "--catalog", catalog], text=True,
        stderr=subprocess.DEVNULL).strip()
    arguments += ["--allow-host", HOST]
service = subprocess.Popen(arguments, stderr=subprocess.PIPE, text=True)
port = service_port = int(service.stderr.readline().rsplit(":", 1)[1].strip("/\n"))
tls = ssl.create_default_context()
tls.check_hostname, tls.verify_mode = False, ssl.CERT_NONE


def connect():
    client = socket.create_connection(("127.0.0.1", port), timeout=20)
    return tls.wrap_socket(client, server_hostname=HOST) if behind_nginx else client


def authorized():
    return f"Host: {HOST if behind_nginx else 'localhost'}\r\n" + (
        f"Authorization: Bearer {token}\r\n" if token else "")


SLOW = [
    (f"GET /v1/parts HTTP/1.1\r\n{authorized()}X-Slow: ".encode(), b"x"),
    (f"POST /v1/designs HTTP/1.1\r\n{authorized()}"
     f"Content-Type: application/json\r\nContent-Length: 5000\r\n\r\n".encode(), b" "),
    (f"GET /v1/parts?limit=150 HTTP/1.1\r\n{authorized()}\r\n".encode() * 3, b""),
]
nginx, port = front.start(folder, service_port) if behind_nginx else (None, port)
slow, refused, over = [], [0], threading.Event()


def open_slow(i):
    try:
        client = connect()
        client.sendall(SLOW[i % 3][0])
        slow.append((client, SLOW[i % 3][1]))
    except OSError:
        refused[0] += 1


def keep_slow():
    while not over.wait(1):
        for client, drop in list(slow):
            try:
                client.sendall(drop)
            except OSError:
                pass


threading.Thread(target=keep_slow, daemon=True).start()
for i in range(count):
    open_slow(i)
time.sleep(1)  # all come from one address, which nginx holds to so many requests a second
times, failed = [], 0
end = time.monotonic() + 15
while time.monotonic() < end:
    start = time.monotonic()
    try:
        client = connect()
        client.sendall(f"GET /v1/parts?limit=1 HTTP/1.1\r\n{authorized()}Connection: close\r\n\r\n"
                       .encode())
        failed += not client.recv(100).startswith(b"HTTP/1.1 200")
        client.close()
    except OSError:
        failed += 1
    times.append(time.monotonic() - start)
    time.sleep(0.01)  # within the requests a second that nginx allows one address
over.set()
with open(f"/proc/{service.pid}/status") as status:
    peak = next(line.split()[1] for line in status if line.startswith("VmHWM"))
times.sort()
print(f"{len(slow)} slow clients {'behind nginx' if nginx else 'straight'}, {refused[0]} refused; "
      f"honest: {len(times)} asked, {failed} failed, median {1e3 * times[len(times) // 2]:.0f} ms, "
      f"slowest {1e3 * times[-1]:.0f} ms; plenum took {int(peak) / 1024:.0f} MB at most")
for client, _ in slow:
    client.close()
if nginx:
    nginx.send_signal(signal.SIGQUIT)
service.send_signal(signal.SIGINT)
service.wait(60)
shutil.rmtree(folder, ignore_errors=True)
sys.exit(bool(failed) or times[-1] > 1)
