#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Standard streams that are closed, full or left by their reader: a run goes on and its files are whole; a command whose
# result is its output says that it failed.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

# code N COMMAND...: the command ends with this code.
code() {
  local wanted=$1 got
  shift
  "$@"
  got=$?
  [ $got -eq "$wanted" ] || { echo "FAILED: exit code $got instead of $wanted: $*"; failures=$((failures + 1)); }
}

# A run that warns (its picture field is unknown), with all kinds of broken streams.
run() { "$program" run bar.toml --out "$1" --set run.end='"5 ms"' --set output.frames.every='"1 ms"'; }
reference_of() { (cd "$1" && cat history.csv frames/*.hdf | cksum); }
run whole > /dev/null 2>&1 || { echo "FAILED: the plain run"; failures=$((failures + 1)); }
closed_out() { run a >&- 2> /dev/null; }
closed_err() { run b > /dev/null 2>&-; }
closed_both() { run c >&- 2>&-; }
closed_all() { run d <&- >&- 2>&-; }
full_out() { run e > /dev/full 2> /dev/null; }
full_err() { run f > /dev/null 2> /dev/full; }
full_both() { run g > /dev/full 2> /dev/full; }
left_by_reader() { exec 4> >(true); wait $!; run h >&4 2>&4; }
for way in closed_out closed_err closed_both closed_all full_out full_err full_both left_by_reader; do code 0 $way; done
for folder in a b c d e f g h; do
  check test "$(reference_of $folder)" = "$(reference_of whole)"
  check grep -q '"status": "completed"' $folder/summary.json
done

# Warnings and errors have nowhere to go either: exit codes stay.
failing() { "$program" run bar.toml --out broken --set 'body.bar.initial_velocity=["0","0","-20000*Z"]' "$@"; }
closed_failing() { failing >&- 2>&-; }
full_failing() { failing > /dev/full 2> /dev/full; }
wrong_case() { "$program" run nothing.toml 2>&-; }
wrong_word() { "$program" fly > /dev/full 2> /dev/full; }
code 3 closed_failing
code 3 full_failing
code 2 wrong_case
code 2 wrong_word

# Where the output is the result.
mkdir -p cases/one
cp bar.toml cases/one/case.toml
cat > cases/one/checks.toml <<'CHECKS'
[[variant]]
name = "short"
set = ["run.end=\"1 ms\""]
short = true
[[check]]
quantity = "steps"
reference = 0
kind = "above"
source = "a run has steps"
evidence = "code"
CHECKS
results() {
  case $1 in
    describe) "$program" describe material neo_hookean ;;
    page) "$program" describe --markdown ;;
    check) "$program" check bar.toml ;;
    json) "$program" verify --cases cases --json ;;
    table) "$program" verify --cases cases ;;
    help) "$program" --help ;;
    version) "$program" --version ;;
  esac
}
to_full() { results "$1" > /dev/full; }
to_closed() { results "$1" >&-; }
to_nobody() { exec 4> >(true); wait $!; results "$1" >&4; }
for result in describe page check json table help version; do
  results $result > plain.txt 2> /dev/null || { echo "FAILED: $result"; failures=$((failures + 1)); }
  check test -s plain.txt
  expect 1 "standard output: cannot be written, No space left on device" to_full $result
  expect 1 "standard output: cannot be written, Bad file descriptor" to_closed $result
  code 1 to_nobody $result 2> /dev/null
done
finish
