#!/usr/bin/env python3
"""Writes a page for each sub-room of model/ with what its headers declare, for Breathe.

usage: docs/generate/headers.py XML FOLDER"""
import pathlib
import sys
import xml.etree.ElementTree as xml

CHECKOUT = pathlib.Path(__file__).resolve().parents[2]
SECTIONS = "briefdescription detaileddescription innerclass define enum typedef var func public*"
VALUE_MAX = 24
INDEX = """# C++ headers of `model/`

What the physics of plenum declares, made of the headers by Doxygen and Breathe.

```{toctree}
%s
```
"""


def headers(folder):
    """{sub-room: [header]} of the files that Doxygen has read."""
    found = {}
    for compound in xml.parse(pathlib.Path(folder) / "index.xml").iterfind("compound[@kind='file']"):
        location = xml.parse(pathlib.Path(folder) / f"{compound.get('refid')}.xml").find(".//compounddef/location")
        parts = pathlib.PurePath(location.get("file")).parts
        inside = pathlib.PurePath(*parts[parts.index("model"):])
        found.setdefault(inside.parts[1], []).append(inside.as_posix())
    return {room: sorted(paths) for room, paths in sorted(found.items())}


def drop_long_values(folder):
    """Values of constants that Sphinx cannot read, lambdas and designated initialisers among them."""
    for path in pathlib.Path(folder).glob("*.xml"):
        tree = xml.parse(path)
        for member in tree.iter("memberdef"):
            for value in member.findall("initializer"):
                if len("".join(value.itertext())) > VALUE_MAX:
                    member.remove(value)
        tree.write(path, encoding="utf-8")


def lead(room):
    text = (CHECKOUT / "model" / room / "README.md").read_text(encoding="utf-8")
    return text.split("\n", 2)[2].split("\n\n- ")[0].split("\n- ")[0].strip()


def page(room, paths):
    text = f"# model/{room}\n\n{lead(room)}\n"
    for path in paths:
        text += f"\n## {path}\n```{{eval-rst}}\n.. doxygenfile:: {path}\n   :sections: {SECTIONS}\n```\n"
    return text


def main():
    folder, target = sys.argv[1], pathlib.Path(sys.argv[2])
    target.mkdir(parents=True, exist_ok=True)
    drop_long_values(folder)
    rooms = headers(folder)
    for room, paths in rooms.items():
        (target / f"{room}.md").write_text(page(room, paths), encoding="utf-8")
    (target / "index.md").write_text(INDEX % "\n".join(rooms), encoding="utf-8")


if __name__ == "__main__":
    main()
