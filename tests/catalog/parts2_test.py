#!/usr/bin/env python3
"""Every number and price of a file of found parts is in the seed, or said why not.

usage: parts2_test.py SOURCE_DIR        reads SOURCE_DIR/../shared/parts2.json; without it there is
                                        nothing to test

Each name of a number in the file is either in FIELDS or CURVES, which say where it belongs, or in
NO_FIELD with the reason why no field takes it; a name in none of them fails. parts2_rows.csv says for
each row which parts of the seed took it, and which of its numbers were left out for which reason ("*":
all of them). Every part that took a row must hold each of its numbers within 2 %, unless it is left
out, and an offer of the same amount for its price.
"""
import csv
import json
import math
import pathlib
import sys

TOLERANCE = 0.02
FIELDS_FILE = "parts2_fields.csv"  # name, field, factor, reason: a field, or the reason why there is none


def seed(folder):
    parts = {}
    for path in sorted((folder / "catalog/data").glob("*.csv")):
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if "id" in row:
                    parts[row["id"]] = row
    return parts


def near(a, b):
    return abs(a - b) <= TOLERANCE * abs(b)


def points(part):
    return [[float(value) for value in point.split(":")] for point in part["curve"].split(";")]


def at(curve, pressure):
    """Flow of a curve of the seed at a pressure, on straight lines between its points."""
    for (p, q, *_), (p2, q2, *_) in zip(curve, curve[1:]):
        if p <= pressure <= p2:
            return q + (q2 - q) * (pressure - p) / (p2 - p)
    return 0.0 if pressure >= curve[-1][0] else curve[0][1]


def held(part, field):
    """The numbers that a part holds for a field; of a pair also those of one piece. None: its family
    has no such field."""
    if field == "free_flow":
        return [max(q for _, q, *_ in points(part))] if part.get("curve") else None
    if field == "current_top":
        most = [i for _, _, *currents in points(part) for i in currents] if part.get("curve") else []
        return [max(most)] if most else None
    if field == "mass_kg_per_channel":
        return [float(part["mass_kg"]) / float(part["channels"])]
    if field == "energy_wh" and "capacity_ah" in part:
        return [float(part["capacity_ah"]) * float(part["nominal_voltage_v"])]
    if field == "c_rate" and "capacity_ah" in part:
        return [float(part["current_max_a"]) / float(part["capacity_ah"])]
    if field == "full_mass_kg" and "co2_mass_kg" in part:
        return [float(part["mass_kg"]) + float(part["co2_mass_kg"])]
    if field not in part:
        return None
    if not part[field]:
        return []
    value = float(part[field])
    pair = part["part_number"].startswith("pair of") and field in ("mass_kg", "body_volume_ml")
    return [value, value / 2] if pair else [value]


def numbers_of(row):
    """The numbers of a row by name; of ranges and curves the lists."""
    named = dict(row["params"], mass_kg=row["mass_kg"])
    return {name: value for name, value in named.items()
            if isinstance(value, (int, float, list, dict)) and not isinstance(value, bool)}


def boxes_ml(dimensions):
    """Volumes of a box and of round bodies with these dimensions."""
    a, b, c = (x / 10 for x in dimensions)
    return [a * b * c] + [math.pi / 4 * x * y * z
                          for x, y, z in ((a, b, c), (b, c, a), (a, c, b))]


class Check:
    def __init__(self, rules):
        self.rules = rules
        self.checked = 0

    def numbers(self, row, parts, left_out, fail):
        for name, value in numbers_of(row).items():
            if name not in self.rules:
                fail(f"{name} = {value} is in no field, and no reason says why")
            elif self.rules[name]["field"] and name not in left_out:
                for part in parts:
                    self.number(name, value, part, fail)

    def number(self, name, value, part, fail):
        rule = self.rules[name]
        if rule["part"] and rule["part"] not in part["id"]:
            return
        if rule["field"] == "curve":
            self.curve(name, value, part, fail)
            return
        for field in rule["field"].split("|"):
            values = held(part, field)
            if values is None:
                continue
            self.checked += 1
            wanted = [v * float(rule["factor"] or 1)
                      for v in (value if isinstance(value, list) else [value])]
            if not any(near(v, w) for v in values for w in wanted):
                fail(f"{name} is {value}, {part['id']} has {field} = {values}")
            return
        if not rule["reason"]:
            fail(f"{name} is {value}, and {part['id']} has no field for it")

    def curve(self, name, value, part, fail):
        if not part.get("curve"):
            fail(f"{name}: {part['id']} has no curve")
            return
        curve, factor = points(part), float(self.rules[name]["factor"] or 1)
        most = max(q for _, q, *_ in curve)
        for pressure, flow, *_ in value:
            self.checked += 1
            if abs(at(curve, abs(pressure)) - flow * factor) > 2 * TOLERANCE * most:
                fail(f"{name}: {flow} L/min at {pressure} kPa, {part['id']} has "
                     f"{at(curve, abs(pressure)):.3g}")

    def body(self, row, parts, left_out, fail):
        dimensions = row["dimensions_mm"]
        if not dimensions or len(dimensions) != 3 or None in dimensions or "dimensions_mm" in left_out:
            return
        for part in parts:
            values = held(part, "body_volume_ml")
            if values is not None:
                self.checked += 1
                if not any(near(v, w) for v in values for w in boxes_ml(dimensions)):
                    fail(f"dimensions_mm are {dimensions}, {part['id']} has body_volume_ml = {values}")

    def price(self, row, parts, left_out, fail):
        price = row["price"]
        if not price or "price" in left_out:
            return
        self.checked += 1
        offers = [offer for part in parts for offer in json.loads(part["offers"] or "[]")]
        for offer in offers:
            each = offer["price"] / offer.get("pack", 1)
            if offer["currency"] == price["currency"] and (
                    near(offer["price"], price["value"]) or near(each, price["value"])):
                return
        fail(f"no offer of {price['value']} {price['currency']}")


def read_rows(path):
    took, left_out = {}, {}
    with open(path, newline="", encoding="utf-8") as file:
        for line in csv.DictReader(file):
            index = int(line["row"])
            took.setdefault(index, []).extend(line["parts"].split())
            if line["left_out"]:
                assert line["reason"], f"row {index}: left out without a reason"
                left_out.setdefault(index, set()).update(line["left_out"].split(";"))
    return took, left_out


def read_rules(path):
    with open(path, newline="", encoding="utf-8") as file:
        rules = {line["name"]: line for line in csv.DictReader(file)}
    for name, rule in rules.items():
        assert rule["field"] or rule["reason"], f"{name}: neither a field nor a reason"
    return rules


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    found = folder.parent / "shared/parts2.json"
    if not found.exists():
        print("no file of found parts: nothing to test")
        return 0
    with open(found, encoding="utf-8") as file:
        rows = json.load(file)
    here = folder / "tests/catalog"
    parts, failures, check = seed(folder), [], Check(read_rules(here / FIELDS_FILE))
    took, left_out = read_rows(here / "parts2_rows.csv")
    for index, row in enumerate(rows):
        def fail(text, index=index, row=row):
            failures.append(f"row {index} ({row['manufacturer']} {row['part_number']}): {text}")

        out, names = left_out.get(index, set()), took.get(index, [])
        unknown = out - {"*", "price", "dimensions_mm"} - set(numbers_of(row))
        if unknown:
            fail(f"leaves out {sorted(unknown)}, which it does not have")
        missing = [part for part in names if part not in parts]
        if missing:
            fail(f"unknown parts {missing}")
        elif not names and "*" not in out:
            fail("is in no part and not left out")
        elif "*" not in out:
            held_by = [parts[part] for part in names]
            for look in (check.numbers, check.body, check.price):
                look(row, held_by, out, fail)
    print("\n".join(failures) or f"{len(rows)} rows, {check.checked} numbers and prices: all in, or "
          "left out with a reason")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
