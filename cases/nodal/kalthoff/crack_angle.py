#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Angle and speed of the crack, from the frames of a run.

Usage: crack_angle.py RESULTS [ANGLE]     folder of the run, and the angle by which the plate is turned, in degrees

The angle is that of the line from the end of the notch with the least squares of distances across to broken cells between
5 and 60 mm above it. The tip is the broken cell farthest from the end of the notch. Needs h5py.
"""
import pathlib
import sys

import h5py
import numpy as np

NOTCH = np.array([0.05, 0.025])  # end of the notch [m]
RAYLEIGH = 0.927 * np.sqrt(190e9 / 2.6 / 8000)  # speed of Rayleigh waves [m/s]


def main(folder, turn="0"):
    places, times, tips = None, [], []
    for path in sorted(pathlib.Path(folder, "frames").glob("*.hdf")):
        with h5py.File(path) as file:
            frame = file["VTKHDF"]
            order = np.argsort(frame["PointData/Id"][:])
            if places is None:
                c, s = np.cos(np.radians(float(turn))), np.sin(np.radians(float(turn)))
                places = frame["Points"][:][order][:, :2] @ np.array([[c, -s], [s, c]]) - NOTCH
            broken = places[frame["PointData/Damage"][:][order] >= 1]
            times.append(frame["FieldData/TimeValue"][0])
        above = broken[broken[:, 1] > 0]
        tips.append(np.hypot(*above.T).max() if len(above) else 0)
    distance = np.hypot(*above.T)
    path = above[(distance > 0.005) & (distance < 0.06)]
    angle = 0.5 * np.arctan2(2 * (path[:, 0] * path[:, 1]).sum(), (path[:, 0]**2 - path[:, 1]**2).sum())
    near, far = (times[int(np.argmax(np.array(tips) > r))] for r in (0.02, 0.06))
    speed = 0.04 / (far - near)
    print(f"angle {np.degrees(angle):.1f} degrees; 20 to 60 mm: {speed:.0f} m/s, "
          f"{speed / RAYLEIGH:.2f} of the speed of Rayleigh waves")


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(*sys.argv[1:])
