#!/usr/bin/env python3
"""Software bill of materials of a binary, CycloneDX 1.5 as JSON on standard output.

What it links is asked of ldd and dpkg; what was compiled in is packages.txt (Debian) and what web/package-lock.json
has for the page; the documentation holds what the theme brings. usage: sbom.py CHECKOUT VERSION BINARY
"""
import json
import pathlib
import re
import subprocess
import sys


# What of the theme stands in the built documentation.
DOCS_PACKAGES = ("furo", "libjs-jquery", "libjs-sphinxdoc", "libjs-underscore", "node-normalize.css",
                 "python3-sphinx-copybutton", "sphinx-common")


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout


def linked_files(binary):
    return sorted(set(re.findall(r"(?:=>\s*|^\s*)(/\S+)", run("ldd", binary), flags=re.M)))


def package_of(file):
    """The Debian package that brings a file; /lib is /usr/lib there."""
    path = pathlib.Path(file)
    for name in (file, str(path.resolve()), str(path.resolve()).removeprefix("/usr")):
        found = subprocess.run(["dpkg", "-S", name], capture_output=True, text=True)
        if found.returncode == 0:
            return found.stdout.split(": ")[0].split(",")[0]
    raise SystemExit(f"{file}: no Debian package brings it")


def licences_of(package):
    """Names of the licences in the package's copyright file, where it is machine-readable."""
    path = pathlib.Path("/usr/share/doc") / package.split(":")[0] / "copyright"
    text = path.read_text(encoding="utf-8", errors="replace") if path.exists() else ""
    if "copyright-format" not in text:
        return []
    return sorted(set(re.findall(r"^License:[ \t]*(\S.*)$", text, flags=re.M)))


def of_debian(package, use):
    name, version, architecture = run("dpkg-query", "-W", "-f", "${Package}\t${Version}\t${Architecture}",
                                      package).split("\t")
    component = {"type": "library", "name": name, "version": version, "scope": "required",
                 "purl": f"pkg:deb/debian/{name}@{version.replace('+', '%2B')}?arch={architecture}",
                 "properties": [{"name": "plenum:use", "value": use}]}
    licences = licences_of(package)
    if licences:
        component["licenses"] = [{"license": {"name": licence}} for licence in licences]
    return component


def of_npm(name, entry):
    component = {"type": "library", "name": name, "version": entry["version"], "scope": "required",
                 "purl": f"pkg:npm/{name.replace('@', '%40')}@{entry['version']}",
                 "properties": [{"name": "plenum:use", "value": "in the page"}]}
    if "license" in entry:
        component["licenses"] = [{"license": {"name": entry["license"]}}]
    return component


def main():
    checkout, version, binary = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
    linked = sorted({package_of(file) for file in linked_files(binary)})
    named = (checkout / "packages.txt").read_text().split("\n")
    compiled = [name for name in named if name.startswith("lib") or name == "nlohmann-json3-dev"]
    compiled = [name for name in compiled if "gtest" not in name and "gmock" not in name]
    lock = json.loads((checkout / "web" / "package-lock.json").read_text())["packages"]
    page = {path.split("node_modules/")[-1]: entry for path, entry in lock.items()
            if path and not entry.get("dev") and not entry.get("optional")}
    components = ([of_debian(package, "linked") for package in linked] +
                  [of_debian(package, "compiled in") for package in sorted(compiled)] +
                  [of_debian(package, "in the documentation") for package in DOCS_PACKAGES] +
                  [of_npm(name, entry) for name, entry in sorted(page.items())])
    json.dump({"bomFormat": "CycloneDX", "specVersion": "1.5", "version": 1,
               "metadata": {"component": {"type": "application", "name": "plenum", "version": version,
                                          "licenses": [{"license": {"id": "Apache-2.0"}}]}},
               "components": components}, sys.stdout, indent=1, ensure_ascii=False)
    print()


if __name__ == "__main__":
    main()
