#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How often the 95 % intervals of `piola identify` hold the truth: four constants of Johnson and Cook's law from three
synthetic curves with noise, which the differential equation of one point gives.

Usage: bench/identify_trials.py PROGRAM [TRIALS [NOISE_MPA]]     (default: 10, 2)
"""
import subprocess
import sys
import tempfile
import time
import tomllib
from pathlib import Path

import numpy as np

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / "tests/identify"))
import johnson_cook_point as point  # noqa: E402

TRUTH = {"A": 90, "B": 292, "n": 0.31, "C": 0.025}


def trial(program, folder, seed, noise):
    random = np.random.default_rng(seed)
    for name in ("tension.toml", "fit.toml"):
        (folder / name).write_text((ROOT / "examples/identify" / name).read_text())
    for rate in (1, 100, 5000):
        point.write_curve(folder / f"rate_{rate}.csv", rate, noise * 1e6, random)
    begin = time.monotonic()
    subprocess.run([program, "identify", folder / "fit.toml", "--out", folder / "found"], check=True, capture_output=True)
    found = tomllib.loads((folder / "found/result.toml").read_text())
    return found, time.monotonic() - begin


def main(program, trials=10, noise=2.0):
    inside = {name: 0 for name in TRUTH}
    whole = 0
    for seed in range(int(trials)):
        with tempfile.TemporaryDirectory() as folder:
            found, seconds = trial(program, Path(folder), seed, float(noise))
        hits = {p["name"]: p["low"] <= TRUTH[p["name"]] <= p["high"] for p in found["parameter"]}
        whole += all(hits.values())
        for name, hit in hits.items():
            inside[name] += hit
        values = ", ".join(f"{p['name']} {p['value']:.4g} ({p['low']:.4g} to {p['high']:.4g})" for p in found["parameter"])
        print(f"seed {seed}: {values}; {found['evaluations']} evaluations, {seconds:.0f} s", flush=True)
    print(f"inside of {trials}: {inside}; all four at once: {whole}")


main(*sys.argv[1:])
