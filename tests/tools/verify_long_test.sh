#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# tools/verify_long counts what truly ran: in a copy of the project's tools, with made-up cmake, ctest, setarch and
# clang-tidy.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
mkdir -p "$work/house/src/piola/base" "$work/house/app" "$work/bin" "$work/elsewhere"
cp -r "$root/tools" "$work/house/"
printf '#!/bin/sh\nexit 0\n' >"$work/house/tools/install_dependencies"
touch "$work/house/src/piola/base/a.cpp" "$work/house/app/main.cpp"

fake() {  # fake NAME LINE...: a command of that name with these lines
  { echo '#!/bin/bash'; printf '%s\n' "${@:2}"; } >"$work/bin/$1"
  chmod +x "$work/bin/$1"
}
good_setarch='shift 2; exec "$@"'
fake cmake 'exit 0'
fake ctest 'echo "ctest $*" >>'"$work"'/calls; echo "100% tests passed, 0 tests failed out of 7"'
fake setarch "echo \"setarch \$*\" >>$work/calls" "$good_setarch"
fake clang-tidy 'echo "tidy $*" >>'"$work"'/calls'

run() { (cd "$work/elsewhere" && PATH="$work/bin:$PATH" ../house/tools/verify_long "$@" 2>&1); }
expect() {  # expect STATUS TEXT STAGE...
  local output status=0
  : >"$work/calls"
  output=$(run "${@:3}") || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "verify_long ${*:3}: expected status $1 and the text '$2', got status $status and"
    echo "$output"
    failures=$((failures + 1))
  fi
}
called() { grep -q -- "$1" "$work/calls" || { echo "not called: $1"; failures=$((failures + 1)); }; }

expect 1 "tsan     never" --last
stages="clang asan tsan sets ranks mutants fuzz readers verify pictures browser tidy site"
expect 2 "unknown stage 'tsam' (allowed: $stages, or --last)" tsam
expect 0 "10 passed, 0 failed" asan           # packages, configure, build and seven tests
expect 0 "11 passed, 0 failed" tsan
called "setarch $(uname -m) -R ctest --preset tsan"
expect 1 "asan     2" --last                  # some stages never ran

# A setarch that fails, before the build or later, is no success.
fake setarch 'exit 1'
expect 1 "2 failed" tsan asan tsan
expect 1 "0 passed, 1 failed" --last
fake setarch '[[ $3 == true ]]'
expect 1 "FAILED: ctest did not run" tsan
fake setarch "$good_setarch"

# Tests that fail are counted, for every stage that runs tests.
fake ctest 'echo "71% tests passed, 2 tests failed out of 7"; exit 8'
expect 1 "8 passed, 2 failed" asan
fake ctest 'exit 1'
expect 1 "FAILED: ctest did not run" asan

# clang-tidy sees every file, and one finding fails the stage.
expect 0 "3 passed, 0 failed" tidy
called "app/main.cpp"
called "src/piola/base/a.cpp"
fake clang-tidy '[[ $* != *main.cpp ]]'
expect 1 "FAILED: clang-tidy over 2 files" tidy

# Some tests only: noted as a part, which is not the whole stage.
fake ctest 'echo "ctest $*" >>'"$work"'/calls; echo "100% tests passed, 0 tests failed out of 1"'
export PIOLA_TEST_FILTER=Shapes
expect 0 "4 passed, 0 failed" asan
called "-R Shapes"
expect 1 "tests 'Shapes' only" --last

echo "verify_long_test: $failures failures"
[[ $failures -eq 0 ]]
