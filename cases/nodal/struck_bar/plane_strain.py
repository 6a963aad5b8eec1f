#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A copper bar that is struck and bends across yield, by finite elements, for the references in checks.toml.

    python3 cases/nodal/struck_bar/plane_strain.py [--across 8]

The elements of ../taylor_bar/axisymmetric.py in plane strain: quadrilaterals with 2 x 2 points and one pressure each
(mean dilatation), deviator by its Jaumann rate and radial return in the geometry of half time, lumped masses, central
differences. Prints what the middle of the free end does: the first peak of its deflection [mm], and the mean from 0.6 to
1.2 ms; and the largest plastic strain. numpy alone.
"""
import argparse
import pathlib
import sys
import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "taylor_bar"))
from axisymmetric import CORNERS, Linear, flow, step_length  # noqa: E402

LENGTH, HEIGHT, SPEED, END, SETTLED = 60e-3, 10e-3, 60.0, 1.2e-3, 0.6e-3


def mesh(across):
    """Nodes (x, y) and square elements; the middle of the free end is a node for even numbers across."""
    along = round(LENGTH / HEIGHT * across)
    y, x = np.meshgrid(np.linspace(-HEIGHT / 2, HEIGHT / 2, across + 1), np.linspace(0, LENGTH, along + 1))
    i, j = np.meshgrid(np.arange(along), np.arange(across), indexing="ij")
    first = (i * (across + 1) + j).ravel()
    return np.stack([x.ravel(), y.ravel()], 1), first[:, None] + np.array([0, across + 1, across + 2, 1])


def points(x, elements):
    """Of each element and point: shape functions, their derivatives by x and y, a radius without end, area."""
    xe = x[elements]
    for g in CORNERS / np.sqrt(3):
        shape = 0.25 * np.prod(1 + g * CORNERS, 1)
        local = 0.25 * CORNERS * (1 + g * CORNERS)[:, ::-1]
        jacobian = np.einsum("ka,ekb->eab", local, xe)
        yield shape, np.einsum("eba,ka->ekb", np.linalg.inv(jacobian), local), np.inf, np.linalg.det(jacobian)


def run(bar, across):
    """Times and deflections of the middle of the end; the largest plastic strain."""
    x, elements = mesh(across)
    middle = len(x) - 1 - across // 2
    v = np.stack([0 * x[:, 0], -SPEED * x[:, 0] / LENGTH], 1)
    held = x[:, 0] == 0
    mass, start = np.zeros(len(x)), np.zeros(len(elements))
    for shape, _, _, area in points(x, elements):
        np.add.at(mass, elements, bar.rho * area[:, None] * shape)
        start += area
    none, energy = np.zeros(len(elements)), np.zeros(len(elements))
    S, state = [np.zeros((len(elements), 4))] * 4, [(none, none)] * 4
    time, dt, curve = 0.0, step_length(bar, x, elements), []
    while time < END:
        half, x = x + 0.5 * dt * v, x + dt * v
        force, opening, volume = np.zeros_like(x[elements]), np.zeros_like(x[elements]), 0
        for q, (before, now) in enumerate(zip(points(half, elements), points(x, elements))):
            S[q], state[q] = flow(bar, S[q], state[q], v[elements], *before[:3], dt)
            by, area = now[1], now[3][:, None]
            xx, yy, _, xy = S[q].T[:, :, None]
            force[:, :, 0] -= area * (xx * by[:, :, 0] + xy * by[:, :, 1])
            force[:, :, 1] -= area * (xy * by[:, :, 0] + yy * by[:, :, 1])
            opening += area[:, :, None] * by
            volume = volume + now[3]
        force += bar.pressure(volume / start, energy / start)[:, None, None] * opening
        energy -= dt * np.einsum("eka,eka->e", force, v[elements])
        total = np.zeros_like(x)
        np.add.at(total, elements, force)
        following = min(1.02 * dt, step_length(bar, x, elements))
        v = v + 0.5 * (dt + following) * total / mass[:, None]
        v[held] = 0
        time, dt = time + dt, following
        curve.append((time, x[middle, 1]))
    return np.array(curve), np.max([strain for strain, _ in state])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--across", type=int, default=8, help="elements across the bar, an even number")
    across = parser.parse_args().across
    curve, strain = run(Linear(), across)
    time, y = curve.T
    late = time >= SETTLED
    mean = np.sum(0.5 * (y[late][1:] + y[late][:-1]) * np.diff(time[late])) / (time[late][-1] - time[late][0])
    print(f"first peak {-1e3 * np.min(y[time < SETTLED]):.4f} mm at {1e3 * time[np.argmin(y)]:.3f} ms, then on average "
          f"{-1e3 * mean:.4f} mm, largest plastic strain {strain:.4f}")


if __name__ == "__main__":
    main()
