"""The page of the HTTP service, from its description (OpenAPI)."""
from pages import code, table
from schemas import fields, takes

HEAD = """# The HTTP API

Made of the description that the service gives at `/openapi.json` (OpenAPI {version}). [The service](../service.md) tells
how it is used, who may ask, and what it does under load.
"""
# Schemas that have a page of their own.
PAGES = {"Requirements": "requirements", "Measurement": "measurement", "Simulation": "simulation", "Map": "map",
         "Evaluation": "evaluation", "Model": "effects", "Designs": "designs", "Diagnosis": "diagnosis",
         "Protocol": "protocol", "DesignsOrValid": "designs", "SimulationOrCurves": "simulation",
         "ResponseOrCurves": "response", "Response": "response", "MapAnswer": "map_answer",
         "EvaluationAnswer": "evaluation_answer", "Part": "families", "StoredPart": "families"}
WITHOUT_FIELDS = ("Text", "Csv", "Unit", "Anything")


def resolved(part, api):
    if "$ref" not in part:
        return part
    for step in part["$ref"].split("/")[1:]:
        api = api[step]
    return api


def name_of(schema):
    return schema.get("$ref", "").rpartition("/")[2]


def body(schema):
    name = name_of(schema)
    if name in PAGES:
        return f"[{name}]({PAGES[name]}.md)"
    return "JSON" if not name else code(name) if name in WITHOUT_FIELDS else f"[{name}](#{name.lower()})"


def responses(operation, api):
    rows = []
    for status, response in operation["responses"].items():
        response = resolved(response, api)
        content = response.get("content", {})
        what = ", ".join(f"{code(media)} {body(one.get('schema', {}))}" for media, one in content.items()) or "no body"
        rows.append((status if status != "default" else "others", what))
    return table(("status", "answer"), rows)


def operations(api):
    """[(METHOD, path, operation)]"""
    return [(method.upper(), path, one) for path, methods in api["paths"].items() for method, one in methods.items()]


def names_in(part):
    """Schemas that a part of the description refers to."""
    if isinstance(part, dict):
        yield from (value.rpartition("/")[2] for name, value in part.items() if name == "$ref")
    for inner in part.values() if isinstance(part, dict) else part if isinstance(part, list) else []:
        yield from names_in(inner)


def put_out(part, api):
    """A schema with what it refers to in its place."""
    if isinstance(part, dict):
        return {name: put_out(value, api) for name, value in resolved(part, api).items()}
    return [put_out(one, api) for one in part] if isinstance(part, list) else part


def documents(api):
    """The documents that have no page of their own."""
    known = api["components"]["schemas"]
    used = {name for name in names_in([api["paths"], api["components"]["responses"]]) if name in known}
    text = "\n## Documents\nWhat the operations above take and give, where it has no page of its own.\n"
    for name in sorted(used - set(PAGES) - set(WITHOUT_FIELDS)):
        text += f"\n### {name}\n"
        schema = put_out(known[name], api)
        for path, rows in fields(schema).items():
            text += f"\n{code(path)}\n\n" if path != "/" else "\n"
            text += table(("field", "is"), [(code(one), takes(inner)) for one, (inner, _) in rows.items()])
    return text


def page(api):
    text = HEAD.format(version=api["openapi"]) + "\n" + api["info"]["description"] + "\n"
    for method, path, operation in operations(api):
        text += f"\n## {method} {path}\n{operation['summary']}\n\n"
        if "security" in operation:
            text += "Open: it needs no token.\n\n"
        parameters = [resolved(one, api) for one in operation["parameters"]]
        if parameters:
            text += table(("parameter", "in", "takes", "meaning"),
                          [(code(one["name"]), one["in"], takes(one["schema"]), one.get("description", ""))
                           for one in parameters]) + "\n"
        for media, one in operation.get("requestBody", {}).get("content", {}).items():
            text += f"Body: {code(media)} {body(one['schema'])}\n\n"
        text += responses(operation, api)
    return text + documents(api)
