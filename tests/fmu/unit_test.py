#!/usr/bin/env python3
"""Units of designs against `plenum simulate` and against balances: unit_test.py SOURCE PLENUM"""
import ctypes
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from loader import ERROR, Unit

SOURCE, PLENUM = pathlib.Path(sys.argv[1]), sys.argv[2]
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="plenum-fmu-"))
CATALOG = ["--catalog", str(SOURCE / "catalog.db")]
MEBIBYTES_MAX = 3


def plenum(*arguments, stdin=None):
    ran = subprocess.run([PLENUM, *arguments, *CATALOG], input=stdin, capture_output=True, text=True, check=False)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout


class Designed:
    """The best design of an example, as a file and as a request to simulate it."""

    def __init__(self, example, configuration):
        request = json.loads((SOURCE / "examples" / f"{example}.json").read_text())
        request["supply"]["configurations"] = [configuration]
        request["ranking"] = {"count": 1, "time_limit_s": 30}
        text = plenum("design", "-", "--json", stdin=json.dumps(request))
        self.answer = json.loads(text)
        self.design = self.answer["designs"][0]
        self.requirements = self.answer["requirements"]
        self.file = FOLDER / f"{example}-{configuration}.fmu"
        plenum("export", "-", "--fmu", str(self.file), stdin=text)
        self.group = self.requirements["actuators"][0]
        self.name, self.count = self.group["name"], self.group["count"]
        self.names = [f"{self.name}[{i + 1}]" for i in range(self.count)] if self.count > 1 else [self.name]

    def part(self, family):
        row = next((row for row in self.design["parts"] if row["family"] == family), None)
        return row and json.loads(plenum("catalog", "show", row["id"], "--json")) | {"quantity": row["quantity"]}

    def source(self):
        source_kpa = self.design["settings"]["source_pressure_kpa_gauge"]
        pump, regulator = self.part("compressor"), self.part("regulator")
        if pump:
            return {"kind": "compressor", "curve": [{k: p[k] for k in ("pressure_kpa_gauge", "free_air_l_per_min")}
                                                    for p in pump["curve"]],
                    "count": pump["quantity"], "reservoir_volume_ml": self.design["settings"]["reservoir_volume_ml"],
                    "initial_pressure_kpa_gauge": source_kpa, "stop_pressure_kpa_gauge": source_kpa}
        flow = regulator.get("flow_max_l_per_min_anr")
        return {"kind": "regulated", "source_pressure_kpa_gauge": source_kpa,
                "regulator": {k: regulator[k] for k in ("sonic_conductance_dm3_per_s_bar", "critical_ratio")},
                **({"flow_l_per_min_anr_max": flow} if flow else {})}

    def simulate(self, commands, end_s, sample_hz, closes=True):
        fittings = [{"part": self.part("fitting")["id"]}] * self.group.get("fittings_per_line", 2)
        half = (len(fittings) + 1) // 2
        tube = {"part": self.part("tubing")["id"], "length_m": self.group["tube_length_m"]}
        chamber = {k: self.group[k] for k in ("rest_volume_ml", "expansion_ratio", "operating_pressure_kpa_gauge")}
        return json.loads(plenum("simulate", "-", "--json", stdin=json.dumps({
            "schema": "simulation/1", "source": self.source(), "t_end_s": end_s, "sample_hz": sample_hz,
            "gas": "co2" if self.design["configuration"] == "co2" else "air",
            "actuators": [{"name": "a", "count": self.count, **chamber,
                           "close_at_operating_pressure": closes and self.holds(),
                           "line": {"elements": [{"part": self.part("valve")["id"]}, *fittings[:half], tube,
                                                 *fittings[half:]]},
                           "valve": [{"t_s": t, "state": s} for t, s in commands]}]})))

    def holds(self):
        return self.part("valve")["function"] != "3/2"

    def unit(self, **options):
        return Unit(self.file, tempfile.mkdtemp(dir=FOLDER), **options)


VALVE = {"inflate": 1, "hold": 0, "deflate": -1}


def drive(unit, names, commands, end_s, step_s, before_step=lambda unit: None):
    """What the unit tells at each communication point."""
    told = []
    steps = round(end_s / step_s)
    for k in range(steps + 1):
        told.append({name: unit[name] for name in unit.variables})
        if k == steps:
            return told
        for t, state in commands:
            if round(t / step_s) == k:
                for name in names:
                    unit[f"{name}.command"] = VALVE[state]
        before_step(unit)
        unit.step(step_s)


def farthest(told, name, series):
    return max(abs(one[name] - other) for one, other in zip(told, series, strict=True))


class UnitTest(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.pumped = Designed("exosuit", "compressor")
        cls.bottled = Designed("gripper", "cylinder")

    def test_the_file_is_as_the_standard_has_it(self):
        self.assertLess(self.pumped.file.stat().st_size, MEBIBYTES_MAX << 20)
        unit = self.pumped.unit()
        root = unit.description
        self.assertEqual(root.get("fmiVersion"), "2.0")
        order = [child.tag for child in root]
        self.assertEqual(order, ["CoSimulation", "UnitDefinitions", "DefaultExperiment", "ModelVariables",
                                 "ModelStructure"])
        variables = list(root.find("ModelVariables"))
        self.assertEqual(len({v.get("name") for v in variables}), len(variables))
        outputs = {i + 1 for i, v in enumerate(variables) if v.get("causality") == "output"}
        for kind in ("Outputs", "InitialUnknowns"):
            self.assertEqual({int(u.get("index")) for u in root.find("ModelStructure").find(kind)}, outputs)
        units = {u.get("name") for u in root.find("UnitDefinitions")}
        for variable in variables:
            self.assertIn(variable[0].get("unit", "1"), units)
        for name in self.pumped.names:
            self.assertEqual(unit[f"{name}.pressure_kpa_gauge"], 0.0)
            self.assertAlmostEqual(unit[f"{name}.volume_now_ml"], self.pumped.group["rest_volume_ml"], 9)
        self.assertEqual(unit["battery_charge"], 1.0)
        unit.free()

    def check_against_simulate(self, designed, commands, end_s, step_s, parameters=(), closes=True):
        unit = designed.unit(parameters=parameters)
        told = drive(unit, designed.names, commands, end_s, step_s)
        unit.free()
        simulated = designed.simulate(commands, end_s, 1 / step_s, closes)
        [group] = simulated["groups"]
        largest = max(group["pressure_kpa_gauge"])
        self.assertGreater(largest, 0.5 * designed.group["operating_pressure_kpa_gauge"])
        for name in designed.names:
            error = farthest(told, f"{name}.pressure_kpa_gauge", group["pressure_kpa_gauge"])
            self.assertLess(error, 1e-6 * largest)
            self.assertLess(farthest(told, f"{name}.volume_now_ml", group["volume_ml"]), 1e-6 * group["volume_ml"][0])
        source = simulated["source_pressure_kpa_gauge"]
        self.assertLess(farthest(told, "source_pressure_kpa_gauge", source), 1e-6 * source[0])
        net_l = sum(one[f"{name}.flow_l_per_min_anr"] for one in told[1:] for name in designed.names) * step_s / 60
        self.assertAlmostEqual(net_l, group["air_in_l_anr"] - group["air_out_l_anr"], 6)
        self.assertAlmostEqual(told[-1]["air_used_l_anr"], group["air_in_l_anr"], 6)
        return told

    def test_a_pump_and_its_reservoir(self):
        commands = [(0.0, "inflate"), (2.0, "deflate"), (4.0, "inflate"), (6.0, "deflate")]
        told = self.check_against_simulate(self.pumped, commands, 8.0, 0.01)
        self.assertGreater(told[-1]["energy_used_wh"], 0)
        usable_wh = told[-1]["energy_used_wh"] / (1 - told[-1]["battery_charge"])
        battery = self.pumped.part("battery")
        full_wh = battery["capacity_ah"] * battery["nominal_voltage_v"] * battery["quantity"]
        self.assertTrue(0.5 * full_wh < usable_wh <= full_wh)

    def test_a_bottle_and_its_regulator(self):
        told = self.check_against_simulate(self.bottled, [(0.1, "inflate"), (0.9, "deflate")], 1.5, 0.004)
        self.assertTrue(0 < told[-1]["air_left"] < 1)
        gas_l = told[-1]["air_used_l_anr"] / (1 - told[-1]["air_left"])
        self.assertGreater(gas_l, 1.0)

    def test_steps_of_any_size_tell_the_same(self):
        commands = [(0.0, "inflate"), (2.0, "deflate")]
        ends = []
        for step_s in (0.5, 0.1, 0.004):
            unit = self.pumped.unit()
            ends.append(drive(unit, self.pumped.names, commands, 3.0, step_s)[-1])
            unit.free()
        for name in ends[0]:
            if name.endswith("flow_l_per_min_anr"):  # the mean of the last step
                continue
            for end in ends[1:]:
                self.assertAlmostEqual(end[name], ends[0][name], delta=1e-6 * max(1e-3, abs(end[name])), msg=name)

    def test_a_valve_that_holds_may_be_left_open(self):
        if not self.pumped.holds():
            self.skipTest("the design's valve cannot hold")
        commands = [(0.0, "inflate")]
        told = self.check_against_simulate(self.pumped, commands, 3.0, 0.02,
                                           {"close_at_operating_pressure": False}, closes=False)
        operating = self.pumped.group["operating_pressure_kpa_gauge"]
        self.assertGreater(told[-1][f"{self.pumped.names[0]}.pressure_kpa_gauge"], 1.02 * operating)

    def test_actuators_are_driven_one_by_one(self):
        unit = self.pumped.unit()
        first, second = self.pumped.names[:2]
        unit[f"{first}.command"] = 1
        for _ in range(50):
            unit.step(0.01)
        self.assertGreater(unit[f"{first}.pressure_kpa_gauge"], 1)
        self.assertEqual(unit[f"{second}.pressure_kpa_gauge"], 0)
        unit.free()

    def test_imposed_volumes_are_right_to_first_order(self):
        # Volumes as the law has them at each point: what is off is that they stay during a step.
        names = self.pumped.names
        rise_s = self.pumped.design["performance"]["groups"][0]["rise_time_s"]
        turn_s = 0.004 * round(0.7 * rise_s / 0.004)  # before a valve closes by itself
        commands, end_s, finest = [(0.0, "inflate"), (turn_s, "deflate")], turn_s + 0.4, 4
        [simulated] = self.pumped.simulate(commands, end_s, 250 * finest)["groups"]
        errors = []
        for refined in (1, 2, 4):
            stride = finest // refined
            volumes = iter(simulated["volume_ml"][::stride])

            def impose(unit, volumes=volumes):
                volume = next(volumes)
                for name in names:
                    unit[f"{name}.volume_ml"] = volume

            unit = self.pumped.unit()
            told = drive(unit, names, commands, end_s, 0.004 / refined, impose)
            unit.free()
            errors.append(farthest(told, f"{names[0]}.pressure_kpa_gauge", simulated["pressure_kpa_gauge"][::stride]))
        self.assertLess(errors[0], 0.05 * self.pumped.group["operating_pressure_kpa_gauge"])
        for coarse, fine in zip(errors, errors[1:]):
            self.assertTrue(1.8 < coarse / fine < 2.2, errors)

    def test_a_squeezed_actuator_keeps_its_gas(self):
        name = self.pumped.names[0]
        if not self.pumped.holds():
            self.skipTest("the design's valve cannot hold")
        unit = self.pumped.unit()
        unit[f"{name}.command"] = 1
        for _ in range(40):
            unit.step(0.01)
        unit[f"{name}.command"] = 0
        unit.step(0.01)
        tube = self.pumped.part("tubing")
        bore_ml = 3.141592653589793 / 4 * tube["inner_diameter_mm"] ** 2 * self.pumped.group["tube_length_m"]
        ambient = 100.0

        def gas(pressure, volume):
            return (pressure + ambient) * (volume + bore_ml)

        before = gas(unit[f"{name}.pressure_kpa_gauge"], unit[f"{name}.volume_now_ml"])
        for volume in (60.0, 30.0, 0.0):
            unit[f"{name}.volume_ml"] = volume
            unit.step(0.01)
            after = gas(unit[f"{name}.pressure_kpa_gauge"], unit[f"{name}.volume_now_ml"])
            self.assertAlmostEqual(after / before, 1, 9)
            if volume:
                self.assertAlmostEqual(unit[f"{name}.volume_now_ml"], volume, 9)
        unit.free()

    def test_a_state_is_gone_back_to(self):
        unit = self.pumped.unit()
        for name in self.pumped.names:
            unit[f"{name}.command"] = 1
        unit.step(0.137)
        state = unit.keep()
        unit.step(0.2)
        first = {name: unit[name] for name in unit.variables}
        unit.step(0.3)
        unit.go_back(state)
        unit.step(0.2)
        self.assertEqual({name: unit[name] for name in unit.variables}, first)
        unit.ok("Reset")
        self.assertEqual(unit["energy_used_wh"], 0)
        self.assertEqual(unit[f"{self.pumped.names[0]}.pressure_kpa_gauge"], 0)
        unit.free()

    def test_what_is_wrong_is_refused_and_said(self):
        unit = self.pumped.unit()
        name = self.pumped.names[0]
        self.assertEqual(unit.set(f"{name}.command", 2), ERROR)
        self.assertIn("must be -1, 0 or 1, is 2", unit.said[-1])
        for value in (-1.0, float("nan"), float("inf")):
            self.assertEqual(unit.set(f"{name}.volume_ml", value), ERROR)
        self.assertEqual(unit.set(f"{name}.pressure_kpa_gauge", 1.0), ERROR)
        self.assertEqual(unit.call("DoStep", ctypes.c_double(0), ctypes.c_double(0), 1), ERROR)
        unit.free()
        with self.assertRaisesRegex(RuntimeError, "not there, or not that of modelDescription.xml"):
            self.pumped.unit(guid="{another}")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
