"""What the answers to two requests say of one another: each function gives (kind, what) or None.

Kinds: "contradiction", where one of the two must be wrong; "empty", where one lists nothing though the
other knows a design.
"""
SAME = 3e-6  # relative: ties are listed within 1e-6, and each amount is printed after rounding


def clearly_less(one, other):
    return one < other - SAME * abs(other) - 1e-12


def differs(one, other):
    return clearly_less(one, other) or clearly_less(other, one)


def comparable(one, other):
    """Whether both count prices alike."""
    return one.answer.get("price_basis") == other.answer.get("price_basis")


def least_possible(ran):
    """Below which an answer says that there is nothing; None where it says nothing."""
    if ran.status == "optimal":
        return ran.best
    bound = ran.answer["proof"].get("lower_bound")
    if bound is None or ran.best is None:
        return bound
    return min(bound, ran.best)


def never_worse(looser, tighter):
    """Each design of the tighter request is one of the looser."""
    if tighter.best is None or not comparable(looser, tighter):
        return None
    if looser.status == "infeasible":
        return "contradiction", f"the looser is infeasible, the tighter has {tighter.best}"
    least = least_possible(looser)
    if least is not None and clearly_less(tighter.best, least):
        return "contradiction", (f"the looser ({looser.status}) has nothing below {least}, the tighter "
                                 f"({tighter.status}) has {tighter.best}")
    if looser.best is None:
        seconds = looser.answer["seconds"]
        return "empty", f"the looser lists nothing after {seconds:.1f} s, the tighter has {tighter.best}"
    return None


def same_best(first, second, whole_list=True):
    """Both have the same designs; `whole_list`: all of them, else the first."""
    if not comparable(first, second):
        return None
    broken = never_worse(first, second) or never_worse(second, first)
    if broken or not (whole_list and first.status == second.status == "optimal"):
        return broken
    objectives = [[design["objective"] for design in ran.designs] for ran in (first, second)]
    if len(objectives[0]) != len(objectives[1]):
        return "contradiction", f"{len(objectives[0])} and {len(objectives[1])} designs"
    for rank, (one, other) in enumerate(zip(*objectives), 1):
        if differs(one, other):
            return "contradiction", f"rank {rank}: {one} and {other}"
    return None


def rows_of(design, without=()):
    """What a parts list holds, in one order."""
    return sorted((row["family"], row["id"], str(row.get("group")), row["quantity"])
                  for row in design["parts"] if row["family"] not in without)


def ids_by_family(design, without=("manifold",)):
    """Joints follow from a rule and are no choice; `require` of them would change the rule."""
    ids = {}
    for row in design["parts"]:
        if row["family"] not in without:
            ids.setdefault(row["family"], set()).add(row["id"])
    return {family: sorted(some) for family, some in sorted(ids.items())}
