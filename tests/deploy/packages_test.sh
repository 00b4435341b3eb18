#!/usr/bin/env bash
# The packages, unpacked into an empty root: the command and the module design there with an empty home.
# usage: tests/deploy/packages_test.sh
set -euo pipefail
cd "$(dirname "$0")/../.."

deploy/package.sh >/dev/null
root=$(mktemp -d) home=$(mktemp -d)
trap 'rm -rf "$root" "$home"' EXIT
fail() { echo "packages: $*" >&2; exit 1; }

for package in build/packages/*.deb; do
  dpkg -x "$package" "$root"
  # Every library that it needs is named, so that apt installs it.
  depends=$(dpkg-deb -f "$package" Depends)
  for name in $(echo "$depends" | tr ',' '\n' | sed 's/[ |(].*//; s/^ *//' | awk '{print $1}'); do
    dpkg-query -W "$name" >/dev/null || fail "$package depends on $name, which is not installed"
  done
  grep -q ipopt <<<"$depends" || fail "$package does not name Ipopt: $depends"
done

dpkg-deb -f build/packages/python3-plenum_*.deb Depends | grep -q '^python3 (>= 3\.11), python3 (<< 3\.12), ' ||
  fail "python3-plenum is for another Python than Debian's"

installed() { (cd "$home" && env -i PATH=/usr/bin HOME="$home" "$@"); }
examples=$root/usr/share/doc/plenum/examples

began=$(date +%s)
installed "$root/usr/bin/plenum" design "$examples/exosuit.json" --top 1 --json >"$home/answer.json"
seconds=$(($(date +%s) - began))
python3 - "$home/answer.json" <<'P'
import json, sys
answer = json.load(open(sys.argv[1]))
assert answer["status"] == "optimal" and len(answer["designs"]) == 1, answer["status"]
P
[ -f "$home/.local/share/plenum/catalog.db" ] || fail "the user's catalogue did not begin"
echo "first design $seconds s after the installation"

installed PYTHONPATH="$root/usr/lib/python3/dist-packages" PLENUM_CATALOG="$root/usr/share/plenum/catalog.db" \
  /usr/bin/python3 - "$examples/gripper.json" <<'P'
import sys, plenum
assert plenum.design(sys.argv[1], top=1).proved
P

wheel=$(ls build/packages/plenum-*.whl)
/usr/bin/python3 - "$wheel" "$home/wheel" <<'P'
import sys, zipfile
zipfile.ZipFile(sys.argv[1]).extractall(sys.argv[2])
P
installed PYTHONPATH="$home/wheel" /usr/bin/python3 - "$examples/gripper.json" <<'P'
import sys, plenum
assert plenum.design(sys.argv[1], top=1).proved
P

zcat "$root/usr/share/man/man1/plenum.1.gz" | grep -q '^\.SS "plenum design"' || fail "no manual page"
[ -f "$root/usr/share/plenum/docs/reference/generated/requirements.html" ] || fail "no documentation"
(cd "$home" && exec env -i PATH=/usr/bin HOME="$home" "$root/usr/bin/plenum" serve --port 0 --no-log) 2>"$home/serve.txt" &
service=$!
trap 'kill "$service" 2>/dev/null; rm -rf "$root" "$home"' EXIT
for _ in $(seq 100); do grep -q listens "$home/serve.txt" && break; sleep 0.1; done
python3 - "$home/serve.txt" <<'P' || fail "the documentation is not served"
import http.client, re, sys
connection = http.client.HTTPConnection("127.0.0.1", int(re.search(r":(\d+)/", open(sys.argv[1]).read()).group(1)))
connection.request("GET", "/docs/tutorials/first_design.html")
answer = connection.getresponse()
assert answer.status == 200 and b"A first design" in answer.read()
P
[ -f "$root/usr/share/bash-completion/completions/plenum" ] || fail "no completion"
grep -q 'ExecStart=/usr/bin/plenum serve' "$root/usr/lib/systemd/system/plenum.service" || fail "no unit"
python3 - "$root/usr/share/doc/plenum/plenum.cdx.json" "$root/usr/bin/plenum" <<'P'
import json, re, subprocess, sys
bom = json.load(open(sys.argv[1]))
assert bom["bomFormat"] == "CycloneDX" and bom["specVersion"] == "1.5"
names = {component["name"] for component in bom["components"]}
linked = subprocess.run(["ldd", sys.argv[2]], capture_output=True, text=True, check=True).stdout
missing = [need for need in ("libsqlite3-0", "libceres-dev", "preact", "uplot", "nlohmann-json3-dev") if need not in names]
assert not missing, missing
assert len(re.findall("=>", linked)) <= 3 * len(names)
P
echo "packages: all well"
