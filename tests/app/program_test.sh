#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Runs the program as a user does: exit codes, results, signals, resume.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

expect 0 "run" "$program" --help
expect 0 "." "$program" --version
expect 2 "" "$program"
expect 2 "" "$program" fly
expect 2 "no such case file" "$program" run nothing.toml
expect 2 "" "$program" run bar.toml --set run.ende=1
check test ! -e bar-results

expect 0 "sway = " "$program" run bar.toml
for file in history.csv summary.json frames/000004.hdf frames.hdf.series \
  pictures/Pressure-000002.png case.toml log.txt; do
  check test -s "bar-results/$file"
done
expect 0 "" "$program" run bar.toml --quiet
check test -z "$("$program" run bar.toml --quiet 2>&1)"
expect 2 "holds the results of another case" "$program" run bar.toml --set 'title="Other"' --out bar-results
expect 0 "5 pictures" "$program" render bar-results --field Velocity --size 300 240
expect 2 "has no field 'Speed'" "$program" render bar-results --field Speed
expect 2 "no frames" "$program" render .
expect 0 "a film of 5 pictures is drawn to film/a.webp" "$program" render bar-results --film film/a.webp --size 300 240
expect 2 "is not the name of a film" "$program" render bar-results --film a.gif --size 300 240
expect 0 "Pressure-times.png" "$program" render bar-results --times "0 s, 1 ms" --view=-x --theme dark --out look
expect 2 "is not a time" "$program" render bar-results --times "0 m"
expect 0 "side-by-side/Pressure-0" "$program" render bar-results bar-results --side-by-side --last --size 300 240
expect 0 "Velocity-Pressure-000004.png" "$program" render --field Velocity --field Pressure bar-results --last
expect 2 "there are several" "$program" render bar-results --field Velocity --field Pressure --component x
expect 2 "2 folders are given" "$program" render bar-results bar-results
expect 2 "references stand over time" "$program" plot bar-results total_energy --against step --checks none.toml
expect 2 "there is one folder only" "$program" render bar-results --side-by-side
expect 2 "the case of the run has none" "$program" render bar-results --panels
expect 0 "drawn" "$program" render bar-results --last --quality high --warp 3 --supports --size 300 240
expect 0 "drawn" "$program" render bar-results --last --roll 4.5 --map grey --no-outline --no-labels --size 300 240
expect 2 "400 not in range -360" "$program" render bar-results --roll 400
expect 2 "rainbow not in" "$program" render bar-results --map rainbow
expect 2 "excludes" "$program" render bar-results --panels --field Velocity
expect 2 "'above' is not known" "$program" render bar-results --view above
expect 2 "is no direction" "$program" render bar-results --view 3 x
expect 0 "picture" "$program" render --view iso bar-results --last --size 300 240
expect 2 "folder is required" "$program" render --last
printf 'case = "bar.toml"\n[parameters]\n"run.cfl" = [0.4, 0.5]\n"run.end" = ["1 ms", "2 ms"]\n' >study.toml
expect 0 "4 of 4 completed" "$program" study study.toml
expect 0 "completed before" "$program" study study.toml --jobs 1
printf 'case = "bar.toml"\n[parameters]\n"run.cfl" = [0.4, -1]\n' >bad.toml
expect 2 "with run.cfl=-1" "$program" study bad.toml
expect 0 "curves drawn to bar-results/energies.svg" "$program" plot bar-results
expect 0 "1 curve drawn to dt.pdf" "$program" plot bar-results dt --log y -o dt.pdf
expect 2 'did you mean "total_energy"' "$program" plot bar-results total_energie
expect 2 "no history.csv" "$program" plot .
expect 2 "end in .svg, .png or .pdf" "$program" plot bar-results -o dt.gif
expect 0 "5 frames in bar-results/report.html" "$program" report bar-results
check test -s bar-results/report.html
expect 0 "5 frames in page/bar.html" "$program" report bar-results --follow -o page/bar.html # the run has ended
expect 2 'did you mean "Pressure"' "$program" report bar-results --fields Presure
expect 2 "holds no run" "$program" report page
expect 2 "end in .html" "$program" report bar-results --out bar.toml
expect 2 "end in .html" "$program" verify --report bar.toml
# A new run takes the page of the run before with it.
cp -r bar-results anew
expect 0 "" "$program" run bar.toml --quiet --out anew --set run.end='"1 ms"'
check test ! -e anew/report.html
expect 0 "completed, t = 20 ms" "$program" watch bar-results
expect 0 "top.displacement x from" "$program" watch bar-results top.displacement_x --once
expect 2 'did you mean "top.displacement_x"' "$program" watch bar-results top.displacement_y
expect 2 "holds no run" "$program" watch page
expect 0 "1 kN/mm = 1000000 in SI units" "$program" describe unit kN/mm
expect 0 "0 degC = 273.15 in SI units" "$program" describe unit degC
expect 2 "is not a unit" "$program" describe unit parsnips
expect 0 "piola plot" "$program" describe man-page
expect 0 "complete -F _piola piola" "$program" describe completion
expect 0 "drawn to look/shape.png" "$program" render --shape bar.toml -o look/shape.png --size 300 240
check test -s look/shape.png
expect 2 "no body of the case has patches" "$program" render --shape bar.toml --patches
expect 2 "add .png" "$program" render --shape bar.toml --out look
expect 2 "excludes" "$program" render --shape bar.toml --last
expect 2 "no such case file" "$program" render --shape nothing.toml

# A number without its unit is allowed, but never in silence: on the screen, in the log and in the summary.
expect 0 "so that the run is a single step" "$program" run bar.toml --quiet --out soft \
  --set body.bar.material.youngs_modulus=17 --set 'body.bar.initial_velocity=["0.01*Z","0","0"]'
check grep -q "softer than any jelly" soft/log.txt
check grep -q "softer than any jelly" soft/summary.json
expect 0 "2 warnings: see log.txt" "$program" run bar.toml --out soft \
  --set body.bar.material.youngs_modulus=17 --set 'body.bar.initial_velocity=["0.01*Z","0","0"]' --force

# A run that lost its newest checkpoint continues to the same bytes.
cp -r bar-results parts
rm "$(ls parts/checkpoints/*.h5 | tail -1)"
expect 0 "completed" "$program" resume parts
check cmp bar-results/history.csv parts/history.csv
check cmp bar-results/frames/000004.hdf parts/frames/000004.hdf

# A damaged newest checkpoint is passed over.
cp -r bar-results damaged
truncate -s 2000 "$(ls damaged/checkpoints/*.h5 | tail -1)"
expect 0 "warning: " "$program" resume damaged
check cmp bar-results/history.csv damaged/history.csv
echo "# a comment changes nothing" >> damaged/case.toml
expect 0 "completed" "$program" resume damaged
expect 2 "bar.material.density: \"1100 kg/m^3\" -> 1200" "$program" resume damaged --set body.bar.material.density=1200
check test -z "$(grep 1200 damaged/case.toml)"
expect 2 "holds no case.toml" "$program" resume .

# A finished run is extended to the bytes of the longer run.
more="--set output.history.every=0.001"
"$program" run bar.toml --quiet --out longer $more --set run.end=0.0263
"$program" run bar.toml --quiet --out extended $more
expect 0 "completed" "$program" resume extended --set run.end=0.0263 --threads 1
for file in history.csv frames/000004.hdf frames/000006.hdf frames.hdf.series; do
  check cmp longer/$file extended/$file
done
check grep -q 'changed: run.end: "20 ms" -> 0.0263' extended/log.txt
expect 2 "lies before the newest checkpoint" "$program" resume extended --set run.end=0.01

# A signal leads to a checkpoint and exit code 4.
"$program" run bar.toml --set run.end='"1000 s"' --out long --quiet &
child=$!
for _ in $(seq 100); do
  [ -e long/checkpoints ] && ls long/checkpoints/*.h5 > /dev/null 2>&1 && break
  sleep 0.1
done
expect 2 "is in use by process $child on host" "$program" run bar.toml --set run.end='"1000 s"' --out long
expect 2 "is in use by process $child on host" "$program" resume long
check test -s long/history.csv
kill -TERM $child
kill -TERM $child 2>/dev/null  # tools that stop programs often signal the process and its group
wait $child
code=$?
[ $code -eq 4 ] || { echo "FAILED: exit code $code after SIGTERM"; failures=$((failures + 1)); }
check grep -q '"status": "stopped"' long/summary.json

# The physics fails: the state is kept and explained.
expect 3 "docs/user/when-it-stops.md" "$program" run bar.toml --out broken \
  --set 'body.bar.initial_velocity=["0","0","-20000*Z"]'
check grep -q '"status": "failed"' broken/summary.json
check test -s broken/checkpoints/failed.h5
expect 0 "in broken/report.html" "$program" report broken
check grep -q '"failed_particle":[0-9]' broken/report.html

# The case itself is never replaced by results, whatever is forced.
mkdir here && cp bar.toml here/case.toml
(
  cd here || exit 1
  expect 2 "give another folder with --out" "$program" run case.toml --out . --force --set run.end='"1 ms"'
  expect 2 "give another folder with --out" "$program" run . --out . --force
  exit $failures
)
failures=$?
check cmp bar.toml here/case.toml
check test "$(ls here)" = case.toml

# A file without end is not read to its end.
expect 2 "is a device (a regular file is needed)" "$program" run /dev/zero

# A folder that cannot be written, a disk that is full.
expect 1 "cannot be written" "$program" run bar.toml --out /proc/piola
# (The thread sanitizer keeps files of its own, which such a limit would hit.)
if [ -z "${TSAN_OPTIONS:-}" ]; then
  (
    ulimit -f 60
    expect 1 "cannot be written, File too large" "$program" run bar.toml --out full \
      --set output.frames.compress=false --set output.frames.every='"1 ms"'
    exit $failures
  )
  failures=$?
fi

finish
