#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# PIOLA_INSTRUCTION_SETS=native builds the backend that fits the features of the processor, as the compiler names them.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0

cat >"$work/ask.cmake" <<ASK
include("$root/cmake/PiolaNativeBackend.cmake")
piola_native_backend(backend)
message("\${backend}")
ASK
backend_of() { cmake "-DCMAKE_CXX_COMPILER=$1" -P "$work/ask.cmake" 2>&1; }

expect() {  # expect BACKEND FEATURE...: with a compiler that names these features
  local backend
  { echo '#!/bin/sh'; printf 'echo "#define __%s__ 1"\n' "${@:2}"; } >"$work/compiler"
  chmod +x "$work/compiler"
  backend=$(backend_of "$work/compiler")
  if [[ $backend != "$1" ]]; then
    echo "features ${*:2}: expected $1, got $backend"
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
backend=$(backend_of "$work/compiler")
[[ $backend == scalar ]] || { echo "a compiler that refuses: got $backend"; failures=$((failures + 1)); }

# The compiler of this system and the processor itself.
if [[ -r /proc/cpuinfo && $(uname -m) == x86_64 ]] && command -v c++ >/dev/null; then
  flags=" $(grep -m 1 '^flags' /proc/cpuinfo) "
  has() { local f; for f in "$@"; do [[ $flags == *" $f "* ]] || return 1; done; }
  expected=scalar
  if has avx2 fma bmi2; then expected=v3; fi
  if has avx2 fma bmi2 avx512f avx512dq avx512bw avx512vl avx512cd; then expected=v4; fi
  backend=$(backend_of "$(command -v c++)")
  if [[ $backend != "$expected" ]]; then
    echo "this processor: expected $expected, got $backend"
    failures=$((failures + 1))
  fi
fi

echo "native_backend_test: $failures failures"
[[ $failures -eq 0 ]]
