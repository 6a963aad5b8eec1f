#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# Makes the object file of one backend safe to link with the others.
#
# Usage: seal_backend.sh BACKEND OUT IN...      (LD, NM, OBJCOPY from the environment)
#
# An object file compiled for AVX-512 also holds copies of ordinary templates, std::vector<double>::push_back for one,
# as weak symbols. The linker keeps one copy of each for the whole program, and if it keeps the AVX-512 one, the
# program stops with an illegal instruction on an older processor, far from the hot loops. Here every weak function and
# virtual table without the backend's namespace in its name becomes private to the object file. Type information stays
# shared, so exceptions and casts work across backends.
set -euo pipefail
backend=$1
out=$2
shift 2
ld=${LD:-ld}
nm=${NM:-nm}
objcopy=${OBJCOPY:-objcopy}

"$ld" -r --force-group-allocation -o "$out.joined" "$@"
"$nm" -p --defined-only "$out.joined" >"$out.mangled"
"$nm" -p -C --defined-only "$out.joined" >"$out.readable"
paste -d '\n' "$out.mangled" "$out.readable" | awk -v backend="$backend" '
  NR % 2 == 1 { kind = $2; name = $3; next }
  (kind == "W" || (kind == "V" && name ~ /^_ZT[VT]/)) && $0 !~ ("piola::([a-z0-9_]+::)*" backend "::") { print name }
' >"$out.private"
if [[ -s $out.private ]]; then
  "$objcopy" --localize-symbols="$out.private" "$out.joined" "$out"
else
  cp "$out.joined" "$out"
fi
rm -f "$out.joined" "$out.mangled" "$out.readable" "$out.private"
