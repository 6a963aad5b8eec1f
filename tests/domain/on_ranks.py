# SPDX-License-Identifier: Apache-2.0
"""What tests of ranks share: starting Piola on several, and comparing what runs have computed."""
import hashlib
import json
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import h5py
import numpy as np

SOURCE = Path(os.environ.get("PIOLA_SOURCE_DIR", Path(__file__).resolve().parents[2]))
PROGRAM = os.environ.get("PIOLA_RANKS_PROGRAM", "")
QUICK = os.environ.get("PIOLA_RANKS_TESTS", "all") != "all"
# Waiting threads sleep, so that more ranks than cores get on.
ENVIRONMENT = {**os.environ, "OMP_WAIT_POLICY": "passive", "OMP_NUM_THREADS": "1"}
failures = 0


def skip_without_ranks():
    if not PROGRAM or not shutil.which("mpirun"):
        print("skipped: needs a program with MPI (PIOLA_MPI or PIOLA_MPI_BESIDE), and mpirun")
        sys.exit(77)


def expect(holds, text):
    global failures
    if not holds:
        print("FAILED: " + text, flush=True)
        failures += 1
    return holds


def finish():
    sys.exit(1 if failures else 0)


def launcher():
    # One machine: mpirun need not look for a way to start programs on others, which a bare system lacks.
    return ["mpirun", "--oversubscribe", "--allow-run-as-root", "--mca", "plm", "isolated"]


def command(ranks, *words):
    return [*([*launcher(), "-n", str(ranks)] if ranks > 1 else []), PROGRAM, *map(str, words)]


def differently(*commands):
    """One rank per command line: [words of a shell before the program, words after it]."""
    line = launcher()
    for number, (before, words) in enumerate(commands):
        line += ([":"] if number else []) + ["-n", "1", *before, PROGRAM, *map(str, words)]
    return line


def start(line, threads=1, timeout=250):
    return subprocess.run(line, capture_output=True, text=True, timeout=timeout,
                          env={**ENVIRONMENT, "OMP_NUM_THREADS": str(threads)})


def piola(ranks, *words, threads=1):
    return start(command(ranks, *words), threads)


def checkpoint(file):
    """What is in it, by name."""
    found = {}
    with h5py.File(file) as h:
        h.visititems(lambda name, item: found.update({name: np.asarray(item).tobytes()})
                     if isinstance(item, h5py.Dataset) else None)
    return {name: hashlib.sha256(data).hexdigest() for name, data in found.items()}


def words_of(file):
    """A log or a summary without what depends on how fast the run was, or on how many it was shared."""
    text = file.read_text().replace(f"{file.parent}/", "")
    if file.name == "log.txt":
        text = re.sub(r"(?m)^.*particles were repartitioned.*\n", "", text)
        return re.sub(r", [\d.e-]+ [^,]+ of wall time|\d+ thread", "", text)
    summary = json.loads(text)
    for name in ("wall_seconds", "stages_per_second", "seconds", "threads", "ranks", "repartition"):
        summary.pop(name, None)
    return json.dumps(summary)


def contents(folder):
    """What a run has left, by name: all bytes of history, frames, checkpoints, pictures; words without times."""
    found = {}
    for file in sorted(folder.rglob("*")):
        name = str(file.relative_to(folder))
        if not file.is_file() or name == "checkpoints/wall_times.txt":
            continue
        data = words_of(file).encode() if name in ("log.txt", "summary.json") else file.read_bytes()
        found[name] = hashlib.sha256(data).hexdigest()
        if file.suffix == ".h5":  # says which data set differs
            found.update({f"{name} {key}": value for key, value in checkpoint(file).items()})
    return found


def differences(a, b):
    return sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))


def short_bar(folder):
    """A run of a second with checkpoints; its history has an interval of its own, which would else follow the end."""
    bar = folder / "bar.toml"
    bar.write_text((SOURCE / "tests/app/bar.toml").read_text() + '[output.history]\nevery = "0.5 ms"\n')
    return bar
