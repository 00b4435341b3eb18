"""The laws and rules as a table that the program reads: catalog/estimates/laws.csv.

A row gives a number of a family as factor times powers of other numbers, for parts that `when` holds
for: "FIELD has TEXT", "FIELD is TEXT", "FIELD above NUMBER", "FIELD known", joined by ';'. The first row
that holds counts. Rows of family "pump" are the coefficients of pumps.py. What names no field is
computed from several: energy_wh, c_rate, fill_energy_j, wall_area_mm2, power_w, free_flow_l_per_min.
"""
import csv
import io
import math
import pathlib

import pumps

FILE = pathlib.Path(__file__).parent / "laws.csv"
HEADER = ["family", "field", "when", "factor", "powers", "uncertainty", "source"]
COMPOSITE = "material has composite", "material has carbon"


def read():
    return FILE.read_text(encoding="utf-8") if FILE.exists() else ""


def write(table):
    FILE.write_text(table, encoding="utf-8")


def text(rows):
    file = io.StringIO()
    writer = csv.writer(file, lineterminator="\n")
    writer.writerow(HEADER)
    writer.writerows(rows)
    return file.getvalue()


def shown(number):
    return f"{number:.6g}"


def of_law(family, field, when, named, predictors, flags=()):
    """A fitted law; `flags` are the places of factors that hold for these parts."""
    slopes = named.law.coefficients[1:]
    factor = math.exp(named.law.coefficients[0] + sum(slopes[i] for i in flags))
    powers = [f"{name}^{shown(slope)}" for i, (name, slope) in enumerate(zip(predictors, slopes))
              if i not in named.law.flags]
    return [family, field, when, shown(factor), " ".join(powers), f"{named.law.sigma:.2g}",
            named.source()]


def of_rule(family, field, when, factor, powers, sigma, name):
    return [family, field, when, shown(factor), powers, f"{min(sigma, 1.0):.2g}" if sigma else "",
            f"rule: {name}, data README"]


def piston_shape(tables):
    row = next(row for row in tables["compressor"] if row["id"] == "viair-90c-12v")
    return " ".join(f"{p!r}^{q!r}" for p, q in pumps.shape(pumps.curve(row)))


def pump_rows(tables, made, pumped):
    (efficiency, spread), line = pumped
    power = made["pump_power"]
    rows = [of_law("pump", "power_max_w", "", power, ["free_flow_l_per_min"]),
            ["pump", "efficiency", "", repr(efficiency), "", repr(spread), "best that pumps reach"],
            ["pump", "line", "", "1", "", repr(line), "measured flow over the straight line"],
            ["pump", "piston_shape", "", "1", piston_shape(tables), "", "VIAIR 90C at 12 V"]]
    factor, slope = power.law.coefficients
    rows[0][3:5] = repr(math.exp(factor)), f"free_flow_l_per_min^{slope!r}"  # as exact as pumps.py
    return rows


def rows(tables, made, ways, pumped, missed):
    (ratio, ratio_sigma), (_, way_sigma) = ways
    sigma = {spread.key: spread.sigma for spread in missed}
    conductance = "sonic_conductance_{}_dm3_per_s_bar".format
    made_rows = pump_rows(tables, made, pumped)
    made_rows += [
        of_rule("compressor", "duty_max", "type has diaphragm", 1, "", sigma["pump_duty"], "pump duty"),
        of_law("compressor", "mass_kg", "", made["pump_mass"], ["power_w", "free_flow_l_per_min"]),
        of_law("compressor", "body_volume_ml", "", made["pump_body"], ["mass_kg"]),
        of_rule("valve", conductance("exhaust"), f"{conductance('fill')} known", 1,
                f"{conductance('fill')}^1", way_sigma, "exhaust as fill"),
        of_rule("valve", "critical_ratio_fill", "", 0.3, "", ratio_sigma, "valve critical ratio"),
        of_rule("valve", "critical_ratio_exhaust", "", 0.3, "", ratio_sigma, "valve critical ratio"),
        of_law("valve", "mass_kg", "body_volume_ml known", made["valve_density"], ["body_volume_ml"]),
    ]
    piloted = [f"function is 3/2;{name}" for name in (
        "pressure_min_kpa_gauge above 0", f"{conductance('fill')} above 1")]
    made_rows += [of_law("valve", "mass_kg", when, made["valve_mass"], [conductance("fill")])
                  for when in piloted]
    made_rows += [
        of_law("valve", "body_volume_ml", "", made["valve_body"], ["mass_kg"]),
        of_rule("fitting", "critical_ratio", "", 0.5, "", None, "fitting critical ratio"),
        of_rule("fitting", "body_volume_ml", "", 1000 / 3, "mass_kg^1", sigma["fitting_body"],
                "fitting body volume"),
        of_rule("battery", "current_max_a", "chemistry is LiPo", 5, "capacity_ah^1",
                sigma["pack_current"], "battery current, 5C where none is given"),
        of_law("battery", "mass_kg", "chemistry is LiFePO4;cells_series above 1", made["pack_mass"],
               ["energy_wh", "c_rate"], flags=[2]),
        of_law("battery", "mass_kg", "chemistry is LiPo", made["pack_mass"], ["energy_wh", "c_rate"]),
        of_law("battery", "mass_kg", "chemistry is LiHV", made["pack_mass"], ["energy_wh", "c_rate"]),
        of_law("battery", "body_volume_ml", "", made["pack_body"], ["mass_kg"]),
    ]
    kinds = [("material has steel", [1])] + [(when, [2]) for when in COMPOSITE] + [("", [])]
    made_rows += [of_law("cylinder", "mass_kg", when, made["bottle_mass"], ["fill_energy_j"], flags)
                  for when, flags in kinds]
    made_rows += [
        of_rule("cylinder", "body_volume_ml", when, factor, "water_volume_l^1", sigma["bottle_body"],
                "bottle body volume")
        for when, factor in [(when, 1600) for when in COMPOSITE] + [("", 1450)]]
    made_rows += [
        of_law("co2", "mass_kg", "co2_mass_kg above 0.2", made["co2_mass"], ["co2_mass_kg"], [1]),
        of_law("co2", "mass_kg", "", made["co2_mass"], ["co2_mass_kg"]),
        of_rule("co2", "body_volume_ml", "co2_mass_kg above 0.2;water_volume_l known", 1750,
                "water_volume_l^1", sigma["co2_body"], "CO2 body volume"),
        of_rule("co2", "body_volume_ml", "water_volume_l known", 1400, "water_volume_l^1",
                sigma["co2_body"], "CO2 body volume"),
        of_rule("co2", "body_volume_ml", "co2_mass_kg above 0.2", 1750 / 0.68, "co2_mass_kg^1",
                sigma["co2_body"], "CO2 body volume"),
        of_rule("co2", "body_volume_ml", "", 1400 / 0.75, "co2_mass_kg^1", sigma["co2_body"],
                "CO2 body volume"),
        of_rule("regulator", "critical_ratio", "", 0.3, "", None, "regulator critical ratio"),
        of_rule("regulator", "body_volume_ml", "", 1000 / 1.5, "mass_kg^1", sigma["regulator_body"],
                "regulator body volume"),
        of_law("reservoir", "mass_kg", "material has steel", made["steel_tank_mass"],
               ["internal_volume_ml"]),
        of_rule("reservoir", "body_volume_ml", "material is PET", 1.15, "internal_volume_ml^1",
                sigma["reservoir_body"], "reservoir body volume"),
        of_rule("reservoir", "body_volume_ml", "", 1.3, "internal_volume_ml^1",
                sigma["reservoir_body"], "reservoir body volume"),
    ]
    made_rows += [of_rule("tubing", "mass_kg_per_m", f"material has {material}", density * 1e-6,
                          "wall_area_mm2^1", None, "tube mass")
                  for material, density in (("polyurethane", 1200), ("nylon", 1020),
                                            ("polyamide", 1020), ("silicone", 1120), ("PVC", 1250),
                                            ("PTFE", 2170))]
    return made_rows
