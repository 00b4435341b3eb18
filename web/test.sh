#!/usr/bin/env bash
# Builds the page and the program, and tests the page as the program serves it in Debian's Chromium
# (apt-get install chromium) with a copy of the catalogue. Needs Node 20.19 or later.
# web/test.sh [NAME…]   only tests/NAME.test.mjs
set -euo pipefail
cd "$(dirname "$0")"
[ -d node_modules ] || npm ci
npm run build
cd ..
[ -f build/release/build.ninja ] || cmake --preset release
cmake --build --preset release --target plenum
tests=()
for name in "${@:-actions lists fields errors import documents recording finding access tank exchange protocol direct_pump vacuum both_rails gait double_acting regulation sweep own_units reload new_user speed}"; do
  for one in $name; do tests+=("web/tests/$one.test.mjs"); done
done
node --test --test-concurrency=1 "${tests[@]}"
