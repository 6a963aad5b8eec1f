#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ballistic limits of the experiments and of runs, by the formula of Recht and Ipson.

Usage: ballistic_limit.py [study.csv of `piola study ballistic_limit.toml`]

R. F. Recht, T. W. Ipson, J. Appl. Mech. 30 (1963) 384-390: v_r = a sqrt(v_i^2 - v_bl^2), a = m/(m + m_plug) for a blunt projectile. The plug is taken as
wide as the projectile. Each pair of velocities gives a limit; the lowest pair above it the best one.
"""
import csv
import math
import sys

MASS, PLUG = 0.197, 7850 * math.pi * 0.010**2 * 0.012  # kg
PAIRS = ((303.5, 199.7), (244.2, 132.6), (200.4, 71.4))  # Borvik and others 2002, Part I, from knowledge


def limit(v, residual):
    """v_bl of one pair [m/s]; larger than v if the projectile did not get through."""
    share = MASS / (MASS + PLUG)
    return math.sqrt(max(v * v - (residual / share) ** 2, 0)) if residual > 0 else math.inf


if __name__ == "__main__":
    pairs = PAIRS
    if len(sys.argv) > 1:
        rows = csv.DictReader(line for line in open(sys.argv[1], encoding="utf-8") if not line.startswith("#"))
        pairs = [(float(r["constants.v"].split()[0]), float(r["residual_velocity"])) for r in rows]
    for v, residual in pairs:
        bound = limit(v, residual)
        print(f"{v:.1f} m/s -> {residual:.1f} m/s:", "stopped" if bound == math.inf else f"v_bl = {bound:.1f} m/s")
