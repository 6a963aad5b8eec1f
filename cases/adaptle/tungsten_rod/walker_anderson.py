#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Penetration of a long rod by the model of Walker and Anderson: numbers of checks.toml.

Usage: walker_anderson.py

J. D. Walker, C. E. Anderson, Int. J. Impact Eng. 16 (1995) 19-48. Momentum along the axis, from the tail of the rod to where the target is at
rest; the target holds by 7/3 Y ln(alpha), alpha being the radius of its plastic zone over that of the crater:

    rho_p dv/dt (L - s) + du/dt [rho_p s + rho_t R (alpha - 1)/(alpha + 1)] + rho_p d/dt[(v - u)/s] s^2/2 + dalpha/dt 2 rho_t R u/(alpha + 1)^2
        = rho_p (v - u)^2/2 - [rho_t u^2/2 + 7/3 Y_t ln(alpha)]
    dv/dt = -Y_p/(rho_p (L - s)) [1 + (v - u)/c + (ds/dt)/c],   dL/dt = u - v,   s = R/2 (v/u - 1)(1 - 1/alpha^2)
    (1 + rho_t u^2/Y_t) sqrt(K - rho_t alpha^2 u^2) = (1 + rho_t alpha^2 u^2/(2 G)) sqrt(K - rho_t u^2),   K = rho_t (c0 + k u)^2
    R = (1 + 0.287 V + 0.148 V^2) times the radius of the rod, V its speed at the start in km/s

s is the length of the plastic zone in the rod, c the speed of waves in it. The strengths are the yield stresses themselves.
"""
import math

RHO_P, Y_P, E_P = 17600.0, 1.0e9, 360e9  # of the rod
RHO_T, Y_T, G_T = 7850.0, 0.8e9, 207e9 / 2.6  # of the target
C_P, K_P, C_T, K_T = 4029.0, 1.237, 4569.0, 1.49  # Hugoniot lines
LENGTH, RADIUS, GAP = 0.080, 0.004, 0.004  # m; the gap is flown before the rod touches


def plastic_zone(u):
    """alpha at the speed u of the interface, by halving: the left side falls with it, the right one rises."""
    q, bulk = RHO_T * u * u, RHO_T * (C_T + K_T * u) ** 2
    low, high = 1.0, math.sqrt(bulk / q)
    for _ in range(80):
        a = 0.5 * (low + high)
        left = (1 + q / Y_T) * math.sqrt(max(bulk - q * a * a, 0))
        low, high = (a, high) if left > (1 + q * a * a / (2 * G_T)) * math.sqrt(bulk - q) else (low, a)
    return 0.5 * (low + high)


def first_speed(v):
    """u behind the two plane shocks of the first touch."""
    low, high = 0.0, v
    for _ in range(80):
        u = 0.5 * (low + high)
        low, high = (u, high) if RHO_P * (C_P + K_P * (v - u)) * (v - u) > RHO_T * (C_T + K_T * u) * u else (low, u)
    return 0.5 * (low + high)


def depth(speed, begin, end, dt=2e-9):
    """How far the interface moves from one time of the case to another, and the rod's speed, u and 7/3 Y ln(alpha) then."""
    crater = RADIUS * (1 + 0.287e-3 * speed + 0.148e-6 * speed**2)
    v, u, length, z, t, at_begin = speed, first_speed(speed), LENGTH, 0.0, GAP / speed, 0.0

    def shape(v, u):
        a = plastic_zone(u)
        return a, 0.5 * crater * (v / u - 1) * (1 - 1 / a**2)

    alpha, s = shape(v, u)
    ds, da, rate = 0.0, 0.0, 0.0
    while t < end:
        dv = -Y_P / (RHO_P * (length - s)) * (1 + (v - u) / math.sqrt(E_P / RHO_P) + ds / math.sqrt(E_P / RHO_P))
        # d/dt of (v - u)/s = 2 u alpha^2/(R (alpha^2 - 1)), with du/dt of the step before
        slope = 4 / (crater * (alpha**2 - 1)) * (0.5 * alpha**2 * rate - u * alpha * da / (alpha**2 - 1))
        push = 0.5 * RHO_P * (v - u) ** 2 - 0.5 * RHO_T * u * u - 7 / 3 * Y_T * math.log(alpha)
        push -= RHO_P * dv * (length - s) + 0.5 * RHO_P * slope * s * s + 2 * RHO_T * crater * u * da / (alpha + 1) ** 2
        new = push / (RHO_P * s + RHO_T * crater * (alpha - 1) / (alpha + 1))
        rate = 0.5 * (rate + new)
        if t < begin <= t + dt:
            at_begin = z + u * (begin - t)
        length, v, z, t = length + dt * (u - v), v + dt * dv, z + dt * u, t + dt
        u += dt * rate
        a, b = shape(v, u)
        da, ds = 0.5 * (da + (a - alpha) / dt), 0.5 * (ds + (b - s) / dt)
        alpha, s = a, b
    return z - at_begin, v, u, 7 / 3 * Y_T * math.log(alpha)


if __name__ == "__main__":
    for v, begin, end in ((1000.0, 30e-6, 60e-6), (2000.0, 10e-6, 30e-6), (3000.0, 6e-6, 18e-6)):
        way, last, u, holds = depth(v, begin, end)
        print(f"{v:.0f} m/s: {1e3 * way:.3f} mm from {1e6 * begin:.0f} to {1e6 * end:.0f} us, mean {way / (end - begin):.1f} m/s;", end=" ")
        print(f"rod {last:.1f} m/s, u {u:.1f} m/s, target {holds / 1e9:.2f} GPa at the end")
