"""Each source of tests has a namespace of its own name: the presets compile several of them as one."""
from tree import Violation


def check_namespaces(tests):
    for path, source in tests.items():
        if not path.startswith("tests/") or not source.stem.endswith("_test"):
            continue
        if f"\nnamespace {source.stem} {{\n" not in source.text or "\nnamespace {\n" in source.text:
            yield Violation("namespace", path, 1, f"has to stand in namespace {source.stem}")
