#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Impact of an elastic ball on a rigid plane by Hertz: K. L. Johnson, Contact Mechanics (1985), section 11.4.

Usage: hertz.py RADIUS DENSITY YOUNGS_MODULUS POISSONS_RATIO SPEED [--balls]
All in SI; --balls: two equal balls, each with SPEED. Prints the largest force, the time of contact, the
largest approach and the largest radius of contact.
"""
import math
import sys

radius, density, modulus, nu, speed = map(float, sys.argv[1:6])
balls = "--balls" in sys.argv
mass = density * 4 * math.pi / 3 * radius ** 3
if balls:  # each deforms as on a plane: twice the approach, of half the reduced modulus, radius and mass
    mass, radius, modulus, speed = mass / 2, radius / 2, modulus / 2, 2 * speed
stiffness = modulus / (1 - nu * nu)
approach = (15 * mass * speed ** 2 / (16 * stiffness * math.sqrt(radius))) ** 0.4
force = 4 / 3 * stiffness * math.sqrt(radius) * approach ** 1.5
print(f"largest force {force:.6g} N, time of contact {1e3 * 2.9432 * approach / speed:.6g} ms, "
      f"approach {1e3 * approach:.5g} mm, radius of contact {1e3 * math.sqrt(radius * approach):.5g} mm")
