"""Where the checkout and its command are, and a catalogue that tests may write."""
import json
import os
import pathlib
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
PROGRAM = os.environ.get("PLENUM_BINARY", str(ROOT / "build" / "release" / "plenum"))


class Folder(tempfile.TemporaryDirectory):
    """A folder with a copy of the seed."""

    def __init__(self):
        super().__init__(prefix="plenum-")
        self.path = pathlib.Path(self.name)
        self.catalog = self.path / "catalog.db"
        shutil.copyfile(ROOT / "catalog.db", self.catalog)


def command(*arguments):
    """The answer of the command as a document."""
    done = subprocess.run([PROGRAM, *map(str, arguments), "--json"], cwd=ROOT, capture_output=True, check=True)
    return json.loads(done.stdout)


def timeless(answer):
    """Without what differs from run to run."""
    return {name: member for name, member in answer.items() if name not in ("seconds",)}


SIMULATION = {
    "schema": "simulation/1",
    "actuators": [{"name": "a", "count": 1, "rest_volume_ml": 50.0, "expansion_ratio": 2.0,
                   "operating_pressure_kpa_gauge": 100.0,
                   "line": {"sonic_conductance_dm3_per_s_bar": 0.3, "critical_ratio": 0.35}}],
    "source": {"kind": "regulated", "source_pressure_kpa_gauge": 200.0},
    "valve": [{"t_s": 0.0, "state": "inflate"}, {"t_s": 1.0, "state": "deflate"}],
    "t_end_s": 2.0, "sample_hz": 50,
}
