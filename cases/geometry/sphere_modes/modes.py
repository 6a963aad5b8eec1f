#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Frequencies and shapes of three modes of a free elastic sphere (H. Lamb, Proc. London Math. Soc. 13, 1882).

Usage: modes.py [POISSONS_RATIO]     0.3 without it
The radius and the speed of shear waves are 1. Fields are series in s = r^2; a mode is where the traction on r = 1 vanishes:
  0T2  u = w(s) z (-y, x, 0)
  0S2  u = a(s) grad q + b(s) q (x, y, z),  q = z^2 - (x^2 + y^2)/2
  0S0  u = f(s) (x, y, z)
"""
import math
import sys

TERMS = 14


def double_factorial(n):
    return math.prod(range(n, 0, -2))


def bessel(order, wave_number):
    """Coefficients in s of j_n(k r) / (k r)^n, times (2n + 1)!! so that the first is 1."""
    scale = double_factorial(2 * order + 1)
    return [scale * (-0.5) ** n * wave_number ** (2 * n) / math.factorial(n) / double_factorial(2 * order + 2 * n + 1)
            for n in range(TERMS)]


def value(series, s=1.0):
    return sum(c * s ** n for n, c in enumerate(series))


def slope(series):
    """d/ds."""
    return [n * c for n, c in enumerate(series)][1:]


def root(function, low, high):
    for _ in range(90):
        middle = 0.5 * (low + high)
        if function(low) * function(middle) <= 0:
            high = middle
        else:
            low = middle
    return 0.5 * (low + high)


def torsional(k):
    """Shear on r = 1 of u = w z (-y, x, 0): r d/dr of the angle of a layer, which is w r times a function of the latitude."""
    w = bessel(2, k)
    return value(w) + 2 * value(slope(w))


def radial(k, lame):
    """Radial stress on r = 1 of u = f x, over the shear modulus: (lame + 2) u' + 2 lame u."""
    f = bessel(1, k)
    return (lame + 2) * (value(f) + 2 * value(slope(f))) + 2 * lame * value(f)


def spheroidal_parts(k, pressure_speed):
    """(a, b) of the gradient of a potential, and of the curl of a curl: what the two kinds of waves make."""
    p, s = bessel(2, k / pressure_speed), bessel(2, k)
    of_pressure = p, [2 * c for c in slope(p)] + [0.0]
    trace = [(3 + 2 * n) * c for n, c in enumerate(s)]
    of_shear = trace, [2 * c + k * k * d for c, d in zip(slope(trace) + [0.0], s)]
    return of_pressure, of_shear


def traction(part, lame):
    """Radial and meridional traction on r = 1 at the angle of 1 rad from the axis, over the shear modulus."""
    (a, b), x = part, (math.sin(1.0), 0.0, math.cos(1.0))
    q, grad = x[2] ** 2 - x[0] ** 2 / 2, (-x[0], 0.0, 2 * x[2])
    hesse = (-1.0, -1.0, 2.0)
    a0, a1, b0, b1 = value(a), value(slope(a)), value(b), value(slope(b))
    gradient = [[2 * a1 * x[j] * grad[i] + (b0 * grad[j] + 2 * b1 * x[j] * q) * x[i]
                 + (a0 * hesse[i] + b0 * q) * (i == j) for j in range(3)] for i in range(3)]
    volume = sum(gradient[i][i] for i in range(3))
    t = [lame * volume * x[i] + sum((gradient[i][j] + gradient[j][i]) * x[j] for j in range(3)) for i in range(3)]
    across = (math.cos(1.0), 0.0, -math.sin(1.0))
    return sum(map(float.__mul__, t, x)), sum(map(float.__mul__, t, across))


def spheroidal(k, lame):
    one, two = (traction(part, lame) for part in spheroidal_parts(k, math.sqrt(lame + 2)))
    return one[0] * two[1] - one[1] * two[0]


def spheroidal_shape(k, lame):
    """a and b of the mode, a(0) = 1."""
    one, two = spheroidal_parts(k, math.sqrt(lame + 2))
    share = -traction(one, lame)[0] / traction(two, lame)[0]
    a, b = ([c + share * d for c, d in zip(one[i], two[i])] for i in range(2))
    return [c / a[0] for c in a], [c / a[0] for c in b]


def main(arguments):
    nu = float(arguments[0]) if arguments else 0.3
    lame = 2 * nu / (1 - 2 * nu)
    speed = math.sqrt(lame + 2)
    kt, ks = root(torsional, 2, 3), root(lambda k: spheroidal(k, lame), 2.2, 3)
    kr = root(lambda k: radial(k, lame), 2, 3)
    a, b = spheroidal_shape(ks, lame)
    print(f"pressure waves run {speed:.6g} times as fast as shear waves")
    print(f"0T2: omega R / c_s = {kt:.8g}, period {2 * math.pi / kt:.8g} R / c_s")
    print(f"0S2: omega R / c_s = {ks:.8g}, period {2 * math.pi / ks:.8g} R / c_s")
    print("     a:", " ".join(f"{c:.8g}" for c in a[:6]))
    print("     b:", " ".join(f"{c:.8g}" for c in b[:6]))
    print(f"0S0: omega R / c_p = {kr:.8g}, period {2 * math.pi / kr / speed:.8g} R / c_s")


main(sys.argv[1:])
