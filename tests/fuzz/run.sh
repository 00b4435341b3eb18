#!/usr/bin/env bash
# Fuzzes each target for SECONDS and keeps what is interesting in tests/fuzz/corpus.
# usage: tests/fuzz/run.sh [SECONDS=60] [TARGET…]     needs Debian's clang-14
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-60}
shift || true
targets=("$@")
[ ${#targets[@]} -gt 0 ] || targets=(requirements measurement csv query frame)

[ -f build/fuzz/build.ninja ] || cmake --preset fuzz >&2
cmake --build --preset fuzz -j "$(nproc)" >&2
for target in "${targets[@]}"; do
  found=$(mktemp -d)
  build/fuzz/fuzz_"$target" -max_total_time="$seconds" -max_len=20000 -timeout=10 \
    -rss_limit_mb=2048 -print_final_stats=1 -artifact_prefix="build/fuzz/$target-" \
    "$found" tests/fuzz/corpus/"$target"
  # Of what was found and what was there the smallest set that covers as much.
  kept=$(mktemp -d)
  build/fuzz/fuzz_"$target" -merge=1 "$kept" tests/fuzz/corpus/"$target" "$found" 2>/dev/null
  rm -f tests/fuzz/corpus/"$target"/*
  find "$kept" -type f -size -4k -exec cp -t tests/fuzz/corpus/"$target" {} +
  rm -r "$found" "$kept"
done
