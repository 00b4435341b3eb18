"""The sources of a checkout: rooms, sub-rooms, units, and what each file includes."""
import pathlib
import re
from dataclasses import dataclass, field

SUFFIXES = (".cc.in", ".cc", ".h")
INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^">]+)[">]', re.M)


@dataclass(frozen=True)
class Violation:
    """What breaks a rule; `value` is compared with the limit of an exception."""

    rule: str
    subject: str
    value: int
    detail: str

    def __str__(self):
        return f"{self.rule}: {self.subject}: {self.detail}"


@dataclass
class Source:
    path: str  # from the root of the checkout
    text: str
    includes: list = field(default_factory=list)

    @property
    def room(self):
        return self.path.split("/")[0]

    @property
    def folder(self):
        return self.path.rpartition("/")[0]

    @property
    def stem(self):
        name = self.path.rpartition("/")[2]
        return name[: -len(next(s for s in SUFFIXES if name.endswith(s)))]

    @property
    def unit(self):
        """The .h and .cc of one name in one folder."""
        return f"{self.folder}/{self.stem}"

    @property
    def place(self):
        """The sub-room, or the stem of a file at the top of its room."""
        parts = self.path.split("/")
        return parts[1] if len(parts) > 2 else self.stem


def is_source(path):
    return path.name.endswith(SUFFIXES)


def read_sources(root, rooms):
    """Path -> Source of all files of the rooms."""
    sources = {}
    for room in rooms:
        for path in sorted((pathlib.Path(root) / room).rglob("*")):
            if path.is_file() and is_source(path):
                name = path.relative_to(root).as_posix()
                text = path.read_text(encoding="utf-8")
                sources[name] = Source(name, text, INCLUDE.findall(text))
    return sources


def lies_in(path, places):
    """Whether a path is one of the places or below one."""
    return any(path == place or path.startswith(place + "/") for place in places)
