#!/usr/bin/env bash
# The search and its rivals on one base-model instance: installs what is missing, builds with -O3
# -march=native, prints the conditions, every rival's formulation and options, and the tables. Not 0
# where the search misses an optimum. About an hour, most of it rivals that run to their limit.
#   bench/search/run.sh [SIZE…]
set -euo pipefail
cd "$(dirname "$0")/../.."
. ./setup.sh

install_packages libsundials-dev libboost-dev coinor-libbonmin-dev coinor-libcbc-dev libpagmo-dev \
  python3-scipy python3-numpy
configure rivals
cmake --build --preset rivals >&2

sizes=("$@")
[ ${#sizes[@]} -gt 0 ] || sizes=(30 100)
time_limit_s=60
core=$(taskset -cp $$ | sed 's/.*[ ,-]//') # the last one that we may use
results=$(mktemp)
trap 'rm "$results"' EXIT

echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), core $core," \
  "load $(cut -d' ' -f1 /proc/loadavg); $time_limit_s s for each run of a prover"
echo "Libraries:$(dpkg-query -W -f ' ${Package} ${Version}' \
  coinor-libbonmin4 coinor-libcbc3 libpagmo8 python3-scipy)"
echo
taskset -c "$core" build/rivals/rivals "$results" "${sizes[@]}" --instances 10 \
  --time-limit "$time_limit_s" >&2
# Debian's Python, which has Debian's SciPy.
taskset -c "$core" /usr/bin/python3 bench/search/rivals_scipy.py \
  build/rivals/bench/search/libbase_library.so "$results" "$time_limit_s"
/usr/bin/python3 bench/search/rivals_table.py "$results"
