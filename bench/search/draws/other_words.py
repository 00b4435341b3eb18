"""The same request in other words: groups in another order and renamed, and in other units."""
import copy
import math

PSI_KPA, INCH_MM, CUBIC_INCH_ML = 6.894757293168361, 25.4, 16.387064
# End of a field's name -> (unit, how many of it are one of the field's own).
UNITS = {
    "_kpa_gauge": ("psi", 1.0 / PSI_KPA), "_kpa_gauge_max": ("psi", 1.0 / PSI_KPA),
    "_kpa_gauge_min": ("bar", 0.01), "_kpa_abs": ("Pa", 1000.0), "_ml": ("in3", 1.0 / CUBIC_INCH_ML),
    "_l_max": ("mL", 1000.0), "_mm": ("in", 1.0 / INCH_MM), "_m": ("in", 1000.0 / INCH_MM),
    "_s_max": ("ms", 1000.0), "_hz": ("1/min", 60.0), "_kg_max": ("g", 1000.0), "_wh_max": ("J", 3600.0),
    "_a_max": ("mA", 1000.0), "_v": ("mV", 1000.0), "_deg": ("rad", math.pi / 180.0),
    "_l_per_min_anr_max": ("L/h", 60.0),
}
# Their numbers have no unit, or stand in lists, where texts are refused.
LEFT = ("objective", "ranking", "pressure_volume", "limits")


def with_unit(field, number):
    """The number as a text in another unit, or as it is."""
    for end in sorted(UNITS, key=len, reverse=True):
        if field.endswith(end):
            unit, factor = UNITS[end]
            return f"{number * factor!r} {unit}"
    return number


def in_other_units(value):
    if isinstance(value, list):
        return [in_other_units(one) for one in value]
    if not isinstance(value, dict):
        return value
    changed = {}
    for field, inner in value.items():
        number = isinstance(inner, (int, float)) and not isinstance(inner, bool)
        if field in LEFT:
            changed[field] = inner
        else:
            changed[field] = with_unit(field, inner) if number else in_other_units(inner)
    return changed


def keeps_order(request):
    """Whether the place of a group in the list says when it begins, and more than a turn of all depends on that."""
    actuators = request["actuators"]
    with_phase = sum("phase" in group for group in actuators)
    if request["duty"].get("simultaneous", True) or with_phase == len(actuators):
        return False
    if with_phase or any("strokes_per_period" in group for group in actuators):
        return True
    # A tank empties from group to group, from the first of a period on.
    return bool({"tank", "tank_and_pump"} & set(request["supply"].get("configurations", [])))


def rotated_and_renamed(request):
    """The first group last, where the order is no part of what is asked for; each with another name."""
    changed = copy.deepcopy(request)
    actuators = changed["actuators"]
    if not keeps_order(request):
        actuators.append(actuators.pop(0))
    for number, group in enumerate(actuators):
        group["name"] = f"{'zyxwvuts'[number]} {group['name'][::-1]}"
    return changed


def splittable(request):
    """Numbers of the groups that may be written as two."""
    actuators, supply = request["actuators"], request["supply"]
    all_phases = all("phase" in group for group in actuators)
    if not (request["duty"].get("simultaneous", True) or all_phases) or len(actuators) > 7:
        return []
    if "direct_pump" in supply.get("configurations", []) or supply.get("regulation") == "per_group":
        return []
    if supply.get("pumps", "shared") != "shared":
        return []
    return [number for number, group in enumerate(actuators)
            if group["count"] > 1 and not isinstance(group.get("phase"), list)]


def split_in_two(request, number):
    """Group `number` as two groups that ask for the same and are filled at the same time."""
    changed = copy.deepcopy(request)
    first = changed["actuators"][number]
    second = copy.deepcopy(first)
    second["count"] = first["count"] // 2
    first["count"] -= second["count"]
    second["name"] += " half"
    changed["actuators"].insert(number + 1, second)
    return changed
