#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Where an imploding shell of copper stops, for checks.toml.

Usage: stop.py [RADIUS ...]     radii [mm] at the start, such as those of the innermost layer of particles
An incompressible flow, r^3 = R^3 - a^3 + r_a^3, of a rigid, perfectly plastic material with elastic shear: the kinetic
energy 2 pi rho v^2 a^4 (1/a - 1/b) at the start equals the plastic work and the elastic energy of the deviator at the
stop, int 4 pi R^2 [2 Y ln(R/r) - Y^2/(6 mu)] dR. Prints the radius of the inner surface at the stop, and of each radius.
"""
import math
import sys

A, B, SPEED = 80e-3, 100e-3, 300.0
RHO, YIELD, SHEAR = 8930.0, 400e6, 117e9 / (2 * 1.35)
POINTS = 4000


def work(inner):
    """Up to an inner radius, by the midpoint rule."""
    step, total = (B - A) / POINTS, 0.0
    for i in range(POINTS):
        start = A + (i + 0.5) * step
        now = (start ** 3 - A ** 3 + inner ** 3) ** (1 / 3)
        total += 4 * math.pi * start ** 2 * step * (2 * YIELD * math.log(start / now) - YIELD ** 2 / (6 * SHEAR))
    return total


low, high = 1e-3, A
while high - low > 1e-9:
    middle = 0.5 * (low + high)
    if work(middle) < 2 * math.pi * RHO * SPEED ** 2 * A ** 4 * (1 / A - 1 / B):
        high = middle
    else:
        low = middle
print(f"inner surface {1e3 * low:.4f} mm")
for text in sys.argv[1:]:
    print(f"from {text} mm to {1e3 * ((1e-3 * float(text)) ** 3 - A ** 3 + low ** 3) ** (1 / 3):.4f} mm")
