"""The same functions at a service give the same answers."""
import json
import subprocess
import time
import unittest

import plenum

from places import EXAMPLES, PROGRAM, SIMULATION, Folder, timeless


class AtAService(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Folder()
        command = [PROGRAM, "serve", "--port", "0", "--no-log", "--catalog", str(cls.folder.catalog)]
        cls.process = subprocess.Popen(command, stderr=subprocess.PIPE, text=True)
        url = cls.process.stderr.readline().split()[-1]
        cls.service = plenum.connect(url)

    @classmethod
    def tearDownClass(cls):
        cls.process.terminate()
        cls.process.wait()
        cls.process.stderr.close()
        cls.folder.cleanup()

    def test_answers_are_those_of_this_machine(self):
        design = self.service.design(EXAMPLES / "gripper.json", top=2, progress=False)
        here = plenum.design(EXAMPLES / "gripper.json", top=2, catalog=self.folder.catalog, progress=False)
        self.assertEqual(timeless(design), timeless(here))
        self.assertIsInstance(design, plenum.Designs)
        self.assertEqual(self.service.simulate(SIMULATION), plenum.simulate(SIMULATION))
        self.assertEqual(self.service.map(EXAMPLES / "map.json"), plenum.map(EXAMPLES / "map.json"))
        self.assertEqual(self.service.evaluate(EXAMPLES / "gripper_by_hand.json"),
                         plenum.evaluate(EXAMPLES / "gripper_by_hand.json", catalog=self.folder.catalog))
        many = self.service.simulate_many([SIMULATION, {"schema": "simulation/1"}])
        self.assertEqual(many[0], plenum.simulate(SIMULATION))
        self.assertIsInstance(many[1], plenum.InputError)

    def test_all_parts_come_over_several_pages(self):
        here = plenum.Catalogue(self.folder.catalog).parts()
        self.assertEqual(set(self.service.parts().index), set(here.index))
        light = self.service.parts("battery", mass_kg_max=0.3)
        self.assertEqual(set(light.index), set(here[(here.family == "battery") & (here.mass_kg <= 0.3)].index))

    def test_long_work_is_waited_for_with_progress(self):
        news = []
        answer = self.service.diagnose(EXAMPLES / "simulated_recording.json", progress=news.append)
        self.assertEqual(answer.verdict, "explained")
        self.assertEqual(list(answer.effects["effect"].unique()), ["creep"])

    def test_a_part_is_measured_and_saved(self):
        part = "generic-lp-small-200kpa"
        self.assertEqual(self.service.protocol(part, sampling_hz=50),
                         plenum.protocol(part, sampling_hz=50, catalog=self.folder.catalog))
        answer = self.service.diagnose(EXAMPLES / "bottle_test_simulated.csv", rig=EXAMPLES / "bottle_test_rig.json",
                                       save_part=part, specimen="A", progress=False)
        saved = answer["saved_part"]
        self.assertEqual((saved["part"], saved["specimen"], saved["refused"]), (part, "A", []))
        row = plenum.Catalogue(self.folder.catalog)[part]
        self.assertEqual({number["field"]: row[number["field"]] for number in saved["numbers"]},
                         {number["field"]: number["value"] for number in saved["numbers"]})

    def test_an_exception_cancels_the_job(self):
        request = json.loads((EXAMPLES / "exosuit.json").read_text())
        request["objective"] = {"minimize": "volume_l"}
        request["ranking"] = {"count": 100, "time_limit_s": 60}

        def refuse(news):
            raise RuntimeError("enough")

        with self.assertRaisesRegex(RuntimeError, "enough"):
            self.service.design(request, progress=refuse)
        jobs = self.service._get("/v1/designs")["jobs"]
        until = time.monotonic() + 20
        while time.monotonic() < until and jobs[0]["status"] == "running":
            time.sleep(0.1)
            jobs = self.service._get("/v1/designs")["jobs"]
        self.assertEqual(jobs[0]["status"], "cancelled")

    def test_refusals(self):
        with self.assertRaises(plenum.InputError) as caught:
            self.service.design({**json.loads((EXAMPLES / "gripper.json").read_text()), "duty": {}})
        self.assertIn("/duty/frequency_hz", [pointer for pointer, _ in caught.exception.errors])
        with self.assertRaises(plenum.ServiceError) as caught:
            self.service._get("/v1/designs/nowhere")
        self.assertEqual(caught.exception.status, 404)
        with self.assertRaises(plenum.ServiceError) as caught:
            plenum.connect("http://127.0.0.1:1").map(EXAMPLES / "map.json")
        self.assertIsNone(caught.exception.status)


class WithAToken(unittest.TestCase):
    def test_the_token_is_sent(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        token = subprocess.run([PROGRAM, "token", "create", "python", "--catalog", str(folder.catalog)],
                               capture_output=True, text=True, check=True).stdout.strip()
        process = subprocess.Popen([PROGRAM, "serve", "--port", "0", "--no-log", "--allow-host", "plenum.test",
                                    "--catalog", str(folder.catalog)], stderr=subprocess.PIPE, text=True)
        try:
            url = process.stderr.readline().split()[-1]
            self.assertEqual(plenum.connect(url, token).simulate(SIMULATION), plenum.simulate(SIMULATION))
            with self.assertRaises(plenum.ServiceError) as caught:
                plenum.connect(url).simulate(SIMULATION)
            self.assertEqual(caught.exception.status, 401)
        finally:
            process.terminate()
            process.wait()
            process.stderr.close()


if __name__ == "__main__":
    unittest.main()
