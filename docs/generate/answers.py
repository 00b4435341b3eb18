"""Tables of the fields of answers, from answers that the program gives to examples."""
from pages import code, table

# Where a document of the same form stands again.
SAME = {"by_configuration/*/design": "entry of `designs`", "orderable/design": "entry of `designs`",
        "orderable": "entry of `by_configuration`", "requirements": "the request as it was understood",
        "on_paper": "the answer without `guarantee`", "variants/examples/*/parts": "parts as of a design",
        "unpriced": "object", "proof/record": "object", "model/effects/*/parameters": "object"}


def same(path):
    return next((words for end, words in SAME.items() if path == end or path.endswith("/" + end)), None)


def kind(value):
    for of, name in ((bool, "true or false"), (int, "number"), (float, "number"), (str, "text"), (list, "list"),
                     (dict, "object")):
        if isinstance(value, of):
            return name
    return "null"


def walk(value, path, found):
    """{path: {kinds}} of a value; what `SAME` names is not entered."""
    if isinstance(value, dict):
        for name, member in value.items():
            inner = f"{path}/{name}".lstrip("/")
            found.setdefault(inner, set()).add(same(inner) or kind(member))
            if same(inner) is None:
                walk(member, inner, found)
    elif isinstance(value, list):
        for member in value:
            walk(member, path + "/*", found)


def tables(documents, section, meanings):
    found = {}
    for document in documents:
        walk(document, "", found)
    groups = {}
    for path, kinds in found.items():
        parent, _, name = path.rpartition("/")
        groups.setdefault(parent, []).append((name, kinds, path))
    text = ""
    for parent, rows in groups.items():
        text += f"\n## {code('/' + parent)}\n" if parent else "\n## The document\n"
        text += table(("field", "is", "meaning"),
                      [(code(name), " or ".join(sorted(kinds - {"null"}) + (["null"] if "null" in kinds else [])),
                        meanings.of(section, path)) for name, kinds, path in rows])
    return text
