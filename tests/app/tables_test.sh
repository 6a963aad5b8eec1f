#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Loads from CSV files: what is said of them, settings, copies for resumed runs, studies of changed files.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

mkdir -p case/data
printf '%s\n' 'time [ms],p [kPa],other' '0,0,a' '5,5,b' '15,1,c' > case/data/pulse.csv
cp bar.toml case/case.toml
cat >> case/case.toml <<'TOML'
[[load]]
name = "push"
body = "bar"
acceleration = [{ file = "data/pulse.csv", column = "p", after = "zero" }, 0, 0]
TOML
# The load is an acceleration; its column must have that unit.
expect 2 'pulse.csv:1:11: the unit of "p"' "$program" check case
sed -i 's/p \[kPa\]/p [m s^-2]/' case/data/pulse.csv
said='table data/pulse.csv over t (3 rows, 0 s to 15 ms; before: 0 m/s^2, after: 0)'
expect 0 "acceleration ($said" "$program" check case
run() { "$program" run case --out "$1" --quiet --threads 1 "${@:2}"; }
check run whole --set 'run.end=20 ms'
expect 0 "$said" cat whole/log.txt

# A resumed run has the copy of the table.
check run half --set 'run.end=10 ms'
cp -r half there
check "$program" resume there --quiet --threads 1 --set 'run.end=20 ms'
mv case/data/pulse.csv kept.csv
check "$program" resume half --quiet --threads 1 --set 'run.end=20 ms'
check cmp there/history.csv half/history.csv
mv half/case-files/1-pulse.csv kept-copy.csv
expect 2 'cannot be read' "$program" resume half --quiet --set 'run.end=22 ms'
sed 's/^5,5/5,6/' kept.csv > case/data/pulse.csv
expect 2 'has changed' "$program" resume half --quiet --set 'run.end=22 ms'

# A changed file is another run; one key of a table may be set.
run_id() {
  python3 -c 'import json, sys; print(json.load(open(sys.argv[1] + "/summary.json"))["identity"]["run"])' "$1"
}
check run other --set 'run.end=20 ms'
check test "$(run_id whole)" != "$(run_id other)"
cp kept.csv case/data/pulse.csv
check run same --set 'run.end=20 ms'
check test "$(run_id whole)" = "$(run_id same)"
check run doubled --set 'run.end=20 ms' --set 'load.push.acceleration.0.scale=2'
check cmp <(head -n 1 doubled/history.csv) <(head -n 1 same/history.csv)
check test "$(sha256sum < doubled/history.csv)" != "$(sha256sum < same/history.csv)"
expect 2 'load.acceleration[0] has 2 of table, file' "$program" check case \
  --set 'load.push.acceleration.0.table=[[0, 1], [1, 2]]'

# The end of a table that must not be passed.
expect 3 'is not a number' run passed --set 'run.end=20 ms' --set 'load.push.acceleration.0.after=error'
expect 0 'the run will stop' "$program" check case --set 'run.end=20 ms' --set 'load.push.acceleration.0.after=error'
finish
