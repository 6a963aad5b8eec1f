# SPDX-License-Identifier: Apache-2.0
"""What tests of ranks share: starting Piola on several, and comparing what runs have computed."""
import hashlib
import os
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
    """Everything in it but how long the run took."""
    found = {}
    with h5py.File(file) as h:
        h.visititems(lambda name, item: found.update({name: np.asarray(item).tobytes()})
                     if isinstance(item, h5py.Dataset) else None)
    return {name: hashlib.sha256(data).hexdigest() for name, data in found.items()}


def contents(folder):
    """What a run has computed, by name."""
    found = {}
    for file in sorted(folder.rglob("*")):
        name = str(file.relative_to(folder))
        if not file.is_file() or name in ("log.txt", "summary.json"):
            continue
        if file.suffix == ".h5":
            found.update({f"{name} {key}": value for key, value in checkpoint(file).items()})
        else:
            found[name] = hashlib.sha256(file.read_bytes()).hexdigest()
    return found


def differences(a, b):
    return sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))


def short_bar(folder):
    """A run of a second with checkpoints; its history has an interval of its own, which would else follow the end."""
    bar = folder / "bar.toml"
    bar.write_text((SOURCE / "tests/app/bar.toml").read_text() + '[output.history]\nevery = "0.5 ms"\n')
    return bar
