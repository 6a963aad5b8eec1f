#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Radial velocity that a slit camera sees, from the history of a run of cylinder_test, at expansions of 6, 12.5 and 19 mm.

The camera looks at one place along the tube, behind a detonation of speed D: v_r/(1 - v_z/D) of the material.

Usage: camera.py RESULTS         folder of a run
"""
import csv
import pathlib
import sys

D = 7980.0


def between(x, xs, ys):
    """y where x is reached for the first time."""
    for k in range(1, len(xs)):
        if xs[k - 1] <= x < xs[k]:
            return ys[k - 1] + (x - xs[k - 1]) / (xs[k] - xs[k - 1]) * (ys[k] - ys[k - 1])
    return float("nan")


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    rows = list(csv.DictReader((pathlib.Path(sys.argv[1]) / "history.csv").open()))
    times = [float(row["time"]) for row in rows]
    expansion = [float(row["outside.displacement_x"]) for row in rows]
    seen = [float(row["outside.velocity_x"]) / (1 - float(row["outside.velocity_y"]) / D) for row in rows]
    for at in (6.0, 12.5, 19.0):
        print(f"{at:4.1f} mm  {1e6 * between(1e-3 * at, expansion, times):.2f} us  "
              f"{between(1e-3 * at, expansion, seen):.0f} m/s")


if __name__ == "__main__":
    main()
