#!/usr/bin/env python3
"""Draws requests, designs for them, and checks the answers: one line of JSON for each seed.

A file that is there already is gone on with: seeds in it are left out. One process of plenum runs at a time.
"""
import argparse
import dataclasses
import json
import os
import pathlib
import random
import time

from draw_request import GROUPS, draw_request
from infeasible_relations import INFEASIBLE
from inquiry import Finding, Inquiry
from plenum_program import Program, faults_of
from relations import WITH_DESIGNS, WITHOUT_DESIGNS

VERIFY_S = 60.0
SLOW = 0.2  # of the time limit: whose answer takes longer is asked one more question only
RELATIONS_EACH = 4


def relations_for(ran):
    if ran.status == "infeasible":
        return INFEASIBLE
    return WITH_DESIGNS if ran.designs else WITHOUT_DESIGNS


def check_relations(inquiry, most):
    """The names of up to `most` relations that applied, in an order drawn from the seed."""
    relations = relations_for(inquiry.first)
    if inquiry.first.cpu_s > SLOW * inquiry.limit_s:
        most = 1
    applied = []
    for name in inquiry.draw.sample(sorted(relations), len(relations)):
        if len(applied) < most and relations[name](inquiry):
            applied.append(name)
    return applied


def check_verify(program, ran, limit_s):
    """(what verify took and said, the fault or None)."""
    verified = program.verify(ran.text, limit_s)
    said = verified.answer or {}
    stopped = bool(said.get("stopped"))
    failed = [check["check"] for check in said.get("checks", []) if not check["ok"]]
    record = {"cpu_s": round(verified.cpu_s, 3), "wall_s": round(verified.wall_s, 3), "exit_code": verified.exit_code,
              "stopped": stopped, "failed": failed, "not_rechecked": said.get("not_rechecked", [])}
    if verified.exit_code != 0 and (failed or not stopped):
        return record, Finding("refused by verify", "verify", verified.errors[-500:])
    return record, None


def examine(program, seed, options):
    """The line of one seed."""
    drawn = draw_request(seed, options.groups, options.limit)
    ran = program.design(drawn.request, proof=options.verify > 0.0)
    record = {"seed": seed, "mode": options.groups, **drawn.classes, "limit_s": options.limit, "status": ran.status,
              "exit_code": ran.exit_code, "designs": len(ran.designs), "best": ran.best,
              "cpu_s": round(ran.cpu_s, 3), "wall_s": round(ran.wall_s, 3)}
    inquiry = Inquiry(program, drawn.request, ran, random.Random(f"relations {seed}"))
    for fault in faults_of(ran, options.limit):
        inquiry.note("design", fault)
    if ran.status is None:
        record["error"] = ran.errors[:300]
    else:
        record["seconds"], record["gap"] = ran.answer["seconds"], ran.answer["proof"].get("gap")
        if options.verify:
            record["verify"], refused = check_verify(program, ran, options.verify)
            inquiry.findings += [refused] if refused else []
        if options.relations:
            record["relations"] = check_relations(inquiry, options.relations)
    record["findings"] = [dataclasses.asdict(finding) for finding in inquiry.findings]
    return record


def seeds_done(path):
    """Those of whole lines; a line that was cut off is removed."""
    if not path.exists():
        return set()
    text = path.read_text(encoding="utf-8")
    whole = text[: text.rfind("\n") + 1]
    if whole != text:
        path.write_text(whole, encoding="utf-8")
    return {json.loads(line)["seed"] for line in whole.splitlines()}


def read_options():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", nargs=2, type=int, required=True, metavar=("FROM", "TO"), help="TO is left out")
    parser.add_argument("--plenum", default="build/release/plenum", help="the program")
    parser.add_argument("--catalog", help="the catalogue; without it plenum's own choice")
    parser.add_argument("--groups", choices=sorted(GROUPS), default="any",
                        help="one, several (2 to 4), at_once (2 to 8 filled together); without it 1 to 4")
    parser.add_argument("--limit", type=float, default=10.0, metavar="S", help="time limit of a search")
    parser.add_argument("--relations", nargs="?", type=int, const=RELATIONS_EACH, default=0, metavar="N",
                        help=f"check N relations of each answer, {RELATIONS_EACH} if N is left out")
    parser.add_argument("--verify", nargs="?", type=float, const=VERIFY_S, default=0.0, metavar="S",
                        help=f"keep the record of each search and verify it, for S seconds ({VERIFY_S:g} if left out)")
    parser.add_argument("--minutes", type=float, default=float("inf"), help="begin no seed after that time")
    parser.add_argument("--out", type=pathlib.Path, required=True, metavar="FILE.jsonl")
    return parser.parse_args()


def main():
    options = read_options()
    program = Program(options.plenum, options.catalog)
    done, start = seeds_done(options.out), time.monotonic()
    with options.out.open("a", encoding="utf-8") as lines:
        for seed in range(*options.seeds):
            if seed in done:
                continue
            if time.monotonic() - start > 60.0 * options.minutes:
                print(f"stopped before seed {seed}")
                break
            record = examine(program, seed, options)
            lines.write(json.dumps(record) + "\n")
            lines.flush()
            print(seed, record["status"], f"{record['cpu_s']:.2f} s", *record.get("relations", []),
                  f"load {os.getloadavg()[0]:.1f}", flush=True)
            for finding in record["findings"]:
                print("   ", finding["kind"], finding["relation"], finding["what"], flush=True)


if __name__ == "__main__":
    main()
