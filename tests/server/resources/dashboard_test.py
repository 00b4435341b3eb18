#!/usr/bin/env python3
"""The dashboard shows metrics that the service has, and each of them. usage: dashboard_test.py CHECKOUT PROGRAM"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import threading
import urllib.request


def metrics_of(program, checkout):
    """The names at /metrics after an answered request, as lines have them."""
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(checkout / "catalog.db", f"{folder}/catalog.db")
        service = subprocess.Popen([program, "serve", "--catalog", f"{folder}/catalog.db", "--port", "0"], cwd=folder,
                                   stderr=subprocess.PIPE, text=True)
        try:
            port = re.search(r":(\d+)/", service.stderr.readline()).group(1)
            threading.Thread(target=service.stderr.read, daemon=True).start()
            for path in ("/v1/limits", "/metrics"):
                with urllib.request.urlopen(f"http://127.0.0.1:{port}{path}", timeout=20) as answer:
                    text = answer.read().decode()
        finally:
            service.terminate()
            service.wait()
    return set(re.findall(r"^(plenum_\w+)", text, re.M))


def complaints(dashboard, names):
    panels = dashboard["panels"]
    shown = set()
    for panel in panels:
        expressions = " ".join(target["expr"] for target in panel["targets"])
        found = set(re.findall(r"plenum_\w+", expressions))
        yield from (f"{panel['title']}: the service has no {name}" for name in found - names)
        shown |= found
    yield from (f"no panel shows {name}" for name in names - shown)
    if len({panel["id"] for panel in panels}) < len(panels):
        yield "two panels have one id"
    if len({tuple(panel["gridPos"].values()) for panel in panels}) < len(panels):
        yield "two panels have one place"


def main(checkout, program):
    root = pathlib.Path(checkout)
    dashboard = json.loads((root / "deploy/shared/dashboard.json").read_text(encoding="utf-8"))
    found = list(complaints(dashboard, metrics_of(pathlib.Path(program).resolve(), root)))
    print(*found, f"{len(dashboard['panels'])} panels", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
