#!/usr/bin/env bash
# Reads of a part over 64 connections, the service and wrk (Debian) on two cores each, first alone,
# then while two optimisation jobs run; as fast as it goes, where answers queue, then with 2 ms between an
# answer and the next request of a connection, some 25,000 a second.
# usage: bench/service/reads.sh [SECONDS=10]     after building build/release/plenum
set -euo pipefail
cd "$(dirname "$0")/../.."
seconds=${1:-10}
folder=$(mktemp -d)
cp catalog.db "$folder"
taskset -c 0,1 build/release/plenum serve --port 0 --catalog "$folder/catalog.db" 2>"$folder/log" &
service=$!
trap 'kill -INT $service; wait $service || true; rm -r "$folder"' EXIT
sleep 1
url=$(sed -n '1s/.*at \(.*\)\//\1/p' "$folder/log")
id=$(curl -s "$url/v1/parts?limit=1" | grep -o '"id":"[^"]*"' | head -1 | cut -d'"' -f4)
ticks() { cut -d' ' -f14,15 "/proc/$service/stat" | tr ' ' '+' | bc; }

echo 'function delay() return 2 end' >"$folder/pause.lua"

measure() {  # measure NAME [wrk's options…]
  echo "== $1, load $(cut -d' ' -f1 /proc/loadavg)"
  local before after
  before=$(ticks)
  taskset -c 2,3 wrk -t2 -c64 -d"${seconds}s" --latency "${@:2}" "$url/v1/parts/$id" |
    tee "$folder/wrk" | grep -E '50%|99%|Requests/sec|requests in|Non-2xx' || true
  after=$(ticks)
  awk -v ticks=$((after - before)) '/requests in/ { printf "  %.1f µs of processor time a request (jobs included)\n", ticks * 1e4 / $1 }' "$folder/wrk"
}

measure "alone"
for _ in 1 2; do
  sed 's/"objective"[^}]*}/"objective": { "minimize": "volume_l" }/; s/"count": 20/"count": 100/' examples/exosuit.json |
    curl -s -o /dev/null --data-binary @- "$url/v1/designs"
done
sleep 1
curl -s "$url/v1/designs" | grep -o '"status":"[a-z]*"' | sort | uniq -c
measure "with two jobs, 2 ms between" -s "$folder/pause.lua"
measure "with two jobs"
curl -s "$url/v1/designs" | grep -o '"status":"[a-z]*"' | sort | uniq -c
