#!/usr/bin/env bash
# Judges `plenum diagnose` on cases as a workshop records them (tests/support/bench/real_case.h).
#   bench/diagnosis/real.sh [SERIES] [CASES] [FOLDER]
# Draws the cases of a series (200), diagnoses each with the command as users have it, two at a time,
# those with a name again of every second reading, and prints the shares. FOLDER keeps everything; a
# second run goes on where it ended.
set -euo pipefail
cd "$(dirname "$0")/../.."
. ./setup.sh

series=${1:-1}
cases=${2:-200}
folder=${3:-build/real-$series}

install_packages libsundials-dev libboost-dev
configure release
cmake --build --preset release --target plenum >&2
configure bench
cmake --build --preset bench --target make_cases >&2

mkdir -p "$folder"
build/bench/make_cases "$series" "$cases" "$folder" real >&2 || echo "Some cases could not be drawn." >&2
python3 bench/diagnosis/run_cases.py build/release/plenum "$folder" --halved
echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)," \
  "load $(cut -d' ' -f1 /proc/loadavg); series $series, $cases cases"
python3 bench/diagnosis/judge_real.py "$folder"
