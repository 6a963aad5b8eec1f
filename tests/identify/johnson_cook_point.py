# SPDX-License-Identifier: Apache-2.0
"""Stress over strain of Johnson and Cook's law at one point, by its differential equation: no code of Piola."""
import csv

import numpy as np

COPPER = {"A": 90e6, "B": 292e6, "n": 0.31, "C": 0.025, "m": 1.09}
SHEAR_MODULUS, DENSITY, HEAT = 124e9 / (2 * 1.34), 8960, 383
ROOM, MELTING, REFERENCE_RATE = 293, 1356, 1


def flow_stress(law, strain, rate, temperature):
    heat = max(0.0, (temperature - ROOM) / (MELTING - ROOM))
    return ((law["A"] + law["B"] * max(strain, 1e-300) ** law["n"])
            * (1 + law["C"] * np.log(max(rate / REFERENCE_RATE, 1))) * (1 - heat ** law["m"]))


def tension(law, rate, end=0.3, steps=6000):
    """True strains and von Mises stresses [Pa] at a constant rate of isochoric stretch; heating is adiabatic."""
    strains, stresses = np.linspace(0, end, steps + 1), np.zeros(steps + 1)
    plastic, temperature, step = 0.0, float(ROOM), end / steps
    for k in range(1, steps + 1):
        trial = 3 * SHEAR_MODULUS * (strains[k] - plastic)
        low, high = 0.0, max(trial / (3 * SHEAR_MODULUS), 0)
        for _ in range(60):  # the plastic strain of the step, by bisection
            middle = 0.5 * (low + high)
            now = flow_stress(law, plastic + middle, middle * rate / step, temperature)
            low, high = (middle, high) if trial - 3 * SHEAR_MODULUS * middle > now else (low, middle)
        stresses[k] = trial - 3 * SHEAR_MODULUS * low
        plastic += low
        temperature += stresses[k] * low / (DENSITY * HEAT)
    return strains, stresses


def write_curve(path, rate, noise, random, law=None, points=30):
    """A measured curve: the law with normal noise of this standard deviation [Pa]."""
    strains, stresses = tension(law or COPPER, rate)
    at = np.linspace(0.01, 0.29, points)
    measured = np.interp(at, strains, stresses) + random.normal(0, noise, points)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file)
        writer.writerow(["strain", "stress [MPa]"])
        writer.writerows([f"{x:.6f}", f"{y / 1e6:.6f}"] for x, y in zip(at, measured))
