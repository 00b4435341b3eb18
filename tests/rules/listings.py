"""What bench/ names source by source is there: no test configures it."""
import pathlib
import re

from tree import Violation

NAMED = re.compile(r"(?<![\w./}-])(?:\$\{(\w+)\}/)?([\w./-]+\.cc)\b")
SET = re.compile(r"set\((\w+) (?:\$\{(\w+)\}/)?([\w./-]+)\)")


def check_listings(root):
    root = pathlib.Path(root)
    for page in sorted((root / "bench").rglob("CMakeLists.txt")):
        text = re.sub(r"#.*", "", page.read_text(encoding="utf-8"))
        places = {"": page.parent, "PROJECT_SOURCE_DIR": root}
        for name, base, path in SET.findall(text):
            places[name] = places.get(base, root) / path
        for base, path in NAMED.findall(text):
            if not (places.get(base, root) / path).is_file():
                yield Violation("listing", str(page.relative_to(root)), 1, f"names {path}, which is not there")
