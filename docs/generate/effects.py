"""The page of effects: parameters from the schema that the service gives, laws from the heads of their headers."""
import pathlib
import re

import schemas
from pages import code, table

HEAD = """# All effects

What a simulation may add to the base model and a diagnosis may find, in the order of application. Parameters and ranges
are those of the program; the text is the head of the header in `model/effects/` that holds the equation.
[Effects](../effects.md) is the overview.
"""
SHARED = "model/effects/learned/learned.h"  # the laws of all learned terms
COMMENT = re.compile(r"\A((?://.*\n)+)")


def specs(model_schema):
    """[(id, law or "", {parameter: schema})] in the order of the registry."""
    found = []
    for branch in schemas.branches(model_schema["properties"]["effects"]["items"]):
        inner = branch["properties"]["parameters"]["properties"]
        law = inner.get("law", {})
        laws = law.get("enum", [law.get("const", "")])
        numbers = {name: one for name, one in inner.items() if name not in ("law", "note")}
        found += [(branch["properties"]["id"]["const"], one, numbers) for one in laws]
    return found


def heads(checkout):
    """{id: (header, comment at its top)} of all headers of effects."""
    found = {}
    for path in sorted((pathlib.Path(checkout) / "model" / "effects").rglob("*.h")):
        text = path.read_text(encoding="utf-8")
        comment = COMMENT.match(text)
        for name in re.findall(r'\bEffectSpec kSpec\w*\s*=\s*\{\s*"(\w+)"', text):
            found.setdefault(name, []).append((path.relative_to(checkout).as_posix(), comment.group(1)))
    return found


def block(path, comment):
    words = "\n".join(re.sub(r"^// ?", "", line) for line in comment.splitlines())
    return f"\n{code(path)}:\n```text\n{words}\n```\n"


def page(model_schema, checkout, meanings):
    text, of_id = HEAD, {}
    for name, law, numbers in specs(model_schema):
        of_id.setdefault(name, []).append((law, numbers))
    known = heads(checkout)
    shared = (pathlib.Path(checkout) / SHARED).read_text(encoding="utf-8")
    for name, laws in of_id.items():
        if name.startswith("learned_") and SHARED not in text:
            text += f"\n## Learned terms\n" + block(SHARED, COMMENT.match(shared).group(1))
        text += f"\n## {name}\n" + meanings.of("effects", name) + "\n"
        for law, numbers in laws:
            text += f"\n`law`: `{law}`\n\n" if law else "\n"
            text += table(("parameter", "takes", "meaning"),
                          [(code(one), schemas.takes(schema), meanings.of("effects", f"{name}/{one}"))
                           for one, schema in numbers.items()]) if numbers else ""
        for path, comment in dict(known.get(name, [])).items():
            text += block(path, comment)
    return text
