#!/usr/bin/env python3
"""Everything public of the program has its entry in the built reference: what the program says by other ways than those
that the pages are made of is looked for there. usage: reference_test.py CHECKOUT PROGRAM"""
import html
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77


def text_of(page):
    """What a page says, without its marks."""
    return html.unescape(re.sub(r"<[^>]+>", "", page.read_text(encoding="utf-8")))


def words_of(page):
    return set(re.findall(r"[\w/{}.:-]+", text_of(page)))


class Program:
    def __init__(self, path, folder):
        self.path, self.folder = path, folder

    def run(self, *words):
        return subprocess.run([self.path, *words], cwd=self.folder, capture_output=True, text=True, check=False).stdout


def commands(program, before=()):
    """(command, options) of every help, as the parser of the command line prints it."""
    text = program.run(*before, "--help")
    if before:
        yield before, {name for name in re.findall(r"^\s+(?:-\w,)?(--[\w-]+)", text, re.M) if name != "--help"}
    below = re.search(r"^Subcommands:\n((?:.*\n)*)", text, re.M)
    names = re.findall(r"^  (\w+)", below.group(1) if below else "", re.M)
    for name in names:
        yield from commands(program, (*before, name))


def request_fields(checkout):
    """Fields of requests that the examples use."""

    def names(value):
        if isinstance(value, dict):
            for name, member in value.items():
                yield name
                yield from names(member)
        elif isinstance(value, list):
            for member in value:
                yield from names(member)

    pages = {"requirements/1": "requirements", "simulation/1": "simulation", "map/1": "map",
             "measurement/1": "measurement", "evaluation/1": "evaluation"}
    for path in sorted((checkout / "examples").glob("*.json")):
        document = json.loads(path.read_text(encoding="utf-8"))
        page = pages.get(document.get("schema"))
        if page in ("requirements", "map"):
            yield page, set(names(document)) - {"note"}


def readers_fields(checkout):
    """Fields that the reader of requirements names in its code."""
    found = set()
    for path in (checkout / "api" / "design" / "read").glob("requirements_reader.cc"):
        text = path.read_text(encoding="utf-8")
        found |= set(re.findall(r'(?:Number|OptionalNumber|Integer|Bool|Choice|Text|Texts|OptionalObject|Object)\(\s*"(\w+)"',
                                text))
    return found


def effects(checkout):
    """(id, [parameters in SI]) of the headers of effects."""
    for path in sorted((checkout / "model" / "effects").rglob("*.h")):
        text = path.read_text(encoding="utf-8")
        for name in re.findall(r'\bEffectSpec kSpec\w*\s*=\s*\{\s*"(\w+)"', text):
            yield name


def limits(checkout):
    for path in ("server/call/service_limits.cc", "api/json/render_limits.cc"):
        text = (checkout / path).read_text(encoding="utf-8")
        yield from re.findall(r'\{"(\w+)",', text)


def families(program):
    """(family, columns) as the catalogue exports them."""
    listed = json.loads(program.run("catalog", "list", "--facets", "--json"))
    for name in listed["facets"]["texts"]["family"]:
        yield name, set(program.run("catalog", "export", name).splitlines()[0].split(","))


def main():
    checkout, binary = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
    pages = checkout / "build" / "docs" / "html" / "reference" / "generated"
    if not pages.is_dir():
        print("the documentation is not built here", file=sys.stderr)
        return SKIPPED
    missing = []

    def wants(page, names, what):
        known = words_of(pages / f"{page}.html")
        missing.extend(f"{page}: {what} {name}" for name in sorted(set(names) - known))

    with tempfile.TemporaryDirectory() as folder:
        shutil.copyfile(checkout / "catalog.db", pathlib.Path(folder) / "catalog.db")
        program = Program(binary, folder)
        text = text_of(pages / "commands.html")
        found = list(commands(program))
        for words, options in found:
            begin = text.find(f"plenum {' '.join(words)}#")  # the heading with its link
            section = text[begin:text.find("Example:", begin)] if begin >= 0 else ""
            missing.extend([f"commands: {' '.join(words)}"] if not section else [])
            missing.extend(f"commands: {' '.join(words)} {option}" for option in options if option not in section)
        for name, columns in families(program):
            section = text_of(pages / "families.html")
            missing.extend([] if name in section else [f"families: {name}"])
            of_all = {"id", "manufacturer", "part_number", "origin", "notes", "series", "orderable", "aliases", "offers",
                      "documents", "provenance", "curve", "family"}
            wants("families", {one for one in columns - of_all if "." not in one}, f"field of {name}:")
    for page, names in request_fields(checkout):
        wants(page, names, "field")
    wants("requirements", readers_fields(checkout), "field")
    wants("effects", effects(checkout), "effect")
    wants("limits", limits(checkout), "limit")
    print("\n".join(missing) or f"{len(found)} commands, and all fields, effects, families and limits have their entries")
    return 1 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
