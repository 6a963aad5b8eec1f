#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The frustum of this case at rest by axisymmetric finite elements, for the references in checks.toml.

    python3 cases/nodal/frustum/axisymmetric.py [--across 2 4 8]

Nine-node quadrilaterals of ../cooks_membrane/plane_strain.py, linear elasticity, exact but for the field within elements.
Prints the work of the traction [mJ]: the force times the mean displacement of the loaded end, and its ratio to that of a bar
of slowly varying section, F^2 L / (pi E r1 r2). numpy alone.
"""
import argparse
import pathlib
import sys
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "cooks_membrane"))
from plane_strain import grid, points, solve  # noqa: E402

WIDE, NARROW, LENGTH = 20e-3, 10e-3, 100e-3  # m
YOUNG, NU, TRACTION = 2.5e9, 0.3, 1e6  # Pa, 1, Pa


def work(across):
    """Of the traction on the narrow end with a roller on the wide one [J]."""
    along = 5 * across
    x, elements = grid(np.array([[0, 0], [0, LENGTH], [NARROW, LENGTH], [WIDE, 0]]), across, along)
    mu, la = YOUNG / (2 * (1 + NU)), YOUNG * NU / ((1 + NU) * (1 - 2 * NU))
    D = la * np.pad(np.ones((3, 3)), (0, 1)) + np.diag([2 * mu, 2 * mu, 2 * mu, mu])
    matrices = 0
    for _, weight, shape, local in points():
        jacobian = np.einsum("ck,ekd->ecd", local, x[elements])
        by = np.einsum("edc,ck->ekd", np.linalg.inv(jacobian), local)
        radius = x[elements][:, :, 0] @ shape
        B = np.zeros((len(elements), 4, 9, 2))  # rr, zz, tt, rz
        B[:, 0, :, 0], B[:, 1, :, 1], B[:, 2, :, 0] = by[:, :, 0], by[:, :, 1], shape / radius[:, None]
        B[:, 3, :, 0], B[:, 3, :, 1] = by[:, :, 1], by[:, :, 0]
        B = B.reshape(-1, 4, 18)
        volume = 2 * np.pi * radius * weight * np.abs(np.linalg.det(jacobian))
        matrices = matrices + volume[:, None, None] * np.einsum("eac,ab,ebd->ecd", B, D, B, optimize=True)
    rows = 2 * across + 1
    load = np.zeros_like(x)
    radii = x[-rows:, 0]
    for k in range(0, rows - 1, 2):  # Simpson's rule is exact for N r
        r = radii[k:k + 3]
        load[len(x) - rows + k:len(x) - rows + k + 3, 1] += 2 * np.pi * TRACTION * (r[2] - r[0]) / 6 * np.array([1, 4, 1]) * r
    free = np.ones_like(x, bool)
    free[x[:, 0] == 0, 0] = False
    free[:rows, 1] = False
    u = solve(matrices, elements, load.ravel(), free.ravel(), across, along)
    return load.ravel() @ u


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--across", type=int, nargs="+", default=[2, 4, 8], help="elements across the radius")
    bar = (TRACTION * np.pi * NARROW**2)**2 * LENGTH / (np.pi * YOUNG * WIDE * NARROW)
    for across in parser.parse_args().across:
        w = work(across)
        print(f"{across:2} across the radius: {1e3 * w:.6f} mJ, {w / bar:.6f} of that of a slender bar")


if __name__ == "__main__":
    main()
