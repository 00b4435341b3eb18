#!/usr/bin/env python3
"""A wheel of the package as it stands in a build folder, with the seed catalogue in it.

It needs the libraries of Debian 12 that the Debian package python3-plenum depends on.
usage: wheel.py FOLDER SEED TARGET
"""
import base64
import hashlib
import pathlib
import subprocess
import sys
import zipfile

METADATA = """Metadata-Version: 2.1
Name: plenum
Version: {version}
Summary: Pneumatic supplies for soft robots, chosen with a proof
License: Apache-2.0
Requires-Python: ==3.11.*
Requires-Dist: numpy
Provides-Extra: pictures
Requires-Dist: pandas; extra == "pictures"
Requires-Dist: matplotlib; extra == "pictures"
"""
WHEEL = """Wheel-Version: 1.0
Generator: plenum
Root-Is-Purelib: false
Tag: {tag}
"""
TAG = "cp311-cp311-linux_x86_64"


def digest(data):
    return base64.urlsafe_b64encode(hashlib.sha256(data).digest()).decode().rstrip("=")


def main():
    folder, seed, target = map(pathlib.Path, sys.argv[1:4])
    version = subprocess.run(["/usr/bin/python3", "-c", "import plenum; print(plenum.__version__)"], check=True,
                             cwd=folder.parent, capture_output=True, text=True).stdout.strip()
    info = f"plenum-{version}.dist-info"
    files = {f"plenum/{path.name}": path.read_bytes() for path in sorted(folder.iterdir()) if path.is_file()}
    files["plenum/catalog.db"] = seed.read_bytes()
    files[f"{info}/METADATA"] = METADATA.format(version=version).encode()
    files[f"{info}/WHEEL"] = WHEEL.format(tag=TAG).encode()
    record = "".join(f"{name},sha256={digest(data)},{len(data)}\n" for name, data in files.items())
    files[f"{info}/RECORD"] = (record + f"{info}/RECORD,,\n").encode()
    target.mkdir(parents=True, exist_ok=True)
    with zipfile.ZipFile(target / f"plenum-{version}-{TAG}.whl", "w", zipfile.ZIP_DEFLATED) as wheel:
        for name, data in files.items():
            wheel.writestr(zipfile.ZipInfo(name, (2026, 1, 1, 0, 0, 0)), data, zipfile.ZIP_DEFLATED)


if __name__ == "__main__":
    main()
