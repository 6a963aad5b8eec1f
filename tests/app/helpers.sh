# SPDX-License-Identifier: Apache-2.0
# shellcheck shell=bash
# Sourced by the tests that run the program as a user does: an empty folder to work in, a short case bar.toml, and words
# to say what is expected. The last line of a test is `finish`.
set -u
program="${PIOLA_PROGRAM:-}"
if [ ! -x "$program" ]; then
  echo "skipped: the program is not built"
  exit 77
fi
helpers=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
work=$(mktemp -d)
trap 'chmod -R u+w "$work"; rm -rf "$work"' EXIT
cd "$work" || exit 1
export OMP_WAIT_POLICY=passive
failures=0

cp "$helpers/bar.toml" .

# expect CODE TEXT COMMAND...: the command ends with this code and says this text.
expect() {
  local code=$1 text=$2 said got
  shift 2
  said=$("$@" 2>&1)
  got=$?
  if [ $got -ne "$code" ]; then
    echo "FAILED: exit code $got instead of $code: $*"
    echo "$said"
    failures=$((failures + 1))
  fi
  case "$said" in
    *"$text"*) ;;
    *) echo "FAILED: '$text' is missing in: $*"; echo "$said"; failures=$((failures + 1)) ;;
  esac
}
check() {
  "$@" || { echo "FAILED: $*"; failures=$((failures + 1)); }
}

# until_there SECONDS FILE: waits for a file.
until_there() {
  local tries=$(($1 * 20))
  until [ -s "$2" ] || [ $tries -eq 0 ]; do
    sleep 0.05
    tries=$((tries - 1))
  done
  check test -s "$2"
}
finish() {
  [ $failures -eq 0 ] && echo "all good"
  exit $((failures > 0))
}
