#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A run whose numbers stop being numbers says so in words, in all that is for people to read.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

printf '[[load]]\nbody = "bar"\nface = "+z"\ntraction = ["1e4*sqrt(0.001 - t)", 0, 0]\n' >> bar.toml
expect 3 'not a number at end' "$program" run bar.toml --out bad --threads 1 --no-pictures
expect 3 'is not a number at t =' "$program" run bar.toml --out bad --threads 1 --no-pictures --quiet
check test "$("$program" run bar.toml --out bad --threads 1 2>&1 | grep -ciw -- '-\?nan')" = 0
check test "$(grep -ciw -- '-\?nan' bad/log.txt)" = 0
check test "$(grep -c 'history.csv: not a number in .*, .* at t = ' bad/log.txt)" = 1
check test "$(grep -c 'left empty' bad/log.txt)" = 1
check "$program" watch bad --once
check test "$("$program" watch bad --once | grep -ciw -- '-\?nan')" = 0
finish
