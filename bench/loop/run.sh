#!/usr/bin/env bash
# Judges the loop from an estimate over a measurement to a better list, in hidden worlds.
#   bench/loop/run.sh SEED [WORLDS] [FILE]
# Draws WORLDS (20) for each request of bench/loop/requirements.json from a SEED of one's own, lets
# engineers buy in each, and prints how they did. FILE keeps a line of JSON for each.
set -euo pipefail
cd "$(dirname "$0")/../.."
. ./setup.sh

seed=${1:?a seed, drawn after the code is fixed}
worlds=${2:-20}
file=${3:-build/loop-$seed.jsonl}

install_packages libsundials-dev libboost-dev
configure bench
cmake --build --preset bench --target loop_bench loop_tests >&2

build/bench/loop_tests --gtest_brief=1 >&2
build/bench/loop_bench catalog.db bench/loop/requirements.json "$seed" "$worlds" >"$file"
echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)," \
  "load $(cut -d' ' -f1 /proc/loadavg); seed $seed, $worlds worlds of each request"
python3 bench/loop/summary.py "$file"
