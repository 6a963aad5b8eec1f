#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# PIOLA_MACHINES=native builds the machine that fits the features of the processor, as the compiler names them.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

cat >"$work/ask.cmake" <<ASK
include("$root/cmake/PiolaNativeMachine.cmake")
piola_native_machine(machine)
message("\${machine}")
ASK
machine_of() { cmake "-DCMAKE_CXX_COMPILER=$1" -P "$work/ask.cmake" 2>&1; }

expect() {  # expect MACHINE FEATURE...: with a compiler that names these features
  local machine
  { echo '#!/bin/sh'; printf 'echo "#define __%s__ 1"\n' "${@:2}"; } >"$work/compiler"
  chmod +x "$work/compiler"
  machine=$(machine_of "$work/compiler")
  if [[ $machine != "$1" ]]; then
    echo "features ${*:2}: expected $1, got $machine"
    failures=$((failures + 1))
  fi
}
v3=(AVX2 FMA BMI2)
v4=("${v3[@]}" AVX512F AVX512DQ AVX512BW AVX512VL AVX512CD)
expect scalar SSE2
expect scalar SSE4_2
expect scalar AVX2 FMA
expect v3 "${v3[@]}"
expect v3 "${v3[@]}" AVX512F
expect v4 "${v4[@]}"

# A compiler that does not know -march=native.
printf '#!/bin/sh\nexit 1\n' >"$work/compiler"
machine=$(machine_of "$work/compiler")
[[ $machine == scalar ]] || { echo "a compiler that refuses: got $machine"; failures=$((failures + 1)); }

# The compiler of this system and the processor itself.
if [[ -r /proc/cpuinfo && $(uname -m) == x86_64 ]] && command -v c++ >/dev/null; then
  flags=" $(grep -m 1 '^flags' /proc/cpuinfo) "
  has() { local f; for f in "$@"; do [[ $flags == *" $f "* ]] || return 1; done; }
  expected=scalar
  if has avx2 fma bmi2; then expected=v3; fi
  if has avx2 fma bmi2 avx512f avx512dq avx512bw avx512vl avx512cd; then expected=v4; fi
  machine=$(machine_of "$(command -v c++)")
  if [[ $machine != "$expected" ]]; then
    echo "this processor: expected $expected, got $machine"
    failures=$((failures + 1))
  fi
fi

echo "native_machine_test: $failures failures"
[[ $failures -eq 0 ]]
