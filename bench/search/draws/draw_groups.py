"""Draws the actuators of a request: what each group is, how fast it must be, and when it is filled."""
import math
from dataclasses import dataclass

VOLUME_ML = (5.0, 2000.0)
PRESSURE_KPA = (20.0, 500.0)


def rounded(value, digits=3):
    """A number as people write it: with few digits."""
    return float(f"{value:.{digits}g}")


def log_uniform(draw, low, high):
    return math.exp(draw.uniform(math.log(low), math.log(high)))


def clamped(value, bounds):
    return min(bounds[1], max(bounds[0], value))


@dataclass
class Manner:
    """What all groups of one request share.

    `timing`: "at once", "in turns" or "gait". `apart`: no two groups may begin at once, as pumps without
    a reservoir ask. `one_phase`: all actuators of a group have the same phase. `double_acting`: cylinders
    may have two chambers.
    """

    evacuated: bool
    timing: str
    groups: int
    apart: bool
    one_phase: bool
    double_acting: bool
    ambient_kpa: float
    volume_ml: float
    pressure_kpa: float


def draw_pressure(draw, manner):
    """The operating pressure of a group, near that of the others as a rule."""
    if manner.evacuated:
        return -rounded(draw.uniform(10.0, 0.84 * manner.ambient_kpa))
    near = log_uniform(draw, 0.6, 1.6) if draw.random() < 0.7 else 1.0
    return rounded(clamped(manner.pressure_kpa * near, PRESSURE_KPA))


def draw_volume(draw, manner):
    return rounded(clamped(manner.volume_ml * log_uniform(draw, 0.5, 2.0), VOLUME_ML))


def chamber(draw, manner, pressure_kpa):
    volume_ml = draw_volume(draw, manner)
    ratio = draw.choice([1, 0.9, 0.7, 0.4, 0.2] if manner.evacuated else [1, 1.2, 1.5, 2, 3, 6])
    return {"rest_volume_ml": volume_ml, "expansion_ratio": ratio}, volume_ml * ratio


def table_of_volumes(draw, manner, pressure_kpa):
    volume_ml = draw_volume(draw, manner)
    points = [(0.0, 1.0), (rounded(0.4 * pressure_kpa), 1.1), (pressure_kpa, 1.7)]
    rows = [{"pressure_kpa_gauge": kpa, "volume_ml": rounded(volume_ml * factor)} for kpa, factor in points]
    return {"rest_volume_ml": volume_ml, "pressure_volume": rows}, volume_ml * 1.7


def cylinder(draw, manner, pressure_kpa):
    bore_mm = draw.choice([10, 12, 16, 20, 25, 32, 40, 50])
    stroke_mm = draw.choice([25, 50, 80, 100, 200])
    stroke_ml = math.pi / 4.0 * bore_mm ** 2 * stroke_mm * 1e-3
    shape = {"bore_mm": bore_mm, "stroke_mm": stroke_mm}
    if draw.random() < 0.35 and manner.double_acting:
        shape |= {"acting": "double", "rod_mm": rounded(0.4 * bore_mm, 2)}
    if draw.random() < 0.3:
        shape["dead_volume_ml"] = rounded(0.1 * stroke_ml)
    return {"cylinder": shape}, 1.05 * stroke_ml


def muscle(draw, manner, pressure_kpa):
    length_mm, diameter_mm = draw.choice([80, 150, 300]), draw.choice([10, 20, 40])
    shape = {"length_mm": length_mm, "diameter_mm": diameter_mm, "contraction": draw.choice([0.1, 0.2, 0.25])}
    if draw.random() < 0.5:
        shape["braid_angle_deg"] = draw.choice([20, 25, 30])
    return {"muscle": shape}, math.pi / 2.0 * diameter_mm ** 2 * length_mm * 1e-3


def pouch(draw, manner, pressure_kpa):
    width_mm, length_mm, cells = draw.choice([30, 60, 100]), draw.choice([60, 100, 200]), draw.choice([1, 2, 4])
    shape = {"width_mm": width_mm, "length_mm": length_mm, "cells": cells}
    return {"pouch": shape}, 0.15 * width_mm ** 2 * length_mm * cells * 1e-3


def growing_body(draw, manner, pressure_kpa):
    diameter_mm, length_m = draw.choice([20, 40, 60]), draw.choice([0.3, 0.5, 1, 2])
    return ({"body": {"diameter_mm": diameter_mm, "length_m": length_m}},
            math.pi / 4.0 * diameter_mm ** 2 * length_m)


SHAPES = {chamber: 54, table_of_volumes: 8, cylinder: 14, muscle: 10, pouch: 7, growing_body: 7}
SOFT = {pouch: 100.0, growing_body: 60.0}  # the most that they stand, kPa


def draw_shape(draw, manner, pressure_kpa):
    """(fields, operating volume in mL, operating pressure in kPa)."""
    if manner.evacuated:
        return *chamber(draw, manner, pressure_kpa), pressure_kpa
    make = draw.choices(list(SHAPES), list(SHAPES.values()))[0]
    pressure_kpa = min(pressure_kpa, SOFT.get(make, pressure_kpa))
    while True:
        fields, volume_ml = make(draw, manner, pressure_kpa)
        if VOLUME_ML[0] <= volume_ml <= VOLUME_ML[1] or make in (chamber, table_of_volumes):
            return fields, volume_ml, pressure_kpa


def draw_pressure_limit(draw, manner, pressure_kpa):
    if draw.random() >= 0.3:
        return {}
    if manner.evacuated:
        lowest = pressure_kpa * draw.choice([1.02, 1.1, 1.15])
        return {"pressure_kpa_gauge_min": max(-0.97 * manner.ambient_kpa, rounded(lowest, 4))}
    return {"pressure_kpa_gauge_max": rounded(pressure_kpa * draw.choice([1.02, 1.1, 1.3, 2]), 4)}


def draw_gait(draw, manner, number, count):
    """Phase, share of the period and strokes of group `number`."""
    gait = {}
    if manner.apart:
        gait["phase"] = rounded(number / manner.groups)
        if manner.groups == 1 and not manner.one_phase and count > 1 and draw.random() < 0.5:
            gait["phase"] = [rounded(i / count) for i in range(count)]
    elif draw.random() < 0.8:
        each = draw.random() < 0.4 and not manner.one_phase
        one = rounded(draw.choice([0, 0.25, 0.5, 0.75, 0.99 * draw.random()]))
        gait["phase"] = [rounded(i / count) for i in range(count)] if each else one
    if draw.random() < 0.7:
        gait["inflate_fraction"] = draw.choice([0.2, 0.3, 0.5, 0.6])
    if not manner.apart and draw.random() < 0.25:
        gait["strokes_per_period"] = 2
    return gait


def draw_group(draw, manner, number):
    """(the group, the period in s that it asks for at least)."""
    group = {"name": f"g{number}", "count": draw.choice([1, 1, 1, 2, 2, 3, 4, 6])}
    fields, volume_ml, pressure_kpa = draw_shape(draw, manner, draw_pressure(draw, manner))
    group |= fields
    group["operating_pressure_kpa_gauge"] = pressure_kpa
    group["tube_length_m"] = draw.choice([0.2, 0.5, 1, 2])
    if draw.random() < 0.7:
        group["fittings_per_line"] = draw.choice([0, 1, 2, 3])
    litres = volume_ml / 1000.0 * (1.0 + abs(pressure_kpa) / 100.0)
    stroke_s = max(0.03, litres / log_uniform(draw, 0.03, 2.0) * group["count"] ** 0.3)
    if draw.random() < 0.9:
        group["rise_time_s_max"] = rounded(stroke_s * log_uniform(draw, 0.5, 3.0), 2)
    if draw.random() < 0.8:
        group["fall_time_s_max"] = rounded(stroke_s * log_uniform(draw, 0.7, 5.0), 2)
    group |= draw_pressure_limit(draw, manner, pressure_kpa)
    if manner.timing == "gait":
        group |= draw_gait(draw, manner, number, group["count"])
    return group, period_of(group, stroke_s)


def period_of(group, stroke_s):
    """Of a group alone, with a little room."""
    share = group.get("inflate_fraction", 0.5)
    rise_s, fall_s = group.get("rise_time_s_max", stroke_s), group.get("fall_time_s_max", stroke_s)
    return 1.2 * max(rise_s / share, fall_s / (1.0 - share)) * group.get("strokes_per_period", 1)
