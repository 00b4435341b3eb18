#!/usr/bin/env python3
"""The laws of catalog/estimates on made-up parts whose answers are known.

usage: estimates_test.py SOURCE_DIR
"""
import math
import pathlib
import re
import subprocess
import sys
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
sys.path.insert(0, str(SOURCE / "catalog/estimates"))
import pumps  # noqa: E402
import spreads  # noqa: E402
import tables  # noqa: E402
from fit import Law, Point  # noqa: E402


class Laws(unittest.TestCase):
    def test_finds_a_power_law_with_a_flag(self):
        points = [Point(f"p{i}", f"s{i}", (x, z, flag), 3.0 * x ** 0.7 * z ** -0.2 * 1.5 ** flag)
                  for i, (x, z, flag) in enumerate(
                      [(1, 2, 0), (2, 5, 1), (4, 3, 0), (8, 7, 1), (16, 2, 1), (32, 9, 0)])]
        law = Law(points, flags={2})
        self.assertAlmostEqual(law.predict((10, 4, 1)), 3 * 10 ** 0.7 * 4 ** -0.2 * 1.5, places=9)
        self.assertLess(law.sigma, 1e-9)

    def test_variants_of_a_series_count_once_and_do_not_predict_themselves(self):
        points = [Point("a", "one", (1.0,), 1.0), Point("b", "two", (1.0,), 2.0)]
        many = points + [Point(f"a{i}", "one", (1.0,), 1.0 + 1e-9 * i) for i in range(50)]
        for given in (points, many):
            law = Law(given, fixed={0: 1.0})
            self.assertAlmostEqual(law.predict((1.0,)), math.sqrt(2.0), places=6)
            self.assertAlmostEqual(law.sigma, math.log(2.0), places=6)

    def test_a_number_with_a_source_stays(self):
        row = {"mass_kg": "1", "mass_kg.provenance": "datasheet", "mass_kg.source": "page 1"}
        tables.predict_into(row, "mass_kg", 5.0, 0.2, "regression: …")
        self.assertEqual(row["mass_kg"], "1")
        row["mass_kg.provenance"] = "estimated"
        tables.predict_into(row, "mass_kg", 5.0, 0.2, "regression: …")
        self.assertEqual((row["mass_kg"], row["mass_kg.uncertainty"]), ("5", "0.2"))


def known(part, series, value, **more):
    return {"id": part, "series": series, "manufacturer": "M", "x": value, "x.source": "page 1",
            "x.provenance": "datasheet", "x.uncertainty": ""} | more


class Spreads(unittest.TestCase):
    def spread(self, rows, kind=spreads.Spread, says=lambda row: 2.0):
        return kind("key", "title", "family", "x", ["a rule"], says, rows)

    def test_a_rule_misses_by_what_the_rows_say_a_series_counting_once(self):
        rows = [known("a", "one", "4")] * 9 + [known("b", "two", "2")]
        self.assertAlmostEqual(self.spread(rows).sigma, math.log(2.0) / math.sqrt(2.0))

    def test_one_series_widens_but_does_not_narrow(self):
        self.assertIsNone(self.spread([known("a", "one", "2.1")]).sigma)
        self.assertAlmostEqual(self.spread([known("a", "one", "4")]).sigma, math.log(2.0))
        self.assertIsNone(self.spread([]).sigma)

    def test_a_class_is_left_out_series_by_series(self):
        rows = [known("a", "one", "1"), known("b", "two", str(math.e))]
        self.assertAlmostEqual(self.spread(rows, spreads.ClassSpread).sigma, 1.0)

    def test_only_estimates_of_the_rule_are_filled(self):
        rule = {"x.source": "rule: a rule, data README", "x.provenance": "estimated"}
        rows = [known("a", "one", "4"), known("b", "two", "2"), known("c", "three", "3", **rule),
                known("d", "three", "3", **(rule | {"x.source": "rule: another"}))]
        self.spread(rows[:2]).fill(rows)
        self.assertEqual([row["x.uncertainty"] for row in rows], ["", "", "0.49", ""])

    def test_every_estimate_has_an_error_or_a_reason(self):
        page = (SOURCE / "docs/explanation/data_quality.md").read_text(encoding="utf-8")
        all_rows = {family: tables.read(family)[1] for family in tables.families()}
        kept = spreads.keeps_default(all_rows)
        self.assertTrue(kept)
        for (family, field), count in kept.items():
            self.assertIn(f"| {family} | `{field}` | {count} |", page)


class Page(unittest.TestCase):
    def test_the_shares_are_those_of_the_command(self):
        command = [sys.executable, str(SOURCE / "catalog/estimates/estimate.py"), "--shares"]
        text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
        _, parts, _, numbers, _, orderable = text.splitlines()[-2].split()
        estimated, priced = re.findall(r"[0-9.]+ %", text.splitlines()[-1])
        page = (SOURCE / "docs/explanation/data_quality.md").read_text(encoding="utf-8")
        last = {}
        for line in page[page.index("## Shares"):page.index("The collection is")].splitlines():
            cells = [cell.strip() for cell in line.strip("|").split("|")]
            if len(cells) == 4:
                last[cells[0]] = cells[3]
        self.assertEqual(last["parts of the seed"], parts)
        self.assertEqual(last["numbers and texts with a provenance"], numbers)
        self.assertEqual(last["of these estimated"], estimated)
        self.assertEqual(last["parts with a price"].split(",")[0], priced)
        self.assertEqual(last["parts known to be products"], orderable)


class Pumps(unittest.TestCase):
    def fill(self, curve, low, high):
        row = {"curve": curve, "voltage_v": "12", "type": "diaphragm", "series": "X",
               "free_air.provenance": "estimated"}
        cut = pumps.fill_curve(row, low, high, 0.4, None)
        return tables.curve(row), cut

    def test_a_strong_pump_keeps_its_line_and_a_weak_one_is_cut(self):
        points, cut = self.fill("0:10:1;100:0:1", 50, 100)
        self.assertFalse(cut)
        self.assertAlmostEqual(points[5][1], 5.0)
        points, cut = self.fill("0:10:1;100:0:1", 2, 4)
        self.assertTrue(cut)
        for pressure, flow, current in points:
            self.assertLessEqual(pumps.work(pressure, flow), 0.4 * 4 + 1e-3)
            self.assertTrue(2 / 12 - 1e-4 <= current <= 4 / 12 + 1e-4)

    def test_suction_rises_to_ambient(self):
        points, _ = self.fill("-80:0:1;0:12:1", 5, 10)
        self.assertEqual((points[0][0], points[-1][:2]), (-80.0, (0.0, 12.0)))
        self.assertTrue(all(a[1] <= b[1] for a, b in zip(points, points[1:])))

    def test_twice_is_as_once(self):
        row = {"curve": "0:10:1;100:0:1", "voltage_v": "12", "type": "diaphragm", "series": "X",
               "free_air.provenance": "estimated"}
        pumps.fill_curve(row, 2, 4, 0.4, None)
        once = row["curve"]
        pumps.fill_curve(row, 2, 4, 0.4, None)
        self.assertEqual(row["curve"], once)


if __name__ == "__main__":
    unittest.main()
