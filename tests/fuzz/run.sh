#!/usr/bin/env bash
# Fuzzes each target for SECONDS, as many at a time as there are cores, and fails at the first crash,
# leak, hang or more than 2 GB; what did it lies in build/asan then.
# usage: tests/fuzz/run.sh [--keep] [SECONDS=60] [TARGET…]     needs Debian's clang-14
# Words of a target's documents are in tests/fuzz/words.
# --keep: adds what is interesting to tests/fuzz/corpus, as the smallest set that covers as much.
set -euo pipefail
cd "$(dirname "$0")/../.."
keep=
if [ "${1:-}" = --keep ]; then
  keep=1
  shift
fi
seconds=${1:-60}
shift || true
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(requirements measurement csv query frame
  design evaluation simulation diagnosis recording import verify)

[ -f build/asan/build.ninja ] || cmake --preset asan >&2
cmake --build --preset asan --target fuzzers >&2

fuzz() {  # fuzz TARGET: what it finds goes to build/asan/found/TARGET
  local target=$1 found=build/asan/found/$1
  rm -rf "$found"
  mkdir -p "$found"
  local words=()
  [ ! -f "tests/fuzz/words/$target.dict" ] || words=(-dict="tests/fuzz/words/$target.dict")
  if ! "build/asan/fuzz_$target" "${words[@]}" -max_total_time="$seconds" -max_len=20000 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/asan/$target-" \
    "$found" "tests/fuzz/corpus/$target" >"build/asan/$target.log" 2>&1; then
    tail -n 60 "build/asan/$target.log"
    echo "fuzz_$target failed"
    return 1
  fi
  echo "fuzz_$target: $(grep -o 'Done [0-9]* runs' "build/asan/$target.log"), nothing found"
}
export -f fuzz
export seconds
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c 'fuzz {}'

[ -n "$keep" ] || exit 0
for target in "${targets[@]}"; do
  kept=$(mktemp -d)
  "build/asan/fuzz_$target" -merge=1 "$kept" "tests/fuzz/corpus/$target" "build/asan/found/$target" 2>/dev/null
  find "$kept" -type f -size -4k -exec cp -n -t "tests/fuzz/corpus/$target" {} +
  rm -r "$kept"
done
