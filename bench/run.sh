#!/usr/bin/env bash
# Compares integrators on one core: installs what is missing, builds with -O3 -march=native, prints
# the conditions and the tables. Not 0 where a method misses the accuracy or a rig fails.
set -euo pipefail
cd "$(dirname "$0")/.."
. ./setup.sh

install_packages libsundials-dev libboost-dev python3-scipy python3-numpy
configure bench
cmake --build --preset bench >&2

core=$(taskset -cp $$ | sed 's/.*[ ,-]//') # the last one that we may use
results=$(mktemp -d)
trap 'rm -r "$results"' EXIT
status=0
pinned() { taskset -c "$core" "$@" || status=1; }

echo "Machine: $(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1), core $core," \
  "load $(cut -d' ' -f1 /proc/loadavg)"
echo "Target: $(g++ -march=native -Q --help=target | awk '$1 == "-march=" {print $2}')" \
  "(SUNDIALS and SciPy: Debian's binaries as they are)"
echo "Libraries:$(dpkg-query -W -f ' ${Package} ${Version}' \
  libsundials-dev libboost1.74-dev python3-scipy python3-numpy)"
build/bench/batch_tests --gtest_brief=1 >&2
pinned build/bench/plenum_bench rise "$results"
pinned /usr/bin/python3 bench/rise_scipy.py "$results" # Debian's, which has Debian's SciPy
echo
pinned /usr/bin/python3 bench/rise_table.py "$results"
echo
pinned build/bench/plenum_bench growth
exit $status
