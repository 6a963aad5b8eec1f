#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Longitudinal modes of a round rod between smooth planes (L. Pochhammer, 1876; C. Chree, 1889), for checks.toml.

Usage: modes.py [POISSONS_RATIO [LENGTH]]     0.3 and 4 without them; radius and speed of shear waves are 1
Smooth planes at both ends make standing waves of q half waves exact: k = q pi / L. With A2 = (omega/c_p)^2 - k^2 and
B2 = (omega/c_s)^2 - k^2
  u_r = -(A2 j(A2 r^2) + ratio k B2 j(B2 r^2)) r cos(k z),  j(s) = J_1(sqrt s) / sqrt s
  u_z = (-k J_0(sqrt(A2) r) + ratio B2 J_0(sqrt(B2) r)) sin(k z)
Both Bessel functions are series in r^2, of any sign of A2 and B2. A mode is where the traction on r = 1 vanishes. Prints
for each mode q.n (n-th root) k, omega, A2, B2, ratio and the period.
"""
import math
import sys

TERMS = 24


def j0(s):
    """J_0(sqrt s)."""
    return sum((-s / 4) ** n / math.factorial(n) ** 2 for n in range(TERMS))


def j1(s):
    """J_1(sqrt s) / sqrt s."""
    return sum(0.5 * (-s / 4) ** n / math.factorial(n) / math.factorial(n + 1) for n in range(TERMS))


def tractions(k, omega, lame):
    """Of both potentials: sigma_rr / cos(k z) and sigma_rz / sin(k z) on r = 1, over the shear modulus."""
    a2, b2 = omega ** 2 / (lame + 2) - k * k, omega ** 2 - k * k
    first = (-lame * (a2 + k * k) * j0(a2) - 2 * a2 * (j0(a2) - j1(a2)), 2 * k * a2 * j1(a2))
    second = (-2 * k * b2 * (j0(b2) - j1(b2)), (k * k - b2) * b2 * j1(b2))
    return first, second


def determinant(k, omega, lame):
    first, second = tractions(k, omega, lame)
    if k == 0:  # no shear: the breathing mode alone
        return first[0]
    return first[0] * second[1] - first[1] * second[0]


def roots(k, lame, count):
    """The lowest frequencies; omega = k is a root of B2, not a mode."""
    found, step, low = [], 1e-3, 1e-4 + 0.3 * k
    while len(found) < count:
        high = low + step
        if determinant(k, low, lame) * determinant(k, high, lame) < 0 and not (k > 0 and low <= k <= high):
            lower, upper = low, high
            for _ in range(60):
                middle = 0.5 * (lower + upper)
                if determinant(k, lower, lame) * determinant(k, middle, lame) <= 0:
                    upper = middle
                else:
                    lower = middle
            found.append(0.5 * (lower + upper))
        low = high
    return found


def main(arguments):
    nu = float(arguments[0]) if arguments else 0.3
    length = float(arguments[1]) if len(arguments) > 1 else 4.0
    lame = 2 * nu / (1 - 2 * nu)
    for q, n in ((0, 1), (1, 1), (2, 1), (3, 1), (4, 1), (1, 2)):
        k = q * math.pi / length
        omega = roots(k, lame, n)[-1]
        first, second = tractions(k, omega, lame)
        ratio = 0.0 if q == 0 else -first[1] / second[1]
        print(f"mode {q}.{n}: k {k:.8f}  omega {omega:.8f}  A2 {omega ** 2 / (lame + 2) - k * k:.8f}  "
              f"B2 {omega ** 2 - k * k:.8f}  ratio {ratio:.8f}  period {2 * math.pi / omega:.8f}")


main(sys.argv[1:])
