#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Oblique impact of an elastic ball on a rigid plane with Coulomb friction: the numbers of checks.toml.

Hertz's normal and Cattaneo's and Mindlin's tangential contact, reduced to a row of independent springs (V. L. Popov and
M. Hess, Method of Dimensionality Reduction in Contact Mechanics and Friction, Springer 2015, chapters 3 and 5); its
results are those of N. Maw, J. R. Barber and J. N. Fawcett, Wear 38, 101-114 (1976). Friction acts at the radius of the
ball. Prints for each angle: v_x' / v_x, omega' R / v_x and the velocity of the contact point over v_x.
"""
from math import pi, sqrt, tan, radians

R, rho, E, nu, mu, v_n = 0.05, 1100.0, 10e6, 0.45, 0.3, 1.0
springs, steps = 400, 20000


def impact(v_x):
    m = 4 / 3 * pi * R**3 * rho
    inertia = 0.4 * m * R * R
    k_z = E / (1 - nu * nu)  # per length
    k_x = k_z * 2 * (1 - nu) / (2 - nu)
    depth = (15 * m * v_n**2 / (16 * k_z * sqrt(R))) ** 0.4
    width = 1.05 * sqrt(R * depth)
    dx = width / springs
    place = [(i + 0.5) * dx for i in range(springs)]
    dt = 2.94 * depth / v_n / steps
    d, vz, vx, spin = 0.0, v_n, v_x, 0.0
    stretch = [0.0] * springs
    while vz > 0 or d > 0:
        d += vz * dt
        slip = (vx - R * spin) * dt
        f_z = f_x = 0.0
        for i, x in enumerate(place):
            u = d - x * x / R
            if u <= 0:
                stretch[i] = 0.0
                continue
            most = mu * k_z * u / k_x
            stretch[i] = max(-most, min(most, stretch[i] + slip))
            f_z += 2 * dx * k_z * u
            f_x += 2 * dx * k_x * stretch[i]
        vz -= f_z / m * dt
        vx -= f_x / m * dt
        spin += R * f_x / inertia * dt
    return vx / v_x, R * spin / v_x


for angle in (20, 45, 70):
    v_x = v_n * tan(radians(angle))
    after, spin = impact(v_x)
    print(f"{angle} degrees, v_x = {v_x:.5f} m/s: {after:.4f} {spin:.4f} {after - spin:.4f}")
