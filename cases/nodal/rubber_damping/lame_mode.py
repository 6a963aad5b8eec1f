#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Peaks of the Lame mode of a square block of linear viscoelastic rubber [mm] and their times [ms], as in checks.toml.

With the amplitude q, k = pi/a and internal variables h_i of the Prony terms:
q'' = -(2 k^2 mu/rho) ((1 - sum g) q + sum g_i h_i),  h_i' = q' - h_i / tau_i.
"""
import numpy as np

SIDE, DENSITY, MODULUS, SPEED = 0.1, 1100, 2e6, 0.1


def amplitude(terms, times):
    square, count = 2 * (np.pi / SIDE) ** 2 * MODULUS / DENSITY, len(terms)
    system = np.zeros((2 + count, 2 + count))
    system[0, 1], system[1, 0] = 1, -square * (1 - sum(g for g, _ in terms))
    for i, (g, tau) in enumerate(terms):
        system[1, 2 + i], system[2 + i, 1], system[2 + i, 2 + i] = -square * g, 1, -1 / tau
    values, vectors = np.linalg.eig(system)
    start = np.linalg.solve(vectors, np.r_[0, SPEED, np.zeros(count)])
    return (vectors[0] * start * np.exp(np.outer(times, values))).sum(axis=1).real


for terms in ([(0.2, 0.5e-3), (0.3, 5e-3)], [(0.3, 1e-3)], [(0.3, 0.1e-3)], []):
    times = np.linspace(0, 0.012, 1_200_001)
    q = amplitude(terms, times)
    peaks = np.flatnonzero((q[1:-1] > q[:-2]) & (q[1:-1] >= q[2:])) + 1
    print(terms, [f"{1e3 * q[p]:.5f} at {1e3 * times[p]:.3f}" for p in peaks])
