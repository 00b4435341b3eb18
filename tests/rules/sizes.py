"""Rules on sizes: folders, files, functions, classes."""
import collections
import json
import subprocess

from tree import Violation


def check_sizes(root, sources, tests, limits):
    """`tests`: sources of tests and benchmarks, which only the rules on folders and files hold."""
    everything = {**sources, **tests}
    folders = collections.Counter(source.folder for source in everything.values())
    for folder, count in sorted(folders.items()):
        if count > limits["files_in_folder"]:
            yield Violation("folder", folder, count, f"has {count} files")
    for path, source in everything.items():
        lines = source.text.count("\n")
        if lines > limits["lines_of_file"]:
            yield Violation("file", path, lines, f"has {lines} lines")
    tags = read_tags(root, sorted(sources))
    yield from check_functions(tags, limits["lines_of_function"])
    yield from check_classes(tags, limits)


def read_tags(root, paths):
    """Definitions of C++ as universal-ctags sees them."""
    command = ["ctags", "-f", "-", "--sort=no", "--languages=C++", "--language-force=C++",
               "--kinds-C++=cfpsm", "--fields=NFneKsZ", "--output-format=json", "-L", "-"]
    done = subprocess.run(command, input="\n".join(paths), cwd=root, text=True, capture_output=True)
    if done.returncode != 0 or (paths and not done.stdout):
        raise SystemExit(f"universal-ctags is needed: {done.stderr.strip()}")
    return [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]


def short(name):
    """Without the namespaces of the project and unnamed ones."""
    return "::".join(p for p in name.split("::") if not p.startswith("__anon") and
                     p not in ("plenum", "model", "optimizer", "verify", "catalog", "calibration",
                               "api", "server"))


def full_name(tag):
    return f"{tag['scope']}::{tag['name']}" if "scope" in tag else tag["name"]


def check_functions(tags, most):
    longest = {}
    for tag in tags:
        if tag["kind"] == "function" and "end" in tag and not tag["name"].startswith("__anon"):
            subject = f"{tag['path']}:{short(full_name(tag))}"
            longest[subject] = max(longest.get(subject, 0), tag["end"] - tag["line"] + 1)
    for subject, lines in longest.items():
        if lines > most:
            yield Violation("function", subject, lines, f"has {lines} lines")


def check_classes(tags, limits):
    """Methods and fields as declared in the class; its methods lie in one .cc."""
    classes = [t for t in tags if t["kind"] in ("class", "struct") and "end" in t]
    by_scope = collections.defaultdict(list)
    for tag in tags:
        if tag.get("scopeKind") in ("class", "struct"):
            by_scope[tag["scope"]].append(tag)
    for owner in classes:
        name = full_name(owner)
        subject = f"{owner['path']}:{short(name)}"
        inside = [t for t in by_scope[name]
                  if t["path"] == owner["path"] and owner["line"] <= t["line"] <= owner["end"]]
        methods = sum(t["kind"] in ("prototype", "function") and not t["name"].startswith("__anon")
                      for t in inside)
        fields = sum(t["kind"] == "member" for t in inside)
        if methods > limits["methods_of_class"]:
            yield Violation("methods", subject, methods, f"has {methods} methods")
        if fields > limits["fields_of_class"]:
            yield Violation("fields", subject, fields, f"has {fields} fields")
        if owner["path"].endswith(".h"):
            files = sorted({t["path"] for t in by_scope[name]
                            if t["kind"] == "function" and t["path"].endswith(".cc")})
            if len(files) > 1:
                yield Violation("one_cc", subject, len(files), "lies in " + ", ".join(files))
