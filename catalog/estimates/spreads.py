"""How far the rules of catalog/data/README.md miss the rows that have the number.

A rule is fixed, so its error is that of its predictions for every series that has the number: the root
of the mean square of the logarithms, a series counting once. Where a rule names a class and no formula,
the error is that of the mean of the class when each series in turn is left out. One series alone says
too little to trust a number more than the default (a half-width of 25 %, so 0.125); it may only say
that the number is worse. A class without any row that has the number keeps the default.
"""
import math

from laws import is_mechanical
from tables import is_known, number

DEFAULT = 0.125
# Counts, diameters and nominal voltages are exact by nature; zero watts are, too.
EXACT = ("cells_series", "nominal_voltage_v", "voltage_v", "stations", "channels",
         "tube_outer_diameter_mm", "outer_diameter_mm", "inner_diameter_mm")
DEFINING = "size classes"  # what defines a size class has no error: one buys a product that has it


class Spread:
    """The error of one rule: `says` gives the rule's number for a row that has one, or None."""

    def __init__(self, key, title, family, field, rule, says, rows, within=lambda row: True,
                 extra=()):
        self.key, self.title, self.family, self.field = key, title, family, field
        self.rule, self.within, self.extra = rule, within, extra
        self.errors = {}
        for row in rows:
            if is_known(row, field) and number(row, field) > 0 and within(row):
                value = says(row)
                if value:
                    self.errors.setdefault(row["series"], []).append(
                        math.log(number(row, field) / value))
        self.sigma = self._sigma()

    def _sigma(self):
        squares = [sum(e * e for e in group) / len(group) for group in self.errors.values()]
        if not squares:
            return None
        sigma = math.sqrt(sum(squares) / len(squares))
        if len(squares) == 1 and sigma <= DEFAULT:
            return None
        return max(sigma, 0.01)

    def holds(self, row):
        source = row[self.field + ".source"]
        return any(rule in source for rule in self.rule) and self.within(row)

    def fill(self, rows):
        for row in rows:
            if row[self.field] and not is_known(row, self.field) and self.holds(row):
                sigma = self.sigma
                row[self.field + ".uncertainty"] = ""
                if sigma is not None:
                    for field in self.extra:
                        if not is_known(row, field):
                            sigma = math.hypot(sigma, number(row, field + ".uncertainty") or 0.0)
                    row[self.field + ".uncertainty"] = f"{min(sigma, 1.0):.2g}"


class SeriesSpread(Spread):
    """A rule that takes the number of a sister: how far variants of a series are from their mean."""

    def _sigma(self):
        squares = []
        for group in self.errors.values():
            mean = sum(group) / len(group)
            if len(group) > 1:
                squares.append(sum((e - mean) ** 2 for e in group) / (len(group) - 1))
        self.errors = {name: group for name, group in self.errors.items() if len(group) > 1}
        return math.sqrt(sum(squares) / len(squares)) if squares else None


class LimitSpread(Spread):
    """A limit that a part stands: only series that stand less than the rule says make it less sure."""

    def _sigma(self):
        if len(self.errors) < 2:
            return super()._sigma()
        squares = [sum(min(e, 0.0) ** 2 for e in group) / len(group)
                   for group in self.errors.values()]
        return max(math.sqrt(sum(squares) / len(squares)), 0.01)


class LawSpread(Spread):
    """A rule of a class in which a law can be fitted: the error of that law."""

    def __init__(self, key, title, family, field, rule, law, within):
        super().__init__(key, title, family, field, rule, None, [], within)
        self.errors = {point.series: [] for point in law.points}
        self.sigma = law.sigma


class SizeSpread(Spread):
    """A share of another's number, as likely anywhere between two shares: `law` predicts the whole."""

    def __init__(self, key, title, family, field, rule, law, shares):
        super().__init__(key, title, family, field, rule, None, [])
        low, high = shares
        self.errors = {point.series: [] for point in law.points}
        self.sigma = math.hypot(law.sigma, (high - low) / (high + low) / math.sqrt(3))


class ClassSpread(Spread):
    """A rule that names a class: the mean of its series, each left out in turn."""

    def _sigma(self):
        logs = [sum(group) / len(group) for group in self.errors.values()]
        n = len(logs)
        if n < 2:
            return None
        mean = sum(logs) / n
        return max(math.sqrt(sum((v - mean) ** 2 for v in logs) / n) * n / (n - 1), 0.01)


def is_electric(row):
    return not is_mechanical(row)


def is_low(row):
    """A mechanical regulator for a line, not for a bottle."""
    return not is_electric(row) and number(row, "inlet_pressure_max_kpa_gauge") < 5000


def tops(rows, field):
    """Of each series the variants with the highest number: a small orifice stands more."""
    top = {}
    for row in rows:
        if is_known(row, field):
            top[row["series"]] = max(top.get(row["series"], 0.0), number(row, field))
    return [row for row in rows if is_known(row, field) and number(row, field) == top[row["series"]]]


def is_bottle(row):
    return number(row, "co2_mass_kg") > 0.2


def round_18650(row):
    name = row["part_number"] + row["series"]
    return row["chemistry"] == "Li-ion" and number(row, "cells_series") == 1 and "18650" in name


def times(field, factor):
    return lambda row: number(row, field) * factor if row.get(field) else None


def always(value):
    return lambda row: value


def all_spreads(tables, made):
    """In the order in which they are filled in: a mass before the body that follows from it."""
    from laws import is_of_cells, is_piloted, pieces
    valves, packs = tables["valve"], tables["battery"]
    fittings, regulators = tables["fitting"], tables["regulator"]
    pack = lambda row: not is_of_cells(row)  # noqa: E731
    size = lambda row: number(row, "sonic_conductance_dm3_per_s_bar") ** 0.5  # noqa: E731
    iron = lambda row: row["chemistry"] == "LiFePO4" and is_of_cells(row)  # noqa: E731
    energy = lambda row: number(row, "nominal_voltage_v") * number(row, "capacity_ah")  # noqa: E731
    diaphragm = lambda row: row["type"] == "diaphragm"  # noqa: E731
    direct = lambda row: row["function"] != "proportional" and not is_piloted(row)  # noqa: E731
    strong = lambda row: number(row, "pressure_max_kpa_gauge") == 700 or (  # noqa: E731
        is_known(row, "pressure_max_kpa_gauge") and number(row, "pressure_max_kpa_gauge") > 60)
    # The Lee Company's valves have a rule of their own.
    ratings = [row for row in tops(valves, "pressure_max_kpa_gauge") if "LHD" not in row["series"]]
    scale, slope = made["regulator_mass"].law.coefficients
    at_mass = lambda mass: math.exp((math.log(mass) - scale) / slope)  # noqa: E731
    return [
        Spread("pack_current", "current of a pack, 5C where none is given", "battery",
               "current_max_a", ["battery current, 5C"], times("capacity_ah", 5), packs, pack),
        ClassSpread("cell_mass", "mass of a round cell of 18650, in packs of them", "battery",
                    "mass_kg", ["packs of cells"], always(1.0),
                    [row for row in packs if round_18650(row)]),
        ClassSpread("iron_mass", "mass of a LiFePO4 cell per Wh", "battery", "mass_kg",
                    ["battery mass"], energy, packs, iron),
        ClassSpread("iron_body", "body of a LiFePO4 cell per Wh", "battery", "body_volume_ml",
                    ["battery body volume"], energy, packs, iron),
        Spread("co2_water", "CO2 per litre, 0.75 kg in cartridges, 0.68 in bottles", "co2",
               "water_volume_l", ["CO2 filling ratio"],
               lambda row: number(row, "co2_mass_kg") / (0.68 if is_bottle(row) else 0.75),
               tables["co2"]),
        Spread("co2_content", "CO2 in a bottle by the same ratio", "co2", "co2_mass_kg",
               ["CO2 filling ratio"],
               lambda row: number(row, "water_volume_l") * (0.68 if is_bottle(row) else 0.75)
               if row["water_volume_l"] and is_known(row, "water_volume_l") else None, tables["co2"]),
        Spread("co2_body", "body of CO2, 1.4 and 1.75 of the water volume", "co2",
               "body_volume_ml", ["CO2 body volume"],
               lambda row: 1000 * number(row, "water_volume_l") * (1.75 if is_bottle(row) else 1.4),
               tables["co2"], extra=("water_volume_l",)),
        Spread("bottle_body", "body of a bottle, 1.45 (composite 1.6) of the water volume", "cylinder",
               "body_volume_ml", ["bottle body volume"],
               lambda row: 1000 * number(row, "water_volume_l") * (
                   1.6 if "omposite" in row["material"] or "carbon" in row["material"] else 1.45),
               tables["cylinder"]),
        Spread("pump_duty", "duty of a diaphragm pump, 1", "compressor", "duty_max", ["pump duty"],
               always(1.0), tables["compressor"], diaphragm),
        SizeSpread("fitting_mass", "mass of a fitting, 0.4 to 0.8 of a stainless one", "fitting",
                   "mass_kg", ["fitting mass"], made["fitting_mass"].law, (0.4, 0.8)),
        Spread("fitting_body", "body of a fitting, mass over 3 g/mL", "fitting", "body_volume_ml",
               ["fitting body volume"], times("mass_kg", 1000 / 3), fittings, extra=("mass_kg",)),
        LimitSpread("fitting_pressure", "pressure of a push-in fitting, 1000 kPa", "fitting",
               "pressure_max_kpa_gauge", ["fitting pressure"], always(1000.0), fittings,
               lambda row: number(row, "pressure_max_kpa_gauge") == 1000),
        LimitSpread("joint_pressure", "pressure of a push-in joint, 1000 kPa", "manifold",
               "pressure_max_kpa_gauge", ["joint pressure"], always(1000.0), tables["manifold"],
               lambda row: number(row, "pressure_max_kpa_gauge") == 1000),
        LimitSpread("nylon_pressure", "pressure of nylon tube, 1000 kPa", "tubing",
               "pressure_max_kpa_gauge", ["tube pressure"], always(1000.0), tables["tubing"],
               lambda row: "nylon" in row["material"]),
        LimitSpread("urethane_pressure", "pressure of polyurethane tube, 800 kPa", "tubing",
               "pressure_max_kpa_gauge", ["tube pressure"], always(800.0), tables["tubing"],
               lambda row: "polyurethane" in row["material"]),
        Spread("regulator_flow", "C of a mechanical regulator, as others of its mass", "regulator",
               "sonic_conductance_dm3_per_s_bar", ["regulator C", "same series"],
               lambda row: at_mass(number(row, "mass_kg")), regulators, is_low),
        ClassSpread("electric_flow", "C of an electric regulator at its mass, by size class",
                    "regulator", "sonic_conductance_dm3_per_s_bar", ["regulator C", "same series"],
                    lambda row: number(row, "mass_kg"), regulators, is_electric),
        LawSpread("regulator_mass", "mass of a mechanical regulator at its C, by size class",
                  "regulator", "mass_kg", ["regulator mass"], made["regulator_mass"].law,
                  lambda row: not is_electric(row)),
        ClassSpread("electric_mass", "mass of an electric regulator at its C, by size class",
                    "regulator", "mass_kg", ["regulator mass"], size, regulators, is_electric),
        Spread("regulator_body", "body of a regulator, mass over 1.5 g/mL", "regulator",
               "body_volume_ml", ["regulator body volume"], times("mass_kg", 1000 / 1.5), regulators,
               extra=("mass_kg",)),
        Spread("regulator_lowest", "lowest inlet of an electric regulator, 100 kPa", "regulator",
               "inlet_pressure_min_kpa_gauge", ["regulator lowest inlet"], always(100.0), regulators,
               is_electric),
        Spread("regulator_least", "lowest inlet of a mechanical regulator, 50 kPa", "regulator",
               "inlet_pressure_min_kpa_gauge", ["regulator lowest inlet"], always(50.0), regulators,
               is_low),
        LimitSpread("electric_inlet", "highest inlet of an electric regulator, 1000 kPa",
                    "regulator", "inlet_pressure_max_kpa_gauge", ["regulator pressures"],
                    always(1000.0), regulators, is_electric),
        LimitSpread("regulator_inlet", "highest inlet of a mechanical regulator, 1000 kPa",
                    "regulator", "inlet_pressure_max_kpa_gauge", ["regulator pressures"],
                    always(1000.0), regulators, is_low),
        ClassSpread("regulator_power", "power of an electric regulator", "regulator",
                    "electrical_power_w", ["regulator power"], always(1.0), regulators, is_electric),
        Spread("pet_mass", "mass of a PET bottle, 20 g + 20 g/L", "reservoir", "mass_kg",
               ["reservoir mass", "heimduo"],
               lambda row: 0.02 + 0.02 * number(row, "internal_volume_ml") / 1000,
               tables["reservoir"], lambda row: row["material"] == "PET"),
        Spread("reservoir_body", "body of a reservoir, 1.15 to 1.3 times the inside", "reservoir",
               "body_volume_ml", ["reservoir body volume"],
               lambda row: number(row, "internal_volume_ml") * (
                   1.15 if row["material"] == "PET" else 1.3), tables["reservoir"]),
        Spread("valve_width", "mass of a direct valve by width, 35 g of 15 mm", "valve", "mass_kg",
               ["valve mass"], lambda row: 0.035 * pieces(row), valves,
               lambda row: direct(row) and 0.05 < number(
                   row, "sonic_conductance_fill_dm3_per_s_bar") < 1),
        ClassSpread("direct_coil", "power of the coil of a direct valve", "valve", "coil_power_w",
                    ["coil power"], always(1.0), valves,
                    direct),
        ClassSpread("pilot_coil", "power of the coil of a pilot", "valve", "coil_power_w",
                    ["coil power"], always(1.0), valves,
                    lambda row: row["function"] != "proportional" and is_piloted(row)),
        LimitSpread("direct_pressure", "pressure of a direct valve, 700 kPa", "valve",
               "pressure_max_kpa_gauge", ["valve pressure"], always(700.0), ratings,
               lambda row: strong(row) and not is_piloted(row)),
        LimitSpread("piloted_pressure", "pressure of a pilot-operated valve, 700 kPa", "valve",
               "pressure_max_kpa_gauge", ["valve pressure"], always(700.0), ratings,
               lambda row: strong(row) and is_piloted(row)),
        LimitSpread("toy_pressure", "pressure of a toy solenoid, 47 kPa", "valve",
               "pressure_max_kpa_gauge", ["valve pressure"], always(47.0), valves,
               lambda row: number(row, "pressure_max_kpa_gauge") < 60),
        SeriesSpread("sister_flow", "C of a valve, as a sister of its series", "valve",
                     "sonic_conductance_fill_dm3_per_s_bar",
                     ["C of the single valve", "same series", "same body"], always(1.0), valves,
                     is_piloted),
        Spread("pilot_pressure", "pressure that a pilot needs, 150 kPa", "valve",
               "pressure_min_kpa_gauge", ["pilot pressure"], always(150.0), valves),
    ]


def keeps_default(tables):
    """Estimated numbers without an uncertainty, by rule; what is exact or defines a class aside."""
    kept = {}
    for family, rows in tables.items():
        for row in rows:
            for column in row:
                field, _, suffix = column.partition(".")
                if suffix != "uncertainty" or row[column] or row.get(field + ".provenance") != "estimated":
                    continue
                source = row[field + ".source"]
                if field in EXACT or DEFINING in source or row.get(field) == "0":
                    continue
                key = (family, field)
                kept[key] = kept.get(key, 0) + 1
    return kept
