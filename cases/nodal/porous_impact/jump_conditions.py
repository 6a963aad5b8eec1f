#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""State behind the shock of the case porous_impact, by the jump conditions of Rankine and Hugoniot.

rho0 (u2 - u1)^2 = (s2 - s1)(J1 - J2), e2 - e1 = (s1 + s2)(J1 - J2)/(2 rho0), s = p + 2/3 Y, with the pressure of p_alpha.
"""
RHO0, DISTENSION, C0, S1, GAMMA = 2160.0, 1.25, 5300.0, 1.34, 2.1
P_ELASTIC, P_SOLID, EXPONENT = 0.1e9, 1e9, 2
SOLID = DISTENSION * RHO0


def root(function, low, high):
    """Root of a function that changes its sign between low and high."""
    rises = function(high) > 0
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if (function(middle) > 0) == rises else (middle, high)
    return middle


def solid_pressure(density, energy):
    m = density / SOLID - 1
    cold = SOLID * C0**2 * m
    if m > 0:
        cold *= (1 + (1 - GAMMA / 2) * m) / (1 - (S1 - 1) * m) ** 2
    return cold + GAMMA * SOLID * energy


def crushed(pressure):
    """Distension on the crush curve; pores are rigid below P_ELASTIC."""
    left = (P_SOLID - max(pressure, P_ELASTIC)) / (P_SOLID - P_ELASTIC)
    return 1 + (DISTENSION - 1) * max(left, 0) ** EXPONENT


def behind(speed, strength, first_pressure):
    """Pressure [Pa] and density [kg/m^3]; with a precursor of first_pressure, 0: none."""
    def pressure(J, energy_at):
        return root(lambda p: crushed(p) * p - solid_pressure(crushed(p) * RHO0 / J, energy_at(p)), 0.0, 1e11)

    def energy(J, p):
        return 0.5 * p * (1 - J) / RHO0
    J1, u1, e1 = 1.0, 0.0, 0.0
    if first_pressure > 0:
        J1 = root(lambda J: DISTENSION * first_pressure
                  - solid_pressure(SOLID / J, energy(J, first_pressure)), 0.99, 1.0)
        u1, e1 = (first_pressure * (1 - J1) / RHO0) ** 0.5, energy(J1, first_pressure)

    def state(J):
        return pressure(J, lambda p: e1 + 0.5 * (p + 2 / 3 * strength + first_pressure) * (J1 - J) / RHO0)
    J = root(lambda J: (max(state(J) + 2 / 3 * strength - first_pressure, 0) * (J1 - J) / RHO0) ** 0.5 + u1 - speed,
             0.5 if first_pressure == 0 else 0.75, J1 - 1e-9)
    return state(J), RHO0 / J


if __name__ == "__main__":
    for speed, strength, precursor in ((1000, 50e6, 0), (2000, 50e6, 0), (200, 0, P_ELASTIC)):
        p, density = behind(speed, strength, precursor)
        print(f"{speed} m/s: {p / 1e9:.4f} GPa, {density:.1f} kg/m^3")
