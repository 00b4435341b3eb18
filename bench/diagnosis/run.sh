#!/usr/bin/env bash
# Judges `plenum diagnose` on measured data sets with known truth.
#   bench/diagnosis/run.sh [SERIES] [CASES] [FOLDER] [TIES]
# Draws the cases of a series (200), decides which can be told apart, diagnoses each with the command
# as users have it, two at a time, carries out the experiments that it proposes, and prints how it
# did beside targets fixed beforehand. The same, apart from them, of single effects in runs that show
# little (102, in FOLDER/ties). FOLDER keeps everything; a second run goes on where it ended.
set -euo pipefail
cd "$(dirname "$0")/../.."
. ./setup.sh

series=${1:-1}
cases=${2:-200}
folder=${3:-build/diagnosis-$series}
ties=${4:-102}

install_packages libsundials-dev libboost-dev
configure release
cmake --build --preset release --target plenum >&2
configure bench
cmake --build --preset bench --target make_cases identify rival extend_case >&2

tools=build/bench
mkdir -p "$folder/ties"
"$tools/make_cases" "$series" "$cases" "$folder" >&2 || echo "Some cases could not be drawn." >&2
"$tools/make_cases" "$series" "$ties" "$folder/ties" tie >&2 ||
  echo "Some ties could not be drawn." >&2
for part in "$folder" "$folder/ties"; do
  "$tools/identify" "$part" 2 2>>"$folder/identify.log" || echo "Some cases were not judged." >&2
  python3 bench/diagnosis/run_cases.py build/release/plenum "$part" "$tools/extend_case"
done
"$tools/rival" "$folder" 2>>"$folder/rival.log" || echo "Some rivals failed." >&2

echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)," \
  "load $(cut -d' ' -f1 /proc/loadavg); series $series, $cases cases and $ties ties"
python3 bench/diagnosis/judge.py "$folder"
