#!/usr/bin/env python3
"""A catalogue of 100,000 parts: import, export and pages of it, by command and over HTTP.

usage: bench/service/catalogue.py [PARTS] [PLENUM]     (default 100000 build/release/plenum)
"""
import contextlib
import http.client
import json
import os
import pathlib
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time

PARTS = int(sys.argv[1]) if len(sys.argv) > 1 else 100_000
PLENUM = os.path.abspath(sys.argv[2] if len(sys.argv) > 2 else "build/release/plenum")
PAGES = [
    "family=valve&mass_kg_max=0.1&sort=-mass_kg&limit=100",
    "family=valve&sonic_conductance_fill_dm3_per_s_bar_min=0.3&mass_kg_max=0.2&sort=price_eur&limit=20",
    "family=valve&port=M5&sort=body_volume_ml&limit=100",
    "manufacturer=maker+7&sort=-mass_kg&limit=100",
    "mass_kg_min=0.01&mass_kg_max=0.02&sort=mass_kg&limit=1000",
    "family=valve&mass_kg_max=0.1&facets=true&limit=20",
    "q=bench-0123&limit=20",
    "q=maker+7+m5&limit=20",
    "q=valve&limit=20",
    "q=valve&facets=true&limit=20",
    "q=m5&family=valve&mass_kg_max=0.1&sort=-mass_kg&facets=true&limit=20",
    "q=none+of+these&facets=true&limit=20",
]


def row(i, draw):
    grams = round(draw.uniform(5, 300), 3)
    return (f"bench-{i:06d},maker {i % 50},V{i},1,3/2,{draw.choice(['M5', 'G1/8', 'G1/4'])},"
            f"{draw.uniform(0.05, 2):.4g},{draw.uniform(0.2, 0.5):.3g},{draw.uniform(0.05, 2):.4g},"
            f"{draw.uniform(0.2, 0.5):.3g},1.5 W,{grams} g,{grams * 0.4:.4g} mL,8 bar,"
            f"{draw.uniform(5, 80):.2f}\n")


def table(parts):
    draw = random.Random(1)
    head = ("id,manufacturer,part_number,channels,function,port,"
            "sonic_conductance_fill_dm3_per_s_bar,critical_ratio_fill,"
            "sonic_conductance_exhaust_dm3_per_s_bar,critical_ratio_exhaust,coil_power_w,mass_kg,"
            "body_volume_ml,pressure_max_kpa_gauge,price_eur\n")
    return head + "".join(row(i, draw) for i in range(parts))


def timed(what, run):
    before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.monotonic()
    result = run()
    wall, after = time.monotonic() - start, resource.getrusage(resource.RUSAGE_CHILDREN)
    cpu = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    print(f"{what:42} {wall:7.2f} s, CPU {cpu:6.2f} s", flush=True)
    return result


def command(folder, *arguments):
    return subprocess.run([PLENUM, "catalog", *arguments], cwd=folder, check=True,
                          stdout=subprocess.PIPE).stdout


@contextlib.contextmanager
def serving(folder):
    """A service and its port; it ends whatever becomes of what is asked of it."""
    process = subprocess.Popen([PLENUM, "serve", "--port", "0"], cwd=folder, stderr=subprocess.PIPE,
                               text=True)
    try:
        yield process, int(process.stderr.readline().rsplit(":", 1)[1].rstrip("/\n"))
    finally:
        process.terminate()
        process.wait()


def get(connection, path):
    connection.request("GET", path)
    answer = connection.getresponse()
    body = answer.read()
    assert answer.status == 200, body
    return body


def post(port, path, body):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=120)
    connection.request("POST", path, body, {"Content-Type": "text/csv"})
    answer = connection.getresponse()
    text = answer.read()
    connection.close()
    assert answer.status == 200, text


def import_over_http(folder):
    """The same table into a fresh catalogue; what it took of the service, which is no child yet."""
    shutil.copy("catalog.db", folder)

    def used():
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def peak_mb():
        status = pathlib.Path(f"/proc/{process.pid}/status").read_text()
        return int(status.split("VmHWM:")[1].split()[0]) / 1024

    with serving(folder) as (process, port):
        before, base, start = used(), peak_mb(), time.monotonic()
        post(port, "/v1/parts/import?family=valve", table(PARTS))
        print(f"{'import over HTTP':42} {time.monotonic() - start:7.2f} s, CPU {used() - before:6.2f} s, "
              f"{peak_mb() - base:.0f} MB above an idle service", flush=True)


def pages(port):
    connection = http.client.HTTPConnection("127.0.0.1", port)
    timed("first page (reads the catalogue)", lambda: get(connection, "/v1/parts?limit=1"))
    timed("first search (makes the index)", lambda: get(connection, "/v1/parts?q=valve&limit=1"))
    for query in PAGES:
        samples = []
        for _ in range(50):
            start = time.monotonic()
            body = get(connection, "/v1/parts?" + query)
            samples.append(1000 * (time.monotonic() - start))
        samples.sort()
        print(f"  median {samples[25]:6.1f} ms  95 % {samples[47]:6.1f} ms  "
              f"{len(body) / 1024:6.0f} kB  {query}", flush=True)
    connection.close()


def after_writes(port):
    """What the next readers wait after a part was changed, and what the revision before costs."""
    connection = http.client.HTTPConnection("127.0.0.1", port)
    part = json.loads(get(connection, "/v1/parts/bench-000100"))
    head = json.loads(get(connection, "/v1/revisions?limit=1"))["revisions"][0]["number"]
    kinds = {"next list after a write": "/v1/parts?limit=20", "next search": "/v1/parts?q=maker&limit=20",
             "a list of the revision before": f"/v1/parts?limit=20&revision={head}",
             "changes of the import, a page": f"/v1/revisions/{head}"}
    samples = {kind: [] for kind in kinds}
    for i in range(7):
        body = json.dumps(dict(part, mass_kg=0.01 * (i + 1)))
        connection.request("PUT", "/v1/parts/bench-000100", body,
                           {"Content-Type": "application/json", "If-Match": "*"})
        answer = connection.getresponse()
        text = answer.read()
        assert answer.status == 200, text
        for kind, path in kinds.items():
            start = time.monotonic()
            get(connection, path)
            samples[kind].append(1000 * (time.monotonic() - start))
    for kind, times in samples.items():
        print(f"{kind:42} median {sorted(times)[3]:6.1f} ms, most {max(times):6.1f} ms", flush=True)
    connection.close()


def main():
    print("load", *os.getloadavg())
    folder = pathlib.Path(tempfile.mkdtemp())
    try:
        shutil.copy("catalog.db", folder)
        import_over_http(folder)
        shutil.copy("catalog.db", folder)
        (folder / "parts.csv").write_text(table(PARTS))
        timed("import --dry-run", lambda: command(folder, "import", "valve", "parts.csv", "--dry-run"))
        timed("import", lambda: command(folder, "import", "valve", "parts.csv"))
        first = timed("export", lambda: command(folder, "export", "valve"))
        (folder / "again.csv").write_bytes(first)
        again = timed("import of the export", lambda: command(folder, "import", "valve", "again.csv"))
        assert b"replace 0" in again, again
        assert command(folder, "export", "valve") == first
        timed("check", lambda: command(folder, "check"))
        timed("backup", lambda: command(folder, "backup", "copy.db"))
        print(f"{'catalog.db':42} {(folder / 'catalog.db').stat().st_size / 2**20:7.1f} MiB")
        with serving(folder) as (_, port):
            pages(port)
            after_writes(port)
    finally:
        shutil.rmtree(folder)


if __name__ == "__main__":
    main()
