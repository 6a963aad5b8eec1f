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

# M L / (E I) is 0.628 rad; 41 x 3 particles rest at 0.6156, and less than 1 % of that may be left.
for step in 1e-3 1.05e-3 1.1e-3 1.2e-3 1.4e-3; do
  expect 0 "varies along it" run "$cases/relaxed_beam.toml" --out rest --set "run.max_step=$step"
  check last rest step 100 40000
  check last rest end.twist_angle 0.6095 0.6218
done
expect 3 "not at rest at run.end" run "$cases/relaxed_beam.toml" --out short --set run.end=2
expect 0 "" "$program" resume short --quiet --set run.end=60
check last short end.twist_angle 0.6095 0.6218

# The same beam under a dead load, by conjugate gradients; kinetic damping rests at 0.5350.
expect 0 "" run "$cases/relaxed_beam.toml" --out descent --set load.moment.follower=false \
  --set run.relax_method=conjugate_gradients --set run.relax_tolerance=1e-4
check last descent step 100 4000
check last descent end.twist_angle 0.5324 0.5377
expect 3 "conjugate gradients, which then hardly get on" run "$cases/relaxed_beam.toml" --out none --set run.end=2 \
  --set run.relax_method=conjugate_gradients

# A pulse of velocity in a bar of 501 particles. The first step would be 60 ns at 2 c / h.
expect 0 "" run "$cases/long_bar.toml" --out long --set output.history.every="1 ns"
check awk -F, 'NR == 1 { for (i = 1; i <= NF; ++i) if ($i == "dt") n = i } $2 == 1 { good = $n >= 50e-9 }
  END { exit !good }' long/history.csv
check last long total_energy 150.1 150.8

# A traction of 1 Pa on an edge of 16 m, for 0.1 s.
for spacing in 2 1; do
  expect 0 "" run "$cases/oblique_panel.toml" --out panel --set "body.panel.shape.spacing=$spacing"
  check grep -Eq '"pull.area_error": (-?[0-9.]+e-1[0-9]|0.0)' panel/summary.json
  check last panel pull.force_y 15.999999999 16.000000001
done
finish
