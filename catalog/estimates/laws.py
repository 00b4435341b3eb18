"""Which number of a part follows from which, fitted on the parts that have them all."""
import csv
import math
import pathlib

import pumps
from fit import Law, Point
from tables import is_known, number

BORES = pathlib.Path(__file__).parent / "bores.csv"

class Named:
    """A law with its words: `x` gives a row's predictors or None."""

    def __init__(self, key, title, unit, names, x, points, flags=(), fixed=None):
        self.key, self.title, self.unit, self.names, self.x = key, title, unit, names, x
        self.law = Law(points, flags, fixed)

    @property
    def formula(self):
        return self.law.formula(self.names, self.unit)

    def source(self):
        return f"regression: {self.title} = {self.formula}; docs/explanation/data_quality.md"


def kin(row):
    """Parts that share what a sheet says of them; a class has parts of many makers."""
    return row["id"] if row["manufacturer"] == "generic" else row["series"]


def observed(rows, field, x, known=()):
    points = []
    for row in rows:
        values = x(row)
        if values and is_known(row, field) and all(is_known(row, f) for f in known):
            points.append(Point(row["id"], kin(row), values, number(row, field)))
    return points


def pieces(row):
    return 2 if row["function"] == "2/2 pair" else int(float(row["channels"]))


# Three positions against two of the same body: 87 g and 74 g (SY3000), 77 g and 67 g (VQ1000).
THREE_POSITIONS = 1.16


def is_piloted(row):
    """A spool that a pilot moves; flanged ones of process actuators (NAMUR) are a kind of their own."""
    c = number(row, "sonic_conductance_fill_dm3_per_s_bar")
    return ("NAMUR" not in row["notes"] + row["part_number"] and row["manufacturer"] != "Norgren"
            and bool(row["pressure_min_kpa_gauge"] or (row["function"] != "proportional" and c > 1)))


def valve_x(row):
    return ((number(row, "sonic_conductance_fill_dm3_per_s_bar"),) if is_piloted(row) else None)


def body_x(row):
    volume = number(row, "body_volume_ml")
    return (volume / pieces(row),) if volume else None


def bore_points(kind):
    with open(BORES, newline="", encoding="utf-8") as file:
        return [Point(row["part"], row["series"], (float(row["bore_mm"]),),
                      float(row["sonic_conductance_dm3_per_s_bar"]))
                for row in csv.DictReader(file) if row["kind"] == kind]


def fitting_x(row):
    return (number(row, "tube_outer_diameter_mm"), number(row, "sonic_conductance_dm3_per_s_bar"))


def flow_of(row):
    return (number(row, "sonic_conductance_dm3_per_s_bar"),)


def is_mechanical(row):
    return "electro" not in row["type"] and "piezo" not in row["type"]


def mass_x(row):
    return (number(row, "mass_kg"),) if row.get("mass_kg") else None


def is_of_cells(row):
    """Round cells have a mass of their own; packs of them are counted cell by cell."""
    single = int(float(row["cells_series"])) < 2 and row["chemistry"] not in ("LiPo", "LiHV")
    return (single or "pack of" in row["part_number"]
            or row["mass_kg.source"].startswith("rule: packs of cells"))


def pack_x(row):
    if is_of_cells(row) or row["chemistry"] == "NiMH":
        return None
    energy = number(row, "nominal_voltage_v") * number(row, "capacity_ah")
    current = number(row, "current_max_a")
    if not current:
        return None
    lithium_iron = 1.0 if row["chemistry"] == "LiFePO4" else 0.0
    return (energy, current / number(row, "capacity_ah"), lithium_iron)


def flow_x(row):
    return (pumps.ends(row)[0],)


def pump_mass_x(power):
    def x(row):
        high = number(row, "power_max_w") if is_known(row, "power_max_w") else power(row)
        return (high, pumps.ends(row)[0])
    return x


def pump_laws(rows):
    """Of a series whose power is printed as one range, the largest variant stands at its top."""
    top = {}
    for row in rows:
        if row["manufacturer"] == "generic" or "gripper" in row["type"] or not is_known(
                row, "power_max_w"):
            continue
        key = (row["series"], row["mass_kg"] or row["id"], row["family"])
        if key not in top or flow_x(row) > flow_x(top[key]):
            top[key] = row
    largest = list(top.values())
    power = Named("pump_power", "highest electrical power of a pump", "W",
                  ["free flow in L/min"], flow_x,
                  observed(largest, "power_max_w", flow_x))
    x = pump_mass_x(lambda row: power.law.predict(flow_x(row)))
    mass = Named("pump_mass", "mass of a pump", "kg", ["power in W", "free flow in L/min"], x,
                 observed(largest, "mass_kg", x))
    body = Named("pump_body", "body of a pump", "mL", ["mass in kg"], mass_x,
                 observed(rows, "body_volume_ml", mass_x, ["mass_kg"]))
    return power, mass, body


def bottle_x(row):
    """Fill pressure x volume in J; steel and carbon composite as factors."""
    steel = 1.0 if row["material"] == "steel" else 0.0
    composite = 1.0 if "composite" in row["material"] or "carbon" in row["material"] else 0.0
    return (number(row, "fill_pressure_kpa_gauge") * number(row, "water_volume_l"), steel, composite)


def co2_x(row):
    bottle = 1.0 if number(row, "co2_mass_kg") > 0.2 else 0.0
    return (number(row, "co2_mass_kg"), bottle)


def steel_tank_x(row):
    return (number(row, "internal_volume_ml"),) if "steel" in row["material"].lower() else None


def all_laws(tables):
    valves = [r for r in tables["valve"] if r["function"] != "2/2"]  # halves of pairs
    packs = tables["battery"]
    power, pump_mass, pump_body = pump_laws(tables["compressor"] + tables["vacuum_pump"])
    made = [
        power, pump_mass, pump_body,
        Named("valve_mass", "mass of a pilot-operated valve", "kg", ["C"], valve_x,
              observed(valves, "mass_kg", valve_x)),
        Named("valve_density", "mass of a valve of known size", "kg", ["body in mL"], body_x,
              [Point(r["id"], r["series"], body_x(r), number(r, "mass_kg") / pieces(r))
               for r in valves if is_known(r, "mass_kg") and is_known(r, "body_volume_ml")],
              fixed={0: 1.0}),
        Named("valve_body", "body of a valve", "mL", ["mass in kg"], mass_x,
              observed(valves, "body_volume_ml", mass_x, ["mass_kg"]), fixed={0: 1.0}),
        Named("valve_bore", "C of a valve", "dm³/(s·bar)", ["bore in mm"], None,
              bore_points("valve"), fixed={0: 2.0}),
        Named("fitting_bore", "C of a fitting", "dm³/(s·bar)", ["bore in mm"], None,
              bore_points("fitting"), fixed={0: 2.0}),
        Named("fitting_mass", "mass of a stainless fitting", "kg",
              ["tube in mm", "C"], fitting_x,
              observed(tables["fitting"], "mass_kg", fitting_x)),
        Named("regulator_mass", "mass of a mechanical regulator", "kg", ["C"], flow_of,
              [Point(r["id"], r["series"], flow_of(r), number(r, "mass_kg"))
               for r in tables["regulator"] if is_known(r, "mass_kg") and is_mechanical(r)]),
        Named("pack_mass", "mass of a pack", "kg",
              ["energy in Wh", "current over capacity in 1/h", "LiFePO4"], pack_x,
              observed(packs, "mass_kg", pack_x, ["current_max_a", "capacity_ah"]), flags={2}),
        Named("pack_body", "body of a pack", "mL", ["mass in kg"], mass_x,
              observed([r for r in packs if pack_x(r)], "body_volume_ml", mass_x, ["mass_kg"])),
        Named("bottle_mass", "mass of a bottle", "kg",
              ["pressure x volume in J", "steel", "composite"], bottle_x,
              observed(tables["cylinder"], "mass_kg", bottle_x), flags={1, 2}),
        Named("co2_mass", "mass of an empty CO2 bottle", "kg", ["CO2 in kg", "a bottle"], co2_x,
              observed(tables["co2"], "mass_kg", co2_x), flags={1}),
        Named("steel_tank_mass", "mass of a steel tank", "kg", ["volume in mL"], steel_tank_x,
              observed(tables["reservoir"], "mass_kg", steel_tank_x)),
    ]
    return {named.key: named for named in made}


def mean_of(values_by_series):
    """Mean of logarithms, a series counting once, and the error when a series is left out."""
    logs = [sum(map(math.log, group)) / len(group) for group in values_by_series.values()]
    mean = sum(logs) / len(logs)
    n = len(logs)
    if n < 2:
        return math.exp(mean), 0.25
    return math.exp(mean), math.sqrt(sum((v - mean) ** 2 for v in logs) / n) * n / (n - 1)
