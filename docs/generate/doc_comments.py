#!/usr/bin/env python3
"""Copies headers with their comments as Doxygen reads them, word by word. usage: doc_comments.py FOLDER ROOM..."""
import pathlib
import re
import sys

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
COMMENT = re.compile(r"^(\s*)//( ?)(.*)$")
BEHIND = re.compile(r"^(\s*[^\s/].*[;,{}\]])  //( ?)(.*)$")
NAMESPACE = re.compile(r"^(namespace plenum\S* \{|\}  // namespace plenum\S*)$")


def escaped(text):
    """Without what Doxygen would take for a command."""
    return re.sub(r"([\\@<>&$#%\"])", r"\\\1", text)


def lines_of(text):
    """Without namespaces, which each header would declare again, and without explicit instantiations."""
    if text.startswith("//"):
        yield "/// @file"
    instantiation = False
    for line in text.splitlines():
        comment, behind = COMMENT.match(line), BEHIND.match(line)
        instantiation = instantiation or line.startswith("extern template")
        if comment:
            yield f"{comment[1]}///{comment[2]}{escaped(comment[3])}"
        elif behind:
            yield f"{behind[1]}  ///<{behind[2]}{escaped(behind[3])}"
        elif not instantiation and not NAMESPACE.match(line):
            yield line
        instantiation = instantiation and not line.endswith(";")


def main():
    folder = pathlib.Path(sys.argv[1])
    for room in sys.argv[2:]:
        for header in sorted((CHECKOUT / room).rglob("*.h")):
            copy = folder / header.relative_to(CHECKOUT)
            copy.parent.mkdir(parents=True, exist_ok=True)
            copy.write_text("\n".join(lines_of(header.read_text(encoding="utf-8"))) + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
