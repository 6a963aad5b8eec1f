#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Exact solution of the Riemann problem of two stiffened gases, and the reference numbers of this case.

Usage: exact.py                         prints the numbers that case.toml and checks.toml hold
       exact.py rho pL pR pinfL pinfR gamma   the same for other data (uL = uR = 0, one density)

A stiffened gas has p + gamma pinf = (gamma - 1) rho e and c^2 = gamma (p + pinf)/rho. The pressure p between both waves is the root of
u_left(p) = u_right(p), where each side is a shock (p above its own pressure: mass flux from the jump conditions) or a simple wave
(p below: p + pinf goes with rho^gamma, and u + 2 c/(gamma - 1) is kept). It is found by halving.
"""
import math
import sys


def side(p, rho, p0, pinf, gamma):
    """Speed that the gas takes, towards the other side's outside, and its density, where its pressure p0 goes to p."""
    if p > p0:
        flux = math.sqrt(rho * ((gamma + 1) / 2 * (p + pinf) + (gamma - 1) / 2 * (p0 + pinf)))
        return -(p - p0) / flux, 1 / (1 / rho - (p - p0) / flux**2), flux / rho
    c = math.sqrt(gamma * (p0 + pinf) / rho)
    ratio = (p + pinf) / (p0 + pinf)
    slower = c * ratio ** ((gamma - 1) / (2 * gamma))
    return 2 / (gamma - 1) * (c - slower), rho * ratio ** (1 / gamma), c


def solve(rho, p_left, p_right, pinf_left, pinf_right, gamma):
    low, high = p_right, p_left
    for _ in range(200):
        p = (low + high) / 2
        u = side(p, rho, p_left, pinf_left, gamma)[0]
        if u > -side(p, rho, p_right, pinf_right, gamma)[0]:
            low = p
        else:
            high = p
    return p, u, side(p, rho, p_left, pinf_left, gamma), side(p, rho, p_right, pinf_right, gamma)


def main(rho=1000.0, p_left=1e9, p_right=0.0, pinf_left=1.64e9 / 4.4, pinf_right=6e8, gamma=4.4):
    p, u, left, right = solve(rho, p_left, p_right, pinf_left, pinf_right, gamma)
    c, c_star = left[2], math.sqrt(gamma * (p + pinf_left) / left[1])
    print(f"pressure between the waves      p  = {p:.8e} Pa")
    print(f"velocity there                  u  = {u:.8f} m/s")
    print(f"density left of the contact     r1 = {left[1]:.6f} kg/m^3")
    print(f"density right of the contact    r2 = {right[1]:.6f} kg/m^3")
    print(f"speed of sound on the left      cL = {c:.6f} m/s, the head of the simple wave in X/t")
    print(f"its tail in X/t                 ct = {c_star * left[1] / rho:.6f} m/s")
    print(f"shock in X/t (X at the start)   W  = {right[2]:.6f} m/s")
    print(f"in the simple wave, y = -X/(t cL): rho = rho0 y^{2 / (gamma + 1):.8f}")


if __name__ == "__main__":
    main(*map(float, sys.argv[1:]))
