#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Table behind docs/theory/scaling.md: weak scaling of a cube by its formulas, for three cuts.

Usage: bench/scaling.py [PARTICLES_PER_RANK ...]      default: 1e6 1e5 1e4
"""
import math
import sys

# A step of the default scheme, counted (tests/domain/ranks_traffic_test.py): right-hand sides, exchanges in each,
# collectives; numbers per halo particle by layers of a lattice within reach.
STAGES, EXCHANGES, COLLECTIVES = 1.08, 6, 3.2
NUMBERS = {1: 25, 2: 4}
THREADS, WORK = 16, 560e-9  # cores of a rank; processor time of a particle and right-hand side [s]
LATENCY, BANDWIDTH, PACKING = 2e-6, 6e9, 1.5e-9  # [s], [bytes/s], [s] of a number on each side
PENCIL = 8  # rows across a pencil
RAGGED = 14  # particles of a row by which the leaves of 16 at a cut across rows differ


def bricks(n, ranks, layers):
    """Halo and neighbours of a cube of n particles cut out of many."""
    side = n ** (1 / 3)
    return (side + 2 * layers) ** 3 - n, 26


def leaves(n, ranks, layers):
    """The same of a part of whole leaves: as long along its rows as makes it read least."""
    side = (n * ranks) ** (1 / 3)

    def halo(length, layers):
        across = n / length
        ends = 2 * across * (layers + RAGGED) if length < side else 0
        return (math.sqrt(across) + 2 * layers) ** 2 * length - n + ends

    lengths = [side ** (k / 200) * n ** ((200 - k) / 600) for k in range(201)]
    best = min(lengths, key=lambda length: halo(length, max(NUMBERS)))
    return halo(best, layers), 26 if best < side else 8


def runs(n, ranks, layers):
    """The same of a run of pencils that go through the whole cube of n * ranks particles."""
    side = (n * ranks) ** (1 / 3)
    pencils = n / (PENCIL ** 2 * side)  # of a rank
    row = side / PENCIL
    if pencils >= row:  # slabs of whole rows of pencils, and ragged ends
        return 2 * layers * side ** 2, 2
    width, depth = PENCIL * max(1, pencils), PENCIL
    length = side * min(1, pencils)
    halo = (width + 2 * layers) * (depth + 2 * layers) * (length + (2 * layers if pencils < 1 else 0)) - n
    around = math.ceil(row / pencils) if pencils >= 1 else 0
    # Ranks that lie along the faces of a plank: before and after it in its own row, and those of the rows beside it.
    return halo, 2 + 2 * 3 if around else 2 + 8 * 3


def row(n, ranks, cut):
    halo, neighbours = cut(n, ranks, max(NUMBERS))
    sweeps = STAGES * n * WORK / THREADS
    messages = STAGES * neighbours * EXCHANGES
    sent = STAGES * 8 * sum(numbers * cut(n, ranks, layers)[0] for layers, numbers in NUMBERS.items())
    talk = messages * LATENCY + sent / BANDWIDTH + 2 * PACKING * sent / 8 / THREADS
    together = COLLECTIVES * 2 * math.ceil(math.log2(ranks)) * LATENCY
    return (n, cut.__name__, halo, messages, sent / 1e6, 1e3 * sweeps, 1e3 * talk, 1e3 * together,
            100 * sweeps / (sweeps + talk + together))


if __name__ == "__main__":
    print("| particles of a rank | cut | halo | messages | MB | sweeps, ms | messages, ms | collectives, ms | efficiency |")
    print("|---|---|---|---|---|---|---|---|---|")
    for n in [float(word) for word in sys.argv[1:]] or (1e6, 1e5, 1e4):
        for cut in (bricks, leaves, runs):
            print("| {:.0e} | {} | {:,.0f} | {:.0f} | {:.2g} | {:.2g} | {:.2g} | {:.2g} | {:.0f} % |".format(
                *row(n, 10_000, cut)))
