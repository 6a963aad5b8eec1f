#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# cases/README.md and the gallery list every case with its picture; a new case that is not in them is noticed.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
failures=0
fail() { echo "$1"; failures=$((failures + 1)); }

python3 -c 'import tomllib' 2>/dev/null || { echo "skipped: needs Python 3.11"; exit 77; }
"$root/tools/list_cases" --check || fail "the pages of the cases are not up to date"
for case in "$root"/cases/*/*/case.toml; do
  name=$(dirname "${case#"$root/cases/"}")
  grep -q "($name/README.md)" "$root/cases/README.md" || fail "not listed: $name"
  grep -q "(../../cases/$name/README.md)\*\*<br>[A-Z]" "$root/docs/user/gallery.md" || fail "not in the gallery: $name"
done
while read -r path; do
  [[ -f $root/cases/$path ]] || fail "no such file: cases/$path"
done < <(grep -oE '(src="|\]\()[^")]+' "$root/cases/README.md" | sed -E 's/^(src="|\]\()//')
while read -r path; do
  [[ -f $root/docs/user/$path ]] || fail "no such file: docs/user/$path"
done < <(grep -oE '(src="|\]\()[^")]+' "$root/docs/user/gallery.md" | sed -E 's/^(src="|\]\()//')
if grep -q 'not measured' "$root/cases/README.md"; then
  fail "a case has no run time - tools/list_cases --measure PROGRAM CASE"
fi

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir -p "$work/tools" "$work/docs/user"
cp "$root/tools/list_cases" "$work/tools/"
cp -r "$root/cases" "$work/"
cp "$root/docs/user/gallery.md" "$work/docs/user/"
cp -r "$work/cases/jst_sph/cable" "$work/cases/jst_sph/another"
output=$("$work/tools/list_cases" --check) && fail "a case that is not listed was not noticed"
[[ $output == *"run tools/list_cases"* ]] || fail "not said what to do: $output"
"$work/tools/list_cases" || fail "the list cannot be written"
"$work/tools/list_cases" --check >/dev/null || fail "the list is not up to date when it was written"
sed -i 's/^A bar/A rod/' "$work/cases/jst_sph/another/README.md"
output=$("$work/tools/list_cases" --check) && fail "a sentence that is not in the gallery was not noticed"
[[ $output == *gallery.md* && $output != *cases/README.md* ]] || fail "the wrong page is named: $output"
grep -q '(jst_sph/another/README.md) | 3D.*| not measured |' "$work/cases/README.md" || fail "the new case is missing"
printf '#!/bin/sh\nexit 3\n' >"$work/program" && chmod +x "$work/program"
output=$("$work/tools/list_cases" --measure "$work/program" jst_sph/another) && fail "a failure passed: $output"
"$work/tools/list_cases" --measur 2>/dev/null
[[ $? -eq 2 ]] || fail "a wrong option is not refused"

echo "list_cases_test: $failures failures"
[[ $failures -eq 0 ]]
