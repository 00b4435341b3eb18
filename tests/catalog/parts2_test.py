#!/usr/bin/env python3
"""Every number and price of a file of found parts is in the seed, or said why not.

usage: parts2_test.py SOURCE_DIR        reads SOURCE_DIR/../shared/parts2.json; without it there is
                                        nothing to test

parts2_rows.csv says for each row which parts of the seed took it, and which of its fields were left
out for which reason ("*": all of them). A number that has a field must be there within 2 %, unless it
is left out; an offer of the same amount must be there for each price.
"""
import csv
import json
import pathlib
import sys

TOLERANCE = 0.02
# Where a number of the file belongs: field of the seed and factor. What is not named here (lives,
# noise, ratings of proof tests, text) has no field.
FIELDS = {
    "mass_kg": ("mass_kg", 1), "body_volume_cm3": ("body_volume_ml", 1),
    "cells_series": ("cells_series", 1), "nominal_voltage_v": ("nominal_voltage_v", 1),
    "capacity_ah": ("capacity_ah", 1), "current_max_a": ("current_max_a", 1),
    "co2_mass_kg": ("co2_mass_kg", 1), "water_volume_l": ("water_volume_l", 1),
    "fill_pressure_kpa_gauge": ("fill_pressure_kpa_gauge", 1),
    "internal_volume_ml": ("internal_volume_ml", 1),
    "outer_diameter_mm": ("outer_diameter_mm", 1), "inner_diameter_mm": ("inner_diameter_mm", 1),
    "tube_outer_diameter_mm": ("tube_outer_diameter_mm", 1),
    "power_min_w": ("power_min_w", 1), "power_max_w": ("power_max_w", 1),
    "vacuum_max_kpa_gauge": ("vacuum_max_kpa_gauge", 1),
    "pressure_max_kpa_gauge": ("pressure_max_kpa_gauge", 1),
    "pressure_max_kpa": ("pressure_max_kpa_gauge", 1),
    "pressure_min_kpa": ("pressure_min_kpa_gauge", 1),
    "coil_power_w": ("coil_power_w", 1), "response_time_ms": ("response_time_ms", 1),
    "channels": ("channels", 1), "critical_ratio": ("critical_ratio", 1),
    "sonic_conductance_dm3_per_s_bar": ("sonic_conductance_dm3_per_s_bar", 1),
    "sonic_conductance_fill_dm3_per_s_bar": ("sonic_conductance_fill_dm3_per_s_bar", 1),
    "sonic_conductance_fill_dm3_per_s_bar_type10": ("sonic_conductance_fill_dm3_per_s_bar", 1),
    "electrical_power_w": ("electrical_power_w", 1), "duty_max": ("duty_max", 1),
    "inlet_pressure_max_kpa": ("inlet_pressure_max_kpa_gauge", 1),
    "suction_flow_at_0_kpa_l_min": ("suction_flow_l_per_min_anr", 1),
    "air_consumption_l_min": ("air_consumption_l_per_min_anr", 1),
    "supply_kpa_gauge": ("supply_pressure_kpa_gauge", 1), "nozzle_mm": ("nozzle_diameter_mm", 1),
    "stages": ("stages", 1), "stations": ("stations", 1), "outlets": ("stations", 1),
    "free_flow_l_min": ("curve", 1), "free_flow_l_min_std": ("curve", 1.0875),
}
# The same number under another name of the seed's family.
ALSO = {"sonic_conductance_dm3_per_s_bar": "sonic_conductance_fill_dm3_per_s_bar",
        "pressure_min_kpa_gauge": "cracking_pressure_kpa_gauge"}


def seed(folder):
    parts = {}
    for path in sorted((folder / "catalog/data").glob("*.csv")):
        with open(path, newline="", encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if "id" in row:
                    parts[row["id"]] = row
    return parts


def values(part, field):
    """The numbers that a part holds for a field; of a pair also those of one piece."""
    for name in (field, ALSO.get(field)):
        if name == "curve" and part.get("curve"):
            return [max(float(point.split(":")[1]) for point in part["curve"].split(";"))]
        if name and part.get(name):
            value = float(part[name])
            pair = part["part_number"].startswith("pair of")
            return [value, value / 2] if pair and field in ("mass_kg", "body_volume_ml") else [value]
    return []


def near(a, b):
    return abs(a - b) <= TOLERANCE * abs(b)


def check_numbers(index, row, parts, left_out, fail):
    numbers = dict(row["params"], mass_kg=row["mass_kg"])
    for name, value in numbers.items():
        if name not in FIELDS or not isinstance(value, (int, float)) or name in left_out:
            continue
        field, factor = FIELDS[name]
        held = {part["id"]: values(part, field) for part in parts
                if field in part or ALSO.get(field) in part}
        if held and not any(near(v, value * factor) for some in held.values() for v in some):
            fail(index, row, f"{name} is {value}, the seed has {field} = {held}")


def check_price(index, row, parts, left_out, fail):
    price = row["price"]
    if not price or "price" in left_out:
        return
    offers = [offer for part in parts for offer in json.loads(part["offers"] or "[]")]
    for offer in offers:
        each = offer["price"] / offer.get("pack", 1)
        if offer["currency"] == price["currency"] and (
                near(offer["price"], price["value"]) or near(each, price["value"])):
            return
    fail(index, row, f"no offer of {price['value']} {price['currency']}")


def main():
    folder = pathlib.Path(sys.argv[1]).resolve()
    found = folder.parent / "shared/parts2.json"
    if not found.exists():
        print("no file of found parts: nothing to test")
        return 0
    with open(found, encoding="utf-8") as file:
        rows = json.load(file)
    parts, failures = seed(folder), []
    took, left_out = {}, {}
    with open(folder / "tests/catalog/parts2_rows.csv", newline="", encoding="utf-8") as file:
        for line in csv.DictReader(file):
            index = int(line["row"])
            took.setdefault(index, []).extend(line["parts"].split())
            if line["left_out"]:
                assert line["reason"], f"row {index}: left out without a reason"
                left_out.setdefault(index, set()).update(line["left_out"].split(";"))

    def fail(index, row, text):
        failures.append(f"row {index} ({row['manufacturer']} {row['part_number']}): {text}")

    for index, row in enumerate(rows):
        out = left_out.get(index, set())
        if not took.get(index) and "*" not in out:
            fail(index, row, "is in no part and not left out")
        missing = [part for part in took.get(index, []) if part not in parts]
        if missing:
            fail(index, row, f"unknown parts {missing}")
        elif "*" not in out:
            held = [parts[part] for part in took.get(index, [])]
            check_numbers(index, row, held, out, fail)
            check_price(index, row, held, out, fail)
    print("\n".join(failures) or f"{len(rows)} rows: all in, or left out with a reason")
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
