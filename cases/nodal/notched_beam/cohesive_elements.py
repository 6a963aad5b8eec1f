#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Force and work by deflection of the notched beam, from finite elements with a cohesive crack in the plane of symmetry.

Usage: cohesive_elements.py [spacing in mm]

Bilinear elements with incompatible modes, plane strain (Poisson's ratio 0: also the beam in space), half of the beam.
The elements are condensed to the nodes of the crack; each deflection is solved by Newton's method. The traction of the
crack falls linearly from the tensile strength to zero at an opening of 2 G / f.
"""
import sys
import numpy as np

YOUNG, STRENGTH, TOUGHNESS = 32e9, 3e6, 50.0  # Pa, Pa, J/m2
DEPTH, SPAN, LENGTH, WIDTH, NOTCH = 0.04, 0.11, 0.14, 0.01, 0.02  # m


def element_stiffness(h):
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
            weight = h * h / 4 * WIDTH
            K += weight * B.T @ C @ B
            K_modes += weight * B.T @ C @ A
            modes += weight * A.T @ C @ A
    return K - K_modes @ np.linalg.solve(modes, K_modes.T)


def condensed(h):
    """Stiffness of the openings at the nodes of the crack and of the deflection, and the areas of these nodes."""
    nx, ny = round(LENGTH / 2 / h), round(DEPTH / h)
    number = lambda i, j: i * (ny + 1) + j
    size = 2 * (nx + 1) * (ny + 1)
    whole, K = np.zeros((size, size)), element_stiffness(h)
    for i in range(nx):
        for j in range(ny):
            nodes = number(i, j), number(i + 1, j), number(i + 1, j + 1), number(i, j + 1)
            at = [2 * n + c for n in nodes for c in (0, 1)]
            whole[np.ix_(at, at)] += K
    crack = [2 * number(0, j) for j in range(ny + 1) if j * h > NOTCH - 1e-9]
    outer = np.array(crack + [2 * number(0, ny) + 1])
    inner = np.setdiff1d(np.arange(size), np.append(outer, 2 * number(round(SPAN / 2 / h), 0) + 1))
    across = whole[np.ix_(inner, outer)]
    area = np.full(len(crack), WIDTH * h)
    area[[0, -1]] /= 2
    return whole[np.ix_(outer, outer)] - across.T @ np.linalg.solve(whole[np.ix_(inner, inner)], across), area


def traction(opening, largest, stiffness):
    """Traction and its slope. largest: opening so far, from which the traction unloads along a secant."""
    first, last = STRENGTH / stiffness, 2 * TOUGHNESS / STRENGTH
    reached = max(opening, largest, first)
    bound = max(0.0, STRENGTH * (last - reached) / (last - first))
    if opening > max(largest, first):
        return bound, -STRENGTH / (last - first) if reached < last else 0.0
    return (stiffness * opening, stiffness) if opening <= 0 else (bound * opening / reached, bound / reached)


def main():
    h = float(sys.argv[1]) * 1e-3 if len(sys.argv) > 1 else 1.25e-3
    K, area = condensed(h)
    n, step, stiffness = len(area), 1e-6, 200 * YOUNG / h
    u, largest, force, work, peak = np.zeros(n), np.zeros(n), 0.0, 0.0, 0.0
    for k in range(1, 301):
        deflection = k * step
        for _ in range(300):
            law = np.array([traction(2 * a, b, stiffness) for a, b in zip(u, largest)])
            rest = K[:n, :n] @ u - K[:n, n] * deflection + area * law[:, 0]
            if np.abs(rest).max() < 1e-8:
                break
            u -= np.linalg.solve(K[:n, :n] + np.diag(2 * area * law[:, 1]), rest)
        else:
            sys.exit(f"no equilibrium at a deflection of {deflection:g} m")
        largest = np.maximum(largest, 2 * u)
        before, force = force, 2 * (K[n, n] * deflection - K[n, :n] @ u)
        work, peak = work + 0.5 * (before + force) * step, max(peak, force)
        if k in (50, 100, 200, 300):
            print(f"{k} um: {force:.2f} N, {1e3 * work:.3f} mJ")
    print(f"largest force: {peak:.2f} N")


if __name__ == "__main__":
    main()
