#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# The pages make a site without warnings, where Sphinx is installed; a link or a picture that leads nowhere is noticed.
set -uo pipefail
root=${PIOLA_SOURCE_DIR:-$(cd "$(dirname "$0")/../.." && pwd)}
/usr/bin/python3 -c 'import sphinx, myst_parser, furo' 2>/dev/null || { echo "skipped: no Sphinx"; exit 77; }
[[ -d /usr/share/javascript/mathjax ]] || { echo "skipped: no MathJax"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
fail() { echo "$1"; failures=$((failures + 1)); }

output=$("$root/tools/make_site" "$work/site" 2>&1) || fail "the pages make no site: $output"
[[ -s $work/site/index.html && -s $work/site/searchindex.js ]] || fail "no front page or no search"
for page in docs/README docs/user/gallery cases/nodal/twisting_column/README src/piola/formulations/nodal/README; do
  [[ -s $work/site/$page.html ]] || fail "no page $page"
done

# A small house with a link that leads nowhere, a page that nothing leads to, and a formula.
house=$work/house
mkdir -p "$house/tools" "$house/docs/user" "$house/docs/images" "$house/cases"
cp "$root/tools/make_site" "$house/tools/"
cp "$root/docs/conf.py" "$root/docs/site.css" "$house/docs/"
echo 'project(Piola VERSION 1.2.3)' >"$house/CMakeLists.txt"
git -C "$house" init -q
printf '# Front\n\nSee [one](user/one.md#two-words) and $x^2$.\n\n```math\n\\int f\n```\n' >"$house/docs/README.md"
printf '# One\n\n## Two words\n' >"$house/docs/user/one.md"
output=$("$house/tools/make_site" "$work/small" 2>&1) || fail "a small house makes no site: $output"
grep -q 'mathjax/MathJax.js' "$work/small/docs/README.html" || fail "formulas are not drawn"
grep -q 'class="math notranslate nohighlight">' "$work/small/docs/README.html" || fail "a formula is no formula"
grep -q '"processClass": "math"' "$work/small/docs/README.html" || fail "formulas are not found by MathJax 2"
grep -q 'Gumshoe = factory' "$work/small/_static/scripts/furo.js" || fail "the theme's script is a module"
grep -q '^import ' "$work/small/_static/scripts/furo.js" && fail "the theme's script imports"
[[ -s $work/small/_static/styles/normalize.css ]] || fail "a style sheet of the theme is missing"
grep -q 'url(/' "$work/small/_static/styles/furo.css" && fail "the theme asks for an absolute place"
expect() {  # expect TEXT: no site, and a message with the text
  output=$("$house/tools/make_site" "$work/small" 2>&1) && fail "made a site in spite of: $1"
  [[ $output == *"$1"* ]] || fail "'$1' is not said: $output"
}
printf '# One\n\n## Other words\n' >"$house/docs/user/one.md"
expect "two-words"
printf '# One\n\n## Two words\n\n[nothing](nothing.md)\n' >"$house/docs/user/one.md"
expect "nothing"
printf '# One\n\n## Two words\n\n<img src="https://example.org/a.png">\n' >"$house/docs/user/one.md"
expect "example.org"
printf '# One\n\n## Two words\n' >"$house/docs/user/one.md"
printf '# Alone\n' >"$house/cases/alone.md"
expect "alone"
mkdir "$work/other" && touch "$work/other/kept"
"$house/tools/make_site" "$work/other" 2>/dev/null && fail "a folder that is no site was replaced"
[[ -f $work/other/kept ]] || fail "a file of somebody else is gone"

echo "site_test: $failures failures"
[[ $failures -eq 0 ]]
