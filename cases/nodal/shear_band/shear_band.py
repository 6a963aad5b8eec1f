#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reference of the case shear_band: simple shear of a layer, one-dimensional, by finite differences.

rho v' = tau_y; tau' = G (v_y - gamma_p'); tau <= Y(e)(1 - T*)/sqrt 3, e = gamma_p/sqrt 3; rho c T' = tau gamma_p' + k T_yy.
Prints the plastic shear strain and the temperature in the middle of the layer, and the mean shear stress.

Usage: shear_band.py [cells] [conductivity]
"""
import sys

import numpy as np

H, SPEED, END = 20e-6, 100.0, 120e-9
RHO, E, NU, C = 4430.0, 114e9, 0.33, 560.0
A, B, N, T0, MELTING = 900e6, 100e6, 0.3, 293.0, 1000.0
RATE, REFERENCE_RATE = 0.1, 1e5
G = E / (2 * (1 + NU))


def strength(plastic_strain, temperature, rate):
    """Flow stress of Johnson and Cook."""
    softened = np.clip(1 - (temperature - T0) / (MELTING - T0), 0, 1)
    hardened = A + B * np.maximum(plastic_strain, 0) ** N
    return hardened * softened * (1 + RATE * np.log(np.maximum(rate / REFERENCE_RATE, 1)))


def shear(cells, conductivity):
    """Values of cells of width h between nodes; velocities of nodes."""
    h = H / cells
    y = (np.arange(cells) + 0.5) * h - H / 2
    dt = 0.5 * h / np.sqrt(G / RHO)
    steps = int(np.ceil(END / dt))
    dt = END / steps
    v = SPEED * ((np.arange(cells + 1) * h - H / 2) / H)
    tau, strain = np.zeros(cells), np.zeros(cells)
    T = T0 + 20 * np.exp(-(y / 2e-6) ** 2)
    for _ in range(steps):
        v[1:-1] += dt / RHO * (tau[1:] - tau[:-1]) / h
        trial = tau + G * dt * (v[1:] - v[:-1]) / h
        size = np.sqrt(3) * np.abs(trial)
        # size - 3 G de = strength(e + de): bisection, as the left side falls and the right side rises
        low, high = np.zeros(cells), size / (3 * G)
        for _ in range(50):
            middle = 0.5 * (low + high)
            more = size - 3 * G * middle > strength(strain + middle, T, middle / dt)
            low, high = np.where(more, middle, low), np.where(more, high, middle)
        grown = np.where(size > strength(strain, T, 0), high, 0)
        left = size - 3 * G * grown
        tau = np.sign(trial) * left / np.sqrt(3)
        strain += grown
        T += left * grown / (RHO * C)
        if conductivity > 0:
            flux = np.zeros(cells + 1)
            flux[1:-1] = conductivity * (T[1:] - T[:-1]) / h
            T += dt / (RHO * C) * (flux[1:] - flux[:-1]) / h
    return strain.max(), T.max(), tau.mean()


if __name__ == "__main__":
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 160
    k = float(sys.argv[2]) if len(sys.argv) > 2 else 386.0
    strain, temperature, stress = shear(count, k)
    print(f"plastic strain {strain:.4f}, temperature {temperature:.1f} K, mean shear stress {stress / 1e6:.2f} MPa")
