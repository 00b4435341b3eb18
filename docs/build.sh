#!/usr/bin/env bash
# Builds the documentation into build/docs/html: the pages of docs/, and those that the program writes of itself.
# Warnings are errors. Needs Debian's Sphinx, MyST, Breathe, Furo and Doxygen (setup.sh: docs_packages).
# usage: docs/build.sh [PROGRAM=build/release/plenum] [FOLDER=build/docs]
set -euo pipefail
cd "$(dirname "$0")/.."
[ -x /usr/bin/sphinx-build ] || { echo "docs: no sphinx-build here; setup.sh names the packages (docs_packages)" >&2; exit 77; }
program=${1:-build/release/plenum} folder=${2:-build/docs}
source=$folder/source

rm -rf "$source" "$folder/headers" "$folder/doxygen" "$folder/html.next"
mkdir -p "$source" "$folder/web"
cp -r docs/. "$source"
cp -r web/screenshots "$folder/web"  # which pages show as ../../web/screenshots
cp CHANGELOG.md "$source/changelog.md"
/usr/bin/python3 -B docs/generate/reference.py "$program" "$source/reference/generated"
/usr/bin/python3 -B docs/generate/doc_comments.py "$folder/headers" model
(cat docs/generate/Doxyfile; echo "INPUT = $folder/headers"; echo "OUTPUT_DIRECTORY = $folder/doxygen") | doxygen -q -
/usr/bin/python3 -B docs/generate/headers.py "$folder/doxygen/xml" "$source/reference/headers"
/usr/bin/sphinx-build -q -W --keep-going -j auto -d "$folder/doctrees" -D breathe_projects.plenum="$PWD/$folder/doxygen/xml" \
  -b html "$source" "$folder/html.next"
rm -rf "$folder/html"  # whose pages of before must not stay
mv "$folder/html.next" "$folder/html"
echo "$folder/html/index.html"
