#!/usr/bin/env python3
"""The README is short, and every link from it and from the docs leads to a file, as does every path of a source or another
file of the project that they name. usage: links_test.py FOLDER"""
import pathlib
import re
import sys

README_LINES_MAX = 149
PATH = re.compile(r"(?<![\w/.:$~<-])((?:[\w-]+/)+[\w.-]*\w\.[a-z]+\b)(?![\w/*<])")


def broken_links(page):
    text = re.sub(r"```.*?```", "", page.read_text(encoding="utf-8"), flags=re.S)
    for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
        if "://" not in target and not (page.parent / target).exists():
            yield f"{page}: {target} is not there"


def missing_files(folder, page):
    """Paths that begin with a folder of the project; of NAME and what is built nothing is asked."""
    for path in PATH.findall(page.read_text(encoding="utf-8")):
        top = path.split("/")[0]
        if top == "build" or "NAME" in path or not (folder / top).is_dir():
            continue
        if not (folder / path).exists():
            yield f"{page}: {path} is not there"


def main():
    folder = pathlib.Path(sys.argv[1])
    pages = [folder / "README.md", *sorted((folder / "docs").rglob("*.md"))]
    faults = [fault for page in pages for fault in (*broken_links(page), *missing_files(folder, page))]
    lines = len(pages[0].read_text(encoding="utf-8").splitlines())
    if lines > README_LINES_MAX:
        faults.append(f"README.md has {lines} lines, more than {README_LINES_MAX}")
    print("\n".join(faults) or f"{len(pages)} pages, README.md of {lines} lines")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
