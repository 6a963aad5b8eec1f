#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The checks of tools/ find what they promise to find, in a small source tree of their own.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
failures=0
licence='// SPDX-License-Identifier: Apache-2.0'

write() {  # write PATH LINE...
  mkdir -p "$(dirname "$tree/$1")"
  printf '%s\n' "${@:2}" >"$tree/$1"
}
expect() {  # expect STATUS TEXT TOOL: the tool ends with STATUS and says TEXT
  local output status=0
  output=$("$root/tools/$3" "$tree" 2>&1) || status=$?
  if [[ $status -ne $1 || $output != *"$2"* ]]; then
    echo "$3: expected status $1 and the text '$2', got status $status and"
    echo "$output"
    failures=$((failures + 1))
  fi
}
fresh() { rm -rf "${tree:?}/src" "${tree:?}/app" && write src/piola/base/a.hpp "$licence" '#pragma once'; }

fresh
expect 0 "0 findings" check_layers
expect 0 "0 findings" check_sizes
expect 0 "0 findings" check_words

# Layers.
fresh && write src/piola/exec/b.hpp "$licence" '#pragma once'
write src/piola/base/c.cpp "$licence" '#include "piola/exec/b.hpp"'
expect 1 "src/piola/base/c.cpp:2: includes piola/exec/b.hpp: base/ (layer 0) does not see exec/ (layer 1)" check_layers
fresh && write src/piola/base/c.cpp "$licence" '// #include "piola/exec/b.hpp"'
expect 0 "0 findings" check_layers
fresh && write src/piola/particles/b.hpp "$licence" && write src/piola/exec/c.hpp "$licence"
write src/piola/materials/d.hpp "$licence" '#include "piola/exec/c.hpp"'
expect 1 "materials/ sees only base, math" check_layers
fresh && write src/piola/formulations/one/passes.hpp "$licence"
write src/piola/formulations/two/step.hpp "$licence" '#include "piola/formulations/one/passes.hpp"'
expect 1 "a formulation never includes another one" check_layers
fresh && write src/piola/formulations/one/passes.hpp "$licence" && write src/piola/formulations/registry.hpp "$licence"
write src/piola/input/a.cpp "$licence" '#include "piola/formulations/registry.hpp"'
expect 0 "0 findings" check_layers
write src/piola/input/a.cpp "$licence" '#include "piola/formulations/one/passes.hpp"'
expect 1 "input/ sees only the files at the top of formulations/" check_layers
fresh && write src/piola/setup/s.hpp "$licence" && write src/piola/input/a.cpp "$licence" '#include "piola/setup/s.hpp"'
expect 0 "0 findings" check_layers
fresh && write src/piola/output/a.cpp "$licence" '#include "piola/base/gone.hpp"'
expect 1 "which does not exist" check_layers
fresh && write src/piola/mechanics/a.hpp "$licence" '#pragma omp parallel for'
expect 1 "OpenMP pragmas (allowed only in exec/)" check_layers
fresh && write src/piola/simulation/a.cpp "$licence" '#include <hdf5.h>'
expect 1 "HDF5 (allowed only in output/)" check_layers
fresh && write src/piola/setup/a.cpp "$licence" 'void f() { std::cout << 1; }'
expect 1 "library code never prints" check_layers
fresh && write src/piola/setup/a.cpp "$licence" 'void f() { std::exit(1); }'
expect 1 "library code never exits" check_layers
fresh && write src/piola/attic/a.cpp "$licence"
expect 1 "attic/ is no module" check_layers

# Sizes.
fresh && write src/piola/base/b.cpp "$licence" 'void tall() {' "$(yes '  ;' | head -n 59)" '}'
expect 1 "src/piola/base/b.cpp:2: function tall: 61 lines (at most 60)" check_sizes
fresh && write src/piola/base/b.cpp "$licence" 'void fits() {' "$(yes '  if (x) { y(); }' | head -n 58)" '}'
expect 0 "0 findings" check_sizes
fresh && write src/piola/base/b.cpp "$licence" 'struct Long {' "$(yes '  int f() { return 1; }' | head -n 90)" '};'
expect 0 "0 findings" check_sizes
fresh && write src/piola/base/b.cpp "$licence" "$(yes '//' | head -n 600)"
expect 1 "601 lines (at most 600)" check_sizes
fresh && write src/piola/base/b.cpp "$licence" "// $(yes 'word' | head -n 30 | tr '\n' ' ')."
expect 1 "characters (at most 120)" check_sizes

# Words.
fresh && write src/piola/base/b.cpp 'int x;'
expect 1 "src/piola/base/b.cpp:1: no licence line" check_words
fresh && write src/piola/base/b.cpp "$licence" 'int x;  '
expect 1 "blanks at the end of the line" check_words
fresh && write src/piola/base/b.cpp "$licence" $'\tint x;'
expect 1 "tab - use spaces" check_words
fresh && write src/piola/base/b.cpp "$licence" '// TODO: later'
expect 1 "reminder without a reason" check_words
fresh && write src/piola/base/b.cpp "$licence" '// TODO(when MPI arrives): exchange'
expect 0 "0 findings" check_words
fresh && write src/piola/base/b.cpp "$licence" '// see /home/someone/notes'
expect 1 "path of one machine" check_words

# Ratchets: what tools/ratchets.txt allows, and no more.
allow() { write tools/ratchets.txt "$@"; }
twins() {  # twins FILE: eight lines of code
  write "$1" "$licence" "$(for k in 1 2 3 4 5 6 7 8; do echo "int of_both_$k();"; done)" "int of_$2();"
}
fresh && allow '# nothing'
expect 0 "const_cast 0" check_ratchets
write src/piola/base/b.cpp "$licence" 'auto& x = const_cast<A&>(a);  // mutable const_cast' \
  'char const* s = "const_cast";'
expect 1 "src/piola/base/b.cpp:2: const_cast" check_ratchets
expect 1 "const_cast: 1 (at most 0)" check_ratchets
allow 'const_cast 2'
expect 0 "const_cast: 1 (recorded: 2) - record it" check_ratchets
recorded() {  # recorded WHEN: --record then leaves one
  "$root/tools/check_ratchets" "$tree" --record >/dev/null
  grep -qx "const_cast 1" "$tree/tools/ratchets.txt" && return
  echo "check_ratchets --record: expected const_cast 1 in ratchets.txt after the count has $1"
  failures=$((failures + 1))
}
recorded fallen
write src/piola/base/c.cpp "$licence" 'auto& x = const_cast<A&>(a);'
recorded risen
fresh && allow && write src/piola/base/b.hpp "$licence" '  mutable int x;' '  static constexpr int size = 12;'
expect 1 "hand_counts 1, const_cast 0, reinterpret_cast 0, mutable 1" check_ratchets
fresh && allow && write src/piola/base/b.cpp "$licence" "$(yes '//' | head -n 400)"
expect 1 "401 lines (more than 400)" check_ratchets
fresh && allow && write src/piola/base/b.cpp "$licence" 'void tall() {' "$(yes '  ;' | head -n 39)" '}'
expect 1 "function tall: 41 lines (more than 40)" check_ratchets
fresh && allow && twins src/piola/base/b.cpp one && twins src/piola/base/c.cpp other
expect 1 "duplicates: 2 (at most 0)" check_ratchets
fresh && allow && twins src/piola/base/b.cpp one && twins tests/c.cpp other
expect 0 "duplicates 0" check_ratchets
fresh && allow && write tests/c.cpp "$licence" 'EXPECT_EQ(said, "case.toml:1:2: run.cfl is -1 (allowed: "' \
  '  "above 0, at most 2) - correct it"); EXPECT_EQ(said, "a - but short");'
expect 1 "tests/c.cpp:2: 'case.toml:1:2: run.cfl is -1 (allowed: above 0, at most 2) -...' - compare" check_ratchets
expect 1 "long_messages_in_tests: 1 (at most 0)" check_ratchets

echo "check_tools_test: $failures failures"
[[ $failures -eq 0 ]]
