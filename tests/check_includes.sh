#!/bin/sh
# The rooms of the house: which may include which, and where each library's headers stay.
# usage: check_includes.sh SOURCE_DIR
cd "$1" || exit 2

complain() {  # complain WHY, lines on standard input
  lines=$(cat)
  [ -z "$lines" ] || printf '%s:\n%s\n' "$1" "$lines"
}

includes() {  # includes PATTERN FOLDER…: include lines that match
  pattern=$1
  shift
  find "$@" \( -name '*.h' -o -name '*.cc' -o -name '*.in' \) -exec grep -nHE \
    "^[[:space:]]*#[[:space:]]*include[[:space:]]*[<\"]($pattern)" {} +
}

arrow() {  # arrow ROOM MAY_NOT…
  room=$1
  shift
  pattern=$(printf '%s/|' "$@")
  includes "${pattern%|}" "$room" | complain "$room/ may not include this room"
}

stays_in() {  # stays_in LIBRARY PATTERN ROOM…
  library=$1
  pattern=$2
  shift 2
  for room in model catalog optimizer calibration api server; do
    case " $* " in *" $room "*) continue ;; esac
    includes "$pattern" "$room" | complain "$library may not be included in $room/"
  done
}

for room in model catalog optimizer calibration api server; do
  if [ -z "$(find "$room" -name '*.h')" ]; then
    echo "$room/ has no headers: nothing was checked"
    exit 2
  fi
done

check() {
  arrow model catalog optimizer calibration api server tests bench
  arrow catalog optimizer calibration api server tests bench
  arrow optimizer catalog calibration api server tests bench
  arrow calibration catalog optimizer api server tests bench
  arrow api server tests bench
  arrow server model catalog optimizer calibration tests bench
  arrow tests bench

  includes '\.\.?/' model catalog optimizer calibration api server |
    complain "includes name the room, not a relative path"

  stays_in cpp-httplib 'httplib' server
  stays_in nlohmann-json 'nlohmann/|json\.hpp' api
  stays_in SQLite 'sqlite3|SQLiteCpp/' catalog
  stays_in OpenSSL 'openssl/' catalog
  stays_in Ipopt 'coin/|Ip[A-Z]' optimizer
  stays_in NLopt 'nlopt' optimizer
  stays_in CLI11 'CLI/' server
  stays_in prometheus-cpp 'prometheus/' server
  stays_in fmt 'fmt/' server
  stays_in Boost 'boost/' model optimizer calibration
  stays_in SUNDIALS 'cvode|nvector/|sun(dials|linsol|matrix)' model
  stays_in Ceres 'ceres/' model calibration
  includes 'httplib' server | grep -v '^server/protocol\.h:' |
    complain "only server/wire/protocol.h includes cpp-httplib"
}

complaints=$(check)
[ -z "$complaints" ] && exit 0
printf '%s\n' "$complaints"
exit 1
