#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Spellings of the previous minor release: read, reported with their place, and in no help, manual or schema.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

sed 's/^threads = 1/threads = 1\nmachine = "scalar"/; s/"jst_sph"/"nodal", least_mass = 0.3/' bar.toml >old.toml
told='old.toml:5:1: "machine" is now "instruction_set"'
expect 0 "$told" "$program" check old.toml
expect 0 '"least_mass" is now "min_mass_ratio"' "$program" check old.toml
expect 0 '--set run.machine=scalar: "machine" is now "instruction_set"' \
  "$program" check bar.toml --set run.machine=scalar
sed 's/^machine/instruction_set = "auto"\nmachine/' old.toml >both.toml
expect 2 'both.toml:6:1: "machine" is now "instruction_set", and both are given' "$program" check both.toml
expect 0 "warning: $told" "$program" run old.toml --out old
check grep -q "$told" old/log.txt
check grep -q 'instruction_set = "scalar"' old/case.toml

# The option that had another name.
expect 0 "" "$program" check bar.toml --instruction-set scalar
expect 0 "" "$program" check bar.toml --machine scalar
expect 0 "" "$program" check old.toml --instruction-set auto
expect 2 "excludes" "$program" check bar.toml --machine scalar --instruction-set scalar
for text in "run --help" "describe man-page" "describe completion" "describe case" "describe case --schema" \
  "describe formulation" "describe case --markdown"; do
  # shellcheck disable=SC2086
  "$program" $text >text.txt 2>&1
  check test -s text.txt
  old=$(grep -E -- '--machine|`machine`|strangers|parting|least_mass|cell_memory|tether|(of|,) printed' text.txt)
  check test -z "$old"
done
expect 2 'there is no option "--machin"' "$program" run bar.toml --machin scalar
expect 2 'did you mean "--instruction-set"' "$program" run bar.toml --instruction-sett scalar

# Columns and fields, of new results and of those of the previous release.
expect 0 "1 curve drawn" "$program" plot old least_jacobian --against step
expect 0 "cell jacobian min" "$program" watch old least_jacobian --once
expect 0 "CellJacobianMin-000004.png" "$program" render old --field LeastJacobian --last --size 300 240
expect 0 "frames in" "$program" report old --fields LeastJacobian
sed -i 's/cell_jacobian_min/least_jacobian/' old/history.csv
expect 0 "1 curve drawn" "$program" plot old cell_jacobian_min
expect 0 "1 curve drawn" "$program" plot old least_jacobian
finish
