# Sourced by run.sh and test.sh: the packages of packages.txt, then one preset configured.

rule_packages="python3 universal-ctags"  # of tests/rules
python_packages="python3-dev pybind11-dev python3-numpy python3-pandas python3-matplotlib mypy"  # of python/
docs_packages="python3-sphinx python3-myst-parser python3-breathe doxygen furo python3-sphinx-copybutton curl"  # of docs/
sanitizer_packages="clang-14 libclang-rt-14-dev"  # of the preset asan
server_packages="postgresql-15"  # of tests of catalogues on a server, which are skipped without it

missing_packages() {  # names of packages.txt and of the arguments that are not installed
  local package
  for package in $(grep -v '^#' packages.txt) "$@"; do
    dpkg-query -W -f '${Status}' "$package" 2>/dev/null | grep -q '^install ok installed$' ||
      echo "$package"
  done
}

install_packages() {
  local missing
  if ! command -v apt-get >/dev/null; then
    echo "No apt-get here: what packages.txt names must be installed already." >&2
    return 0
  fi
  missing=$(missing_packages "$@" | tr '\n' ' ')
  [ -n "$missing" ] || return 0
  local as_root=
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "Missing Debian packages; install them as root, then run this again:" >&2
      echo "  apt-get install --no-install-recommends $missing" >&2
      exit 1
    fi
    as_root=sudo
  fi
  echo "Installing: $missing" >&2
  $as_root apt-get update -q >&2
  # shellcheck disable=SC2086
  $as_root env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends $missing >&2
}

configure() {  # configure PRESET [OPTIONS]; ninja notices changed CMake files by itself afterwards
  [ -f "build/$1/build.ninja" ] && [ $# -eq 1 ] || cmake --preset "$@" >&2
}
