#!/usr/bin/env bash
# Installs what is missing, builds and runs tests.
# ./test.sh        all tests, in a release build
# ./test.sh fast   those that take seconds: what one runs after each edit
# ./test.sh doors  those that take seconds of the rooms that read what others wrote, with
#                  AddressSanitizer and UndefinedBehaviorSanitizer
# ./test.sh asan   all tests with both
# ./test.sh full   all tests in both, and what is too long for every commit
set -euo pipefail
cd "$(dirname "$0")"
. ./setup.sh

build() {  # build PRESET [TARGET...]; the release has the package for Python, too
  local preset=$1
  shift
  configure "$preset" $([ "$preset" != release ] || echo "-D PLENUM_PYTHON=ON")
  cmake --build --preset "$preset" ${1:+--target "$@"} >&2
}

run_tests() {  # run_tests PRESET [ARGUMENTS OF CTEST]; a table of durations: build/PRESET/tests.xml
  local preset=$1
  shift
  ctest --preset "$preset" -j "$(nproc)" --output-junit "$PWD/build/$preset/tests.xml" "$@"
}

long_tests() {
  tests/fuzz/run.sh 600
  PLENUM_KILLS=150 PLENUM_KILL_WRITES=6000 build/release/server_tests --gtest_filter='Kill.*'
  PLENUM_FAULTS_TOTAL=10000 python3 -B tests/server/faults/faults_test.py . build/release/plenum build/release/tests/libplenum_faults.so
  build bench batch_tests
  build/bench/batch_tests --gtest_brief=1
  tests/deploy/packages_test.sh
}

case ${1:-all} in
  all)
    install_packages $rule_packages $python_packages $docs_packages
    build release
    run_tests release
    ;;
  fast)
    install_packages $rule_packages $python_packages $docs_packages
    build release
    run_tests release -L fast
    ;;
  doors)
    install_packages $rule_packages $sanitizer_packages
    build asan catalog_tests api_tests server_tests
    run_tests asan -L '^(catalog|api|server)\.fast'
    ;;
  asan)
    install_packages $rule_packages $sanitizer_packages
    build asan
    run_tests asan
    ;;
  full)
    export PLENUM_FULL=1  # tests that are too long for every commit, and all draws of those by enumeration
    install_packages $rule_packages $sanitizer_packages $python_packages $docs_packages
    build release
    run_tests release
    build asan
    run_tests asan
    long_tests
    ;;
  *)
    echo "usage: ./test.sh [fast | doors | asan | full]" >&2
    exit 2
    ;;
esac
