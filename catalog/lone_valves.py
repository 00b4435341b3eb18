#!/usr/bin/env python3
"""Adds to data/valve.csv, after each pair of 2/2 valves, one of the two by itself.

A pair fills and vents one actuator; one by itself vents an actuator that a pump of its own feeds
(docs/reference/requests.md, Pumps without a reservoir). Mass, volume and price of a pair's row are
those of both: halves are written, with the pair's provenance and "half of the pair's" in the source.
Rows that are there stay as they are.
"""
import csv
import json
import pathlib

VALVES = pathlib.Path(__file__).parent / "data" / "valve.csv"
HALVED = ["mass_kg", "body_volume_ml", "price_eur"]
NOTE = "One vents an actuator that is fed past it. Row of the pair halved"


def half(pair):
    row = dict(pair)
    row["id"] = pair["id"].removesuffix("-pair")
    row["part_number"] = pair["part_number"].removeprefix("pair of ").split(" (MH1")[0]
    row["function"] = "2/2"
    row["notes"] = ". ".join(s for s in [NOTE, *pair["notes"].split(". ")] if "Two " not in s)
    row["aliases"] = ""
    for field in HALVED:
        if pair[field]:
            row[field] = repr(round(float(pair[field]) / 2, 9))
            row[field + ".source"] = "half of the pair's: " + pair[field + ".source"]
    if pair["offers"]:
        offers = json.loads(pair["offers"])
        for offer in offers:
            offer["price"] = round(offer["price"] / 2, 4)
        row["offers"] = json.dumps(offers, separators=(",", ":"), ensure_ascii=False)
    return row


def main():
    with open(VALVES, newline="", encoding="utf-8") as file:
        reader = csv.DictReader(file)
        fields, rows = reader.fieldnames, list(reader)
    ids = {row["id"] for row in rows}
    written = []
    for row in rows:
        written.append(row)
        if row["function"] == "2/2 pair" and row["id"].removesuffix("-pair") not in ids:
            written.append(half(row))
    with open(VALVES, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, fields, lineterminator="\n")
        writer.writeheader()
        writer.writerows(written)


if __name__ == "__main__":
    main()
