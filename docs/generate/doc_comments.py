#!/usr/bin/env python3
"""Filter of Doxygen: comments of a header as comments that it reads, word by word. usage: doc_comments.py FILE"""
import re
import sys

COMMENT = re.compile(r"^(\s*)//( ?)(.*)$")
NAMESPACE = re.compile(r"^(namespace plenum\S* \{|\}  // namespace plenum\S*)$")
BEHIND = re.compile(r"^(\s*[^\s/].*[;,{}\]])  //( ?)(.*)$")


def escaped(text):
    """Without what Doxygen would take for a command."""
    return re.sub(r"([\\@<>&$#%\"])", r"\\\1", text)


def lines_of(text):
    """Without namespaces, which each header would declare again, and without explicit instantiations."""
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
    with open(sys.argv[1], encoding="utf-8") as file:
        text = file.read()
    if text.startswith("//"):
        print("/// @file")
    print("\n".join(lines_of(text)))


if __name__ == "__main__":
    main()
