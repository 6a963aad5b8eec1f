#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Impact of a rod with a round end on a rigid plane: J. E. Sears, Trans. Cambridge Philos. Soc. 21 (1908) 49-105.

Usage: sears.py RADIUS LENGTH DENSITY YOUNGS_MODULUS POISSONS_RATIO SPEED     all in SI; LENGTH of the cylinder alone
The nose follows Hertz, F = 4/3 E/(1 - nu^2) sqrt(R) d^1.5; the rod, as long as its volume, carries plane waves: a force
F slows its end down by F/(rho c A), and again by twice that each time its wave has come back from the free end. Prints
the largest force, the time of contact and the momentum after over that before.
"""
import math
import sys

radius, length, density, modulus, nu, speed = map(float, sys.argv[1:7])
length += 2 / 3 * radius
wave = math.sqrt(modulus / density)
impedance = density * wave * math.pi * radius ** 2
stiffness = 4 / 3 * modulus / (1 - nu * nu) * math.sqrt(radius)
dt = length / wave / 20000
delay = round(2 * length / wave / dt)
force, impulse, d, t = [0.0], 0.0, 0.0, 0.0
while True:
    rate = speed - force[-1] / impedance
    for k in range(1, len(force) // delay + 1):
        rate -= 2 * force[len(force) - 1 - k * delay] / impedance
    d, t = d + dt * rate, t + dt
    if d <= 0:
        break
    force.append(stiffness * d ** 1.5)
    impulse += dt * force[-1]
before = density * math.pi * radius ** 2 * length * speed
print(f"largest force {max(force):.5g} N, time of contact {1e3 * t:.5g} ms, "
      f"momentum after / before {impulse / before - 1:.5g} (before: {before:.6g} kg m/s)")
