"""The computations: answers are those of the command, arrays and frames go in and come out, Ctrl-C stops them."""
import ast
import copy
import json
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest

import numpy as np
import pandas as pd

import plenum
from plenum import _core
from plenum.documents import plain

from places import EXAMPLES, ROOT, SIMULATION, Folder, command, timeless

MAP = {"schema": "map/1", "source_pressure_ratio": [1.5, 3], "operating_pressure_ratio": [1.2, 2.0],
       "expansion_ratio": [1], "critical_ratio": [0.3]}


class AnswersAreThoseOfTheCommand(unittest.TestCase):
    def test_design(self):
        answer = plenum.design(EXAMPLES / "gripper.json", top=2, catalog=ROOT / "catalog.db")
        self.assertEqual(timeless(answer), timeless(command("design", EXAMPLES / "gripper.json", "--top", 2)))
        self.assertTrue(answer.proved)
        self.assertTrue(plenum.verify(answer, catalog=ROOT / "catalog.db"))

    def test_evaluate(self):
        self.assertEqual(plenum.evaluate(EXAMPLES / "gripper_by_hand.json", catalog=ROOT / "catalog.db"),
                         command("evaluate", EXAMPLES / "gripper_by_hand.json"))

    def test_simulate(self):
        self.assertEqual(plenum.simulate(EXAMPLES / "simulation_effects.json"),
                         command("simulate", EXAMPLES / "simulation_effects.json"))

    def test_map(self):
        self.assertEqual(plenum.map(EXAMPLES / "map.json"), command("map", EXAMPLES / "map.json"))

    def test_sweep(self):
        table = plenum.sweep(EXAMPLES / "how_often.json", catalog=ROOT / "catalog.db")
        expected = command("sweep", EXAMPLES / "how_often.json")
        self.assertEqual([timeless(row) for row in table["rows"]], [timeless(row) for row in expected["rows"]])
        self.assertEqual(list(table.frame["/duty/frequency_hz"]), [0.05, 0.1, 0.2, 0.5])

    def test_verify_refuses_a_changed_answer(self):
        answer = plenum.design(EXAMPLES / "gripper.json", top=1, catalog=ROOT / "catalog.db")
        answer["designs"][0]["totals"]["mass_kg"] = 0.001
        self.assertFalse(plenum.verify(answer, catalog=ROOT / "catalog.db"))


class ArraysAndFrames(unittest.TestCase):
    def test_arrays_go_in(self):
        request = copy.deepcopy(MAP)
        request["source_pressure_ratio"] = np.array([1.5, 3.0])
        request["operating_pressure_ratio"] = pd.Series([1.2, 2.0])
        request["expansion_ratio"] = [np.float64(1.0)]
        self.assertEqual(plenum.map(request), plenum.map(MAP))

    def test_a_response_as_arrays_and_frame(self):
        response = plenum.simulate(SIMULATION)
        self.assertEqual(response.t_s.dtype, float)
        self.assertEqual(response.t_s.shape, response.pressure_kpa_gauge("a").shape)
        self.assertEqual(response.frame["a_kpa_gauge"].tolist(), response["groups"][0]["pressure_kpa_gauge"])
        with self.assertRaisesRegex(KeyError, "there are a"):
            response.pressure_kpa_gauge("b")

    def test_a_vented_chamber_follows_the_closed_form(self):
        # Choked outflow of a rigid chamber at constant temperature: p falls by exp(-C·P0·t/V) (absolute pressures).
        request = copy.deepcopy(SIMULATION)
        request["actuators"][0]["expansion_ratio"] = 1.0
        request["source"] = {"kind": "none"}
        request["initial"] = {"pressure_kpa_gauge": 600.0}
        request["valve"] = [{"t_s": 0.0, "state": "deflate"}]
        request["t_end_s"] = 1.0
        request["actuators"][0]["line"]["sonic_conductance_dm3_per_s_bar"] = 0.05
        response = plenum.simulate(request)
        absolute = response.pressure_kpa_gauge() + 100.0
        choked = absolute > 100.0 / 0.35
        expected = 700.0 * np.exp(-0.05e-8 * 1e5 * response.t_s / 50e-6)
        self.assertGreater(choked.sum(), 10)
        np.testing.assert_allclose(absolute[choked], expected[choked], rtol=1e-6)

    def test_a_measured_frame_is_the_measurement(self):
        document = json.loads((EXAMPLES / "simulated_recording.json").read_text())
        run = document["runs"][0]
        starts = [command["t_s"] for command in run["valve"]]
        states = [run["valve"][max(np.searchsorted(starts, t, "right") - 1, 0)]["state"] for t in run["t_s"]]
        frame = pd.DataFrame({"run": run["id"], "t_s": run["t_s"], "valve": states,
                              "pressure_kpa_gauge": run["pressure_kpa_gauge"]})
        frame.loc[5, "pressure_kpa_gauge"] = np.nan  # a missing sample
        from plenum.local import measurements

        texts, files = measurements(frame, document["rig"])
        read = json.loads(texts[0])["runs"][0]
        self.assertEqual(read["t_s"], run["t_s"])
        self.assertIsNone(read["pressure_kpa_gauge"][5])
        self.assertEqual(read["pressure_kpa_gauge"][6:], run["pressure_kpa_gauge"][6:])
        self.assertEqual(files[0][0], "frame 1")
        with self.assertRaisesRegex(plenum.InputError, "rig: is required"):
            plenum.diagnose(frame)

    def test_a_recording_in_a_dialect_of_a_laboratory(self):
        from plenum.local import measurements

        rows = [(0, 0.0, 0), (10, 0.0, 1), (20, 0.6, 1), (30, 1.0, 1), (40, 0.3, 0), (50, 0.01, 0)]
        text = "Zeit [ms];p [bar];Ventil µ\n" + "".join(
            f"{ms};{str(bar).replace('.', ',')};{on}\n" for ms, bar, on in rows)
        rig = {"ambient": {"pressure_kpa_abs": 98.0}}
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "bench.csv"
            for encoding in ("utf-8", "utf-16", "latin-1"):
                path.write_text(text, encoding=encoding)
                document = json.loads(measurements(path, rig)[0][0])
                run = document["runs"][0]
                np.testing.assert_allclose(run["t_s"], [0.0, 0.01, 0.02, 0.03, 0.04, 0.05])
                np.testing.assert_allclose(run["pressure_kpa_gauge"], [0.0, 0.0, 60.0, 100.0, 30.0, 1.0])
                self.assertEqual([command["state"] for command in run["valve"]], ["deflate", "inflate", "deflate"])
                self.assertEqual(document["understood"][0]["decimal"], "comma")
            answer = {"columns": {"p [bar]": "pressure_kpa_gauge [bar abs]", "Ventil µ": "valve [0 = hold]"}}
            run = json.loads(measurements(path, rig, answer)[0][0])["runs"][0]
            np.testing.assert_allclose(run["pressure_kpa_gauge"][2], 60.0 - 98.0)
            self.assertEqual(run["valve"][-1]["state"], "hold")
            path.write_text("Time;p [bar];valve\n0;0;hold\n", encoding="utf-8")
            with self.assertRaisesRegex(plenum.InputError, "in which unit"):
                measurements(path, rig)

    def test_many_are_those_of_each(self):
        requests = [copy.deepcopy(SIMULATION) for _ in range(6)]
        for number, request in enumerate(requests):
            request["actuators"][0]["rest_volume_ml"] = 20.0 + 10.0 * number
        requests[3]["actuators"][0]["rest_volume_ml"] = -1
        news = []
        answers = plenum.simulate_many(requests, threads=3, progress=news.append)
        for number, request in enumerate(requests):
            if number != 3:
                alone = plenum.simulate(request)  # rounded to twelve digits
                np.testing.assert_allclose(answers[number].frame, alone.frame, rtol=1e-11)
                np.testing.assert_allclose(answers[number].volume_ml(), alone.volume_ml(), rtol=1e-11)
                self.assertEqual(answers[number]["performance"], alone["performance"])
                self.assertEqual(len(plain(answers[number])["t_s"]), len(alone["t_s"]))
        self.assertIsInstance(answers[3], plenum.InputError)
        self.assertTrue(all(one["of"] == 6 for one in news))
        self.assertEqual(answers[3].pointer, "/actuators/0/rest_volume_ml")


class Errors(unittest.TestCase):
    def test_every_bad_field_is_named(self):
        request = json.loads((EXAMPLES / "gripper.json").read_text())
        request["actuators"][0]["rest_volume_ml"] = -1
        request["duty"]["frequency_hz"] = "fast"
        with self.assertRaises(plenum.InputError) as caught:
            plenum.design(request, catalog=ROOT / "catalog.db")
        pointers = [pointer for pointer, _ in caught.exception.errors]
        self.assertEqual(pointers, ["/actuators/0/rest_volume_ml", "/duty/frequency_hz"])
        self.assertIn("must be", caught.exception.message)
        self.assertIsInstance(caught.exception, ValueError)

    def test_what_is_no_document(self):
        for source in ({"schema": object()}, "nowhere.json", {"t_s": float("inf")}, 3):
            with self.assertRaises(plenum.InputError):
                plenum.simulate(source)

    def test_no_catalogue(self):
        with self.assertRaisesRegex(plenum.InputError, "no such catalogue"):
            plenum.design(EXAMPLES / "gripper.json", catalog="nowhere.db")
        with self.assertRaises(plenum.CatalogueError):
            plenum.design(EXAMPLES / "gripper.json", catalog=EXAMPLES / "gripper.json")


SLOW = """
import json, signal, sys, threading, plenum
request = json.load(open("examples/exosuit.json"))
request["objective"] = {"minimize": "volume_l"}
request["ranking"] = {"count": 100, "time_limit_s": 60}
try:
    plenum.design(request, catalog="catalog.db", progress=lambda news: (print("begun", flush=True)))
except KeyboardInterrupt as stopped:
    print(type(stopped.answer).__name__, stopped.answer.status)
"""


class Watching(unittest.TestCase):
    def test_ctrl_c_stops_the_search_with_the_best_so_far(self):
        process = subprocess.Popen([sys.executable, "-c", SLOW], cwd=ROOT, stdout=subprocess.PIPE, text=True)
        self.assertEqual(process.stdout.readline(), "begun\n")
        sent = time.monotonic()
        process.send_signal(signal.SIGINT)
        out, _ = process.communicate(timeout=30)
        self.assertEqual(out.splitlines()[-1], "Designs cancelled")
        self.assertLess(time.monotonic() - sent, 10.0)

    def test_an_exception_of_the_listener_stops_the_search(self):
        def refuse(news):
            raise RuntimeError("enough")

        request = json.loads((EXAMPLES / "exosuit.json").read_text())
        request["objective"] = {"minimize": "volume_l"}
        request["ranking"] = {"count": 100, "time_limit_s": 60}
        with self.assertRaisesRegex(RuntimeError, "enough") as caught:
            plenum.design(request, catalog=ROOT / "catalog.db", progress=refuse)
        self.assertEqual(caught.exception.answer.status, "cancelled")

    def test_other_threads_of_python_run_meanwhile(self):
        ticks, done = 0, threading.Event()

        def work():
            plenum.design(EXAMPLES / "exosuit.json", top=3, catalog=ROOT / "catalog.db", progress=False)
            done.set()

        thread = threading.Thread(target=work)
        thread.start()
        while not done.is_set():
            time.sleep(0.01)
            ticks += 1
        thread.join()
        self.assertGreater(ticks, 10)


class TheCatalogue(unittest.TestCase):
    def setUp(self):
        self.folder = Folder()
        self.addCleanup(self.folder.cleanup)
        self.catalogue = plenum.Catalogue(self.folder.catalog)

    def test_parts_as_a_frame(self):
        frame = self.catalogue.parts("battery")
        self.assertEqual(set(frame["family"]), {"battery"})
        self.assertTrue((frame["mass_kg"] > 0).all())
        self.assertEqual(len(self.catalogue), len(command("catalog", "list")["parts"]))
        part = frame.index[0]
        self.assertEqual(self.catalogue[part], command("catalog", "show", part))

    def test_a_part_is_added_and_removed(self):
        part = {"id": "my-fitting", "family": "fitting", "manufacturer": "bench", "part_number": "F1",
                "tube_outer_diameter_mm": 4.0, "sonic_conductance_dm3_per_s_bar": 0.31, "critical_ratio": 0.4,
                "mass_kg": np.float64(0.003), "body_volume_ml": 0.7, "pressure_max_kpa_gauge": "8 bar", "thread": "M5"}
        before = self.catalogue.revision["number"]
        self.assertEqual(self.catalogue.add(part)["number"], before + 1)
        self.assertEqual(self.catalogue["my-fitting"]["pressure_max_kpa_gauge"], 800.0)
        with self.assertRaisesRegex(plenum.InputError, "is taken"):
            self.catalogue.add(part)
        self.catalogue.add({**part, "mass_kg": 0.004}, replace=True)
        self.assertEqual(self.catalogue["my-fitting"]["mass_kg"], 0.004)
        self.catalogue.remove("my-fitting")
        self.assertNotIn("my-fitting", self.catalogue)
        with self.assertRaisesRegex(plenum.InputError, "no part has the id"):
            self.catalogue.remove("my-fitting")

    def test_a_frame_is_imported(self):
        frame = pd.DataFrame({"id": ["my-1", "my-2"], "manufacturer": "me", "part_number": ["1", "2"],
                              "mass_kg": ["250 g", "310 g"], "nominal_voltage_v": 11.1, "capacity_ah": [4.0, 5.0],
                              "cells_series": 3, "current_max_a": 40.0, "body_volume_ml": [130.0, 150.0]})
        planned = self.catalogue.import_table("battery", frame, dry_run=True)
        self.assertNotIn("my-1", self.catalogue)
        self.assertEqual(self.catalogue.import_table("battery", frame), planned)
        self.assertEqual(planned, {"added": ["my-1", "my-2"], "replaced": [], "unchanged": []})
        self.assertEqual(self.catalogue.parts("battery").loc["my-2", "mass_kg"], 0.31)
        self.assertEqual(self.catalogue.import_table("battery", frame.set_index("id"))["unchanged"], ["my-1", "my-2"])
        frame.loc[1, "current_max_a"] = -1.0
        with self.assertRaises(plenum.InputError) as caught:
            self.catalogue.import_table("battery", frame)
        self.assertEqual(caught.exception.pointer, "/3/current_max_a")  # the row as in a file
        with self.assertRaisesRegex(plenum.InputError, "no family"):
            self.catalogue.import_table("wheel", frame)

    def test_numbers_of_a_diagnosis_go_into_a_part(self):
        part, field = "generic-lp-small-200kpa", "sonic_conductance_dm3_per_s_bar"
        protocol = plenum.protocol(part, sampling_hz=50, bottle_uncertainty=0.002, catalog=self.folder.catalog)
        self.assertEqual(protocol, command("protocol", part, "--sampling-hz", 50, "--bottle-uncertainty", 0.002))
        self.assertTrue(any("Weigh" in step for step in protocol.steps))
        promised = protocol.precision.set_index("field").loc[field, "uncertainty"]
        self.assertEqual(protocol.template["schema"], "measurement/1")
        with self.assertRaisesRegex(plenum.InputError, "sampling_hz"):
            plenum.protocol(part, sampling_hz=0, catalog=self.folder.catalog)
        with self.assertRaisesRegex(plenum.InputError, "no part has the id"):
            plenum.protocol("no-such-part", catalog=self.folder.catalog)

        diagnosis = plenum.diagnose(EXAMPLES / "bottle_test_simulated.csv", rig=EXAMPLES / "bottle_test_rig.json",
                                    catalog=self.folder.catalog)
        saved = self.catalogue.save_part(part, diagnosis, specimen="A")
        self.assertEqual(saved["refused"], [])
        written = {number["field"]: number for number in saved["numbers"]}
        self.assertAlmostEqual(written[field]["value"], 0.53, delta=0.53 * 3 * written[field]["uncertainty"])
        self.assertLess(written[field]["uncertainty"], 3 * promised)
        self.assertEqual(self.catalogue[part][field], written[field]["value"])
        self.assertEqual(self.catalogue.revision["number"], saved["revision"]["number"])
        with self.assertRaisesRegex(plenum.InputError, "no part has the id"):
            self.catalogue.save_part("no-such-part", diagnosis)
        with self.assertRaisesRegex(plenum.InputError, "no answer of diagnose"):
            self.catalogue.save_part(part, {"verdict": "explained"})

    def test_numbers_read_by_hand_go_into_a_part(self):
        part = "generic-lp-small-200kpa"
        saved = self.catalogue.write_measured(part, {"mass_kg": "31 g"}, "1 %", how="letter scale", anyway=True)
        self.assertEqual([number["value"] for number in saved["numbers"]], [0.031])
        self.assertEqual(self.catalogue[part]["mass_kg"], 0.031)
        with self.assertRaisesRegex(plenum.InputError, "uncertainty"):
            self.catalogue.write_measured(part, {"mass_kg": "31 g"}, 2.0)

    def test_the_default_is_the_one_that_is_named(self):
        found = subprocess.run([sys.executable, "-c", "import plenum; print(plenum.Catalogue().path)"],
                               env={**os.environ, "PLENUM_CATALOG": str(self.folder.catalog)}, capture_output=True,
                               text=True, check=True)
        self.assertEqual(found.stdout.strip(), str(self.folder.catalog))


class TheStubs(unittest.TestCase):
    def test_they_name_what_the_module_has(self):
        text = (ROOT / "python" / "plenum" / "_core.pyi").read_text()
        stubs = {node.name: [argument.arg for argument in node.args.args]
                 for node in ast.parse(text).body if isinstance(node, ast.FunctionDef)}
        module = {name: member.__doc__.splitlines()[0] for name, member in vars(_core).items()
                  if callable(member) and not name.startswith("_")}
        self.assertEqual(set(stubs), set(module))
        for name, arguments in stubs.items():
            inner = module[name].partition("(")[2].rpartition(") ->")[0]
            named = [piece.partition(":")[0].strip() for piece in split(inner) if piece.strip()]
            self.assertEqual(named, arguments, module[name])


def split(text):
    """At commas outside of brackets."""
    pieces, depth = [""], 0
    for sign in text:
        depth += (sign in "[(") - (sign in "])")
        if sign == "," and depth == 0:
            pieces.append("")
        else:
            pieces[-1] += sign
    return pieces


if __name__ == "__main__":
    unittest.main()
