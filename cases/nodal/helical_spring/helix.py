#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Stiffness of a helical spring by linear elasticity, for the references in checks.toml.

    python3 cases/nodal/helical_spring/helix.py [--degree 2 4 6 8]

Away from its ends every section of a helical spring under an axial force deforms alike: with eta = z - c phi, c = pitch/(2 pi),
the displacement is w(r, eta) in cylindrical components, plus K phi along z and a turn psi phi about z. Ritz's method with
polynomials for w up to a degree, the exact section and psi free; no thin-wire assumption. Prints the stiffness [N/m], its ratio
to G d^4/(8 D^3 n), and psi/K [1/m]. numpy alone.
"""
import argparse
import numpy as np

RADIUS, WIRE, PITCH, TURNS = 30e-3, 5e-3, 25e-3, 2  # of the coil to the middle of the wire; radius of the wire; m
YOUNG, NU = 2e9, 0.3


def section():
    """Points xi, eta and weights of the section, (r - R)^2 + (eta cos(alpha))^2 < WIRE^2."""
    t, w = np.polynomial.legendre.leggauss(24)
    radius, turn = (1 + t) / 2, 2 * np.pi * np.arange(48) / 48
    cosine = 1 / np.hypot(1, PITCH / (2 * np.pi * RADIUS))
    xi = WIRE * np.outer(radius, np.cos(turn))
    eta = WIRE * np.outer(radius, np.sin(turn)) / cosine
    weight = np.outer(w / 2 * radius, np.full(48, 2 * np.pi / 48)) * WIRE**2 / cosine
    return xi.ravel(), eta.ravel(), weight.ravel()


def stiffness(degree):
    xi, eta, weight = section()
    r, c = RADIUS + xi, PITCH / (2 * np.pi)
    mu, la = YOUNG / (2 * (1 + NU)), YOUNG * NU / ((1 + NU) * (1 - 2 * NU))
    strains = []  # rr, phi phi, zz, phi z, r z, r phi of each unknown
    for i in range(degree + 1):
        for j in range(degree + 1 - i):
            x, y = xi / WIRE, eta / WIRE
            f = x**i * y**j
            by_r = i * x**max(i - 1, 0) * y**j / WIRE
            by_eta = j * x**i * y**max(j - 1, 0) / WIRE
            zero = 0 * f
            strains += [[by_r, f / r, zero, zero, by_eta, -c * by_eta / r],
                        [zero, -c * by_eta / r, zero, by_eta, zero, by_r - f / r],
                        [zero, zero, by_eta, -c * by_eta / r, by_r, zero]]
    zero = 0 * r
    strains += [[zero, 1 + zero, zero, zero, zero, zero], [zero, zero, zero, 1 / r, zero, zero]]  # psi, K
    e = np.array(strains)
    D = la * np.pad(np.ones((3, 3)), (0, 3)) + np.diag([2 * mu] * 3 + [mu] * 3)
    A = np.einsum("uap,ab,vbp,p->uv", e, D, e, weight * r, optimize=True)
    scale = 1 / np.sqrt(np.diag(A) + 1e-30)
    scale[np.diag(A) == 0] = 0
    S = A * scale[:, None] * scale[None, :]
    free = np.linalg.lstsq(S[:-1, :-1], -S[:-1, -1], rcond=1e-11)[0]
    energy = 0.5 * (S[-1, -1] + S[-1, :-1] @ free) / scale[-1]**2  # per radian, K = 1
    return energy / (np.pi * TURNS), free[-1] * scale[-2] / scale[-1]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--degree", type=int, nargs="+", default=[2, 4, 6, 8], help="of the polynomials")
    shear = YOUNG / (2 * (1 + NU))
    thin = shear * (2 * WIRE)**4 / (8 * (2 * RADIUS)**3 * TURNS)
    print(f"thin wire, G d^4/(8 D^3 n): {thin:.2f} N/m")
    for degree in parser.parse_args().degree:
        k, unwinding = stiffness(degree)
        print(f"degree {degree}: {k:.2f} N/m, {k / thin:.5f} of the thin wire, psi/K = {unwinding:.5f} /m")


if __name__ == "__main__":
    main()
