#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ranks against threads: steps of the twisting column with 26 x 157 x 26 particles, on one rank with two threads and on
two ranks with one, in turn; or of another case. Prints the speed of the steps (wall time, without set-up and output), the processor time
of the whole run, and what ranks spent on each other.

Usage: bench/ranks.py PROGRAM [REPEATS [STEPS]]      PROGRAM: with MPI; default 5 times 60 steps
       bench/ranks.py PROGRAM REPEATS CASE END       END: when the run of the case ends, "2e-6" seconds
CASE is a folder with a case.toml: cases/adaptle/impact_2d, or bench/eulerian_cube (150e-6).
"""
import json
import os
import re
import resource
import subprocess
import sys
import tempfile
from pathlib import Path
from statistics import median

SOURCE = Path(__file__).resolve().parents[1]
STEP = 0.24e-3  # [s], once the run has settled


def column(folder, steps):
    text = (SOURCE / "cases/jst_sph/twisting_column/case.toml").read_text()
    head = text[:text.index("[[probe]]")].replace("[6, 31, 6]", "[26, 157, 26]")
    end = f"{steps * STEP / 10:.6e} s"  # steps begin short
    case = folder / "case.toml"
    case.write_text(head.replace('end = "0.3 s"', f'end = "{end}"') + f'[output.history]\nevery = "{end}"\n')
    return case


def part_of(file, folder, end):
    """A case until then, with two rows of its history and no other files."""
    case = folder / "case.toml"
    text = file.read_text()
    for name in ("frames", "checkpoints", "pictures"):
        text = re.sub(rf"^\[output\.{name}\]\n(?:(?!\[).*\n?)*", "", text, flags=re.MULTILINE)
    text = re.sub(r"^\[output\.history\]\n(?:(?!\[).*\n?)*", "", text, flags=re.MULTILINE)
    text = re.sub(r'^end = .*$', f'end = "{end:.6e} s"', text, count=1, flags=re.MULTILINE)
    case.write_text(text + f'\n[output.history]\nevery = "{end:.6e} s"\n')
    return case


def run(program, case, ranks, threads):
    launcher = ["mpirun", "--oversubscribe", "--allow-run-as-root", "--bind-to", "none", "-n", str(ranks)]
    out = case.parent / f"out{ranks}"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run([*(launcher if ranks > 1 else []), program, "run", case, "--out", out, "--force", "--quiet",
                    "--no-pictures", "--threads", str(threads)], check=True, stderr=subprocess.DEVNULL,
                   env={**os.environ, "OMP_WAIT_POLICY": "passive"})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    summary = json.loads((out / "summary.json").read_text())
    summary["processor"] = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    return summary


def main(program, repeats=5, steps=60, end=None):
    with tempfile.TemporaryDirectory() as folder:
        place = Path(folder)
        (place / "short").mkdir()
        if end is None:
            case, short = column(place, int(steps)), column(place / "short", int(steps) // 4)
        else:
            case, short = (part_of(SOURCE / steps / "case.toml", *to)
                           for to in ((place, float(end)), (place / "short", float(end) / 4)))
        speeds, processor, talk = {1: [], 2: []}, {1: [], 2: []}, []
        for _ in range(repeats):
            for ranks, threads in ((1, 2), (2, 1)):
                # What both runs have in common, set-up and start, is left out of the processor time of a step.
                summary, less = run(program, case, ranks, threads), run(program, short, ranks, threads)
                speeds[ranks].append(summary["stages_per_second"] / 1e6)
                processor[ranks].append(1e3 * (summary["processor"] - less["processor"]) /
                                        (summary["steps"] - less["steps"]))
                talk += [1e3 * (rank["message_seconds"] + rank["collective_seconds"])
                         for rank in summary.get("ranks", [])]
            print("  M particle-stages/s: {:.2f} on 1 rank of 2 threads, {:.2f} on 2 ranks of 1; processor time of a "
                  "step {:.1f} and {:.1f} ms".format(speeds[1][-1], speeds[2][-1], processor[1][-1], processor[2][-1]),
                  flush=True)
    for name, take, values in (("fastest", max, speeds), ("median speed", median, speeds),
                               ("least processor time", min, processor), ("median processor time", median, processor)):
        print(f"{name}: {take(values[1]):.2f} and {take(values[2]):.2f}, ratio {take(values[2]) / take(values[1]):.3f}")
    print(f"{summary['steps']} steps; in a step a rank spends {min(talk):.2f} ms at least, {median(talk):.2f} ms in the "
          "median on messages and sums, waiting among them")


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(Path(sys.argv[1]).resolve(), *map(int, sys.argv[2:3]), *sys.argv[3:5])
