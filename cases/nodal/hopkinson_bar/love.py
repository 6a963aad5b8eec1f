#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The pulse of this case in an endless bar with Love's lateral inertia, for the references in checks.toml.

    python3 cases/nodal/hopkinson_bar/love.py

Frequencies of waves along the bar are c k / sqrt(1 + (nu r k)^2), r the polar radius of gyration of its section (A. E. H. Love,
Treatise on the Mathematical Theory of Elasticity, section 278). Prints for some distances of travel the largest speed over the
one at the start, and its time. numpy alone.
"""
import numpy as np

SPEED, NU, WIDTH = np.sqrt(200e9 / 7850), 0.3, 80e-3
SECTIONS = {"without": 0.0, "round, radius 10 mm": 10e-3**2 / 2, "square, 20 mm": 20e-3**2 / 6}  # squares of r
COUNT, LENGTH = 2**14, 16.0

x = (np.arange(COUNT) - COUNT // 2) * LENGTH / COUNT
k = 2 * np.pi * np.fft.fftfreq(COUNT, LENGTH / COUNT)
start = np.fft.fft(np.exp(-(x / WIDTH)**2))
for name, r2 in SECTIONS.items():
    frequency = SPEED * np.abs(k) / np.sqrt(1 + NU**2 * r2 * k**2)
    for distance in (0.25, 0.5, 1.0):
        place = np.argmin(np.abs(x - distance))
        times = np.linspace(distance - 0.01, distance + 0.01, 401) / SPEED
        curve = [np.fft.ifft(start * np.cos(frequency * t)).real[place] for t in times]
        peak = np.argmax(curve)
        print(f"{name}: after {distance} m {curve[peak]:.5f} at {1e6 * times[peak]:.2f} us")
