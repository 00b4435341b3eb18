"""Runs the command plenum, one process at a time, and measures it."""
import json
import os
import subprocess
import tempfile
import threading
import time
from dataclasses import dataclass

LATE_S = 2.0  # of CPU beyond a time limit that is not kept
EARLY = 0.9  # of the time limit: who stops before it without a proof gave up
HANG_FACTOR, HANG_S = 6.0, 60.0


@dataclass
class Ran:
    """One run: how it ended, what it printed, what it took."""

    exit_code: int  # negative: the signal that ended it
    text: str
    errors: str
    cpu_s: float
    wall_s: float
    answer: dict | None

    @property
    def status(self):
        return self.answer.get("status") if self.answer else None

    @property
    def designs(self):
        return self.answer.get("designs", []) if self.answer else []

    @property
    def best(self):
        """The objective of the first design, None without one."""
        return self.designs[0]["objective"] if self.designs else None

    @property
    def proved(self):
        return self.status in ("optimal", "infeasible")


class Program:
    def __init__(self, path, catalog=None):
        self.path = os.path.abspath(path)
        self.options = ["--catalog", os.path.abspath(catalog)] if catalog else []

    def run(self, arguments, text, hang_s):
        """Ends a process that takes more than `hang_s` of the clock."""
        with tempfile.TemporaryFile() as given, tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as errors:
            given.write(text.encode())
            given.seek(0)
            start = time.monotonic()
            process = subprocess.Popen([self.path, *arguments, "--json", *self.options, "-"], stdin=given,
                                       stdout=out, stderr=errors)
            timer = threading.Timer(hang_s, process.kill)
            timer.start()
            _, status, usage = os.wait4(process.pid, 0)
            timer.cancel()
            process.returncode = os.waitstatus_to_exitcode(status)
            wall_s = time.monotonic() - start
            out.seek(0)
            errors.seek(0)
            printed, complaints = out.read().decode(errors="replace"), errors.read().decode(errors="replace")
        try:
            answer = json.loads(printed)
        except ValueError:
            answer = None
        return Ran(process.returncode, printed, complaints.strip(), usage.ru_utime + usage.ru_stime, wall_s, answer)

    def design(self, request, proof=False):
        hang_s = HANG_FACTOR * request["ranking"]["time_limit_s"] + HANG_S
        return self.run(["design", *(["--proof"] if proof else [])], json.dumps(request), hang_s)

    def evaluate(self, request, design):
        document = {"schema": "evaluation/1", "requirements": request, "design": design}
        return self.run(["evaluate"], json.dumps(document), HANG_FACTOR * 60.0)

    def verify(self, text, time_limit_s):
        return self.run(["verify", "--time-limit", str(time_limit_s)], text, HANG_FACTOR * time_limit_s + HANG_S)


def faults_of(ran, time_limit_s):
    """(kind, what) of each fault that one answer shows by itself."""
    if ran.exit_code not in (0, 2):
        yield "crash", f"exit status {ran.exit_code} after {ran.wall_s:.1f} s: {ran.errors[-300:]}"
    if ran.exit_code == 2 and not ran.errors:
        yield "crash", "refused without a message"
    if ran.cpu_s > time_limit_s + LATE_S:
        yield "overrun", f"{ran.cpu_s:.1f} s of CPU, {ran.wall_s:.1f} s of the clock; limit {time_limit_s:g} s"
    if ran.status == "feasible" and ran.answer["seconds"] < EARLY * time_limit_s:
        proof = ran.answer["proof"]
        yield "early", (f"feasible after {ran.answer['seconds']:.2f} s of {time_limit_s:g} s, gap {proof.get('gap')}, "
                        f"undecided {proof.get('undecided')}, {len(ran.designs)} designs")
