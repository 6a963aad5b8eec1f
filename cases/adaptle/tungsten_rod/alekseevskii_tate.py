#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Penetration of a long rod by the model of Alekseevskii and Tate, with the strengths of Tate 1986: numbers of checks.toml.

Usage: alekseevskii_tate.py

rho_p (v - u)^2/2 + Y_p = rho_t u^2/2 + R_t at the interface; dv/dt = -Y_p/(rho_p L), dL/dt = u - v of the rod behind it.
Y_p = 1.7 sigma_p, R_t = sigma_t (2/3 + ln(0.57 E_t/sigma_t)).
"""
import math

ROD, TARGET = 17600.0, 7850.0  # densities, kg/m^3
YIELD = 1.0e9  # of the rod, Pa
Y = 1.7 * YIELD
R = 0.8e9 * (2 / 3 + math.log(0.57 * 207e9 / 0.8e9))
LENGTH = 0.080  # m
GAP = 0.004  # m, which the rod flies before it touches


def speed(v):
    """u at the rod's speed v; 0 below the speed at which the target holds."""
    a, b, c = (ROD - TARGET) / 2, -ROD * v, ROD * v * v / 2 + Y - R
    return max((-b - math.sqrt(b * b - 4 * a * c)) / (2 * a), 0.0)


def depth(v, begin, end, drag=Y, steps=20000):
    """How far the interface moves from one time of the case to another, and the rod's speed then, by the midpoint rule."""
    t, length, z, at_begin = GAP / v, LENGTH, 0.0, 0.0
    dt = (end - t) / steps
    for _ in range(steps):
        half_v, half_length = v - dt / 2 * drag / (ROD * length), length + dt / 2 * (speed(v) - v)
        u = speed(half_v)
        if t < begin <= t + dt:
            at_begin = z + u * (begin - t)
        z, length, v, t = z + dt * u, length + dt * (u - half_v), v - dt * drag / (ROD * half_length), t + dt
    return z - at_begin, v


if __name__ == "__main__":
    print(f"R_t = {R / 1e9:.4f} GPa, Y_p = {Y / 1e9:.4f} GPa")
    for v, begin, end in ((1000.0, 30e-6, 60e-6), (2000.0, 10e-6, 30e-6), (3000.0, 6e-6, 18e-6)):
        way, last = depth(v, begin, end)
        print(f"{v:.0f} m/s: u = {speed(v):.1f} m/s at the start, hydrodynamic {v / (1 + math.sqrt(TARGET / ROD)):.1f};", end=" ")
        print(f"{1e3 * way:.3f} mm from {1e6 * begin:.0f} to {1e6 * end:.0f} us, mean {way / (end - begin):.1f} m/s; rod {last:.1f} m/s,", end=" ")
        print(f"{depth(v, begin, end, YIELD)[1]:.1f} m/s where its yield stress alone brakes it")
