#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# Slips of the pen on the command line and in the file system: the message names what was meant.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

expect 2 'piola: there is no command "chek" (known: run, check, ' "$program" chek bar.toml
expect 2 'did you mean "check"?' "$program" chek bar.toml
expect 2 'piola run: there is no option "--thread" (known: ' "$program" run bar.toml --thread 2
expect 2 'did you mean "--threads"?' "$program" run bar.toml --thread=2
expect 2 'did you mean "--quiet"?' "$program" run bar.toml --thread 2 --quite
expect 2 'there is no option "--thread"' "$program" run bar.toml --thread 2 --quite
expect 2 'piola: there is no option "--verson"' "$program" --verson
expect 2 "case" "$program" run

# Fields and ranges of colours, and what a law is for.
expect 0 "" "$program" run bar.toml --out bar --quiet --set 'run.end="1 ms"' --set 'output.frames.every="1 ms"'
expect 2 "did you mean \"Velocity\"?" "$program" render bar --field velocity
expect 2 "--range: 5 -5 is empty (allowed: the lower value first) - write --range -5 5" \
  "$program" render bar --range 5 -5
expect 2 "--range: 5 5 is empty" "$program" render bar --range 5 5
expect 0 "small strain" "$program" describe material linear_elastic
expect 0 "Cauchy's stress is not symmetric" "$program" describe material linear_elastic

# A value with a space that the shell made two words of.
expect 2 'write --set "run.end=1 us"' "$program" run bar.toml --set run.end=1 us
expect 2 'write --set "run.end=1 us"' "$program" check --set run.end=1 us bar.toml

ln -s loop.toml loop.toml
ln -s there here
ln -s here there
expect 2 "loop.toml: is a link that leads back to itself" "$program" run loop.toml
expect 2 "loop.toml: is a link that leads back to itself" "$program" check loop.toml
expect 2 "here: is a link that leads back to itself" "$program" resume here
expect 1 "Too many levels of symbolic links" "$program" render here
expect 1 "cannot be" "$program" run bar.toml --out here
check test -L here -a -L there
finish
