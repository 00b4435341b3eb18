#!/usr/bin/env python3
"""Fills what the seed rows can be given by rule: series, orderable, response_time_ms.

usage: catalog/derive_fields.py [FOLDER]      FOLDER holds the CSV files, default catalog/data

Only empty cells are filled, so what was corrected by hand stays. The rules stand in
catalog/data/README.md; build_catalog makes catalog.db of the result.
"""
import csv
import math
import pathlib
import re
import statistics
import sys

FAMILIES = ["battery", "check_valve", "co2", "compressor", "cylinder", "ejector", "fitting",
            "manifold", "regulator", "relief_valve", "reservoir", "silencer", "tubing",
            "vacuum_pump", "valve"]
COMMON = ["series", "orderable", "aliases", "offers", "documents"]

# Per family: a pattern for "maker: part number" and the model base that it stands for, the first
# match counts. Without a match the base is the part number, without "pair of" and what stands in
# brackets behind it.
BASES = {
    "valve": [
        (r"ASCO: (?:pair of )?R[HLM][BFLM]", "RB"),
        (r"AVENTICS: (?:pair of )?(DO\d+)", r"\1"),
        (r"CKD: (M\dG[AB]\d|4F\d)", r"\1"),
        (r"Festo: (?:pair of )?(MHA\d|CPE\d+|MPYE|VUVG-LK?\d+|VUVS)", r"\1"),
        (r"generic: (FA0520E)", r"\1"),
        (r"Lee Company: (LHD)", r"\1"),
        (r"Norgren: 971\d+", "97100"),
        (r"SMC: (?:pair of )?(S070|PVQ3)", lambda m: "PVQ30" if m[1] == "PVQ3" else m[1]),
        (r"SMC: (?:pair of )?V114", "V100"),
        (r"SMC: (?:pair of )?VQ110", "VQ100"),
        (r"SMC: (VQ\d000|S[XY]\d000|SYJ\d00|VT307)", r"\1"),
        (r"SMC: (SYJ?\d)\d+-", r"\g<1>000"),
    ],
    "compressor": [
        (r"JSG: (BD-\d+)", r"\1"),
        (r"Airpo: (D028B)", r"\1"),
        (r"Adafruit / ZR: (ZR370)", r"\1"),
        (r"generic: (diaphragm|piston) pump [\d.]+ V, (.*)", r"\1 pump \2"),
        (r"generic \(Edragon\): (vacuum/air pump)", r"\1"),
        (r"[^:]*: (.*?) \([\d.]+ V\)$", r"\1"),
    ],
    "battery": [
        (r"generic: \d+S\d+P (pack of .*)", r"\1"),
        (r"DJI: (.*?)(?: pack)?$", r"\1"),
        (r"[^:]*: (INR\d+)-", r"\1"),
        (r"Tattu: (G-Tech|R-Line)", r"\1"),
    ],
    "co2": [
        (r"generic: .*CO2 (cartridge|bottle)", r"CO2 \1"),
        (r"generic: .*CO2 cylinder", "CO2 bottle"),
        (r"GOST 949-73:", "1 L steel"),
        (r"JT / Tippmann: (40020)", r"\1"),
    ],
    "cylinder": [
        (r"generic: .* (\d+ bar) bottle, (.*)", r"\1 bottle, \2"),
        (r"generic: \d+/(\d+) (?:bottle, )?(aluminium|carbon composite)", r"\1 psi bottle, \2"),
        (r"generic: (AL|ALU|HP)\d+$", r"\1"),
        (r"generic: (Aluminium|Steel) [\d.]+", r"\1"),
        (r"DEDEPU: (mini tank)", r"\1"),
        (r"Faber: (HP)\d", r"\1"),
        (r"Metal Impact: (S)\d", r"\1"),
        (r"Empire: (Ultra)", r"\1"),
        (r"HK Army: .*(HSTL)", r"\1"),
        (r"Ninja: (SL2)", r"\1"),
        (r"Ninja: \d+/(\d+) (aluminium)", r"\1 psi \2"),
    ],
    "fitting": [
        (r"generic: PC\d+", "PC straight push-in"),
        (r"generic: push-in elbow", "elbow push-in"),
        (r"generic: push-in .* soft stub", "push-in on a soft stub"),
        (r"generic: push-in", "straight push-in"),
        (r"generic: barb", "barb"),
        (r"generic: .* pushed on", "push-on joint"),
        (r"McMaster-Carr: (5121K)", r"\1"),
        (r"SMC: (KQ2?[GHL][HS]?)", r"\1"),
    ],
    "regulator": [
        (r"Festo: (VEAA|VPPE)", r"\1"),
        (r"generic: (.*?), (?:up to )?(?:0-)?\d+ kPa", r"\1"),
        (r"SMC: IR20", "IR2000"),
        (r"SMC: ITVH20", "ITVH2000"),
        (r"SMC: (ITV\d)0", r"\g<1>000"),
        (r"SMC: (SRA)", r"\1"),
        (r"McMaster-Carr: (1777K)", r"\1"),
        (r"Interstate Pneumatics: (WR1110)", r"\1"),
        (r"generic: (PRU14)", r"\1"),
    ],
    "reservoir": [
        (r"Clippard: (AVT-PP)", r"\1"),
        (r"Festo: (CRVZS)", r"\1"),
        (r"VIAIR: .*(air tank)", r"\1"),
        (r"generic: (accumulator|PET bottle|(?:aluminium|composite|moulded nylon) reservoir)",
         r"\1"),
    ],
    "tubing": [
        (r"Festo: (PUN-H)", r"\1"),
        (r"generic: urethane", "polyurethane"),
        (r"generic: (.*?) [\d.]+ ?x", r"\1"),
        (r"SMC: (T|TIA|TIUB|TU)\d", r"\1"),
    ],
}


def battery_line(part_number, chemistry):
    """What is left of "6S 1300 mAh 130C" without its numbers; the chemistry where nothing is."""
    left = re.sub(r"\b\d+S\b|\b\d+ mAh\b|\b\d+C\b", " ", part_number)
    return " ".join(left.split()) or chemistry


def series_of(family, row):
    maker, number = row["manufacturer"], row["part_number"]
    base = None
    for pattern, template in BASES.get(family, []):
        match = re.match(pattern, f"{maker}: {number}")
        if match:
            base = template(match) if callable(template) else match.expand(template)
            break
    if base is None:
        base = re.sub(r"^pair of | \([^()]*\)$", "", number)
        if family == "battery":
            base = battery_line(base, row["chemistry"])
    return f"{maker} {base}"


def orderable_of(row):
    """A class of parts is no product; what a maker lists is one."""
    return "false" if row["manufacturer"].startswith("generic") else "true"


def valve_class(row):
    """Technology and size: what switches a valve, and how far it has to move."""
    conductance = float(row["sonic_conductance_fill_dm3_per_s_bar"])
    if row["pressure_min_kpa_gauge"] or (row["function"] != "proportional" and conductance > 1):
        return "pilot-operated"
    if row["function"] == "proportional":
        return "proportional"
    return "direct-acting, C up to 0.5" if conductance <= 0.5 else "direct-acting, C up to 1"


def spread(times):
    """Standard deviation of the logarithms of the times, so a relative one."""
    return statistics.stdev(math.log(time) for time in times)


def by_series(rows):
    """The median time of each series, so that one with many variants does not count more."""
    times = {}
    for row in rows:
        times.setdefault(row["series"], []).append(float(row["response_time_ms"]))
    return [statistics.median(group) for group in times.values()]


def fill_response_times(rows):
    known = [row for row in rows if row["response_time_ms"]
             and row["response_time_ms.provenance"] != "estimated"]
    on_off = [row for row in known if valve_class(row) != "proportional"]
    for row in rows:
        if row["response_time_ms"]:
            continue
        like = [other for other in known if other["series"] == row["series"]]
        what = f"series {row['series']}"
        if not like:
            what = valve_class(row)
            like = [other for other in known if valve_class(other) == what]
        times = by_series(like)
        # Of fewer than three series the spread says little: then that of all on/off valves holds.
        sigma = spread(times if len(times) >= 3 else by_series(on_off))
        count = f"{len(like)} row{'s' if len(like) > 1 else ''} of {len(times)} series"
        row["response_time_ms"] = f"{statistics.median(times):.3g}"
        row["response_time_ms.provenance"] = "estimated"
        row["response_time_ms.source"] = (
            f"rule: valve response time, {what}: median of {count}, data README")
        row["response_time_ms.uncertainty"] = f"{sigma:.2g}"


def with_columns(header, family):
    after = header.index("notes") + 1
    header = header[:after] + [c for c in COMMON if c not in header] + header[after:]
    new = "response_time_ms.uncertainty"
    if family == "valve" and new not in header:
        header.insert(header.index("response_time_ms.source") + 1, new)
    return header


def main():
    folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else
                          pathlib.Path(__file__).parent / "data")
    for family in FAMILIES:
        path = folder / f"{family}.csv"
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            header = with_columns(list(reader.fieldnames), family)
            rows = [{column: row.get(column) or "" for column in header} for row in reader]
        for row in rows:
            row["series"] = row["series"] or series_of(family, row)
            row["orderable"] = row["orderable"] or orderable_of(row)
        if family == "valve":
            fill_response_times(rows)
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, header, lineterminator="\n")
            writer.writeheader()
            writer.writerows(rows)


if __name__ == "__main__":
    main()
