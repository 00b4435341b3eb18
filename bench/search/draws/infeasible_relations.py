"""Relations of requests that are proved to be infeasible: what would have to give way, and what conflicts."""
from limit_changes import drop, keep_in_force, set_field
from relations import alone, in_units, rotated, tightened


def relaxed(inquiry):
    """What the answer says would have to give way, given way, leaves a design."""
    relaxation = inquiry.first.answer.get("relaxation")
    if not relaxation:
        return False
    changed = inquiry.request
    for entry in relaxation:
        pointer, value = entry["requirement"], entry.get("value")
        if pointer.startswith("/"):
            changed = drop(changed, pointer) if value is None else set_field(changed, pointer, value)
    ran = inquiry.ask("relaxed", changed)
    if ran is None:
        return False
    said = ", ".join(f"{entry['requirement']} {entry.get('value')}" for entry in relaxation)
    if ran.status == "infeasible":
        inquiry.note("relaxed", ("contradiction", f"still infeasible with {said}"), changed)
    elif not ran.designs:
        inquiry.note("relaxed", ("empty", f"no design found with {said}"), changed)
    return True


def conflicts_minimal(inquiry):
    """With only a conflict's demands in force nothing is feasible; without any one of them something is."""
    asked = False
    for conflict in inquiry.first.answer.get("conflicts") or []:
        pointers = [entry["requirement"] for entry in conflict]
        if pointers and all(pointer.startswith("/") for pointer in pointers):
            asked = True
            check_conflict(inquiry, conflict, set(pointers))
    return asked


def check_conflict(inquiry, conflict, pointers):
    name = "conflict " + " ".join(sorted(pointers))
    in_force = keep_in_force(inquiry.request, pointers)
    ran = inquiry.ask(name, in_force)
    if ran is not None and ran.designs:
        inquiry.note(name, ("contradiction", f"these alone are feasible: {ran.best}"), in_force)
    for entry in conflict:
        if not entry.get("proved", True):
            continue
        without = keep_in_force(inquiry.request, pointers - {entry["requirement"]})
        ran = inquiry.ask(name, without)
        if ran is not None and ran.status == "infeasible":
            inquiry.note(name, ("contradiction", f"still infeasible without {entry['requirement']}"), without)


INFEASIBLE = {relation.__name__: relation for relation in (
    relaxed, conflicts_minimal, rotated, in_units, tightened, alone)}
