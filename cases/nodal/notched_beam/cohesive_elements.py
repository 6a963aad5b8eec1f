#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Force and work of notched_beam and wedge_splitting, from finite elements with a cohesive crack at the symmetry plane.

Usage: cohesive_elements.py [beam | wedge] [spacing in mm]

Bilinear elements with incompatible modes, plane strain (Poisson's ratio 0: also the body in space), half of the body:
x is the normal of the crack, y runs along it. The elements are condensed to the nodes of the crack and of the load;
each displacement of the load is solved by Newton's method. The traction of the crack falls linearly from the tensile
strength to zero at an opening of 2 G / f.
"""
import sys
from types import SimpleNamespace
import numpy as np

YOUNG, TOUGHNESS = 32e9, 50.0  # Pa, J/m2
# Lengths in m. length: of the whole body along x. load: place and direction of the force on this half, and its sign.
# held: place and direction of a support, other than the plane of symmetry.
BODIES = {
    "beam": SimpleNamespace(
        strength=3e6, length=0.14, depth=0.04, width=0.01, notch=0.02, load=(0.0, 0.04, 1, -1), held=(0.055, 0.0, 1)
    ),
    "wedge": SimpleNamespace(
        strength=6e6, length=0.08, depth=0.08, width=0.02, notch=0.04, load=(0.0, 0.01, 0, 1), held=(0.0, 0.08, 1)
    ),
}


def element_stiffness(h, width):
    """8 x 8, of a square of side h, its incompatible modes condensed."""
    C = YOUNG * np.diag([1, 1, 0.5])
    xi, eta, point = np.array([-1, 1, 1, -1]), np.array([-1, -1, 1, 1]), 1 / np.sqrt(3)
    K, K_modes, modes = np.zeros((8, 8)), np.zeros((8, 4)), np.zeros((4, 4))
    for s in (-point, point):
        for t in (-point, point):
            dx, dy = xi * (1 + eta * t) / 2 / h, eta * (1 + xi * s) / 2 / h
            B, A = np.zeros((3, 8)), np.zeros((3, 4))
            B[0, 0::2], B[1, 1::2], B[2, 0::2], B[2, 1::2] = dx, dy, dy, dx
            for k, (gx, gy) in enumerate(((-4 * s / h, 0), (0, -4 * t / h))):
                A[0, 2 * k], A[1, 2 * k + 1], A[2, 2 * k], A[2, 2 * k + 1] = gx, gy, gy, gx
            weight = h * h / 4 * width
            K += weight * B.T @ C @ B
            K_modes += weight * B.T @ C @ A
            modes += weight * A.T @ C @ A
    return K - K_modes @ np.linalg.solve(modes, K_modes.T)


def condensed(body, h):
    """Stiffness of the openings at the nodes of the crack and of the load's displacement, and areas of these nodes."""
    nx, ny = round(body.length / 2 / h), round(body.depth / h)
    number = lambda i, j: i * (ny + 1) + j
    place = lambda x, y, direction: 2 * number(round(x / h), round(y / h)) + direction
    size = 2 * (nx + 1) * (ny + 1)
    whole, K = np.zeros((size, size)), element_stiffness(h, body.width)
    for i in range(nx):
        for j in range(ny):
            nodes = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            at = [2 * n + c for n in nodes for c in (0, 1)]
            whole[np.ix_(at, at)] += K
    crack = [2 * number(0, j) for j in range(ny + 1) if j * h > body.notch - 1e-9]
    outer = np.array(crack + [place(*body.load[:3])])
    inner = np.setdiff1d(np.arange(size), np.append(outer, place(*body.held)))
    across = whole[np.ix_(inner, outer)]
    area = np.full(len(crack), body.width * h)
    area[[0, -1]] /= 2
    return whole[np.ix_(outer, outer)] - across.T @ np.linalg.solve(whole[np.ix_(inner, inner)], across), area


def traction(strength, opening, largest, stiffness):
    """Traction and its slope. largest: opening so far, from which the traction unloads along a secant."""
    first, last = strength / stiffness, 2 * TOUGHNESS / strength
    reached = max(opening, largest, first)
    bound = max(0.0, strength * (last - reached) / (last - first))
    if opening > max(largest, first):
        return bound, -strength / (last - first) if reached < last else 0.0
    return (stiffness * opening, stiffness) if opening <= 0 else (bound * opening / reached, bound / reached)


def main():
    body = BODIES[sys.argv[1] if len(sys.argv) > 1 else "beam"]
    h = float(sys.argv[2]) * 1e-3 if len(sys.argv) > 2 else 1.25e-3
    K, area = condensed(body, h)
    # A force along y in the plane of symmetry is that of both halves. Along x, each half moves by half of the opening.
    n, step, stiffness = len(area), 1e-6, 200 * YOUNG / h
    along_crack = body.load[2] == 1
    u, largest, force, work, peak = np.zeros(n), np.zeros(n), 0.0, 0.0, 0.0
    for k in range(1, 301):
        displacement = body.load[3] * k * step * (1 if along_crack else 0.5)
        for iteration in range(300):
            law = np.array([traction(body.strength, 2 * a, b, stiffness) for a, b in zip(u, largest)])
            rest = K[:n, :n] @ u + K[:n, n] * displacement + area * law[:, 0]
            if np.abs(rest).max() < 1e-8:
                break
            # Full steps may cycle between two states of a node.
            u -= np.linalg.solve(K[:n, :n] + np.diag(2 * area * law[:, 1]), rest) * (1 if iteration < 30 else 0.5)
        else:
            sys.exit(f"no equilibrium at {k} um")
        largest = np.maximum(largest, 2 * u)
        before, force = force, (2 if along_crack else 1) * body.load[3] * (K[n, n] * displacement + K[n, :n] @ u)
        work, peak = work + 0.5 * (before + force) * step, max(peak, force)
        if k in (50, 100, 200, 300):
            print(f"{k} um: {force:.2f} N, {1e3 * work:.3f} mJ")
    print(f"largest force: {peak:.2f} N")


if __name__ == "__main__":
    main()
