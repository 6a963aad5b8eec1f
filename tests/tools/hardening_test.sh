#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# A release of the program is hardened: position independent, full RELRO, stack protector, checked copies.
set -uo pipefail
program=${PIOLA_PROGRAM:-}
if [[ ${PIOLA_HARDENED:-0} != 1 || ! -x $program || $(uname -s) != Linux ]] || ! command -v readelf >/dev/null; then
  echo "skipped: needs readelf and a hardened release build (PIOLA_HARDENING)"
  exit 77
fi
failures=0
expect() {  # expect WHAT PATTERN COMMAND...: the output of the command has the pattern
  "${@:3}" 2>/dev/null | grep -E "$2" >/dev/null || { echo "no $1 ($2 in ${*:3})"; failures=$((failures + 1)); }
}
expect "position independent program" 'Type: +DYN' readelf -hW "$program"
expect "read-only relocations" 'GNU_RELRO' readelf -lW "$program"
expect "binding before the start" 'BIND_NOW|FLAGS_1.*NOW' readelf -dW "$program"
expect "stack protector" '__stack_chk_fail' readelf --dyn-syms -W "$program"
expect "checked copies" '__[a-z]+_chk@' readelf --dyn-syms -W "$program"
echo "hardening_test: $failures failures"
[[ $failures -eq 0 ]]
