#!/usr/bin/env bash
# plenum.simulate_many beside SciPy. usage: bench/python/run.sh [RIGS=10000] [OF_SCIPY=200]
set -euo pipefail
cd "$(dirname "$0")/../.."
. ./setup.sh
install_packages $python_packages python3-scipy
configure release -D PLENUM_PYTHON=ON
cmake --build --preset release --target plenum_package >&2
PYTHONPATH=build/release/python /usr/bin/python3 bench/python/simulate_many.py "$@"
