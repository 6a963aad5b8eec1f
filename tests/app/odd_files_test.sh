#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Pipes, devices, links and removed results: nothing waits for ever, nothing elsewhere is written to, nothing is silent.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"
in_time() { timeout 20 "$@"; }

# What is read must be a regular file.
mkfifo pipe.toml pipe.csv pipe.stl pipe.h5
expect 2 'pipe.toml: is a pipe (a regular file is needed)' in_time "$program" run pipe.toml
expect 2 'is a device' in_time "$program" check /dev/zero
expect 2 'pipe.toml: is a pipe' in_time "$program" study pipe.toml
points() {
  cat > points.toml <<END
title = "points"
run.end = "1 ms"
[[body]]
name = "b"
shape = $1
material = { law = "neo_hookean", density = 1100, youngs_modulus = "17 MPa", poissons_ratio = 0.45 }
formulation = { name = "jst_sph" }
END
}
for file in pipe.csv pipe.h5 /dev/zero; do
  points "{ points = { file = \"$file\" } }"
  expect 2 "$file" in_time "$program" check points.toml
done
points '{ mesh = { file = "pipe.stl", unit = "mm" }, spacing = "1 mm" }'
expect 2 'pipe.stl' in_time "$program" check points.toml

# What is written goes into the folder, whatever links stand there.
short() { "$program" run bar.toml --out "$1" --quiet --threads 1 --set 'run.end=2 ms' "${@:2}"; }
echo precious > precious
mkdir linked
ln -s ../precious linked/lock
expect 1 'a link stands there' short linked
rm linked/lock
for name in log.txt summary.json history.csv case.toml case.toml.part summary.json.part frames.hdf.series.part; do
  ln -s ../precious "linked/$name"
done
mkdir linked/checkpoints
ln -s ../../precious linked/checkpoints/wall_times.txt.part
check short linked --force --set 'output.frames.every=1 ms'
check test "$(find linked -type l | wc -l)" = 0
rm linked/log.txt
ln -s ../precious linked/log.txt
expect 1 'log.txt: cannot be written' "$program" resume linked --set 'run.end=3 ms'
rm linked/log.txt
ln -s ../precious linked/report.html.part
check "$program" report linked
expect 2 'pipe.toml: is a pipe' in_time "$program" report linked --checks pipe.toml
ln -s ../precious linked/energies.svg.part
check "$program" plot linked
printf 'case = "bar.toml"\n[parameters]\n"run.end" = ["1 ms"]\n' > one.toml
mkdir one-study
ln -s ../precious one-study/run-1.txt
ln -s ../precious one-study/study.csv.part
check "$program" study one.toml
check test "$(cat precious)" = precious

# Files of others in the folders of results stay; those of Piola are replaced.
short mine
echo 'mine' | tee mine/pictures/notes.txt mine/pictures/figure-1.png mine/frames/notes.txt > mine/checkpoints/mine.h5
echo 'not a picture of this run' > mine/pictures/Pressure-000900.png
check short mine
for file in pictures/notes.txt pictures/figure-1.png frames/notes.txt checkpoints/mine.h5; do
  check test "$(cat mine/$file)" = mine
done
check test ! -e mine/pictures/Pressure-000900.png

# Results that are removed while the run goes on are missed.
removed() {
  rm -rf gone
  "$program" run bar.toml --out gone --quiet --threads 1 --set 'run.end=1 s' --set 'output.frames.every=1 ms' \
    --set 'output.history.every=1 ms' > said 2>&1 &
  local child=$!
  until_there 20 gone/frames/000001.hdf
  rm -r gone/"$1"
  kill -TERM $child
  wait $child
  local code=$?
  cat said
  return $code
}
expect 1 'frames/000000.hdf' removed frames/000000.hdf
check grep -q '"status": "incomplete"' gone/summary.json
expect 1 'history.csv' removed history.csv
expect 1 'log.txt' removed log.txt

# Control characters reach neither terminal nor log.
escape=$(printf '\033')
sed 's/^title = .*/title = "red \\u001B[31m"/' bar.toml > red.toml
expect 2 'control character \x1b' "$program" run red.toml
expect 2 'there is no such case file' "$program" run "${escape}[31m.toml"
check test "$("$program" run "${escape}[31m.toml" 2>&1 | grep -c "$escape")" = 0
printf 'title = "%s"\n' "$(printf 'x%.0s' $(seq 600))" > long.toml
sed '/^title/d' bar.toml >> long.toml
expect 2 'the title has 600 characters (allowed: at most 500)' "$program" check long.toml
finish
