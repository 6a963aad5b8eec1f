#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Rest, slender bodies and loads beside oblique edges: right answers, or a refusal with its cause.
. "$(dirname "$0")/../app/helpers.sh"
cases=$helpers/../regression
run() { "$program" run --force --no-pictures --quiet --threads 1 "$@"; }
# last FOLDER COLUMN LEAST MOST: the last value of a column lies between these.
last() {
  awk -F, -v c="$2" -v a="$3" -v b="$4" 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == c) n = i } { v = $n }
    END { if (!n || v < a || v > b) { print c " = " v; exit 1 } }' "$1/history.csv"
}

# M L / (E I) is 0.628 rad; 41 x 3 particles rest at 0.6151, 61 x 3 at 0.6176.
for step in 1e-3 1.05e-3 1.1e-3 1.2e-3 1.4e-3; do
  expect 0 "varies along it" run "$cases/relaxed_beam.toml" --out rest --set "run.max_step=$step"
  check last rest step 100 20000
  check last rest end.twist_angle 0.613 0.617
done
expect 3 "not at rest at run.end" run "$cases/relaxed_beam.toml" --out short --set run.end=2
expect 0 "" "$program" resume short --quiet --set run.end=60
check last short end.twist_angle 0.613 0.617

expect 2 "miss the divergence theorem" run "$cases/long_bar.toml" --out long

# A traction of 1 Pa on an edge of 16 m, for 0.1 s.
for spacing in 2 1; do
  expect 0 "scaled by 0.9" run "$cases/oblique_panel.toml" --out panel --set "body.panel.shape.spacing=$spacing"
  expect 0 "scaled by 0.9" "$program" check "$cases/oblique_panel.toml" --set "body.panel.shape.spacing=$spacing"
  check grep -q '"pull.area_error": -\?0.0' panel/summary.json
  check last panel pull.force_y 15.999999999 16.000000001
done
finish
