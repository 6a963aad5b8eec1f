#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Number and sizes of the pieces of an expanding ring by Mott's theory.

The ring is rigid and perfectly plastic. Of a length dx, a share (ln 2) A dx / V0 m e^(m-1) / ef^m de breaks while its strain
grows from e to e + de, if it still stretches. From a break the ends move apart as rigid pieces that grow by
x = sqrt(2 Y t / (rho rate)): inside, nothing breaks any more. N. F. Mott, Proc. R. Soc. A 189 (1947) 300-308; as a sum over
breaks: D. Grady, Fragmentation of Rings and Shells, Springer 2006, chapter 2.

Usage: mott.py SPEED [MODULUS]         speed in m/s, of the case's ring
"""
import math
import random
import sys

RADIUS, THICKNESS, DENSITY, YIELD, FRACTURE, VOLUME = 16e-3, 0.8e-3, 2700.0, 300e6, 0.1, 4e-8


def ring(speed, modulus):
    """Rate of strain [1/s], hoop stress [Pa], hoop strain at fracture, length [m] and breaks per length and strain."""
    stress = YIELD * 2 / math.sqrt(3)  # plane strain
    strain = FRACTURE * math.sqrt(3) / 2
    now = math.sqrt(speed**2 - 2 * stress * strain / DENSITY)  # plastic work until then
    radius = RADIUS * math.exp(strain)
    area = THICKNESS * RADIUS / radius
    share = lambda e: math.log(2) * area / VOLUME * modulus * e ** (modulus - 1) / strain**modulus
    return now / radius, stress, strain, 2 * math.pi * radius, share


def count(speed, modulus, steps=3000):
    """Expected number of breaks: each place breaks unless a piece has reached it."""
    rate, stress, strain, length, share = ring(speed, modulus)
    step = 2.5 * strain / steps
    breaks = [share((k + 0.5) * step) * step for k in range(steps)]
    reach = [math.sqrt(2 * stress * k * step / (DENSITY * rate**2)) for k in range(steps)]
    total = 0.0
    for k in range(steps):
        covered = sum(breaks[j] * 2 * reach[k - j] for j in range(k))
        total += breaks[k] * math.exp(-covered)
        if covered > 40:
            break
    return total * length


def spread(speed, modulus, draws=200):
    """Standard deviation of the sizes of pieces over their mean, from drawn rings."""
    rate, stress, strain, length, share = ring(speed, modulus)
    sizes = []
    per_place = share(strain) * strain / modulus  # places per length of which half break at the fracture strain
    chance = random.Random(1)
    for _ in range(draws):
        places = int(length * per_place / math.log(2))
        drawn = []
        for _ in range(places):
            e = strain * (-math.log(1 - chance.random()) / math.log(2)) ** (1 / modulus)
            drawn.append((e, chance.random() * length))
        broken = []
        for e, x in sorted(drawn):
            covered = False
            for when, where in broken:
                apart = abs(x - where)
                if min(apart, length - apart) < math.sqrt(2 * stress * (e - when) / (DENSITY * rate**2)):
                    covered = True
                    break
            if not covered:
                broken.append((e, x))
        at = sorted(x for _, x in broken)
        sizes += [b - a for a, b in zip(at, at[1:] + [at[0] + length])]
    mean = sum(sizes) / len(sizes)
    return math.sqrt(sum((s - mean) ** 2 for s in sizes) / len(sizes)) / mean, len(sizes) / draws


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    v, m = float(sys.argv[1]), float(sys.argv[2]) if len(sys.argv) == 3 else 15.0
    relative, drawn_count = spread(v, m)
    print(f"{v:g} m/s, m = {m:g}: {count(v, m):.1f} pieces ({drawn_count:.1f} drawn), spread {relative:.2f}")
