"""The page of the HTTP service, from its description (OpenAPI)."""
from pages import code, table
from schemas import takes

HEAD = """# The HTTP API

Made of the description that the service gives at `/openapi.json` (OpenAPI {version}). [The service](../service.md) tells
how it is used, who may ask, and what it does under load.
"""
# Schemas that have a page of their own.
PAGES = {"Requirements": "requirements", "Measurement": "measurement", "Simulation": "simulation", "Map": "map",
         "Evaluation": "evaluation", "Model": "effects", "Designs": "designs", "Diagnosis": "diagnosis",
         "Protocol": "protocol"}


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
    return f"[{name}]({PAGES[name]}.md)" if name in PAGES else code(name) if name else "JSON"


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
    return text
