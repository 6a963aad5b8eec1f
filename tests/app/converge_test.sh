#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# piola converge: orders, limits and errors of quantities.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"
cp "$helpers/../regression/study/bar.toml" "$helpers/../regression/study/tiny.toml" .

# The bar's end moves by 2 v/pi = 63.662 mm. The dissipation of the default scheme, of fourth differences with a factor
# h^3, makes the error one of third order.
expect 0 "run-3: spacing 25 mm, 41 particles" "$program" converge bar.toml --factors 1 0.5 0.25 --check
check test ! -e bar-converge
expect 0 "3 of 3 completed" "$program" converge bar.toml --factors 1 0.5 0.25
awk -F, '$1 == "reach" { exit !($6 == "monotonic" && $7 > 2.5 && $7 < 3.5 && $8 > 63.63 && $8 < 63.69) }' \
  bar-converge/convergence.csv || { echo "FAILED:"; cat bar-converge/convergence.csv; failures=$((failures + 1)); }
# Estimated errors cover the true ones.
awk -F, '$1 == "reach" { for (k = 3; k < 6; k++) { e = $k - 63.662; if (e < 0) e = -e; if (e > $(k + 6)) exit 1 } }' \
  bar-converge/convergence.csv || { echo "FAILED:"; cat bar-converge/convergence.csv; failures=$((failures + 1)); }
expect 0 "run-2 (spacing=\"0.05 m\"): completed before" "$program" converge bar.toml --factors 1 0.5 0.25
expect 0 "1 curve drawn to bar-converge/reach.svg" "$program" plot bar-converge reach
expect 0 "2 of 2 completed" "$program" converge bar.toml --factors 1 0.5 --column end.velocity_x:minimum -o columns
check grep -q "^end_velocity_x_minimum,m/s,-0.09.*two values" columns/convergence.csv

# What does not converge is said, with exit code 3: a column that counts.
expect 3 "does not converge" "$program" converge bar.toml --factors 1 0.5 0.25 --column step -o steps
expect 0 "does not converge monotonically" "$program" converge bar.toml --factors 1 0.5 0.25 \
  --set body.bar.formulation.name=nodal -o nodal
expect 2 "has no [[quantity]]" "$program" converge bar.toml --set quantity='[]'
expect 2 'did you mean "strain_energy"' "$program" converge bar.toml --column strain_energie
expect 2 "two are the same" "$program" converge bar.toml --factors 1 1
expect 2 "nearly the same spacing" "$program" converge bar.toml --factors 1 0.99
expect 2 "with spacings 5 times as large" "$program" converge tiny.toml --factors 1 5
expect 2 "run.threads" "$program" converge bar.toml --threads many
printf 'x,volume\n0,1\n1,1\n2,1\n3,1\n' >c.csv
expect 2 "particles of a file" "$program" converge bar.toml --set 'body.0.shape={points={file="c.csv"}}'
finish
