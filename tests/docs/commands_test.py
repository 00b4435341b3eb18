#!/usr/bin/env python3
"""The commands of a page run as they stand there, and print what the page says.

Each block ```sh of a page is run by bash, in order, in a folder of its own with a copy of the catalogue and of the
examples. The lines of a block ```text that follows were printed one after the other; a line that ends in … need only
begin so, and a line … or a blank one stands for any that were printed in between. Before a block <!-- test: … --> may say
  serve                a service that runs until the page ends; port 8080 becomes a free one
  fails                it ends with a status that is not 0
  not run: REASON      it is not run here

usage: commands_test.py CHECKOUT PROGRAM PAGE..."""
import argparse
import itertools
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time

BLOCK = re.compile(r"^(?:<!-- test: (?P<mark>[^\n]*) -->\n)?```sh\n(?P<commands>.*?)^```\n(?:\n?```text\n(?P<said>.*?)^```)?",
                   re.S | re.M)
WIDTH = 100
SECONDS_MAX = 300
PORT = "8080"


def free_port():
    with socket.socket() as found:
        found.bind(("127.0.0.1", 0))
        return found.getsockname()[1]


class Folder:
    """Where the commands of one page are run."""

    def __init__(self, path, checkout, program):
        self.path, self.services, self.port = pathlib.Path(path), [], free_port()
        shutil.copytree(checkout / "examples", self.path / "examples")
        shutil.copyfile(checkout / "catalog.db", self.path / "catalog.db")
        for link in ("bin/plenum", "build/release/plenum"):
            (self.path / link).parent.mkdir(parents=True)
            (self.path / link).symlink_to(program)
        keep = {name: os.environ[name] for name in ("LANG", "LD_LIBRARY_PATH") if name in os.environ}
        self.environment = keep | {"PATH": f"{self.path}/bin:/usr/local/bin:/usr/bin:/bin", "COLUMNS": str(WIDTH),
                                   "HOME": str(self.path), "LC_ALL": "C.UTF-8", "NO_PROXY": "*"}

    def start(self, commands):
        text = f"exec {commands.strip()}"
        return subprocess.Popen(["bash", "-c", text.replace(PORT, str(self.port))], cwd=self.path,
                                env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                stderr=subprocess.STDOUT, text=True)

    def serve(self, commands):
        if PORT not in commands:
            commands = commands.strip() + f" --port {PORT}"
        self.services.append(self.start(commands))
        until = time.monotonic() + 30
        while time.monotonic() < until:
            with socket.socket() as tried:
                if tried.connect_ex(("127.0.0.1", self.port)) == 0:
                    return 0, ""
            time.sleep(0.05)
        return 1, "the service does not listen"

    def run(self, commands):
        done = subprocess.run(["bash", "-euo", "pipefail", "-c", commands.replace(PORT, str(self.port))], cwd=self.path,
                              env=self.environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=SECONDS_MAX, check=False)
        return done.returncode, done.stdout.replace(str(self.port), PORT)

    def close(self):
        for service in self.services:
            service.terminate()
            service.communicate()


def is_printed(line, printed):
    return printed == line or (line.endswith("…") and printed.startswith(line[:-1].rstrip()))


def missing_lines(said, printed):
    """Of each run of lines without … or a blank one in between, the first that was not printed right after the one
    before; of a run that was not printed at all, or not here, its first."""
    rest = [line.rstrip() for line in printed.splitlines() if line.strip()]
    lines = [line.rstrip() for line in said.splitlines()]
    runs = [list(run) for is_text, run in itertools.groupby(lines, lambda line: line.strip() not in ("", "…")) if is_text]
    for run in runs:
        begins = [at for at, one in enumerate(rest) if is_printed(run[0], one)]
        if not begins:
            yield run[0]
            continue
        lengths = [next((k for k, line in enumerate(run) if at + k >= len(rest) or not is_printed(line, rest[at + k])),
                        len(run)) for at in begins]
        best = max(range(len(begins)), key=lambda i: lengths[i])
        if lengths[best] < len(run):
            yield run[lengths[best]]
        rest = rest[begins[best] + lengths[best]:]


def faults_of(page, folder, verbose):
    for number, block in enumerate(BLOCK.finditer(page.read_text(encoding="utf-8")), 1):
        mark, commands = block["mark"] or "", block["commands"]
        where = f"{page.name}, block {number}"
        if mark.startswith("not run: "):
            print(f"{where} is not run: {mark[9:]}")
            continue
        if mark not in ("", "serve", "fails"):
            yield f"{where}: no such mark: {mark}"
            continue
        status, printed = folder.serve(commands) if mark == "serve" else folder.run(commands)
        if verbose:
            print(f"== {where}, status {status}\n{commands}--\n{printed}")
        if (status != 0) != (mark == "fails"):
            yield f"{where} ended with {status}:\n{commands}{printed}"
        for line in missing_lines(block["said"] or "", printed):
            yield f"{where} did not print this, or not here: {line}"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("checkout", type=pathlib.Path)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("pages", type=pathlib.Path, nargs="+")
    parser.add_argument("--verbose", action="store_true", help="print what was printed")
    given = parser.parse_args()
    faults = []
    for page in given.pages:
        with tempfile.TemporaryDirectory(prefix="plenum-page-") as path:
            folder = Folder(path, given.checkout.resolve(), given.program.resolve())
            try:
                faults += faults_of(page, folder, given.verbose)
            finally:
                folder.close()
    print("\n".join(faults) or "all commands work")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
