# shellcheck shell=bash
# SPDX-License-Identifier: Apache-2.0
# Shared by tools/test and tools/verify_long: named stages, a count of what passed and failed, one closing line.

passed=0
failed=0
skipped=0
jobs=${PIOLA_JOBS:-$(nproc)}

# stage TITLE: a heading with the time since the start.
stage() { printf '\n== %s  [%d s]\n' "$1" "$SECONDS"; }

# check NAME COMMAND...: runs the command; counts one test.
check() {
  local name=$1
  shift
  if "$@" </dev/null; then
    passed=$((passed + 1))
  else
    failed=$((failed + 1))
    echo "FAILED: $name"
    return 1
  fi
}

# quietly LOG COMMAND...: output goes to LOG; the errors in it are shown if the command fails.
quietly() {
  local log=$1
  shift
  if ! "$@" >"$log" 2>&1; then
    grep -nE '(error|warning):|FAILED|CMake Error|undefined reference' -A 6 "$log" | head -n 60 || true
    echo "(the whole log is in $log)"
    return 1
  fi
}

# build PRESET [OPTION...]: configures and builds everything of a preset; counts one test.
build() {
  local preset=$1
  shift
  mkdir -p "build/$preset"
  check "configure $preset" quietly "build/$preset/configure.log" cmake --preset "$preset" "$@" &&
    check "build $preset" quietly "build/$preset/build.log" cmake --build --preset "$preset" -- -k 0 -j"$jobs"
}

# run_ctest PRESET [COMMAND...]: every test counts; ctest runs under the command, if there is one. PIOLA_TEST_FILTER, a
# regular expression, chooses tests by name.
run_ctest() {
  local preset=$1 log=build/$1/ctest.log summary bad all left_out
  shift
  local chosen=(--preset "$preset" -j"$jobs" --timeout 600 --no-tests=error)
  if [[ -n ${PIOLA_TEST_FILTER:-} ]]; then
    chosen+=(-R "$PIOLA_TEST_FILTER")
  fi
  # Tests run side by side, each with several threads: one that spins while it waits takes the core of another
  # (four of them side by side: 12.9 s, and 1.1 s asleep).
  export OMP_WAIT_POLICY=passive
  "$@" ctest "${chosen[@]}" >"$log" 2>&1 </dev/null || true
  summary=$(grep -E 'tests passed, [0-9]+ tests? failed out of [0-9]+' "$log" || true)
  if [[ -z $summary ]]; then
    tail -n 20 "$log"
    failed=$((failed + 1))
    echo "FAILED: ctest did not run"
    return 1
  fi
  bad=$(sed -E 's/.* ([0-9]+) tests? failed out of.*/\1/' <<<"$summary")
  all=$(sed -E 's/.*out of ([0-9]+).*/\1/' <<<"$summary")
  left_out=$(grep -cE '^ *[0-9]+/[0-9]+ Test .*\*\*\*Skipped' "$log" || true)
  passed=$((passed + all - bad - left_out))
  failed=$((failed + bad))
  skipped=$((skipped + left_out))
  if [[ $bad -gt 0 ]]; then
    grep -vE '^ *[0-9]+/[0-9]+ Test .*(Passed|Skipped)|^ *Start |\(Skipped\)$|^Note: |^\[[-=]{10}\]' "$log" |
      cut -c1-400 | tail -n 200
    echo "(the whole log is in $log)"
    return 1
  fi
  grep -E 'Total Test time' "$log" || true
}

# finish: the closing line and the exit status.
finish() {
  printf '\n%d s, %d skipped\n' "$SECONDS" "$skipped"
  echo "$passed passed, $failed failed"
  [[ $failed -eq 0 ]]
}
