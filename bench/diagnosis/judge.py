"""Compares diagnoses with the truth.

usage: judge.py FOLDER
Reads FOLDER/truth, answers, times, decided, identify and rival (see run.sh), and the same in
FOLDER/ties if that is there, and prints tables, each share with its 95 % Wilson interval and the target that was fixed before any case was run.
"""

import collections
import json
import math
import pathlib
import statistics
import sys

KINDS = ("clean", "full", "fifth", "pair", "outside")
VERDICTS = ("adequate", "explained", "tie", "unexplained", "undecided", "none")


def read(folder, name):
    path = folder / name
    return json.loads(path.read_text()) if path.exists() else None


def wilson(hits, count):
    if count == 0:
        return 0.0, 1.0
    z, p = 1.96, hits / count
    middle = (p + z * z / (2 * count)) / (1 + z * z / count)
    half = z * math.sqrt(p * (1 - p) / count + z * z / (4 * count * count)) / (1 + z * z / count)
    return max(0.0, middle - half), min(1.0, middle + half)


def share(label, flags, target=""):
    flags = list(flags)
    if not flags:
        print(f"  {label:<62} no cases    {target}")
        return
    hits = sum(map(bool, flags))
    low, high = wilson(hits, len(flags))
    print(f"  {label:<62} {hits:4d}/{len(flags):<4d} {100 * hits / len(flags):5.1f} % "
          f"[{100 * low:.0f}, {100 * high:.0f}]  {target}")


def quantile(values, at):
    ordered = sorted(values)
    return ordered[min(len(ordered) - 1, int(at * len(ordered)))]


def ids_of(effects):
    return frozenset(e["id"] for e in effects)


class Case:
    def __init__(self, folder, path):
        name = path.name
        self.name = path.stem
        self.truth = json.loads(path.read_text())
        self.answer = read(folder / "answers", name)
        self.decided = read(folder / "decided", name)
        self.identify = read(folder / "identify", name)
        self.rival = read(folder / "rival", name)
        self.time = read(folder / "times", name)
        self.kind = self.truth["kind"]
        self.listed = self.kind not in ("clean", "outside")
        self.true_ids = ids_of(self.truth["effects"])
        self.verdict = self.answer["verdict"] if self.answer else "none"
        self.ids = ids_of(self.answer["effects"]) if self.answer else frozenset()

    @property
    def identifiable(self):
        return self.identify and self.identify["identifiable"]

    @property
    def exact(self):
        if self.kind == "clean":
            return self.verdict == "adequate"
        return self.listed and self.verdict == "explained" and self.ids == self.true_ids

    @property
    def tie_holds_truth(self):
        if self.verdict != "tie":
            return False
        return any(frozenset(tied) == self.true_ids for tied in self.answer["tied"])

    @property
    def only_learned(self):
        return self.ids and all(i.startswith("learned_") for i in self.ids)

    @property
    def wrongly_confident(self):
        """Names an effect that is not there; a learned term outside the list is no such name."""
        if self.verdict != "explained":
            return False
        if self.kind == "outside":
            return not self.only_learned
        return not self.ids <= self.true_ids

    def floor(self):
        """Of the runs held out, kPa."""
        return self.truth["runs"][-1]["noise_rms_kpa"]

    def heldout(self, when):
        return self.answer[when]["holdout_rms_kpa"]

    def heldout_clean(self):
        """Outliers and clipped readings have no floor to be compared with."""
        sensor = self.truth["sensor"]
        return not sensor["clipped"] and sensor["outliers"] == 0


def confusion(cases):
    print("\nVerdicts")
    print("  " + " " * 10 + "".join(f"{v:>12}" for v in VERDICTS))
    for kind in KINDS:
        count = collections.Counter(c.verdict for c in cases if c.kind == kind)
        print(f"  {kind:<10}" + "".join(f"{count[v]:12d}" for v in VERDICTS))


def naming(cases):
    print("\nNaming (clean: adequate)")
    of = {kind: [c for c in cases if c.kind == kind] for kind in KINDS}
    share("clean: adequate", (c.exact for c in of["clean"]), ">= 97 %")
    for kind in ("full", "fifth", "pair"):
        known = [c for c in of[kind] if c.identify]
        told = [c for c in known if c.identifiable]
        share(f"{kind}: identifiable", (c.identifiable for c in known),
              ">= 70 %" if kind == "full" else "")
        share(f"{kind}: exact of the identifiable", (c.exact for c in told),
              ">= 95 %" if kind == "full" else "")
        share(f"{kind}: named or in the tie, of the identifiable",
              (c.exact or c.tie_holds_truth for c in told))
        share(f"{kind}: exact of all", (c.exact for c in of[kind]))
        share(f"{kind}: named or in the tie, of all",
              (c.exact or c.tie_holds_truth for c in of[kind]),
              ">= 85 %" if kind in ("fifth", "pair") else "")
    share("outside: unexplained", (c.verdict == "unexplained" for c in of["outside"]), ">= 85 %")
    share("outside: unexplained, or explained by learned terms alone",
          (c.verdict == "unexplained" or c.verdict == "explained" and c.only_learned
           for c in of["outside"]))
    share("wrong effect named with confidence, of all", (c.wrongly_confident for c in cases),
          "<= 2 %")
    ties = [c for c in cases if c.verdict == "tie"]
    share("ties that hold the truth", (c.tie_holds_truth for c in ties if c.listed), ">= 90 %")
    share("ties on clean cases or outside the list", (not c.listed for c in ties))


def per_effect(cases):
    print("\nExact (or in the tie) by effect, full size / a fifth; unexplained by effect outside")
    table = collections.defaultdict(lambda: collections.defaultdict(list))
    for c in cases:
        if c.kind in ("full", "fifth"):
            (effect,) = c.true_ids
            table[effect][c.kind].append(c.exact or c.tie_holds_truth)
        elif c.kind == "outside":
            (effect,) = c.true_ids
            table[effect][c.kind].append(c.verdict == "unexplained")
    for effect in sorted(table):
        row = "  ".join(f"{kind} {sum(flags)}/{len(flags)}" for kind, flags in table[effect].items())
        print(f"  {effect:<26} {row}")


def intervals(cases):
    print("\n95 % intervals that hold the truth")
    effects, numbers, identified = [], [], []
    for c in cases:
        if not c.exact:
            continue
        for found in c.answer["effects"]:
            (true,) = (e for e in c.truth["effects"] if e["id"] == found["id"])
            if found["parameters"].get("law") != true["parameters"].get("law"):
                continue
            for name, estimate in found["parameters"].items():
                if name == "law" or estimate["ci95"][0] is None:
                    continue
                value = true["parameters"][name]
                hit = estimate["ci95"][0] <= value <= estimate["ci95"][1]
                effects.append(hit)
                if estimate.get("identified", True):
                    identified.append(hit)
        for name, estimate in c.answer["fitted"].items():
            if name not in c.truth["numbers"] or estimate["ci95"][0] is None:
                continue
            scale = estimate["value"] / estimate["factor"]
            value = scale * c.truth["numbers"][name]["factor"]
            numbers.append(estimate["ci95"][0] <= value <= estimate["ci95"][1])
    share("parameters of effects", effects, "90 to 98 %")
    share("  of those said to be identified", identified)
    share("declared numbers", numbers, "90 to 98 %")


def errors(cases):
    print("\nError over the noise floor (held-out run; without clipping and outliers), median [p95]")
    for label, chosen in (
            ("right answers", [c for c in cases if c.exact]),
            *((kind, [c for c in cases if c.kind == kind and c.answer]) for kind in KINDS)):
        chosen = [c for c in chosen if c.heldout_clean() and c.heldout("after") is not None]
        if not chosen:
            continue
        cells = []
        for when in ("declared", "before", "after"):
            ratios = [c.heldout(when) / c.floor() for c in chosen if c.heldout(when) is not None]
            if ratios:
                cells.append(f"{when} {statistics.median(ratios):.2f} [{quantile(ratios, 0.95):.2f}]")
        rival = [c for c in chosen if c.rival]
        for name in ("ridge_kpa", "neighbours_kpa"):
            if rival:
                ratios = [c.rival[name] / c.floor() for c in rival]
                cells.append(f"{name[:-4]} {statistics.median(ratios):.2f} "
                             f"[{quantile(ratios, 0.95):.2f}]")
        print(f"  {label:<14} n {len(chosen):<4d} " + "  ".join(cells))
    named = [c for c in cases if c.exact and c.heldout_clean() and c.heldout("after") is not None]
    share("right answers: after <= 1.1 floors", (c.heldout("after") <= 1.1 * c.floor() for c in named),
          "all")
    halved = []
    for c in cases:
        if c.kind != "outside" or not c.answer:
            continue
        if c.verdict == "explained" and c.only_learned:
            before, after = c.heldout("before"), c.heldout("after")
            halved.append(before is not None and after is not None and after <= 0.5 * before)
        if c.verdict != "unexplained":
            continue
        d = c.answer.get("discrepancy") or {}
        before, after = d.get("holdout_before_kpa"), d.get("holdout_after_kpa")
        halved.append(before is not None and after is not None and after <= 0.5 * before)
    share("outside: the learned term halves the held-out error", halved, ">= 70 %")


def without_holdout(c):
    """Forward selection by AIC among the fits that the diagnosis made; no runs held out, no ties."""
    samples = sum(r["samples"] for r in c.truth["runs"] if not r["held_out"])
    aic = {}
    for candidate in c.answer["candidates"]:
        if candidate.get("bic") is None:
            continue
        penalty = candidate["parameters"] * (2.0 - math.log(samples))
        ids = frozenset(candidate["effects"])
        if any(i.startswith("learned_") for i in ids):
            continue
        aic[ids] = min(aic.get(ids, math.inf), candidate["bic"] + penalty)
    chosen = frozenset()
    while True:
        larger = [s for s in aic if len(s) == len(chosen) + 1 and s > chosen]
        best = min(larger, key=aic.get, default=None)
        if best is None or aic[best] >= aic.get(chosen, math.inf):
            return chosen
        chosen = best


def rivals(cases):
    print("\nRival: forward selection by AIC, without runs held out and without ties")
    answered = [c for c in cases if c.answer and c.answer["candidates"]]
    for kind in KINDS:
        chosen = [c for c in answered if c.kind == kind]
        if kind == "outside":
            share("outside: names an effect", (without_holdout(c) for c in chosen))
        else:
            share(f"{kind}: exact", (without_holdout(c) == c.true_ids for c in chosen))
    share("wrong effect named, of all",
          (c.kind == "outside" and without_holdout(c) or not without_holdout(c) <= c.true_ids
           for c in answered))


def experiments(cases):
    print("\nProposed experiments, carried out on the true rig")
    ties = [c for c in cases if c.verdict == "tie" and c.listed]
    share("ties with a proposal", (c.answer["next_experiment"] is not None for c in ties))
    carried = [c for c in ties if c.decided]
    share("  decided for the truth",
          (c.decided["verdict"] == "explained" and ids_of(c.decided["effects"]) == c.true_ids
           for c in carried), ">= 90 %")


def times(cases):
    seconds = [c.time["seconds"] for c in cases if c.time]
    if seconds:
        print(f"\nSeconds per case, two side by side: median {statistics.median(seconds):.1f}, "
              f"p95 {quantile(seconds, 0.95):.1f}, most {max(seconds):.1f}")


def confounded(folder):
    """Single effects in runs that show little, drawn apart from the series (make_cases ... tie)."""
    cases = [c for c in (Case(folder, path) for path in sorted((folder / "truth").glob("*.json")))
             if c.answer and c.identify]
    seen = [c for c in cases if c.identify["without_bic"] is None or c.identify["without_bic"] > 10]
    alike = [c for c in seen if not c.identifiable]
    print(f"\nConfounded: {len(cases)} single effects in runs that show little, {len(seen)} to be "
          f"seen at all, {len(alike)} of them with a rival within 10 of BIC")
    for label, chosen in (("with a rival", alike),
                          ("told apart", [c for c in seen if c.identifiable])):
        count = collections.Counter(
            c.verdict + {True: " (right)", False: " (wrong)"}.get(
                c.exact if c.verdict == "explained"
                else c.tie_holds_truth if c.verdict == "tie" else None, "")
            for c in chosen)
        print(f"  {label}: " + ", ".join(f"{n} {v}" for v, n in sorted(count.items())))
        share(f"{label}: named or in the tie", (c.exact or c.tie_holds_truth for c in chosen))
        share(f"{label}: wrong effect named with confidence",
              (c.wrongly_confident for c in chosen), "<= 2 %")
    share("ties that hold the truth", (c.tie_holds_truth for c in cases if c.verdict == "tie"),
          ">= 90 %")
    experiments(cases)
    failures(cases)


def failures(cases):
    print("\nCases that missed (series, number)")
    for c in cases:
        good = c.verdict == "unexplained" if c.kind == "outside" else c.exact or c.tie_holds_truth
        if good:
            continue
        sensor = c.truth["sensor"]
        faults = [f for f in ("correlated", "clipped", "missing", "clock") if sensor[f]]
        faults += ["outliers"] if sensor["outliers"] else []
        apart = c.identify["distance_bic"] if c.identify else None
        said = sorted(c.ids) if c.verdict != "tie" else c.answer["tied"]
        print(f"  {c.truth['series']} {c.name} {c.kind:<8} {'+'.join(sorted(c.true_ids)) or '-':<36} "
              f"{c.truth['supply']:<10} visible {c.truth['visible']:.2f}"
              f"{'' if apart is None else f' apart {apart:.0f}'} -> {c.verdict} {said} {faults}")


def main():
    folder = pathlib.Path(sys.argv[1])
    everything = [Case(folder, path) for path in sorted((folder / "truth").glob("*.json"))]
    cases = [c for c in everything if c.time or c.answer]
    print(f"{len(cases)} of {len(everything)} cases diagnosed; identifiability known for "
          f"{sum(c.identify is not None for c in cases)}")
    for table in (confusion, naming, per_effect, intervals, errors, rivals, experiments, times,
                  failures):
        table(cases)
    if (folder / "ties").exists():
        confounded(folder / "ties")


if __name__ == "__main__":
    main()
