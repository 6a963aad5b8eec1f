#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Displacements of a tube that yields under inner pressure: plane strain, von Mises, no hardening.

Finite elements of the radius with one point each, loaded in steps, Newton's method in each. Usage:

    python3 yielding.py PRESSURE_OVER_YIELD_STRESS RADIUS_IN_MM ...
"""
import sys
from math import log, sqrt

YOUNG, NU, YIELD, INNER, OUTER = 10e9, 0.3, 10e6, 0.01, 0.02  # Pa, -, Pa, m, m
ELEMENTS, STEPS = 160, 60
SHEAR, BULK = YOUNG / 2 / (1 + NU), YOUNG / 3 / (1 - 2 * NU)


def stress_of(strain, plastic):
    """Stress, plastic strain, factor on the deviator and its direction after the return to the yield surface."""
    elastic = [e - p for e, p in zip(strain, plastic)]
    mean = sum(elastic) / 3
    deviator = [2 * SHEAR * (e - mean) for e in elastic]
    mises = sqrt(1.5 * sum(s * s for s in deviator))
    if mises <= YIELD:
        return [3 * BULK * mean + s for s in deviator], plastic, 1.0, None
    factor = YIELD / mises
    grown = [p + (mises - YIELD) / (3 * SHEAR) * 1.5 * s / mises for p, s in zip(plastic, deviator)]
    return [3 * BULK * mean + factor * s for s in deviator], grown, factor, [1.5 * s / mises for s in deviator]


def tangent(factor, normal):
    """d(radial, hoop stress) / d(radial, hoop strain)."""
    d = [[BULK + 2 * SHEAR * factor * ((i == j) - 1 / 3) for j in range(2)] for i in range(2)]
    if normal:
        for i in range(2):
            for j in range(2):
                d[i][j] -= 4 / 3 * SHEAR * factor * normal[i] * normal[j]
    return d


def solve(diagonal, off, right):
    """A symmetric tridiagonal system."""
    for k in range(1, len(right)):
        ratio = off[k - 1] / diagonal[k - 1]
        diagonal[k] -= ratio * off[k - 1]
        right[k] -= ratio * right[k - 1]
    right[-1] /= diagonal[-1]
    for k in range(len(right) - 2, -1, -1):
        right[k] = (right[k] - off[k] * right[k + 1]) / diagonal[k]
    return right


def displacements(pressure):
    """Radii and radial displacements [m] at the pressure [Pa]."""
    width = (OUTER - INNER) / ELEMENTS
    radii = [INNER + width * k for k in range(ELEMENTS + 1)]
    u, plastic = [0.0] * (ELEMENTS + 1), [[0.0] * 3] * ELEMENTS
    for step in range(1, STEPS + 1):
        start = plastic
        for _ in range(60):
            diagonal, off, right = [0.0] * (ELEMENTS + 1), [0.0] * ELEMENTS, [0.0] * (ELEMENTS + 1)
            right[0] = pressure * step / STEPS * INNER
            plastic = []
            for k in range(ELEMENTS):
                middle = radii[k] + width / 2
                rows = ((-1 / width, 1 / width), (0.5 / middle, 0.5 / middle))  # strains of the two displacements
                strain = [row[0] * u[k] + row[1] * u[k + 1] for row in rows] + [0.0]
                stress, grown, factor, normal = stress_of(strain, start[k])
                plastic.append(grown)
                d, weight = tangent(factor, normal), middle * width
                for a in range(2):
                    right[k + a] -= weight * sum(stress[i] * rows[i][a] for i in range(2))
                    for b in range(2):
                        term = weight * sum(rows[i][a] * d[i][j] * rows[j][b] for i in range(2) for j in range(2))
                        if a == b:
                            diagonal[k + a] += term
                        elif a < b:
                            off[k] += term
            change = solve(diagonal, off, right)
            u = [value + more for value, more in zip(u, change)]
            if max(map(abs, change)) < 1e-13:
                break
    return radii, u


def main():
    ratio, places = float(sys.argv[1]), [float(word) for word in sys.argv[2:]]
    print(f"limit: {2 / sqrt(3) * log(OUTER / INNER):.4f} of the yield stress")
    radii, u = displacements(ratio * YIELD)
    for place in places:
        k = min(int((place / 1e3 - INNER) / (OUTER - INNER) * ELEMENTS), ELEMENTS - 1)
        part = (place / 1e3 - radii[k]) / (radii[k + 1] - radii[k])
        print(f"{place:g} mm: {1e6 * ((1 - part) * u[k] + part * u[k + 1]):.4f} um")


if __name__ == "__main__":
    main()
