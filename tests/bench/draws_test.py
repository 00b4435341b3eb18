#!/usr/bin/env python3
"""The requests that bench/search/draws draws, and that its comparisons find what is broken.

usage: draws_test.py SOURCE_DIR PLENUM
"""
import pathlib
import sys
import unittest

PLENUM, SOURCE = sys.argv.pop(2), pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "bench/search/draws"))
import comparison  # noqa: E402
import limit_changes  # noqa: E402
import other_words  # noqa: E402
from draw_request import GROUPS, draw_request  # noqa: E402
from plenum_program import Program, Ran  # noqa: E402

SEEDS = 50
TINY_S = 0.01


def answered(status, *objectives, lower_bound=None):
    answer = {"status": status, "seconds": 1.0, "proof": {"lower_bound": lower_bound},
              "designs": [{"objective": objective, "parts": []} for objective in objectives]}
    return Ran(0, "", "", 1.0, 1.0, answer)


class Drawing(unittest.TestCase):
    def test_the_same_seed_gives_the_same_request(self):
        for mode in GROUPS:
            self.assertEqual(draw_request(7, mode).request, draw_request(7, mode).request)
            self.assertNotEqual(draw_request(7, mode).request, draw_request(8, mode).request)

    def test_a_mode_gives_its_numbers_of_groups(self):
        for mode, weights in GROUPS.items():
            drawn = {draw_request(seed, mode).classes["groups"] for seed in range(200)}
            self.assertEqual(drawn, set(weights))

    def test_no_request_is_refused(self):
        program = Program(PLENUM, SOURCE / "catalog.db")
        modes = sorted(GROUPS)
        for seed in range(SEEDS):
            request = draw_request(seed, modes[seed % len(modes)], TINY_S).request
            ran = program.design(request)
            self.assertEqual(ran.exit_code, 0, f"{request['name']}: {ran.errors}")


class Changes(unittest.TestCase):
    def test_a_changed_field_leaves_the_request_as_it_was(self):
        request = {"actuators": [{"rise_time_s_max": 1.0}], "supply": {}}
        changed = limit_changes.set_field(request, "/actuators/0/rise_time_s_max", 2.0)
        self.assertEqual((request["actuators"][0], changed["actuators"][0]),
                         ({"rise_time_s_max": 1.0}, {"rise_time_s_max": 2.0}))
        self.assertEqual(limit_changes.set_field(changed, "/actuators/0/rise_time_s_max", limit_changes.REMOVED),
                         {"actuators": [{}], "supply": {}})

    def test_what_is_not_in_force_is_dropped(self):
        request = {"actuators": [{"operating_pressure_kpa_gauge": 50.0, "rise_time_s_max": 1.0, "fall_time_s_max": 2.0}],
                   "duty": {"frequency_hz": 0.4, "actuations": 9}, "supply": {"mass_kg_max": 1.0, "parts": "orderable"}}
        kept = limit_changes.keep_in_force(request, {"/actuators/0/fall_time_s_max", "/supply/parts"})
        self.assertEqual(kept["actuators"][0], {"operating_pressure_kpa_gauge": 50.0, "fall_time_s_max": 2.0,
                                                "pressure_kpa_gauge_max": 1e4})
        self.assertEqual((kept["duty"], kept["supply"]), ({"frequency_hz": 0.01, "actuations": 1}, {"parts": "orderable"}))
        self.assertEqual(set(kept["limits"].values()), {16})

    def test_numbers_get_other_units_and_weights_do_not(self):
        given = {"tube_length_m": 1.0, "count": 2, "objective": {"minimize": {"mass_kg": 1.0}}}
        self.assertEqual(other_words.in_other_units(given), given | {"tube_length_m": f"{1000.0 / 25.4!r} in"})

    def test_two_halves_ask_for_what_the_group_asks(self):
        request = {"actuators": [{"name": "a", "count": 5}], "duty": {"simultaneous": True}, "supply": {}}
        self.assertEqual(other_words.splittable(request), [0])
        halves = other_words.split_in_two(request, 0)["actuators"]
        self.assertEqual([half["count"] for half in halves], [3, 2])


class Comparisons(unittest.TestCase):
    def test_a_looser_request_is_not_worse(self):
        worse = comparison.never_worse(answered("optimal", 2.0), answered("optimal", 1.0))
        self.assertEqual(worse[0], "contradiction")
        self.assertEqual(comparison.never_worse(answered("infeasible"), answered("feasible", 1.0))[0], "contradiction")
        self.assertEqual(comparison.never_worse(answered("feasible"), answered("optimal", 1.0))[0], "empty")
        bound = comparison.never_worse(answered("feasible", 3.0, lower_bound=2.0), answered("feasible", 1.0))
        self.assertEqual(bound[0], "contradiction")

    def test_an_unproved_list_may_be_worse(self):
        self.assertIsNone(comparison.never_worse(answered("feasible", 3.0, lower_bound=0.5), answered("optimal", 1.0)))

    def test_the_same_request_has_the_same_list(self):
        self.assertIsNone(comparison.same_best(answered("optimal", 1.0, 2.0), answered("optimal", 1.0, 2.0)))
        self.assertEqual(comparison.same_best(answered("optimal", 1.0, 2.0), answered("optimal", 1.0, 2.1))[0],
                         "contradiction")


if __name__ == "__main__":
    unittest.main()
