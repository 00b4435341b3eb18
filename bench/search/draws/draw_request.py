"""Draws a requirements document from a seed.

What is plainly invalid, as a source below the operating pressure, is not drawn; what cannot be met is.
"""
import random
from dataclasses import dataclass

from draw_groups import PRESSURE_KPA, VOLUME_ML, Manner, clamped, draw_group, log_uniform, rounded
from draw_supply import (draw_configurations, draw_limits, draw_objective, draw_power, draw_pumps,
                         pressure_supply, vacuum_supply)

# Number of groups and their weights.
GROUPS = {"any": {1: 62, 2: 28, 3: 7, 4: 3}, "one": {1: 1}, "several": {2: 60, 3: 25, 4: 15},
          "at_once": {2: 30, 3: 20, 4: 16, 5: 10, 6: 10, 7: 7, 8: 7}}
AMBIENT_KPA = 101.325
FREQUENCY_HZ = (1e-4, 20.0)


@dataclass
class Drawn:
    """A request, and the classes that table.py counts it in."""

    request: dict
    classes: dict


def draw_timing(draw, mode):
    if mode == "at_once":
        return "at once"
    if draw.random() < 0.22:
        return "gait"
    return "at once" if draw.random() < 0.55 else "in turns"


def draw_manner(draw, mode):
    """(what all groups share, configurations, {} or {"pumps": whose the pumps are})."""
    groups = draw.choices(list(GROUPS[mode]), list(GROUPS[mode].values()))[0]
    evacuated = draw.random() < 0.17
    timing = draw_timing(draw, mode)
    configurations = draw_configurations(draw, evacuated, at_once=mode == "at_once")
    pumps = draw_pumps(draw, configurations, evacuated)
    direct = "direct_pump" in configurations
    own_pumps = pumps.get("pumps", "shared") != "shared"
    if direct and groups > 1 and not own_pumps and timing == "at once":
        timing = "in turns"
    ambient_kpa = draw.choice([80, 95, 101.325]) if draw.random() < 0.1 else AMBIENT_KPA
    manner = Manner(evacuated, timing, groups, apart=direct and not own_pumps,
                    one_phase=pumps.get("pumps") == "per_actuator", double_acting=not direct,
                    ambient_kpa=ambient_kpa, volume_ml=log_uniform(draw, *VOLUME_ML),
                    pressure_kpa=log_uniform(draw, *PRESSURE_KPA))
    return manner, configurations, pumps


def draw_duty(draw, manner, periods_s):
    """As slow as the groups' limits ask, up to five times slower; sometimes too quick for turns."""
    turns = manner.groups if manner.timing == "in turns" and draw.random() < 0.5 else 1
    frequency_hz = 1.0 / (max(periods_s) * turns * log_uniform(draw, 1.0, 5.0))
    duty = {"frequency_hz": rounded(clamped(frequency_hz, FREQUENCY_HZ), 2),
            "actuations": draw.choice([1, 5, 20, 100, 500, 2000, 10000])}
    if manner.timing != "at once" or draw.random() < 0.7:
        duty["simultaneous"] = manner.timing == "at once"
    return duty


def draw_extras(draw, manner):
    """Fields that most requests leave out."""
    extras = {}
    if draw.random() < 0.06:
        extras["prices"] = "lower_bound"
    if draw.random() < 0.2:
        extras["rise"] = {"to_fraction": draw.choice([0.63, 0.9, 0.98])}
    if draw.random() < 0.2:
        extras["fall"] = {"to_fraction": draw.choice([0.37, 0.1, 0.03])}
    if manner.ambient_kpa != AMBIENT_KPA or draw.random() < 0.05:
        extras["ambient"] = {"pressure_kpa_abs": manner.ambient_kpa,
                             "temperature_k": draw.choice([273, 293.15, 310])}
    if draw.random() < 0.2:
        extras["limits"] = {"compressors_max": draw.choice([1, 3, 4]), "batteries_max": draw.choice([1, 2, 6]),
                            "cylinders_max": draw.choice([1, 2]), "reservoirs_max": draw.choice([1, 3])}
    return extras


def timing_class(manner):
    return "one group" if manner.groups == 1 and manner.timing != "gait" else manner.timing


def configuration_class(evacuated, configurations):
    if len(configurations) > 1:
        return "several"
    return f"vacuum {configurations[0]}" if evacuated else configurations[0]


def draw_request(seed, mode="any", time_limit_s=10.0):
    """The same request for the same seed and mode."""
    draw = random.Random(f"{mode} {seed}")
    manner, configurations, pumps = draw_manner(draw, mode)
    drawn = [draw_group(draw, manner, number) for number in range(manner.groups)]
    actuators = [group for group, _ in drawn]
    request = {"schema": "requirements/1", "name": f"draw {seed} of {mode}", "actuators": actuators,
               "duty": draw_duty(draw, manner, [period_s for _, period_s in drawn])}
    pressures = [group["operating_pressure_kpa_gauge"] for group in actuators]
    if manner.evacuated:
        supply = vacuum_supply(draw, configurations, min(pressures), manner.ambient_kpa)
    else:
        supply = pressure_supply(draw, configurations, max(pressures))
    request["supply"] = supply | pumps | draw_power(draw) | draw_limits(draw)
    objective, minimize = draw_objective(draw)
    request["objective"] = {"minimize": minimize}
    request |= draw_extras(draw, manner)
    request["ranking"] = {"count": draw.choice([5, 10, 20]), "time_limit_s": time_limit_s}
    if draw.random() < 0.15:
        request["ranking"]["list"] = "combinations"
    classes = {"groups": manner.groups, "timing": timing_class(manner),
               "configuration": configuration_class(manner.evacuated, configurations), "objective": objective}
    return Drawn(request, classes)
