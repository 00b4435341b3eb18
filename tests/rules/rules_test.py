"""Each rule sees a violation that is planted in a small house, and nothing in the house as it is."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from check_rules import complaints, read_exceptions, violations

RULES = {
    "limits": {
        "files_in_folder": 3,
        "lines_of_file": 30,
        "lines_of_function": 5,
        "methods_of_class": 3,
        "fields_of_class": 2,
    },
    "rooms": {
        "model": {"sees": [], "order": ["air", "flow"]},
        "search": {"sees": ["model"], "order": ["values", "walk"]},
        "check": {"sees": ["model", "search/values"], "order": ["check"]},
        "api": {"sees": ["search"], "order": ["answer"]},
    },
    "libraries": {"sqlite": {"headers": "sqlite3", "rooms": ["search"]}},
}

HOUSE = {
    "model/README.md": "# model/\n\n- `air/`: gas.\n- `flow/`: flow through\n  one element.\n",
    "model/air/README.md": "- `gas`: the gas.\n",
    "model/air/gas.h": "struct Gas { double r; };\n",
    "model/air/gas.cc": '#include "model/air/gas.h"\n',
    "model/flow/README.md": "- `tube`: a tube.\n- `bend`: a bend.\n",
    "model/flow/tube.h": '// bend.cc: the bend.\n#include "model/air/gas.h"\nclass Tube { void A(); void B(); };\n',
    "model/flow/tube.cc": '#include "model/flow/tube.h"\nvoid Tube::A() {}\nvoid Tube::B() {}\n',
    "model/flow/bend.cc": '#include "model/flow/tube.h"\n',
    "search/README.md": "- `values/`: values.\n- `walk/`: the walk.\n",
    "search/values/README.md": "- `design`: a design.\n",
    "search/values/design.h": '#include "model/flow/tube.h"\n',
    "search/walk/README.md": "- `walker`: walks.\n",
    "search/walk/walker.h": '#include "search/values/design.h"\n',
    "check/README.md": "- `check`: checks.\n",
    "check/check.h": '#include "search/values/design.h"\n',
    "api/README.md": "- `answer`: the answer.\n",
    "api/answer.h": '#include "search/walk/walker.h"\n',
    "bench/CMakeLists.txt": "set(flow ${PROJECT_SOURCE_DIR}/model/flow)\nadd_library(a ${flow}/bend.cc b.cc)\n",
    "bench/b.cc": "",
    "tests/model/tube_test.cc": '#include "model/flow/tube.h"\nnamespace tube_test {\n}\n',
}


def write(root, files):
    for name, text in files.items():
        path = pathlib.Path(root) / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")


def found_in(changes=(), removed=()):
    """(rule, subject) of what the rules find in the house with some files changed."""
    with tempfile.TemporaryDirectory() as root:
        files = {**HOUSE, **dict(changes)}
        write(root, {name: text for name, text in files.items() if name not in removed})
        return sorted({(v.rule, v.subject) for v in violations(root, RULES)})


class Rules(unittest.TestCase):
    def expect(self, changes, *expected, removed=()):
        self.assertEqual(found_in(changes, removed), sorted(expected))

    def test_the_house_keeps_them(self):
        self.expect({})

    def test_direction_of_rooms(self):
        self.expect(
            {"model/air/gas.cc": '#include "model/air/gas.h"\n#include "search/values/design.h"\n'},
            ("room", "model/air/gas.cc"),
            ("cycle", "model/air/gas"),
        )

    def test_one_sub_room_is_not_the_room(self):
        self.expect({"check/check.h": '#include "search/walk/walker.h"\n'}, ("room", "check/check.h"))

    def test_an_umbrella_does_not_hide_an_arrow(self):
        self.expect(
            {"search/values/design.h": '#include "search/walk/walker.h"\n', "search/walk/walker.h": ""},
            ("room", "check/check.h"),
            ("order", "search/values/design.h"),
        )

    def test_relative_paths_and_tests(self):
        self.expect({"api/answer.h": '#include "../search/x.h"\n'}, ("room", "api/answer.h"))
        self.expect({"api/answer.h": '#include "tests/support/x.h"\n'}, ("room", "api/answer.h"))

    def test_order_of_sub_rooms(self):
        self.expect(
            {"model/air/gas.h": '#include "model/flow/tube.h"\n', "model/flow/tube.h": "// bend.cc\n"},
            ("order", "model/air/gas.h"),
        )

    def test_places_are_those_of_the_order(self):
        self.expect(
            {"api/more.h": "", "api/README.md": HOUSE["api/README.md"] + "- `more`: more.\n"},
            ("order", "api/more.h"),
        )
        self.expect({"check/README.md": "- `checks`: checks.\n", "check/checks.h": ""},
                    ("order", "check/check"), ("order", "check/checks.h"), removed=["check/check.h"])

    def test_cycles_of_units(self):
        self.expect(
            {
                "model/flow/bend.h": '#include "model/flow/tube.h"\n',
                "model/flow/tube.cc": HOUSE["model/flow/tube.cc"] + '#include "model/flow/bend.h"\n',
                "model/flow/tube.h": HOUSE["model/flow/tube.h"],
            },
            ("cycle", "model/flow/bend"),
            ("folder", "model/flow"),
        )

    def test_libraries(self):
        self.expect({"model/air/gas.cc": "#include <sqlite3.h>\n"}, ("library", "model/air/gas.cc"))
        self.expect(
            {"search/walk/walker.h": "#  include <sqlite3.h>\n"}, ("library", "api/answer.h")
        )

    def test_every_cc_has_its_header(self):
        self.expect(
            {"model/flow/tube.h": HOUSE["model/flow/tube.h"].replace("bend.cc", "pipe.cc")},
            ("header", "model/flow/bend.cc"),
        )
        self.expect({"model/flow/tube.h": HOUSE["model/flow/tube.h"].replace("bend.cc", "ben*.cc")})

    def test_stems(self):
        self.expect(
            {"search/walk/tube.h": "", "search/walk/README.md": "- `walker`: w.\n- `tube`: t.\n"},
            ("stem", "tube"),
        )

    def test_folders_and_files(self):
        names = [f"tests/model/t{i}.cc" for i in range(3)]
        self.expect({name: "" for name in names}, ("folder", "tests/model"))
        self.expect({"model/air/gas.h": "\n" * 31}, ("file", "model/air/gas.h"))
        self.expect({"tests/model/tube_test.cc": "\nnamespace tube_test {\n" + "\n" * 30},
                    ("file", "tests/model/tube_test.cc"))

    def test_functions(self):
        body = "int Long() {\n  int a = 0;\n  a++;\n  a++;\n  return a;\n}\n"
        self.expect({"model/air/gas.cc": body}, ("function", "model/air/gas.cc:Long"))
        self.expect({"model/air/gas.cc": body.replace("  a++;\n  a++;\n", "  a++;\n")})

    def test_classes(self):
        head = "// bend.cc\nclass Tube {\n"
        self.expect(
            {"model/flow/tube.h": head + "  void A(); void B(); void C() {} Tube();\n};\n"},
            ("methods", "model/flow/tube.h:Tube"),
        )
        self.expect(
            {"model/flow/tube.h": head + "  void A(); void B();\n  int a, b;\n  double c_ = 0.0;\n};\n"},
            ("fields", "model/flow/tube.h:Tube"),
        )
        self.expect(
            {"model/flow/tube.cc": "void Tube::A() {}\n", "model/flow/bend.cc": "void Tube::B() {}\n"},
            ("one_cc", "model/flow/tube.h:Tube"),
        )

    def test_namespaces_of_tests(self):
        self.expect({"tests/model/tube_test.cc": "\nnamespace {\n}\n"},
                    ("namespace", "tests/model/tube_test.cc"))

    def test_listings_of_the_bench(self):
        self.expect({"bench/CMakeLists.txt": "add_library(a ${PROJECT_SOURCE_DIR}/model/flow/bend.cc old.cc)\n"},
                    ("listing", "bench/CMakeLists.txt"))

    def test_pages(self):
        self.expect({}, ("page", "model/air/README.md"), removed=["model/air/README.md"])
        self.expect({"model/README.md": "- `air/`: gas.\n"}, ("page", "model/README.md"))
        more = HOUSE["model/air/README.md"]
        self.expect({"model/air/README.md": more + "- `wind`: wind.\n"}, ("page", "model/air/README.md"))
        self.expect({"model/air/README.md": more + more}, ("page", "model/air/README.md"))
        self.expect({"model/air/README.md": "- `gas`:\n"}, ("page", "model/air/README.md"))

    def test_an_empty_room_is_an_error(self):
        with self.assertRaisesRegex(SystemExit, "nothing was checked"):
            found_in(removed=["api/answer.h"])


class Exceptions(unittest.TestCase):
    LONG = {"model/air/gas.h": "\n" * 40}

    def complaints(self, text, changes):
        with tempfile.TemporaryDirectory() as root:
            write(root, {**HOUSE, **changes, "exceptions.txt": text})
            exceptions = read_exceptions(pathlib.Path(root) / "exceptions.txt")
            return list(complaints(violations(root, RULES), exceptions))

    def test_they_cover_up_to_their_limit(self):
        self.assertEqual(self.complaints("# why\nfile | model/air/gas.h | 40 | split it\n", self.LONG), [])
        self.assertIn("allows 39",
                      self.complaints("file | model/air/gas.h | 39 | split it\n", self.LONG)[0])

    def test_stale_ones_fail(self):
        lines = self.complaints("file | model/air/gas.h | 40 | split it\n", {})
        self.assertEqual(lines, ["exceptions.txt: file | model/air/gas.h: no longer needed"])

    def test_each_has_a_reason(self):
        for text in ("file | model/air/gas.h | 40 |\n", "file | model/air/gas.h | many | x\n",
                     "file | a | 1 | x\nfile | a | 2 | y\n"):
            with self.assertRaises(SystemExit):
                self.complaints(text, {})

    def test_the_command_ends_with_1(self):
        with tempfile.TemporaryDirectory() as root:
            write(root, HOUSE)
            tool = pathlib.Path(__file__).parent / "check_rules.py"
            write(root, {"rules/rules.toml": '[limits]\nfiles_in_folder = 3\nlines_of_file = 30\n'
                         "lines_of_function = 5\nmethods_of_class = 3\nfields_of_class = 2\n"
                         '[rooms.model]\nsees = []\norder = ["air", "flow"]\n[libraries]\n',
                         "rules/exceptions.txt": ""})
            run = lambda: subprocess.run([sys.executable, "-B", tool, root, f"{root}/rules"],
                                         capture_output=True, text=True)
            self.assertEqual((run().returncode, run().stdout), (0, ""))
            write(root, self.LONG)
            self.assertEqual(run().returncode, 1)
            self.assertIn("file: model/air/gas.h: has 40 lines", run().stdout)


if __name__ == "__main__":
    unittest.main()
