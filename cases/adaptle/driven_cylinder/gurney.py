#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Velocity of the wall of the case's cylinder from the energy of its gases.

Gases of one density whose velocity grows linearly with the radius hold a quarter of C v^2 (R. W. Gurney, BRL report 405, 1943),
so that  (M/2 + C/4) v^2 = C (E0 - E_s(V))/rho0 - plastic work.  E_s is the isentrope of Jones, Wilkins and Lee,
A/R1 exp(-R1 V) + B/R2 exp(-R2 V) + c/(omega V^omega): through (V = 1, E0) if all burns at once, through the state of Chapman
and Jouguet behind a detonation.

Usage: gurney.py RADIUS         mean radius of the wall in mm
"""
import math
import sys

RHO, A, B, R1, R2, OMEGA, E0, D, P_CJ = 1717.0, 524.2e9, 7.678e9, 4.2, 1.1, 0.34, 8.5e9, 7980.0, 29.5e9
CHARGE, INNER, OUTER, COPPER, YIELD = 12.7e-3, 13e-3, 15.556e-3, 8930.0, 300e6


def exponentials(V):
    return A / R1 * math.exp(-R1 * V) + B / R2 * math.exp(-R2 * V)


def velocity(mean_radius, at_once):
    gas, metal = math.pi * CHARGE**2, math.pi * (OUTER**2 - INNER**2)
    inner = math.sqrt(mean_radius**2 - metal / (2 * math.pi))  # roughly: half of the metal is inside
    V = (inner / CHARGE) ** 2
    if at_once:
        c = (E0 - exponentials(1)) * OMEGA
    else:
        Vj = 1 - P_CJ / (RHO * D * D)
        c = (E0 + P_CJ * (1 - Vj) / 2 - exponentials(Vj)) * OMEGA * Vj**OMEGA
    given = gas * (E0 - exponentials(V) - c / (OMEGA * V**OMEGA))
    start = math.sqrt((INNER**2 + OUTER**2) / 2)
    plastic = metal * 2 / math.sqrt(3) * YIELD * math.log(mean_radius / start)
    return math.sqrt((given - plastic) / (COPPER * metal / 2 + RHO * gas / 4))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    r = float(sys.argv[1]) * 1e-3
    print(f"{velocity(r, True):.0f} m/s if all burns at once, {velocity(r, False):.0f} m/s behind a detonation")
