#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Studies: a row of study.csv is of the run that it names, or has no value. And what is drawn of them.
# The thread sanitizer holds signals back and handles them itself.
[ -z "${TSAN_OPTIONS:-}" ] || exit 77
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"
cases="$helpers/../regression/study"

# study NAME KEY VALUES: NAME.toml with one parameter, whose runs lie in NAME.
study() { printf 'case = "case.toml"\njobs = 1\nout = "%s"\n[parameters]\n"%s" = [%s]\n' "$1" "$2" "$3" >"$1.toml"; }
# row FOLDER NUMBER: that row of study.csv.
row() { sed -n "$(($2 + 1))p" "$1/study.csv"; }
# not_before COMMAND...: a study that completes, and takes no run for one that was made before.
not_before() {
  local said
  said=$("$@")
  case "$said" in
    *"completed before"* | *"0 of"*) echo "FAILED: $*: $said"; failures=$((failures + 1)) ;;
  esac
}
is() { [ "$1" = "$2" ] || { echo "FAILED: '$1' instead of '$2'"; failures=$((failures + 1)); }; }

# A spacing that the formulation refuses when it is built, where an earlier run has left results.
cp "$cases/tiny.toml" case.toml
study refused body.b.shape.spacing '"1 mm", "0.8 mm"'
expect 0 "2 of 2 completed" "$program" study refused.toml
check grep -q '^run-2,0.8 mm,completed,[0-9.]' refused/study.csv
study refused body.b.shape.spacing '"1 mm", "5 mm"'
expect 3 "1 of 2 completed" "$program" study refused.toml
is "$(row refused 2)" 'run-2,5 mm,failed,'
expect 3 'run-1 (body.b.shape.spacing="1 mm"): completed before' "$program" study refused.toml

# A case of another title, edited or by a parameter: its folders hold the results of another case.
study edited run.cfl '0.4'
expect 0 "1 of 1 completed" "$program" study edited.toml
sed -i 's/^title.*/title = "another"/' case.toml
expect 3 "holds the results of another case" "$program" study edited.toml
is "$(row edited 1)" 'run-1,0.4,failed'
cp "$cases/tiny.toml" case.toml
study titled title '"one"'
expect 0 "1 of 1 completed" "$program" study titled.toml
study titled title '"two"'
expect 3 "0 of 1 completed" "$program" study titled.toml
is "$(row titled 1)" 'run-1,two,failed'

# A signal during set-up, which is made long by many particles.
study set-up run.end '"20 us"'
expect 0 "1 of 1 completed" "$program" study set-up.toml
study set-up run.end '"30 us"'
"$program" study set-up.toml --set body.b.shape.spacing='"0.01 mm"' >said 2>&1 &
parent=$!
until child=$(pgrep -P $parent); do sleep 0.05; done
kill -TERM "$child"
wait $parent
is $? 3
# The signal comes before or after the run has begun to watch for signals.
check grep -Eq "signal 15 ended it|stopped by a signal" said
is "$(row set-up 1)" 'run-1,30 us,failed'

# A study that is killed leaves its runs running; another one that finds them there does not take their results.
study killed run.end '"10 s"'
"$program" study killed.toml &
parent=$!
until_there 20 killed/run-1/history.csv
child=$(pgrep -P $parent)
kill -KILL $parent
wait $parent 2>/dev/null
study killed run.end '"20 us"'
expect 3 "0 of 1 completed" "$program" study killed.toml
is "$(row killed 1)" 'run-1,20 us,failed'
kill -KILL "$child"
expect 0 "1 of 1 completed" "$program" study killed.toml

# A file that the case names belongs to the identity of a run, and so does the program; threads and comments do not.
points() { # spacing [m]
  awk -v h="$1" 'BEGIN {
    print "x,y,volume"
    for (i = 0; i < 8; i++) for (j = 0; j < 6; j++) print i * h "," j * h "," h * h
  }'
}
cp "$cases/cloudy.toml" cloudy.toml
points 0.001 >c.csv
printf 'case = "cloudy.toml"\njobs = 1\nout = "cloud"\n[parameters]\n"run.cfl" = [0.3]\n' >cloud.toml
expect 0 "(run.cfl=0.3): completed" "$program" study cloud.toml
first=$(row cloud 1)
echo "# a comment" >>cloudy.toml
expect 0 "completed before" "$program" study cloud.toml --threads 1
points 0.0012 >c.csv
not_before "$program" study cloud.toml
check [ "$(row cloud 1)" != "$first" ]
python3 - <<'END'
import json
path = "cloud/run-1/summary.json"
summary = json.load(open(path))
summary["identity"]["run"] = "0" * 16  # as if another program had written it
json.dump(summary, open(path, "w"))
END
not_before "$program" study cloud.toml

# Relative paths start from the folder of the case, those of a study from its own; --set holds for all runs.
mkdir -p there/files
points 0.001 >there/files/a.csv
cp there/files/a.csv b.csv
cp cloudy.toml there/cloudy.toml
expect 0 "particles" "$program" check there/cloudy.toml --set body.b.shape.points.file=files/a.csv
expect 0 "particles" "$program" check there/cloudy.toml --set 'body.b.shape={ points = { file = "files/a.csv" } }'
printf 'case = "there/cloudy.toml"\n[parameters]\n"body.b.shape.points.file" = ["b.csv", "there/files/a.csv"]\n' \
  >files.toml
expect 0 "2 of 2 completed" "$program" study files.toml --set run.end='"10 us"'
check grep -q 'end = "10 us"' files-study/run-2/case.toml

# A plot of a study.
printf 'case = "case.toml"\n[parameters]\n%s\n%s\n' '"body.b.material.youngs_modulus" = ["4 MPa", "5000 kPa"]' \
  '"run.cfl" = [0.3, 0.4]' >two.toml
expect 0 "4 of 4 completed" "$program" study two.toml
expect 0 "2 curves drawn to two-study/study.svg" "$program" plot two-study
expect 0 "2 curves drawn to e.svg" "$program" plot two-study/study.csv e --against run.cfl --out e.svg
check grep -q "<svg" e.svg
expect 2 'did you mean "run.cfl"' "$program" plot two-study e --against run.clf
expect 2 "has no quantity" "$program" plot two-study f
expect 2 "leave them out" "$program" plot two-study e --with two-study

# A variant that is refused has no plots of an earlier run on the page of a verification.
mkdir -p verified/tiny
cp "$cases/tiny.toml" verified/tiny/case.toml
cat >verified/tiny/checks.toml <<'END'
[[variant]]
name = "one"
set = []
short = true
[[check]]
variant = "one"
quantity = "e"
reference = "0.86 J"
tolerance = "5 %"
kind = "within"
evidence = "theory"
source = "a square"
END
expect 0 "passes" "$program" verify --cases verified --out kept --markdown page
check [ -n "$(ls page/*.svg)" ]
sed -i 's/1 mm/5 mm/' verified/tiny/case.toml
expect 1 "falls short" "$program" verify --cases verified --out kept --markdown later
check [ -z "$(ls later/*.svg 2>/dev/null)" ]

finish
