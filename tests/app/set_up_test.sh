#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Set-up that takes longer than the wall time, or that a signal stops, ends with exit code 4 and keeps what was packed.
[ -z "${TSAN_OPTIONS:-}" ] || exit 77
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"
torus="$helpers/../regression/packed_torus.toml"

# run [OPTION...]: in the folder `torus`, one step of a body whose packing takes a second or more.
run() { "$program" run "$torus" --threads 1 --set run.end=1e-9 --out torus "$@"; }

# Each slot ends after the sweep that it is in, and the next slot goes on from there. Slots this short never finish the
# packing, however fast the processor is.
sweeps() { sed -n 's/.*after \([0-9]*\) of at most.*/\1/p' said.txt; }
last=0
for _ in 1 2 3; do
  run --wall-time "1 ms" 2> said.txt
  check test $? -eq 4
  check grep -q "continues from there" said.txt
  check test "$(sweeps)" -gt $last
  last=$(sweeps)
done
check test -s torus/unfinished-set-up/packed-*.cloud
check test ! -e torus/summary.json

# A signal ends set-up, whatever it is at; then, without a limit, the run has its particles.
"$program" run "$torus" --threads 1 --set run.end=1e-9 --out torus --quiet &
child=$!
for _ in $(seq 500); do
  mask=$(awk '/^SigCgt/ { print $2 }' /proc/$child/status 2> /dev/null)
  ((0x${mask:-0} & 0x4000)) && break
  sleep 0.01
done
kill -s TERM $child
wait $child
check test $? -eq 4
expect 0 "completed" run
check test ! -e torus/unfinished-set-up

# The same places as without stops. A folder with other things is left alone.
mkdir foreign
echo mine > foreign/notes.txt
expect 4 "not kept" "$program" run "$torus" --threads 1 --out foreign --wall-time "1 ms"
check test "$(ls foreign)" = notes.txt
"$program" run "$torus" --set run.end=1e-9 --out whole --quiet
check cmp torus/case-files/packed-*.cloud whole/case-files/packed-*.cloud
finish
