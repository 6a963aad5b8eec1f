# SPDX-License-Identifier: Apache-2.0
"""Measures the cost of frames and checkpoints of a run on ranks: a cube of N^3 particles, ten steps, without output,
with a frame and with a checkpoint after each step.

Usage: bench/ranks_files.py PROGRAM [N [RANKS,RANKS... [REPEATS]]]        (default: 60, 1,2,4, 3; medians)
PROGRAM must know MPI (PIOLA_MPI, or piola-mpi of PIOLA_MPI_BESIDE). Ranks have one thread each.
"""
import json
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

from ranks_memory import CASE

STEPS = 10
EVERY = {"nothing": (), "frames": ("output.frames.every",), "checkpoints": ("output.checkpoints.every",)}


def run(program, ranks, case, folder, kind, step):
    """Wall time [s]."""
    words = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "--mca", "plm", "isolated", "-n", str(ranks)]
    words += [program, "run", case, "--out", folder, "--force", "--quiet", "--no-pictures"]
    for key in ("output.frames.every", "output.checkpoints.every", "output.history.every"):
        words += ["--set", f'{key}="{step if key in EVERY[kind] else 1} s"']
    words += ["--set", f'run.end="{STEPS * step} s"', "--set", f'run.max_step="{step} s"']
    subprocess.run(words, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"})
    return json.loads((folder / "summary.json").read_text())["wall_seconds"]


program, n = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 60
counts = [int(count) for count in (sys.argv[3] if len(sys.argv) > 3 else "1,2,4").split(",")]
repeats = int(sys.argv[4]) if len(sys.argv) > 4 else 3
step = 1e-6 / n  # below the limit from the first step on
with tempfile.TemporaryDirectory() as work:
    case, folder = Path(work) / "case.toml", Path(work) / "results"
    case.write_text(CASE.format(n=n, formulation="jst_sph", end=1, more=""))
    for ranks in counts:
        wall = {kind: statistics.median(run(program, ranks, case, folder, kind, step) for _ in range(repeats))
                for kind in EVERY}
        print(f"{ranks} ranks: a step {1e3 * wall['nothing'] / STEPS:.0f} ms; " + "; ".join(
            f"{kind}, each {1e3 * (wall[kind] - wall['nothing']) / STEPS:.0f} ms" for kind in ("frames", "checkpoints")),
            flush=True)
