#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Sealing keeps templates of one instruction set out of the others, and check_isa sees the difference.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
if [[ $(uname -m) != x86_64 ]] || ! command -v g++ >/dev/null; then
  echo "skipped: needs g++ on x86-64"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/backends"
failures=0
fail() { echo "$1"; failures=$((failures + 1)); }

cat >"$work/backend.cpp" <<'CODE'
#include <vector>
template <class T> [[gnu::noinline]] T shared(std::vector<T> const& v) { return v.front(); }
namespace piola::inline v3 {
template <class T> [[gnu::noinline]] T own(T x) { return x * x; }
double solve(std::vector<double> const& v) { return own(shared(v)); }
}  // namespace piola::inline v3
CODE
g++ -std=c++20 -O1 -march=x86-64-v3 -c -o "$work/plain.o" "$work/backend.cpp" || fail "the compiler failed"

cp "$work/plain.o" "$work/backends/demo.v3.o"
output=$("$root/tools/check_isa" "$work") && fail "check_isa accepted an object file that is not sealed"
[[ $output == *"demo.v3.o: shares 'double shared<double>"* ]] || fail "the shared function is not named: $output"
[[ $output != *"own<"* ]] || fail "a function of the backend's namespace is reported: $output"

bash "$root/cmake/seal_backend.sh" v3 "$work/backends/demo.v3.o" "$work/plain.o" || fail "sealing failed"
output=$("$root/tools/check_isa" "$work") || fail "check_isa refuses a sealed object file: $output"
nm -C "$work/backends/demo.v3.o" | grep -q ' T piola::v3::solve' || fail "sealing hid the backend's own function"

cat >"$work/backend.cpp" <<'CODE'
double first();
double const early = first();
CODE
g++ -std=c++20 -O1 -c -o "$work/backends/demo.v3.o" "$work/backend.cpp"
output=$("$root/tools/check_isa" "$work") && fail "check_isa accepted code that runs at program start"
[[ $output == *"runs code at program start"* ]] || fail "the early code is not reported: $output"

echo "check_isa_test: $failures failures"
[[ $failures -eq 0 ]]
