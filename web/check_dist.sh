#!/usr/bin/env bash
# Whether web/dist is what the sources build. Needs Node 20.19 or later.
set -euo pipefail
cd "$(dirname "$0")"
[ -d node_modules ] || npm ci
built=$(mktemp -d)
trap 'rm -rf "$built"' EXIT
npx tsc --noEmit
npx vite build --logLevel warn --outDir "$built/dist"
diff -r "$built/dist" dist && echo "web/dist is up to date" || {
  echo "web/dist is not what the sources build: npm run build" >&2
  exit 1
}
