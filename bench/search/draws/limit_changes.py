"""Each limit of a request made looser and tighter."""
import copy
from dataclasses import dataclass

REMOVED = object()
WITHOUT_BATTERY = {"cylinder", "co2", "mains", "tank"}
PIECES = ("compressors_max", "batteries_max", "cylinders_max", "co2_max", "reservoirs_max")


@dataclass
class Change:
    """A field and its looser and tighter value; None where there is none."""

    pointer: str
    looser: object
    tighter: object


def set_field(request, pointer, value):
    """A copy with one field set, or removed where it is."""
    changed = copy.deepcopy(request)
    *way, last = pointer.strip("/").split("/")
    place = changed
    for key in way:
        place = place[int(key)] if isinstance(place, list) else place.setdefault(key, {})
    if value is REMOVED:
        place.pop(last, None)
    else:
        place[int(last) if isinstance(place, list) else last] = value
    return changed


def changes_of_group(number, group, draw):
    at = f"/actuators/{number}/"
    for field in ("rise_time_s_max", "fall_time_s_max"):
        if field in group:
            yield Change(at + field, group[field] * draw.choice([1.1, 1.5, 3]), group[field] * draw.choice([0.6, 0.9]))
    operating = group["operating_pressure_kpa_gauge"]
    field = "pressure_kpa_gauge_max" if operating > 0 else "pressure_kpa_gauge_min"
    limit = group.get(field, 1.05 * operating)
    yield Change(at + field, max(1.2 * limit, -199.0), 0.5 * (operating + limit))


def changes_of_supply(request, draw):
    supply = request["supply"]
    pressures = [group["operating_pressure_kpa_gauge"] for group in request["actuators"]]
    for field in ("mass_kg_max", "volume_l_max", "cost_eur_max"):
        if field in supply:
            yield Change(f"/supply/{field}", supply[field] * 1.5, supply[field] * draw.choice([0.7, 0.95]))
    for field in ("source_pressure_kpa_gauge_max", "tank_fill_kpa_gauge_max"):
        if field in supply:
            yield Change(f"/supply/{field}", supply[field] * 1.4, max(supply[field] * 0.8, 1.02 * max(pressures)))
    flow = supply.get("mains", {}).get("flow_l_per_min_anr_max")
    if flow:
        yield Change("/supply/mains/flow_l_per_min_anr_max", 2.0 * flow, 0.5 * flow)
    for field in ("energy_wh_max", "current_a_max"):
        if field in supply.get("power", {}):
            amount = supply["power"][field]
            yield Change(f"/supply/power/{field}", 2.0 * amount, 0.5 * amount)
    floor = supply.get("vacuum", {}).get("vacuum_kpa_gauge_min")
    if floor:
        yield Change("/supply/vacuum/vacuum_kpa_gauge_min", REMOVED, 0.5 * (floor + min(pressures)))
    orderable = supply.get("parts") == "orderable"
    yield Change("/supply/parts", REMOVED if orderable else None, None if orderable else "orderable")
    regulation = supply.get("regulation", "shared")
    if "vacuum" not in supply and len(pressures) > 1:
        yield Change("/supply/regulation", None if regulation == "any" else "any",
                     draw.choice(["shared", "per_group"]) if regulation == "any" else None)


def changes_of_duty(request):
    duty, supply = request["duty"], request["supply"]
    count = duty["actuations"]
    yield Change("/duty/actuations", max(1, int(0.6 * count)) if count > 1 else None, int(1.7 * count) + 1)
    # A slower gait makes the mission longer, in which regulators with electronics take more energy.
    energy_counts = "energy_wh" in str(request["objective"]) or "energy_wh_max" in supply.get("power", {})
    if not energy_counts and set(supply.get("configurations", ["vacuum"])) <= WITHOUT_BATTERY:
        yield Change("/duty/frequency_hz", 0.6 * duty["frequency_hz"], min(100.0, 1.5 * duty["frequency_hz"]))


def changes_of(request, draw):
    """All that the request can be changed in."""
    for number, group in enumerate(request["actuators"]):
        yield from changes_of_group(number, group, draw)
    yield from changes_of_supply(request, draw)
    yield from changes_of_duty(request)
    for field, most in request.get("limits", {}).items():
        yield Change(f"/limits/{field}", most + 1, most - 1 if most > 1 else None)
    if "rise" in request:
        fraction = request["rise"]["to_fraction"]
        yield Change("/rise/to_fraction", 0.9 * fraction, 0.5 * (1.0 + fraction))
    if "fall" in request:
        fraction = request["fall"]["to_fraction"]
        yield Change("/fall/to_fraction", 0.5 * (1.0 + fraction), 0.7 * fraction)


def demands_of(request):
    """Pointers of all demands that may be dropped, whether the request states them or not."""
    for number, group in enumerate(request["actuators"]):
        pressed = group["operating_pressure_kpa_gauge"] > 0
        for field in ("rise_time_s_max", "fall_time_s_max", f"pressure_kpa_gauge_{'max' if pressed else 'min'}"):
            yield f"/actuators/{number}/{field}"
    yield from ("/duty/actuations", "/duty/frequency_hz")
    supply = request["supply"]
    yield from (f"/supply/{field}" for field in supply if field.endswith("_max") or field == "parts")
    if "mains" in supply:
        yield "/supply/mains/flow_l_per_min_anr_max"
    yield from (f"/limits/{field}" for field in PIECES)


def dropped_value(request, pointer):
    """What a demand is when it is dropped, as docs/reference/requests.md says."""
    if pointer == "/duty/frequency_hz":
        frequency_hz = request["duty"]["frequency_hz"]
        return max(1e-4, frequency_hz / 4096.0, min(0.01, frequency_hz / 8.0))
    field = pointer.rpartition("/")[2]
    if pointer.startswith("/limits/"):
        return 16
    return {"actuations": 1, "pressure_kpa_gauge_max": 1e4, "pressure_kpa_gauge_min": -199.0}.get(field, REMOVED)


def drop(request, pointer):
    return set_field(request, pointer, dropped_value(request, pointer))


def keep_in_force(request, kept):
    """A copy in which all demands but those of `kept`, a set of pointers, are dropped."""
    for pointer in demands_of(request):
        if pointer not in kept:
            request = drop(request, pointer)
    return request
