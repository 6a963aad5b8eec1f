#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# What signals and --wall-time do to a run: stop or go on, with a checkpoint from which it continues to the same bits.
# The thread sanitizer holds signals back and handles them itself.
[ -z "${TSAN_OPTIONS:-}" ] || exit 77
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

# start FOLDER [OPTION...]: a run that would last for hours, in the background; returns when it steps.
start() {
  local folder=$1
  shift
  "$program" run bar.toml --set run.end='"1000 s"' --set output.frames.every='"1 h"' \
    --set output.pictures.every='"1 h"' --set output.checkpoints.every='"1 h"' --quiet --out "$folder" "$@" &
  child=$!
  until_there 20 "$folder/history.csv"
  sleep 0.2
}
# ended CODE: the run in the background ends with this code.
ended() {
  local got
  wait $child
  got=$?
  [ $got -eq "$1" ] || { echo "FAILED: exit code $got instead of $1 in $folder"; failures=$((failures + 1)); }
}
# Waits until the run in the background has its handler of SIGUSR1, before which nothing can keep a signal: with
# sanitizers a program takes long to load.
until_caught() {
  local mask
  for _ in $(seq 500); do
    mask=$(awk '/^SigCgt/ { print $2 }' /proc/$child/status 2> /dev/null)
    ((0x${mask:-0} & 0x200)) && return
    sleep 0.01
  done
}
newest() { ls "$1"/checkpoints/*.h5 2> /dev/null | tail -1; }

# Stop with a checkpoint.
for signal in INT TERM HUP USR2; do
  folder=stop-$signal
  start $folder
  kill -s $signal $child
  ended 4
  check test -s "$(newest $folder)"
  check grep -q '"status": "stopped"' $folder/summary.json
done

# Checkpoint and go on, twice; then the process is killed, and continues from the second.
folder=asked
start $folder
kill -s USR1 $child
for _ in $(seq 100); do [ -n "$(newest $folder)" ] && break; sleep 0.05; done
first=$(newest $folder)
check test -s "$first"
kill -s USR1 $child
asked() { grep -c 'checkpoint at step .* as asked' $folder/log.txt; }  # the log follows the file
for _ in $(seq 100); do [ "$(asked)" -eq 2 ] && break; sleep 0.05; done
check test "$(newest $folder)" != "$first"
check kill -s 0 $child
kill -s KILL $child
ended 137
check test "$(asked)" -eq 2
expect 4 "" "$program" resume $folder --wall-time "1 s"

# Before a run steps, requests for checkpoints are kept, not fatal; afterwards the bits are those of a quiet run.
"$program" run bar.toml --quiet --out quiet
"$program" run bar.toml --quiet --out disturbed &
child=$! folder=disturbed
until_caught
for _ in $(seq 20); do sleep 0.02; kill -s USR1 $child 2> /dev/null; done
ended 0
check cmp quiet/history.csv disturbed/history.csv
check cmp quiet/frames/000004.hdf disturbed/frames/000004.hdf

# nohup: a hangup that is ignored at the start stays ignored.
folder=detached
(trap '' HUP; exec "$program" run bar.toml --set run.end='"1000 s"' --quiet --out detached) &
child=$!
until_there 20 detached/history.csv
kill -s HUP $child
sleep 0.3
check kill -s 0 $child
kill -s TERM $child
ended 4

# A second signal ends a run at once that hangs: here for ever, in a write to a pipe that is full and that nobody reads.
folder=hanging
mkfifo pipe
exec 3<> pipe
dd if=/dev/zero bs=65536 count=1 >&3 2> /dev/null
"$program" run bar.toml --out hanging > pipe &
child=$!
sleep 3  # it has written to the pipe by then
kill -s TERM $child
kill -s TERM $child  # tools often signal twice, the process and its group
sleep 0.7
check kill -s 0 $child
kill -s TERM $child
ended 143
exec 3>&-

# The wall time: in time, with a checkpoint.
folder=timed
begin=$(date +%s%N)
expect 4 "the wall time is used up" "$program" run bar.toml --set run.end='"1000 s"' --out timed --wall-time "4000 ms"
spent=$((($(date +%s%N) - begin) / 1000000))
check test $spent -lt 6000
check test $spent -gt 2000  # a slow disk or a busy machine makes it leave more time for the checkpoint
check test -s "$(newest timed)"
check grep -q "the wall time is used up" timed/log.txt
expect 0 "completed" "$program" run bar.toml --out enough --wall-time 2h
check cmp quiet/history.csv enough/history.csv
# Cut into pieces by its wall time, a run comes to the same bits.
pieces() {
  "$program" run bar.toml --quiet --out pieces --wall-time "0.001 s"
  for _ in 1 2; do "$program" resume pieces --quiet --wall-time "0.001 s"; done
  "$program" resume pieces --quiet
}
expect 0 "" pieces
check cmp quiet/history.csv pieces/history.csv
check cmp quiet/frames/000004.hdf pieces/frames/000004.hdf

expect 2 '--wall-time: "5 m" is not a time' "$program" run bar.toml --wall-time "5 m"
expect 2 '--wall-time: "-1 s" leaves no time' "$program" run bar.toml --wall-time="-1 s"
expect 2 '--wall-time: "soon" is not a number' "$program" resume timed --wall-time soon
expect 2 'a time such as "2 h" is needed' "$program" resume timed --wall-time ""

# Threads: by the environment where the case does not say, and never turning idly unless the user wants it.
"$program" run bar.toml --set run.threads=auto --set run.end='"1 ms"' --out threads --force > said.txt
OMP_NUM_THREADS=3 "$program" run bar.toml --set run.threads=auto --set run.end='"1 ms"' --out threads --force > said.txt
check grep -q " 3 threads" said.txt
OMP_NUM_THREADS=3 "$program" run bar.toml --set run.end='"1 ms"' --out threads --force > said.txt
check grep -q " 1 thread$" said.txt
folder=waits
unset OMP_WAIT_POLICY
start waits
check grep -qz "GOMP_SPINCOUNT=" /proc/$child/environ
check grep -qz "KMP_BLOCKTIME=" /proc/$child/environ
kill -s TERM $child
ended 4
export OMP_WAIT_POLICY=active
start wishes
check grep -qz "OMP_WAIT_POLICY=active" /proc/$child/environ
check test "$(grep -cz "GOMP_SPINCOUNT=" /proc/$child/environ)" -eq 0
kill -s TERM $child
ended 4
finish
