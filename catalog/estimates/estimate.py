#!/usr/bin/env python3
"""Predicts the numbers of the seed that no source gives, each with the error of its law.

usage: catalog/estimates/estimate.py [--check | --shares | --report FOLDER]

Without an option it rewrites the estimated cells of catalog/data. --check only says which files would
change, --shares prints how much of the catalogue is estimated and how many parts have a price,
--report writes a plot of each law and prints the table of docs/explanation/data_quality.md.
"""
import copy
import math
import re
import sys

import law_table
import laws
import pumps
import spreads
import tables
from tables import is_known, number, predict_into

EJECTOR_FLOWS = ("suction_flow_l_per_min_anr", "vacuum_max_kpa_gauge",
                 "air_consumption_l_per_min_anr", "supply_pressure_kpa_gauge")
EJECTOR_SPREAD = 0.7
BORE = re.compile(r"(?:C by bore|assumed bore of) ([\d.]+) mm")


def together(*sigmas):
    return math.sqrt(sum(s * s for s in sigmas))


def fill(law, row, field, factor=1.0, extra=0.0):
    x = law.x(row)
    if x and all(v > 0 or i in law.law.flags for i, v in enumerate(x)):
        predict_into(row, field, factor * law.law.predict(x), together(law.law.sigma, extra),
                     law.source())


def own(row, field):
    return number(row, field + ".uncertainty") or 0.0


def fill_valves(rows, made):
    for row in rows:
        bore = BORE.search(row["notes"])
        for side in ("fill", "exhaust"):
            field = f"sonic_conductance_{side}_dm3_per_s_bar"
            if "PVQ flow" in row[field + ".source"]:
                row[field + ".uncertainty"] = f"{made['valve_bore'].law.sigma:.2g}"
            if bore and not is_known(row, field):
                law = made["valve_bore"]
                predict_into(row, field, law.law.predict((float(bore[1]),)), law.law.sigma,
                             law.source() + f"; bore {bore[1]} mm assumed")
        sized = is_known(row, "body_volume_ml")
        if sized:
            fill(made["valve_density"], row, "mass_kg", laws.pieces(row))
        else:
            fill(made["valve_mass"], row, "mass_kg",
                 laws.THREE_POSITIONS if row["function"] == "proportional" else 1.0)
        if not sized:
            fill(made["valve_body"], row, "body_volume_ml", 1.0,
                 0.0 if is_known(row, "mass_kg") else own(row, "mass_kg"))


def fill_spreads(rows):
    """b of valves and C of the way out, where the sheets that have them agree."""
    ratios, ways = {}, {}
    for row in rows:
        if is_known(row, "critical_ratio_fill"):
            ratios.setdefault(row["series"], []).append(number(row, "critical_ratio_fill"))
        fields = [f"sonic_conductance_{s}_dm3_per_s_bar" for s in ("exhaust", "fill")]
        if all(is_known(row, f) for f in fields):
            ways.setdefault(row["series"], []).append(number(row, fields[0]) / number(row, fields[1]))
    ratio, way = laws.mean_of(ratios), laws.mean_of(ways)
    for row in rows:
        for field, sigma in (("critical_ratio_fill", ratio[1]), ("critical_ratio_exhaust", ratio[1]),
                             ("sonic_conductance_exhaust_dm3_per_s_bar", way[1])):
            if not is_known(row, field) and row[field + ".source"].startswith("rule:"):
                row[field + ".uncertainty"] = f"{min(sigma, 1.0):.2g}"
    return ratio, way


def fill_fittings(rows, made):
    law = made["fitting_bore"]
    for row in rows:
        field = "sonic_conductance_dm3_per_s_bar"
        bore = BORE.search(row[field + ".source"]) or re.search(
            r"; bore ([\d.]+) mm", row[field + ".source"])
        if bore and not is_known(row, field):
            predict_into(row, field, law.law.predict((float(bore[1]),)), law.law.sigma,
                         law.source() + f"; bore {bore[1]} mm")


def fill_packs(rows, made):
    for row in rows:
        if not row["current_max_a"]:
            row["current_max_a"] = f"{5 * number(row, 'capacity_ah'):.4g}"
            row["current_max_a.provenance"] = "estimated"
            row["current_max_a.source"] = "rule: battery current, 5C where none is given, data README"
        if laws.pack_x(row):
            fill(made["pack_mass"], row, "mass_kg")
        if not laws.is_of_cells(row) or row["body_volume_ml"] == "":
            fill(made["pack_body"], row, "body_volume_ml", 1.0,
                 0.0 if is_known(row, "mass_kg") else own(row, "mass_kg"))


def fill_pumps(rows, made):
    measured = [row for row in rows if pumps.is_measured(row)]
    by_series, offs, piston = {}, {}, None
    for row in measured:
        by_series.setdefault(row["series"], []).append(pumps.peak_efficiency(row))
        if row["id"] == "viair-90c-12v":
            piston = pumps.shape(pumps.curve(row))
        if row["type"] != "piston":
            offs.setdefault(row["series"], []).extend(pumps.off_the_line(row))
    efficiency, spread = laws.mean_of(by_series)
    squares = [sum(e * e for e in group) / len(group) for group in offs.values() if group]
    line = math.sqrt(sum(squares) / len(squares))
    power = made["pump_power"]
    for row in rows:
        low, high = pumps.printed_power(row)
        of_power = 0.0
        if high is None:
            high, of_power = power.law.predict(laws.flow_x(row)), power.law.sigma
            if row["free_air.provenance"] != "estimated":
                high, of_power = pumps.most_work(row) / efficiency, spread
        low = low or high / 2
        if row["current.provenance"] == "estimated":
            cut = pumps.fill_curve(row, low, high, efficiency, piston)
            # Anywhere between the two ends of the power, as likely here as there.
            range_of_power = (high - low) / (high + low) / math.sqrt(3)
            row["current.uncertainty"] = f"{together(of_power, range_of_power):.2g}"
            if row["free_air.provenance"] == "estimated":
                row["free_air.uncertainty"] = f"{max(line, spread if cut else 0.0):.2g}"
        if row["family"] == "compressor" or row["mass_kg"]:
            slope = made["pump_mass"].law.coefficients[1]
            fill(made["pump_mass"], row, "mass_kg", 1.0,
                 0.0 if is_known(row, "power_max_w") else slope * power.law.sigma)
            fill(made["pump_body"], row, "body_volume_ml", 1.0,
                 0.0 if is_known(row, "mass_kg") else own(row, "mass_kg"))
    return (efficiency, spread), line


def fill_vessels(all_rows, made):
    for row in all_rows["cylinder"]:
        fill(made["bottle_mass"], row, "mass_kg")
    for row in all_rows["co2"]:
        fill(made["co2_mass"], row, "mass_kg")
    for row in all_rows["reservoir"]:
        fill(made["steel_tank_mass"], row, "mass_kg")


def fill_halves(rows):
    """A lone valve is half of its pair (catalog/lone_valves.py), and as uncertain."""
    pairs = {row["id"]: row for row in rows}
    for row in rows:
        pair = pairs.get(row["id"] + "-pair")
        if row["function"] == "2/2" and pair:
            for column in row:
                if column.endswith(".uncertainty") and row[column.replace(
                        ".uncertainty", ".provenance")] == "estimated":
                    row[column] = pair[column]


def fill_ejectors(rows):
    """Mass and body of those whose flows are all known: no law, since one row alone has them."""
    known = [row for row in rows if is_known(row, "mass_kg") and is_known(row, "body_volume_ml")]
    if len(known) != 1:
        raise SystemExit("several ejectors have a printed mass: time for a law")
    source = f"rule: ejector size, as {known[0]['id']}, the only one with a printed mass, data README"
    for row in rows:
        if all(is_known(row, field) for field in EJECTOR_FLOWS):
            for field in ("mass_kg", "body_volume_ml"):
                predict_into(row, field, number(known[0], field), EJECTOR_SPREAD, source)


def shares(all_rows):
    print(f"{'family':13} {'parts':>6} {'priced':>7} {'numbers':>8} {'estimated':>10} {'orderable':>10}")
    total = [0] * 5
    for family, rows in all_rows.items():
        counts = [len(rows), sum(any(k.startswith("price_eur") and "." not in k and r[k] for k in r)
                                 for r in rows)]
        cells = [v for r in rows for k, v in r.items() if k.endswith(".provenance") and v]
        counts += [len(cells), cells.count("estimated"), sum(r["orderable"] == "true" for r in rows)]
        total = [a + b for a, b in zip(total, counts)]
        print(f"{family:13} {counts[0]:6} {counts[1]:7} {counts[2]:8} {counts[3]:10} {counts[4]:10}")
    print(f"{'all':13} {total[0]:6} {total[1]:7} {total[2]:8} {total[3]:10} {total[4]:10}")
    print(f"estimated {100 * total[3] / total[2]:.1f} % of numbers, priced "
          f"{100 * total[1] / total[0]:.1f} % of parts")


def main():
    option = sys.argv[1] if len(sys.argv) > 1 else ""
    headers, all_rows = {}, {}
    for family in tables.families():
        headers[family], all_rows[family] = tables.read(family)
        for row in all_rows[family]:
            row["family"] = family
    if option == "--shares":
        return shares(all_rows)
    before = copy.deepcopy(all_rows)
    made = laws.all_laws(all_rows)
    # Before the laws, which add the errors of the numbers that they take.
    missed = spreads.all_spreads(all_rows, made)
    for spread in missed:
        spread.fill(all_rows[spread.family])
    valves = [row for row in all_rows["valve"] if row["function"] != "2/2"]  # halves of pairs
    fill_valves(valves, made)
    ways = fill_spreads(valves)
    fill_halves(all_rows["valve"])
    fill_fittings(all_rows["fitting"], made)
    fill_packs(all_rows["battery"], made)
    pumped = fill_pumps(all_rows["compressor"] + all_rows["vacuum_pump"], made)
    fill_vessels(all_rows, made)
    fill_ejectors(all_rows["ejector"])
    if option == "--report":
        import plots
        plots.report(sys.argv[2], made, ways, pumped)
        return plots.report_rules(missed, spreads.keeps_default(all_rows))
    changed = [family for family in all_rows if all_rows[family] != before[family]]
    table = law_table.text(law_table.rows(all_rows, made, ways, pumped, missed))
    if table != law_table.read():
        changed.append("laws.csv")
    if option == "--check":
        print("would change:", ", ".join(changed) or "nothing")
        return 1 if changed else 0
    law_table.write(table)
    for family in set(changed) & set(all_rows):
        for row in all_rows[family]:
            del row["family"]
        tables.write(family, headers[family], all_rows[family])
    return 0


if __name__ == "__main__":
    sys.exit(main())
