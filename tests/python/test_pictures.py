"""Pictures show the numbers of their answers."""
import json
import os
import unittest

os.environ.setdefault("MPLBACKEND", "Agg")

import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

import plenum  # noqa: E402

from places import EXAMPLES, ROOT, SIMULATION  # noqa: E402


class Pictures(unittest.TestCase):
    def tearDown(self):
        plt.close("all")

    def test_masses_of_a_list(self):
        designs = plenum.design(EXAMPLES / "gripper.json", top=3, catalog=ROOT / "catalog.db", progress=False)
        ax = designs.plot()
        for row, design in enumerate(designs.designs):
            ends = [bars[row].get_x() + bars[row].get_width() for bars in ax.containers]
            self.assertAlmostEqual(max(ends), design.mass_kg, places=9)
        self.assertEqual(len(ax.containers), len({part for design in designs.designs for part in design.parts.family}))
        self.assertEqual(designs.frame.loc[1, "mass_kg"], designs.best.mass_kg)
        self.assertEqual(len(designs.best.plot().containers), len(set(designs.best.parts.family)))
        self.assertIn("finger", [line.get_label() for line in designs.best.response.plot().lines])

    def test_a_front(self):
        request = json.loads((EXAMPLES / "gripper.json").read_text())
        request["objective"] = {"pareto": ["mass_kg", "volume_l"]}
        answer = plenum.design(request, catalog=ROOT / "catalog.db", progress=False)
        points = answer.plot().lines[-1]
        self.assertEqual(sorted(points.get_xdata()), sorted(answer.front["mass_kg"]))
        self.assertTrue((np.diff(points.get_ydata()) < 0).all())

    def test_a_response(self):
        response = plenum.simulate(SIMULATION)
        line = response.plot().lines[0]
        np.testing.assert_array_equal(line.get_xdata(), response.t_s)
        np.testing.assert_array_equal(line.get_ydata(), response.pressure_kpa_gauge())

    def test_a_map(self):
        answer = plenum.map(EXAMPLES / "map.json")
        mesh = answer.plot().collections[0]
        first = answer.frame[answer.frame.expansion_ratio == answer.frame.expansion_ratio.iloc[0]]
        reached = first.rise_time_normalised.dropna()
        np.testing.assert_allclose(sorted(np.ma.compressed(mesh.get_array())), sorted(reached))
        line = plenum.map({**json.loads((EXAMPLES / "map.json").read_text()), "operating_pressure_ratio": [1.2]}).plot()
        self.assertEqual(len(line.lines[0].get_xdata()), 4)


class ADiagnosis(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.answer = plenum.diagnose(EXAMPLES / "simulated_recording.json", progress=False)

    def test_it_finds_what_the_recording_was_made_with(self):
        # The recording has creep of 13 % over 1.25 s (examples/simulated_recording.json, README.md).
        found = self.answer.effects.set_index(["effect", "parameter"]).loc["creep"]
        for parameter, truth in (("fraction", 0.13), ("time_constant_s", 1.25)):
            self.assertLess(found.loc[parameter, "ci95_low"], truth)
            self.assertGreater(found.loc[parameter, "ci95_high"], truth)
        self.assertEqual(self.answer.verdict, "explained")
        self.assertIn("creep", set(self.answer.candidates["effects"]))

    def test_residuals_have_the_error_that_is_stated(self):
        for model in ("before", "after"):
            frame = self.answer.residuals(model)
            for run, of_run in frame.groupby("run"):
                rms_kpa = float(np.sqrt(np.mean(of_run["residual_kpa"] ** 2)))
                self.assertAlmostEqual(rms_kpa, self.answer[model]["runs"][run], delta=0.02 * rms_kpa)

    def test_the_picture_holds_each_run_of_both_models(self):
        ax = self.answer.plot()
        self.assertEqual(len(ax.lines), 2 * len(self.answer["series"]))
        self.assertEqual([text.get_text() for text in ax.get_legend().get_texts()],
                         ["base model, refitted", "with effects", "noise (one σ)"])
        plt.close("all")


if __name__ == "__main__":
    unittest.main()
