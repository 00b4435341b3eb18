#!/usr/bin/env bash
# Installs what is missing, builds build/release/plenum and designs the exosuit's supply.
set -euo pipefail
cd "$(dirname "$0")"
. ./setup.sh

install_packages
configure release
cmake --build --preset release --target plenum >&2
build/release/plenum design examples/exosuit.json "$@"
