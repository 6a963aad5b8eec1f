#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Spherical shell that yields under pressure inside: R. Hill, The Mathematical Theory of Plasticity (1950), chapter V.

Usage: hill.py [RADIUS ...]     radii [mm] whose displacement is printed; radii of the shell 10 and 20 mm, front at 15 mm
Perfectly plastic, yield stress Y, small strains. With the front at c
  p = 2 Y [ln(c/a) + (1 - c^3/b^3)/3]
  u = 2 Y c^3/(3 E b^3) [(1 - 2 nu) R + (1 + nu) b^3/(2 R^2)]                 for R > c
  plastic strain = 2 (1 - nu) Y/E (c^3/R^3 - 1)                                for R < c
The mean of the plastic strain over the shell tells where the front is: it grows as c^3 ln(c/a) - (c^3 - a^3)/3.
"""
import math
import sys

A, B, C = 10.0, 20.0, 15.0
YIELD, MODULUS, NU = 200e6, 200e9, 0.3


def mean_plastic_strain(c):
    return 6 * (1 - NU) * YIELD / MODULUS * (c ** 3 * math.log(c / A) - (c ** 3 - A ** 3) / 3) / (B ** 3 - A ** 3)


print(f"pressure / Y {2 * (math.log(C / A) + (1 - C ** 3 / B ** 3) / 3):.6f}")
for factor in (0.98, 1, 1.02):
    print(f"mean plastic strain with the front at {factor * C:.2f} mm: {mean_plastic_strain(factor * C):.6g}")
for text in sys.argv[1:]:
    R = float(text)
    u = 2 * YIELD * C ** 3 / (3 * MODULUS * B ** 3) * ((1 - 2 * NU) * R + (1 + NU) * B ** 3 / (2 * R * R))
    print(f"displacement at {text} mm: {1e3 * u:.4f} um")
