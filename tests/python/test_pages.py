"""The code of the tutorial and the notebooks runs as it stands there."""
import json
import os
import pathlib
import re
import shutil
import unittest

os.environ.setdefault("MPLBACKEND", "Agg")

import matplotlib.pyplot as plt  # noqa: E402

from places import PROGRAM, ROOT, Folder  # noqa: E402

TEN_LINES = 10


class Pages(unittest.TestCase):
    def setUp(self):
        folder = Folder()
        self.addCleanup(folder.cleanup)
        shutil.copytree(ROOT / "examples", folder.path / "examples")
        self.addCleanup(os.chdir, os.getcwd())
        self.addCleanup(plt.close, "all")
        os.chdir(folder.path)

    def test_the_tutorial(self):
        text = (ROOT / "docs" / "tutorials" / "python.md").read_text(encoding="utf-8")
        blocks = re.findall(r"^```python\n(.*?)^```", text, flags=re.S | re.M)
        self.assertLessEqual(len(blocks[0].splitlines()), TEN_LINES)
        names = {}
        exec(compile(blocks[0], "python.md, block 1", "exec"), names)
        self.assertGreater(pathlib.Path("front.png").stat().st_size, 1000)
        for number, block in enumerate(blocks[1:], 2):
            exec(compile(block, f"python.md, block {number}", "exec"), names)
        self.assertGreater(pathlib.Path("residuals.png").stat().st_size, 1000)

    def run_notebook(self, name):
        notebook = json.loads((ROOT / "docs" / "notebooks" / name).read_text(encoding="utf-8"))
        self.assertEqual(notebook["nbformat"], 4)
        names = {}
        for number, cell in enumerate(notebook["cells"], 1):
            if cell["cell_type"] == "code":
                self.assertEqual(cell["outputs"], [])  # they are made by whoever runs it
                exec(compile("".join(cell["source"]), f"{name}, cell {number}", "exec"), names)

    def test_a_first_design(self):
        self.run_notebook("first_design.ipynb")

    def test_a_first_diagnosis(self):
        self.run_notebook("first_diagnosis.ipynb")

    def test_a_first_service(self):
        shutil.copyfile(ROOT / "catalog.db", "catalog.db")
        os.environ.setdefault("PLENUM_BINARY", PROGRAM)
        self.run_notebook("first_service.ipynb")

    def test_measuring_a_part(self):
        shutil.copyfile(ROOT / "catalog.db", "catalog.db")
        self.run_notebook("measure_a_part.ipynb")

    def test_every_notebook_is_run_here(self):
        tested = {"first_design.ipynb", "first_diagnosis.ipynb", "first_service.ipynb", "measure_a_part.ipynb"}
        self.assertEqual({path.name for path in (ROOT / "docs" / "notebooks").glob("*.ipynb")}, tested)


if __name__ == "__main__":
    unittest.main()
