#!/bin/bash
# SPDX-License-Identifier: Apache-2.0
# A resumed run has the files that it began with, or says which of them it has not.
source "${PIOLA_SOURCE_DIR:-$(dirname "$0")/../..}/tests/app/helpers.sh"

# lattice COLUMNS ROWS SHIFT: particles 1 mm apart.
lattice() {
  awk -v nx="$1" -v ny="$2" -v x0="$3" 'BEGIN { print "x,y,volume"
    for (j = 0; j < ny; j++) for (i = 0; i < nx; i++) printf "%g,%g,1e-6\n", x0 + i * 1e-3, j * 1e-3 }'
}
summary() {
  python3 -c 'import json, sys; print(json.load(open(sys.argv[1] + "/summary.json"))[sys.argv[2]])' "$1" "$2"
}

mkdir -p case/a
cp "$helpers/../regression/kept_names.toml" case/case.toml
lattice 10 5 0 > case/a/b.csv
lattice 6 6 0.1 > case/a__b.csv
cp -r case original
run() { "$program" run "$1" --out "$2" --quiet --threads 1 "${@:3}"; }
resume() { "$program" resume "$1" --quiet --threads 1 "${@:2}"; }

# Files with names that look alike are kept apart, and a run goes on without the originals, wherever it lies.
check run case whole
check run case half --set 'run.end=20 us'
rm -r case
mkdir elsewhere
mv half elsewhere
check resume elsewhere/half --set 'run.end=40 us'
check cmp whole/history.csv elsewhere/half/history.csv
check test "$(summary elsewhere/half status)" = completed

# A copy that was changed is refused by the name that the case has for it, unless the original is as it was.
cp -r original case
run case half --set 'run.end=20 us'
lattice 10 5 0.0001 > half/case-files/1-b.csv
check resume half --set 'run.end=24 us'
lattice 10 5 0.0001 > case/a/b.csv
expect 2 '"a/b.csv"' resume half --set 'run.end=28 us'
rm -r half/case-files
expect 2 'half/a/b.csv: cannot be read' resume half --set 'run.end=28 us'
rm -r half case

# Without the list nothing says that a file is the one that the run began with.
cp -r original case
run case half --set 'run.end=20 us'
rm half/case-files/files.toml
cp -r case/a case/a__b.csv half
expect 2 'is not in this list' resume half --set 'run.end=28 us'
rm -r half

# A file that is too large to be copied must have the content that it had.
lattice 10 5 0 > case/a/b.csv
yes "# padding padding padding padding padding padding padding padding" | head -n 800000 >> case/a/b.csv
expect 0 'is not copied' "$program" run case --out half --quiet --set 'run.end=20 us'
check test ! -e half/case-files/1-b.csv
mv half elsewhere/large
check resume elsewhere/large --set 'run.end=24 us'
echo '# one more line' >> case/a/b.csv
expect 2 'has changed' resume elsewhere/large --set 'run.end=28 us'
expect 2 'a/b.csv' resume elsewhere/large --set 'run.end=28 us'

# Copies beside an ordinary case are not what it names.
rm -r case
cp -r original case
mkdir case/case-files
lattice 3 3 0 > case/case-files/1-b.csv
cp case/case-files/1-b.csv case/case-files/a__b.csv
cp elsewhere/half/case-files/files.toml case/case-files
check run case again --set 'run.end=20 us'
check test "$(summary again particles)" = 86
finish
