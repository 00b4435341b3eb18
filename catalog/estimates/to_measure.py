#!/usr/bin/env python3
"""What of the winners of examples/ would have to be weighed first.

usage: catalog/estimates/to_measure.py PROGRAM [CATALOG]

Runs each example and prints, for every winner of whose mass more than 40 % is estimated, the fewest
parts, the heaviest first, whose masses would have to be known for it to be 40 % at most. Parts whose
number of the search is estimated, too (flow, current, C), are marked: their bottle test or curve goes
with the weighing.
"""
import json
import pathlib
import subprocess
import sys

import tables
from tables import is_known

EXAMPLES = tables.DATA.parents[1] / "examples"
MOST = 0.4
MASSES = ("mass_kg", "mass_kg_per_m")


def rows_by_id():
    return {row["id"]: row for family in tables.families() for row in tables.read(family)[1]}


def has_estimated(row, starts):
    return any(column.startswith(starts) and column.endswith(".provenance") and value == "estimated"
               for column, value in row.items())


def to_weigh(design, rows):
    """Parts by id, the heaviest first, until at most 40 % of the mass is estimated; None: enough is."""
    unknown = {}
    for part in design["parts"]:
        row = rows.get(part["id"])
        if row and not any(is_known(row, field) for field in MASSES):
            unknown[part["id"]] = unknown.get(part["id"], 0.0) + part["mass_kg"]
    left, chosen = sum(unknown.values()), []
    total = design["totals"]["mass_kg"]
    for name, mass in sorted(unknown.items(), key=lambda item: (-item[1], item[0])):
        if left <= MOST * total:
            break
        flow = has_estimated(rows[name], ("sonic_conductance", "free_air", "current."))
        chosen.append(f"`{name}`" + ("\\*" if flow else ""))
        left -= mass
    return chosen, left / total


def main():
    program, *catalog = sys.argv[1:]
    options = ["--catalog", catalog[0]] if catalog else []
    rows = rows_by_id()
    print("| example | mass in kg | estimated | to be weighed first | then estimated |\n"
          "| --- | --- | --- | --- | --- |")
    for file in sorted(EXAMPLES.glob("*.json")):
        if json.loads(file.read_text(encoding="utf-8")).get("schema") != "requirements/1":
            continue
        done = subprocess.run([program, "design", str(file), "--json", *options], check=True,
                              capture_output=True, text=True)
        designs = json.loads(done.stdout)["designs"]
        share = designs[0]["data_quality"]["mass_share_estimated"] if designs else 0.0
        if share <= MOST:
            continue
        chosen, left = to_weigh(designs[0], rows)
        print(f"| {pathlib.Path(file).stem} | {designs[0]['totals']['mass_kg']:.3f} | "
              f"{100 * share:.0f} % | {', '.join(chosen)} | {100 * left:.0f} % |")


if __name__ == "__main__":
    main()
