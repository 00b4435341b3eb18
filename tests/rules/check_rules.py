#!/usr/bin/env python3
"""Checks the rules of the house (rules.toml) on a checkout.

usage: check_rules.py ROOT [RULES_FOLDER]

Prints what breaks a rule and is not in exceptions.txt, and the exceptions that are no longer
needed; ends with 1 if there is any. The text of an exception is one line:
  rule | subject | limit | what would mend it
"""
import pathlib
import sys
import tomllib

from includes import check_includes
from listings import check_listings
from namespaces import check_namespaces
from pages import check_pages
from sizes import check_sizes
from tree import read_sources


def violations(root, rules):
    sources = read_sources(root, rules["rooms"])
    missing = [room for room in rules["rooms"] if not any(s.room == room for s in sources.values())]
    if missing:
        raise SystemExit(f"{missing[0]}/ has no sources: nothing was checked")
    tests = read_sources(root, ["tests", "bench"])
    return [
        *check_includes(sources, rules),
        *check_sizes(root, sources, tests, rules["limits"]),
        *check_pages(root, sources),
        *check_namespaces(tests),
        *check_listings(root),
    ]


def read_exceptions(path):
    """(rule, subject) -> limit."""
    exceptions = {}
    for number, line in enumerate(path.read_text(encoding="utf-8").splitlines(), 1):
        if not line.strip() or line.startswith("#"):
            continue
        cells = [cell.strip() for cell in line.split("|")]
        if len(cells) != 4 or not cells[2].isdigit() or not cells[3]:
            raise SystemExit(f"{path.name}:{number}: wanted: rule | subject | limit | reason")
        if (cells[0], cells[1]) in exceptions:
            raise SystemExit(f"{path.name}:{number}: {cells[1]} stands twice")
        exceptions[cells[0], cells[1]] = int(cells[2])
    return exceptions


def complaints(found, exceptions):
    """Violations beyond their exceptions, and exceptions that nothing needs."""
    for violation in found:
        limit = exceptions.get((violation.rule, violation.subject), -1)
        if violation.value > limit:
            allowed = f" (the exception allows {limit})" if limit >= 0 else ""
            yield f"{violation}{allowed}"
    needed = {(violation.rule, violation.subject) for violation in found}
    for rule, subject in sorted(set(exceptions) - needed):
        yield f"exceptions.txt: {rule} | {subject}: no longer needed"


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    own = pathlib.Path(sys.argv[2] if len(sys.argv) == 3 else __file__).resolve()
    folder = own if own.is_dir() else own.parent
    rules = tomllib.loads((folder / "rules.toml").read_text(encoding="utf-8"))
    exceptions = read_exceptions(folder / "exceptions.txt")
    lines = list(complaints(violations(sys.argv[1], rules), exceptions))
    for line in lines:
        print(line)
    sys.exit(1 if lines else 0)


if __name__ == "__main__":
    main()
