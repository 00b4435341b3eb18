"""Draws what a request says of its supply: configurations, sources, limits, power, pumps."""
from draw_groups import log_uniform, rounded

CONFIGURATIONS = ["compressor", "cylinder", "co2", "mains", "direct_pump", "tank", "tank_and_pump"]
TANKS = {"tank", "tank_and_pump"}


def draw_configurations(draw, evacuated, at_once):
    """Their names; with evacuated actuators those of supply.vacuum."""
    if evacuated:
        return draw.choice([["pump"], ["pump"], ["mains"], ["pump", "mains"]])
    names = [name for name in CONFIGURATIONS if name != "direct_pump" or not at_once]
    return draw.sample(names, draw.choices([1, 2, 3, 5], [50, 25, 15, 10])[0])


def draw_pumps(draw, configurations, evacuated):
    """Whose the pumps are, {} for all groups'."""
    if configurations == ["direct_pump"] and draw.random() < 0.5:
        return {"pumps": draw.choice(["shared", "per_group", "per_actuator"])}
    if evacuated and configurations == ["pump"] and draw.random() < 0.2:
        return {"pumps": draw.choice(["per_group", "per_actuator"])}
    return {}


def vacuum_supply(draw, configurations, deepest_kpa, ambient_kpa):
    """`deepest_kpa`: the operating pressure of the group that is evacuated most."""
    vacuum = {"configurations": configurations}
    if "mains" in configurations:
        wall = [share * ambient_kpa for share in (-0.6, -0.8, -0.9)]
        vacuum["mains"] = {"pressure_kpa_gauge": draw.choice([rounded(kpa) for kpa in wall if kpa < deepest_kpa])}
    if draw.random() < 0.5:
        floor = [share * ambient_kpa for share in (-0.95, -0.9, -0.88)]
        vacuum["vacuum_kpa_gauge_min"] = rounded(draw.choice(floor))
    return {"vacuum": vacuum}


def pressure_supply(draw, configurations, highest_kpa):
    """`highest_kpa`: the highest operating pressure of all groups."""
    supply = {"configurations": configurations}

    def above(*values):
        return draw.choice([kpa for kpa in values if kpa > 1.1 * highest_kpa])

    if "mains" in configurations:
        supply["mains"] = {"pressure_kpa_gauge": above(300, 600, 800)}
        if draw.random() < 0.6:
            supply["mains"]["flow_l_per_min_anr_max"] = draw.choice([20, 100, 200, 500])
    if TANKS & set(configurations) and draw.random() < 0.7:
        supply["tank_fill_kpa_gauge_max"] = above(600, 800, 1200, 3000)
    if draw.random() < 0.35:
        supply["source_pressure_kpa_gauge_max"] = above(400, 600, 800, 1000)
    if draw.random() < 0.3:
        supply["regulation"] = draw.choice(["shared", "per_group", "any", "any"])
    return supply


def draw_power(draw):
    kind = draw.choices(["battery", "wall", "robot"], [75, 12, 13])[0]
    if kind == "battery":
        return {}
    power = {"kind": kind}
    if kind == "robot":
        power["voltage_v"] = draw.choice([6, 12, 24])
        if draw.random() < 0.5:
            power["energy_wh_max"] = draw.choice([5, 50, 500])
        if draw.random() < 0.5:
            power["current_a_max"] = draw.choice([2, 5, 20])
    return {"power": power}


def draw_limits(draw):
    """On the sums of a design."""
    limits = {}
    for field, share, low, high in (("mass_kg_max", 0.15, 0.3, 8.0), ("volume_l_max", 0.12, 0.5, 10.0),
                                    ("cost_eur_max", 0.08, 50.0, 1500.0)):
        if draw.random() < share:
            limits[field] = rounded(log_uniform(draw, low, high), 2)
    if draw.random() < 0.12:
        limits["parts"] = "orderable"
    return limits


def draw_objective(draw):
    """(name of its class, what to minimize)."""
    name = draw.choices(["mass_kg", "volume_l", "cost_eur", "energy_wh", "weighted"], [50, 12, 12, 10, 16])[0]
    if name != "weighted":
        return name, name
    if draw.random() < 0.6:
        return name, {"mass_kg": 1.0, "volume_l": rounded(log_uniform(draw, 0.05, 2.0), 2)}
    return name, {"mass_kg": 1.0, "energy_wh": rounded(log_uniform(draw, 0.01, 0.3), 2)}
