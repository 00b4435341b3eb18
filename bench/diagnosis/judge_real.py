"""Compares diagnoses of cases as a workshop records them (make_cases … real) with the truth.

usage: judge_real.py FOLDER
Reads FOLDER/truth, answers, times and halved (run_cases.py … --halved): causes are effects and wrong
numbers alike.
  right     the names are the true causes, or "adequate" where there is none
  part      some of the true causes and nothing else; a seam that gapes is a leak, and a zero that
            drifts from run to run an offset
  open      nothing is named: unexplained, undecided, or a tie
  missed    "adequate", though there is a cause
  beside    a name that is not there, beside structure that is said to be left
  wrong     a name that is not there, with "explained"
"""

import collections
import json
import pathlib
import statistics
import sys

from judge import quantile, read, share


def names_of(answer):
    return frozenset(e["id"] for e in answer["effects"]) | frozenset(
        "number:" + n["name"] for n in answer.get("numbers", []))


class Case:
    def __init__(self, folder, path):
        self.name = path.stem
        self.truth = json.loads(path.read_text())
        self.answer = read(folder / "answers", path.name)
        self.halved = read(folder / "halved", path.name)
        self.time = read(folder / "times", path.name)
        self.causes = frozenset(e["id"] for e in self.truth["effects"])
        if self.truth["wrong"]:
            self.causes |= {"number:" + self.truth["wrong"]}
        self.kin = self.causes | ({"leak"} if "gaping_seam" in self.causes else set())
        if self.truth["sensor"]["drift"]:
            self.kin |= {"sensor_offset"}
        self.readings = self.truth["runs"][0]["samples"]
        self.names = names_of(self.answer)

    @property
    def outcome(self):
        verdict = self.answer["verdict"]
        if self.names:
            if self.names == self.causes:
                return "right"
            if self.names <= self.kin:
                return "part"
            return "wrong" if verdict == "explained" else "beside"
        if verdict == "adequate":
            return "missed" if self.causes else "right"
        return "open"

    @property
    def tie_holds_truth(self):
        return any(frozenset(tied) == self.causes for tied in self.answer["tied"])


def kind_of(case):
    if not case.causes:
        return "none"
    effects = [e for e in case.truth["effects"]]
    if not effects:
        return "number"
    return "number + effect" if case.truth["wrong"] else "effect"


def main():
    folder = pathlib.Path(sys.argv[1])
    paths = sorted((folder / "truth").glob("*.json"))
    cases = [Case(folder, p) for p in paths if (folder / "answers" / p.name).exists()]
    print(f"{len(cases)} of {len(paths)} cases answered")
    outcomes = ("right", "part", "open", "missed", "beside", "wrong")
    print("  " + " " * 18 + "".join(f"{o:>9}" for o in outcomes))
    for kind in ("none", "number", "effect", "number + effect"):
        count = collections.Counter(c.outcome for c in cases if kind_of(c) == kind)
        print(f"  {kind:<18}" + "".join(f"{count[o]:9d}" for o in outcomes))
    share("cause named, or honestly open",
          (c.outcome in ("right", "part", "open") for c in cases), ">= 90 %")
    share("cause named", (c.outcome in ("right", "part") for c in cases))
    share("wrong with confidence", (c.outcome == "wrong" for c in cases), "<= 1 %")
    share("wrong beside structure", (c.outcome == "beside" for c in cases))
    share("ties that hold the truth", (c.tie_holds_truth for c in cases if c.answer["tied"]))
    few = [c for c in cases if c.readings <= 30]
    share("8 to 30 readings a run: named or open",
          (c.outcome in ("right", "part", "open") for c in few))
    halved = [c for c in cases if c.names and c.halved]
    share("names the same, or fewer, from every second reading",
          (names_of(c.halved) <= c.names for c in halved), ">= 98 %")
    seconds = [c.time["seconds"] for c in cases if c.time]
    print(f"  seconds: median {statistics.median(seconds):.1f}, p95 {quantile(seconds, 0.95):.1f}, "
          f"most {max(seconds):.1f}")
    for c in cases:
        if c.outcome in ("missed", "beside", "wrong") or (
                c.halved and c.names and not names_of(c.halved) <= c.names):
            half = sorted(names_of(c.halved)) if c.halved else "-"
            print(f"  {c.name} {c.outcome:<7} {c.truth['supply']:<10} n {c.readings:<4} "
                  f"true {sorted(c.causes)} named {sorted(c.names)} {c.answer['verdict']} half {half}"
                  f" visible {c.truth['visible']:.1f}")


main()
