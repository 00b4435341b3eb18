#!/usr/bin/env python3
"""Every field of real answers stands in the OpenAPI description, with the type that it has.

usage: answer_schema_test.py SOURCE_DIR PROGRAM

The answers are those of the examples, of the first with and without `guarantee`, and those that the
generated reference is made of, which together have every part of designs/1.
"""
import pathlib
import sys
import unittest

CHECKOUT = pathlib.Path(sys.argv.pop(1)).resolve()
PROGRAM = sys.argv.pop(1)
sys.path.insert(0, str(CHECKOUT / "docs/generate"))
import reference  # noqa: E402
from program import in_a_folder_of_its_own  # noqa: E402

NAMES = {str: "string", bool: "boolean", int: "number", float: "number", list: "array", dict: "object",
         type(None): "null"}


class Schemas:
    def __init__(self, description):
        self.schemas = description["components"]["schemas"]
        self.faults = set()

    def resolved(self, schema):
        while "$ref" in schema:
            schema = self.schemas[schema["$ref"].rsplit("/", 1)[1]]
        return schema

    def check(self, value, schema, path):
        schema = self.resolved(schema)
        if "anyOf" in schema and "properties" not in schema:
            branches = [self.resolved(one) for one in schema["anyOf"]]
            fitting = [one for one in branches if self.fits(value, one)]
            if not fitting:
                self.faults.add(f"{path}: {NAMES[type(value)]} is none of its forms")
                return
            schema = fitting[0]
        elif not self.fits(value, schema):
            self.faults.add(f"{path}: is {NAMES[type(value)]}, not {schema.get('type')}")
            return
        if isinstance(value, list) and "items" in schema:
            for one in value:
                self.check(one, schema["items"], path + "/*")
        if isinstance(value, dict):
            known = schema.get("properties", {})
            for name, member in value.items():
                if name in known:
                    self.check(member, known[name], f"{path}/{name}")
                elif not schema.get("additionalProperties") and "properties" in schema:
                    self.faults.add(f"{path}/{name}: is not described")
                elif "properties" not in schema and "additionalProperties" not in schema and schema:
                    self.faults.add(f"{path}/{name}: is not described")

    @staticmethod
    def fits(value, schema):
        types = schema.get("type")
        if types is None:
            return True
        types = [types] if isinstance(types, str) else types
        name = NAMES[type(value)]
        return name in types or (name == "number" and "integer" in types)


def without_requests(answer):
    """The request as it was understood has a schema and tests of its own."""
    return {name: value for name, value in answer.items() if name not in ("requirements", "understood")}


class AnswerSchema(unittest.TestCase):
    def test_describes_every_field_of_answers(self):
        with in_a_folder_of_its_own(PROGRAM, CHECKOUT) as program:
            with program.service() as get:
                schemas = Schemas(get("/openapi.json"))
            answers = reference.example_answers(program)
            for name in ("gripper", "double_acting_lift", "jamming_gripper", "both_rails"):
                answers.append(program.answer("design", program.example(name)))
            plain = program.example("gripper_guaranteed")
            del plain["guarantee"]
            answers.append(program.answer("design", plain))
            pairs = program.example("crawler") | {"guarantee": True}
            pairs["ranking"] = {"count": 1, "time_limit_s": 20}
            answers.append(program.answer("design", pairs))
        for answer in answers:
            schemas.check(without_requests(answer), {"$ref": "#/components/schemas/Designs"}, "")
        self.assertEqual(sorted(schemas.faults), [])
        self.assertTrue(any("measure_first" in answer for answer in answers))

    def test_a_field_that_is_not_described_is_a_fault(self):
        schemas = Schemas({"components": {"schemas": {"A": {
            "type": "object", "properties": {"b": {"type": "array", "items": {"type": "number"}},
                                             "c": {"type": "object"}}}}}})
        schemas.check({"b": [1, "x"], "c": {"d": 1}, "e": 2}, schemas.schemas["A"], "")
        self.assertEqual(sorted(schemas.faults), ["/b/*: is string, not number", "/c/d: is not described",
                                                  "/e: is not described"])


if __name__ == "__main__":
    unittest.main()
