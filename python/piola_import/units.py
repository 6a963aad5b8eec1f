# SPDX-License-Identifier: Apache-2.0
"""Consistent units of files that do not name theirs, as factors to SI."""
from dataclasses import dataclass

LENGTH = {"m": 1.0, "cm": 1e-2, "mm": 1e-3, "um": 1e-6, "in": 0.0254, "ft": 0.3048}
TIME = {"s": 1.0, "ms": 1e-3, "us": 1e-6}
MASS = {"kg": 1.0, "g": 1e-3, "mg": 1e-6, "tonne": 1e3, "t": 1e3, "lb": 0.45359237, "slug": 14.593902937206364,
        "slinch": 175.12683524647636}
KINDS = {"length": LENGTH, "time": TIME, "mass": MASS}


@dataclass(frozen=True)
class Units:
    """Base units in SI; the products below turn a number of the file into SI."""
    length: float = 1.0
    time: float = 1.0
    mass: float = 1.0

    @property
    def velocity(self):
        return self.length / self.time

    @property
    def acceleration(self):
        return self.length / self.time**2

    @property
    def density(self):
        return self.mass / self.length**3

    @property
    def stress(self):
        return self.mass / (self.length * self.time**2)

    @property
    def specific_heat(self):
        """Energy per mass and kelvin."""
        return self.velocity**2


def read_units(text):
    """Units of a text such as "mm,ms,g", "kg-mm-ms", "mm" or "SI"; what is not named is SI. Raises ValueError."""
    if text.strip().lower() == "si":
        return Units()
    found = {}
    for word in text.replace("-", ",").replace("/", ",").replace(" ", ",").split(","):
        if not word:
            continue
        kind = next((kind for kind, known in KINDS.items() if word in known), None)
        if kind is None:
            raise ValueError(f"--units {text}: \"{word}\" is not a unit (allowed: SI; {', '.join(LENGTH)}; "
                             f"{', '.join(TIME)}; {', '.join(MASS)}) - name a length, a time and a mass, as mm,ms,kg")
        if kind in found:
            raise ValueError(f"--units {text}: names two units of {kind} - name one")
        found[kind] = KINDS[kind][word]
    if not found:
        raise ValueError(f"--units \"{text}\": names no unit - write for example mm,ms,kg or SI")
    return Units(**found)


def names_all(text):
    """Whether a text for read_units names length, time and mass."""
    words = set(text.replace("-", ",").replace("/", ",").replace(" ", ",").split(","))
    return text.strip().lower() == "si" or all(words & set(known) for known in (LENGTH, TIME, MASS))
