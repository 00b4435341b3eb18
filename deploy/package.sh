#!/usr/bin/env bash
# Builds the packages plenum and python3-plenum (.deb) and a wheel into build/packages/.
# usage: deploy/package.sh
set -euo pipefail
cd "$(dirname "$0")/.."
. ./setup.sh

install_packages $python_packages $docs_packages dpkg-dev file
configure release -D PLENUM_PYTHON=ON -D PLENUM_PACKAGES=ON
cmake --build --preset release --target package_files >&2
rm -rf build/docs/html
docs/build.sh >&2
rm -rf build/packages
(cd build/release && cpack --config CPackConfig.cmake >&2)
rm -rf build/packages/_CPack_Packages
python3 deploy/wheel.py build/release/python/plenum catalog.db build/packages
ls -l build/packages
