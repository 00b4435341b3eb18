"""Tables of the fields of a request, from the schema that the service gives (learnt from the readers)."""
from pages import code, table

# Objects of the form of another one, which are not told again.
SAME = {"/runs/*/rig": "what differs from `/rig`, in its form", "/beside": "a design in the form of `/design`",
        "/requirements": "requirements"}
REMARKS = {"note", "notes", "comment", "description", "date", "license", "origin", "url", "author"}


def branches(schema):
    """What a value may be, null left out."""
    for key in ("anyOf", "oneOf", "allOf"):
        if key in schema:
            return [one for branch in schema[key] for one in branches(branch)]
    return [] if schema.get("type") == "null" else [schema]


def is_effect(schema):
    return "const" in schema.get("properties", {}).get("id", {})


def type_of(schema):
    kind = schema.get("type")
    return next((one for one in kind if one != "null"), None) if isinstance(kind, list) else kind


def number(value):
    return f"{value:g}" if abs(value) < 1e6 else f"{value:,.0f}"


def limits(schema):
    """"1 to 64", "above 0, up to 1"."""
    low, high = schema.get("minimum"), schema.get("maximum")
    above, below = schema.get("exclusiveMinimum"), schema.get("exclusiveMaximum")
    ends = ("" if low is None else number(low), "" if high is None else number(high))
    if all(ends):
        return f"{ends[0]} to {ends[1]}"
    pieces = [f"from {ends[0]}" if ends[0] else "", f"above {number(above)}" if above is not None else "",
              f"up to {ends[1]}" if ends[1] else "", f"below {number(below)}" if below is not None else ""]
    return ", ".join(piece for piece in pieces if piece)


def texts(schema):
    if "const" in schema:
        return code(schema["const"])
    return ", ".join(code(one) for one in schema["enum"])


def takes(schema):
    """One cell: what the value of a field may be."""
    found = []
    for branch in branches(schema):
        kind = type_of(branch)
        if "enum" in branch or "const" in branch:
            found.append(texts(branch))
        elif kind in ("number", "integer"):
            found.append(" ".join(word for word in ("whole number" if kind == "integer" else "", limits(branch)) if word)
                         or "number")
        elif kind == "boolean":
            found.append("`true` or `false`")
        elif kind == "array":
            items = branch.get("items", {})
            inner = "effects" if any(map(is_effect, branches(items))) else takes(items)
            found.append(f"list, each {inner}" if inner else "list")
        elif kind == "object" or "properties" in branch:
            found.append("object")
        elif kind == "string" and not branch.get("examples"):  # with examples: a number with its unit
            found.append("text")
    return "; ".join(dict.fromkeys(found)) or "anything"


def objects(schema, path):
    """(path, schema) of each object in a schema, itself first."""
    if path in SAME:
        return
    for branch in branches(schema):
        if is_effect(branch):
            continue
        if "properties" in branch:
            yield path or "/", branch
            for name, inner in branch["properties"].items():
                yield from objects(inner, f"{path}/{name}")
        if isinstance(branch.get("items"), dict):
            yield from objects(branch["items"], f"{path}/*")


def fields(schema):
    """{path of an object: {name: (schema, required)}}; objects at the same path are put together."""
    found = {}
    for path, one in objects(schema, ""):
        rows = found.setdefault(path, {})
        for name, inner in one["properties"].items():
            if name not in REMARKS and name not in rows:
                rows[name] = (inner, name in one.get("required", []))
    return {path: rows for path, rows in found.items() if rows}


def all_paths(schema):
    return sorted(f"{path.rstrip('/')}/{name}" for path, rows in fields(schema).items() for name in rows)


def tables(schema, section, meanings):
    text = ""
    for path, rows in fields(schema).items():
        text += f"\n## {code(path)}\n" if path != "/" else "\n## The document\n"
        text += table(("field", "takes", "meaning"),
                      [(f"**{code(name)}**" if required else code(name),
                        SAME.get(f"{path.rstrip('/')}/{name}") or takes(inner),
                        meanings.of(section, f"{path}/{name}")) for name, (inner, required) in rows.items()])
    return text
