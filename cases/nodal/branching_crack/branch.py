#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Place where the crack branches, from the frames of a run.

Usage: branch.py RESULTS     folder of the run

The place is the smallest X of broken cells more than 1.5 mm above and below the line of the slit. Needs h5py.
"""
import pathlib
import sys

import h5py
import numpy as np


def last_frame(folder):
    """Places at the start [m] and damage at the end, by number of the particle."""
    frames = sorted(pathlib.Path(folder, "frames").glob("*.hdf"))
    values = []
    for path, name in ((frames[0], "Points"), (frames[-1], "PointData/Damage")):
        with h5py.File(path) as file:
            frame = file["VTKHDF"]
            values.append(frame[name][:][np.argsort(frame["PointData/Id"][:])])
    return values


def main(folder):
    places, damage = last_frame(folder)
    broken = places[damage >= 1] * 1e3
    for side, name in ((1, "above"), (-1, "below")):
        branch = broken[side * broken[:, 1] > 1.5]
        print(f"{name}: from X = {branch[:, 0].min():.1f} mm to Y = {side * (side * branch[:, 1]).max():.1f} mm")


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
