"""Each room and sub-room has a README.md with one line for each sub-room and file."""
import pathlib
import re

from tree import Violation

LINE = re.compile(r"^- `([\w.]+)/?`: \S", re.M)


def check_pages(root, sources):
    folders = {}  # of each folder what its page has to name
    for source in sources.values():
        folders.setdefault(source.folder, set()).add(source.stem)
        inner = source.folder
        while "/" in inner:
            outer, _, name = inner.rpartition("/")
            folders.setdefault(outer, set()).add(name)
            inner = outer
    for folder, expected in sorted(folders.items()):
        page = pathlib.Path(root) / folder / "README.md"
        if not page.is_file():
            yield Violation("page", f"{folder}/README.md", 1, "is missing")
            continue
        named = LINE.findall(page.read_text(encoding="utf-8"))
        # A page may say more of folders that hold no sources, such as data.
        extra = [n for n in named if n not in expected and not (page.parent / n).is_dir()]
        for name in sorted(expected - set(named)):
            yield Violation("page", f"{folder}/README.md", 1, f"has no line for {name}")
        for name in sorted(set(extra)):
            yield Violation("page", f"{folder}/README.md", 1, f"names {name}, which is not there")
        for name in sorted({n for n in named if named.count(n) > 1}):
            yield Violation("page", f"{folder}/README.md", 1, f"names {name} twice")
