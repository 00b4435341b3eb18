#!/usr/bin/env python3
"""Sends the bytes of http_cases.txt to the service and compares its answers; compares the exceptions of the table with
those of docs/reference/http.md. usage: http_cases_test.py CHECKOUT PROGRAM | http_cases_test.py CHECKOUT --table"""
import email.utils
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import threading
from typing import NamedTuple

CASES_MIN = 150
REQUEST = b"GET /healthz HTTP/1.1\r\nHost: localhost\r\n\r\n"
SHORT = {b"$H": b"Host: localhost\r\n", b"$J": b"Content-Type: application/json\r\n", b"$0": REQUEST}


class Case(NamedTuple):
    section: str
    source: str
    sent: str  # as it stands in the table
    expected: str
    what: str
    reason: str


def read_cases(path):
    for line in path.read_text(encoding="utf-8").splitlines():
        if not line or line.startswith("#"):
            continue
        cells = line.split(" | ")
        section, source, sent, expected, what, reason = [*cells, ""][:6]
        if len(cells) not in (5, 6):
            raise SystemExit(f"{path.name}: five or six cells are wanted: {line}")
        yield Case(section, source, sent, expected, what, reason)


def bytes_of(sent):
    escapes = {b"r": b"\r", b"n": b"\n", b"t": b"\t", b"0": b"\0", b"\\": b"\\"}

    def unescape(found):
        mark = found.group(1)
        return bytes([int(mark[1:], 16)]) if mark[:1] == b"x" else escapes[mark]

    raw = re.sub(rb"\\(x[0-9a-f]{2}|.)", unescape, sent.encode("latin-1"))
    for short, whole in SHORT.items():
        raw = raw.replace(short, whole)
    return re.sub(rb"\$\{(.*?)\*(\d+)\}", lambda found: found.group(1) * int(found.group(2)), raw, flags=re.S)


def receive(port, sent):
    """All that comes back after the client has said that it sends no more."""
    with socket.create_connection(("127.0.0.1", port), timeout=20) as connection:
        connection.sendall(sent)
        connection.shutdown(socket.SHUT_WR)
        pieces = []
        try:
            while piece := connection.recv(1 << 16):
                pieces.append(piece)
        except ConnectionResetError:
            pieces.append(b"(reset)")
        return b"".join(pieces)


def check_head(status, fields):
    """What every answer has, and what some must have; complaints."""
    if status >= 200 and email.utils.parsedate(fields.get("date", "-")) is None:
        yield f"{status} without a date"
    for needed, statuses in (("allow", {405, 204}), ("retry-after", {429, 503}), ("content-length", {200, 400, 404})):
        if status in statuses and needed not in fields and "transfer-encoding" not in fields:
            yield f"{status} without {needed}"
    if status in (100, 204, 304) and "content-length" in fields:
        yield f"{status} with a length"


def read_answers(answers, expected):
    """The statuses, and whether the connection goes on, as the table has them; complaints."""
    seen, complaints, goes_on = [], [], "open"
    wanted = iter(expected.split())
    while answers:
        head, end, answers = answers.partition(b"\r\n\r\n")
        lines = head.decode("latin-1").split("\r\n")
        line = re.fullmatch(r"HTTP/1\.1 (\d{3}) [ -~]+", lines[0])
        if not line or not end:
            return "broken", [f"no answer: {head[:80]!r}"]
        fields = {name.lower(): value.strip() for name, _, value in (field.partition(":") for field in lines[1:])}
        status, is_head = int(line.group(1)), next(wanted, "").endswith("h")
        complaints += check_head(status, fields)
        seen.append(f"{status}h" if is_head else str(status))
        goes_on = "close" if fields.get("connection") == "close" else "open"
        answers = answers if is_head else answers[int(fields.get("content-length", 0)):]
    return " ".join([*(seen or ["-"]), goes_on]), complaints


def check_cases(cases, port):
    for case in cases:
        got, complaints = read_answers(receive(port, bytes_of(case.sent)), case.expected)
        if got != case.expected:
            complaints.append(f"answered {got}, not {case.expected}")
        yield from (f"{case.section} {case.what}: {complaint}: {case.sent[:120]}" for complaint in complaints)


def table_of(cases):
    """The exceptions, as the page has them."""
    lines = ["| section | what comes | answer | why |", "| --- | --- | --- | --- |"]
    reason = ""
    for case in cases:
        if not case.reason:
            continue
        reason = reason if case.reason == "as above" else case.reason
        rfc, _, number = case.section.partition("-")
        status = case.expected.split()[0]
        lines.append(f"| RFC {rfc}, {number} | {case.what} | {status} | {reason} |")
    return "\n".join(lines)


def serve(program, folder):
    process = subprocess.Popen([program, "serve", "--catalog", f"{folder}/catalog.db", "--port", "0"], cwd=folder,
                               stderr=subprocess.PIPE, text=True)
    port = re.search(r":(\d+)/", process.stderr.readline())
    threading.Thread(target=process.stderr.read, daemon=True).start()  # the log
    return process, int(port.group(1))


def main(checkout, program):
    root = pathlib.Path(checkout)
    cases = list(read_cases(root / "tests/server/wire/http_cases.txt"))
    if program == "--table":
        print(table_of(cases))
        return 0
    complaints = [] if len(cases) >= CASES_MIN else [f"{len(cases)} cases are too few"]
    page = (root / "docs/reference/http.md").read_text(encoding="utf-8")
    if table_of(cases) not in page:
        complaints.append("docs/reference/http.md has other exceptions; http_cases_test.py . --table gives them")
    if f"{len(cases)} cases" not in page:
        complaints.append(f"docs/reference/http.md does not say that there are {len(cases)} cases")
    with tempfile.TemporaryDirectory() as folder:
        shutil.copy(root / "catalog.db", f"{folder}/catalog.db")
        process, port = serve(str(pathlib.Path(program).resolve()), folder)
        try:
            complaints += check_cases(cases, port)
        finally:
            process.terminate()
            process.wait()
    print(*complaints, f"{len(cases)} cases, {len(complaints)} complaints", sep="\n")
    return 1 if complaints else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
