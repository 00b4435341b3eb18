#!/usr/bin/env bash
# Installs what is missing, builds everything and runs all tests.
# ./test.sh [asan]   asan: with AddressSanitizer and UndefinedBehaviorSanitizer
set -euo pipefail
cd "$(dirname "$0")"
. ./setup.sh

preset=${1:-release}
case $preset in
  release | asan) ;;
  *)
    echo "usage: ./test.sh [asan]" >&2
    exit 2
    ;;
esac
install_packages
configure "$preset"
cmake --build --preset "$preset" >&2
ctest --preset "$preset" -j "$(nproc)"
