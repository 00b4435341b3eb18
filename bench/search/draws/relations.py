"""Relations between the answers to a request and to changed ones, for requests that have a design.

A relation is a function of an Inquiry. It asks, notes what is broken, and returns whether it applied.
"""
import copy

import comparison
import limit_changes
import other_words

EVALUATED = {"mass_kg": 1e-6, "volume_l": 1e-6, "cost_eur": 1e-6, "energy_wh": 1e-4}
ACHIEVED = 1e-3  # relative, of times and margins that a simulation gives
OF_ROW = ("family", "id", "quantity", "group")
SETTINGS = ("source_pressure_kpa_gauge", "reservoir_volume_ml", "tank_fill_kpa_gauge", "pump_stop_kpa_gauge",
            "vacuum_kpa_gauge", "group_pressure_kpa_gauge")


def loosened(inquiry):
    """With one limit looser the best is never worse."""
    return ask_changed(inquiry, "looser")


def tightened(inquiry):
    """With one limit tighter the best is never better."""
    return ask_changed(inquiry, "tighter")


def ask_changed(inquiry, way):
    changes = [change for change in limit_changes.changes_of(inquiry.request, inquiry.draw)
               if getattr(change, way) is not None]
    if not changes or (way == "looser" and not inquiry.first.designs):
        return False
    change = inquiry.draw.choice(changes)
    changed = limit_changes.set_field(inquiry.request, change.pointer, getattr(change, way))
    name = f"{way} {change.pointer}"
    ran = inquiry.ask(name, changed, may_refuse=["/supply/parts"])
    if ran is None:
        return False
    if way == "looser":
        broken = confirmed(inquiry, name, changed, ran, inquiry.first)
    else:
        broken = confirmed(inquiry, name, inquiry.request, inquiry.first, ran)
    inquiry.note(name, broken, changed)
    return True


def confirmed(inquiry, name, looser_request, looser, tighter):
    """What is broken, unless only the joints differ.

    Joints follow from the rise times by a rule: a looser limit may give the same parts a joint that costs more.
    """
    broken = comparison.never_worse(looser, tighter)
    if broken is None or broken[0] != "contradiction":
        return broken
    required = copy.deepcopy(looser_request) | {"require": comparison.ids_by_family(tighter.designs[0])}
    again = inquiry.ask(f"{name}, parts of the tighter required", required)
    if again is None or not again.designs or looser.best is None:
        return broken
    if comparison.clearly_less(again.best, looser.best):
        return broken[0], f"{broken[1]}; with its parts required the looser request itself has {again.best}"
    joints = [[row for row in comparison.rows_of(ran.designs[0]) if row[0] == "manifold"] for ran in (again, tighter)]
    return broken if joints[0] == joints[1] else None


def rotated(inquiry):
    """Groups in another order and with other names give the same list."""
    changed = other_words.rotated_and_renamed(inquiry.request)
    return same_list(inquiry, "rotated", changed)


def in_units(inquiry):
    """The same in psi, inches, minutes gives the same list."""
    return same_list(inquiry, "units", other_words.in_other_units(inquiry.request))


def same_list(inquiry, name, changed):
    ran = inquiry.ask(name, changed)
    if ran is not None:
        inquiry.note(name, comparison.same_best(inquiry.first, ran), changed)
    return ran is not None


def winner_required(inquiry):
    """With only the best design's parts to choose from, the best is the same."""
    if not inquiry.first.designs:
        return False
    changed = copy.deepcopy(inquiry.request) | {"require": comparison.ids_by_family(inquiry.first.designs[0])}
    ran = inquiry.ask("winner required", changed)
    if ran is not None:
        inquiry.note("winner required", comparison.same_best(inquiry.first, ran, whole_list=False), changed)
    return ran is not None


def losers_excluded(inquiry):
    """Without parts that the best design does not have, the best is the same."""
    if len(inquiry.first.designs) < 2:
        return False
    kept = comparison.ids_by_family(inquiry.first.designs[0])
    losers = {part for design in inquiry.first.designs for family, ids in comparison.ids_by_family(design).items()
              for part in ids if part not in kept.get(family, [])} - {"custom"}
    if not losers:
        return False
    some = inquiry.draw.sample(sorted(losers), min(len(losers), inquiry.draw.choice([1, 3, 30])))
    changed = copy.deepcopy(inquiry.request) | {"exclude": sorted(some)}
    ran = inquiry.ask("losers excluded", changed, may_refuse=["/exclude"])
    if ran is not None:
        inquiry.note("losers excluded", comparison.same_best(inquiry.first, ran, whole_list=False), changed)
    return ran is not None


def winner_excluded(inquiry):
    """Without one part of the best design, nothing is better."""
    if not inquiry.first.designs:
        return False
    ids = comparison.ids_by_family(inquiry.first.designs[0])
    changed = copy.deepcopy(inquiry.request) | {"exclude": [inquiry.draw.choice(sorted(sum(ids.values(), [])))]}
    ran = inquiry.ask("winner excluded", changed, may_refuse=["/exclude"])
    if ran is not None:
        inquiry.note("winner excluded", comparison.never_worse(inquiry.first, ran), changed)
    return ran is not None


def split(inquiry):
    """A group written as two that ask for the same: as good, where each actuator has its own valve.

    Where the best design of the two gives them the same parts it is one of the request, so that two are
    never better. The best design of the request is one of the two's, so that they are never worse.
    """
    numbers = other_words.splittable(inquiry.request)
    if not numbers or not inquiry.first.designs:
        return False
    number = inquiry.draw.choice(numbers)
    changed = other_words.split_in_two(inquiry.request, number)
    ran = inquiry.ask("split", changed)
    if ran is None:
        return False
    if own_valves(inquiry.request, inquiry.first.designs[0]):
        inquiry.note("split", comparison.never_worse(ran, inquiry.first), changed)
    if ran.designs and own_valves(changed, ran.designs[0]) and halves_alike(changed, number, ran.designs[0]):
        inquiry.note("split", comparison.never_worse(inquiry.first, ran), changed)
    return True


def own_valves(request, design):
    """Whether each actuator has a valve of its own, and all groups one regulator."""
    counts = {group["name"]: group["count"] for group in request["actuators"]}
    for row in design["parts"]:
        if row["family"] == "regulator" and row.get("group") is not None:
            return False
        if row["family"] == "valve" and row["quantity"] < counts.get(row.get("group"), float("inf")):
            return False
    return True


def halves_alike(request, number, design):
    names = [request["actuators"][number + half]["name"] for half in (0, 1)]
    ids = [sorted((row["family"], row["id"]) for row in design["parts"] if row.get("group") == name) for name in names]
    return ids[0] == ids[1]


def evaluated_again(inquiry):
    """What the answer prints of a design, evaluated, meets all and has the same totals and margins."""
    if not inquiry.first.designs:
        return False
    others = inquiry.first.designs[1:]
    for design in [inquiry.first.designs[0], *([inquiry.draw.choice(others)] if others else [])]:
        given = {"configuration": design["configuration"],
                 "parts": [{name: row[name] for name in OF_ROW if row.get(name) is not None}
                           for row in design["parts"]],
                 "settings": {name: value for name, value in design["settings"].items()
                              if name in SETTINGS and value is not None}}
        ran = inquiry.program.evaluate(inquiry.request, given)
        for what in differences(design, ran):
            what = f"rank {design['rank']}, {design['configuration']}: {what}"
            document = {"schema": "evaluation/1", "requirements": inquiry.request, "design": given}
            inquiry.note("evaluated again", ("contradiction", what), document)
    return True


def differences(design, ran):
    if ran.exit_code != 0 or ran.answer is None:
        yield f"exit status {ran.exit_code}: {ran.errors[:300]}"
        return
    again = ran.answer
    if not again.get("works"):
        yield f"does not work: {again.get('detail')}"
        return
    for amount, tolerance in EVALUATED.items():
        yield from unlike(amount, design["totals"].get(amount), again["totals"].get(amount), tolerance)
    margins = {margin["requirement"]: margin["achieved"] for margin in again["margins"]}
    for margin in design["margins"]:
        yield from unlike(margin["requirement"], margin["achieved"], margins.get(margin["requirement"]), ACHIEVED)
    for margin in again["margins"]:
        if margin["relative_margin"] is not None and margin["relative_margin"] < -1e-5:
            yield f"misses {margin['requirement']} by {-margin['relative_margin']:.2g}"


def unlike(name, printed, again, tolerance):
    if printed is None and again is None:
        return
    if printed is None or again is None or abs(printed - again) > tolerance * abs(printed) + 1e-9:
        yield f"{name} is printed as {printed} and evaluated as {again}"


def alone(inquiry):
    """One configuration alone is never better than all together, and what by_configuration says of it."""
    names = inquiry.request["supply"].get("configurations", [])
    if len(names) < 2:
        return False
    name = inquiry.draw.choice(names)
    changed = copy.deepcopy(inquiry.request)
    changed["supply"]["configurations"] = [name]
    if name not in ("tank", "tank_and_pump"):
        changed["supply"].pop("tank_fill_kpa_gauge_max", None)
    ran = inquiry.ask(f"{name} alone", changed, may_refuse=["/actuators"])
    if ran is None:
        return False
    inquiry.note(f"{name} alone", comparison.never_worse(inquiry.first, ran), changed)
    rows = [row for row in inquiry.first.answer.get("by_configuration") or [] if row["configuration"] == name]
    if rows and comparison.comparable(inquiry.first, ran):
        inquiry.note(f"{name} alone", against_row(rows[0], ran), changed)
    return True


def against_row(row, ran):
    """A row of by_configuration against the answer for that configuration alone."""
    listed = row.get("objective")
    if row["status"] == "infeasible" and ran.designs:
        return "contradiction", f"by_configuration says infeasible, alone it has {ran.best}"
    if ran.status == "infeasible" and listed is not None:
        return "contradiction", f"by_configuration has {listed}, alone it is infeasible"
    if row["status"] == ran.status == "optimal" and comparison.differs(listed, ran.best):
        return "contradiction", f"by_configuration has {listed}, alone the best is {ran.best}"
    return None


def known_from_turns(inquiry):
    """Where the list is empty: the parts of the same groups in turns may do."""
    if inquiry.first.status != "feasible" or inquiry.first.designs or len(inquiry.request["actuators"]) < 2:
        return False
    turns = copy.deepcopy(inquiry.request)
    turns["duty"]["simultaneous"] = False
    for group in turns["actuators"]:
        group.pop("phase", None)
    in_turns = inquiry.ask("in turns", turns)
    if in_turns is None or not in_turns.designs:
        return False
    changed = copy.deepcopy(inquiry.request) | {"require": comparison.ids_by_family(in_turns.designs[0])}
    ran = inquiry.ask("parts of the groups in turns required", changed)
    if ran is not None:
        inquiry.note("parts of the groups in turns required", comparison.never_worse(inquiry.first, ran), changed)
    return ran is not None


WITH_DESIGNS = {relation.__name__: relation for relation in (
    loosened, tightened, rotated, in_units, winner_required, losers_excluded, winner_excluded, split, evaluated_again,
    alone)}
WITHOUT_DESIGNS = {relation.__name__: relation for relation in (known_from_turns, tightened, alone, rotated)}
