"""Pieces of MyST pages: tables, cells, meanings."""
import pathlib
import re
import tomllib


SOMETIMES = "sometimes"


def cell(text):
    """A text within a row of a table."""
    return str(text).replace("|", "\\|").replace("\n", " ")


def code(text):
    return f"`{text}`"


def table(heads, rows):
    lines = ["| " + " | ".join(heads) + " |", "|" + " --- |" * len(heads)]
    lines += ["| " + " | ".join(cell(item) for item in row) + " |" for row in rows]
    return "\n".join(lines) + "\n"


class Meanings:
    """What names mean to people, from meanings.toml.

    A key is a name or, where a name means different things, the last steps of its path ("cylinder/length_m"); the
    longest that fits wins; what a section lacks, "any" may have, or "sometimes", which holds what an answer has only
    where time ran out. A name without a meaning is a fault, and a meaning that nothing has, but in "sometimes"."""

    def __init__(self, path):
        self.sections = tomllib.loads(pathlib.Path(path).read_text(encoding="utf-8"))
        self.used = {name: set() for name in self.sections}
        self.missing = set()

    def of(self, section, path):
        steps = [step for step in path.split("/") if step not in ("", "*")]
        keys = ["/".join(steps[first:]) for first in range(len(steps))] + [re.sub(r"_\d+", "_N", steps[-1])]
        for name in (section, "any", SOMETIMES):
            for key in keys:
                if key in self.sections[name]:
                    self.used[name].add(key)
                    return self.sections[name][key]
        self.missing.add(f"{section}: {path}")
        return ""

    def faults(self):
        faults = [f"no meaning of {name}" for name in sorted(self.missing)]
        for section, used in self.used.items():
            if section != SOMETIMES:
                faults += [f"nothing has {section}: {key}" for key in self.sections[section] if key not in used]
        return faults
