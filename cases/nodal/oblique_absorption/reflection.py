#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Plane pressure waves at a surface with dashpots: velocities of the reflected pressure and shear waves over that of the
wave that comes in, and the share of the energy that they keep.

Usage: reflection.py [POISSONS_RATIO]
"""
import sys

import numpy as np


def wave(speed, direction, polarisation, lam, mu):
    """Velocity and traction on the normal x of a wave whose displacement has the slope 1."""
    stress = lam * np.dot(direction, polarisation) * np.eye(2)
    stress = stress + mu * (np.outer(direction, polarisation) + np.outer(polarisation, direction))
    return -speed * polarisation, stress[:, 0]


def reflection(angle, nu, normal, shear):
    """Amplitudes in velocity, and share of the energy, for factors on both impedances."""
    lam, mu = nu / ((1 + nu) * (1 - 2 * nu)), 0.5 / (1 + nu)
    cp, cs = np.sqrt(lam + 2 * mu), np.sqrt(mu)
    sine = np.sin(angle)
    p = np.array([np.cos(angle), sine])
    back = np.array([-np.cos(angle), sine])
    s = np.array([-np.sqrt(1 - (sine * cs / cp) ** 2), sine * cs / cp])
    across = np.array([-s[1], s[0]])
    drag = np.diag([normal * cp, shear * cs])
    (v, t), (vp, tp), (vs, ts) = (wave(*w, lam, mu) for w in ((cp, p, p), (cp, back, back), (cs, s, across)))
    found = np.linalg.solve(np.array([tp + drag @ vp, ts + drag @ vs]).T, -(t + drag @ v))
    amplitude = np.abs(found) * np.array([cp, cs]) / cp
    energy = amplitude[0] ** 2 + amplitude[1] ** 2 * cs * -s[0] / (cp * np.cos(angle))
    return *amplitude, energy


def tuned(angle, nu):
    """Factors on the impedances that `angle` stands for."""
    ratio = (1 - 2 * nu) / (2 * (1 - nu))  # mu over the modulus of pressure waves
    return (1 - 2 * ratio * np.sin(angle) ** 2) / np.cos(angle), 2 * np.sqrt(ratio) * np.cos(angle)


def main():
    nu = float(sys.argv[1]) if len(sys.argv) > 1 else 0.25
    print(f"Poisson's ratio {nu}\nangle  factors           pressure  shear   energy")
    for degrees in (0, 15, 30, 45, 60):
        for factors in ((1, 1), tuned(np.radians(30), nu), (0.5, 0.5)):
            p, s, energy = reflection(np.radians(degrees), nu, *factors)
            print(f"{degrees:5}  {factors[0]:.4f} {factors[1]:.4f}  {p:12.4f} {s:9.4f} {energy:10.6f}")


if __name__ == "__main__":
    main()
