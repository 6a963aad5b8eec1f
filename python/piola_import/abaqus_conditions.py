# SPDX-License-Identifier: Apache-2.0
"""Supports, initial velocities, gravity and the duration of an Abaqus file."""
import numpy as np

from .model import Support, Velocity

TYPES = {"ENCASTRE": "xyz", "PINNED": "xyz", "XSYMM": "x", "YSYMM": "y", "ZSYMM": "z"}


class Conditions:
    """Reads the keywords that are no mesh into the model of `placed`."""

    def __init__(self, keywords, placed, units, problems):
        self.keywords, self.placed, self.units, self.problems = keywords, placed, units, problems
        self.model = placed.model

    def read(self):
        for keyword in self.keywords:
            if keyword.name == "BOUNDARY":
                self._boundary(keyword)
            elif keyword.name == "INITIAL CONDITIONS" and keyword.get("TYPE") == "VELOCITY":
                self._velocity(keyword)
            elif keyword.name == "DYNAMIC":
                self.model.end = keyword.values(0, self.problems, 2)[1] * self.units.time or None
            elif keyword.name == "DLOAD" and not keyword.get("AMPLITUDE"):
                self._load(keyword)
            else:
                self.model.left.add(", ".join([keyword.name] + [f"TYPE={v}" for k, v in keyword.parameters.items()
                                                                if k == "TYPE"]), keyword.place)

    def _boundary(self, keyword):
        """Held directions; prescribed ones that are not zero are left."""
        held = {}
        for row in range(len(keyword.lines)):
            fields = keyword.fields(row) + [""] * 4
            name, first = fields[0].upper(), fields[1].upper()
            if first in TYPES:
                fix = TYPES[first]
            elif first.isdigit():
                last = int(fields[2]) if fields[2].isdigit() else int(first)
                fix = "".join(axis for k, axis in enumerate("xyz", 1) if int(first) <= k <= last)
            else:
                self.model.left.add(f"BOUNDARY {first}", keyword.at(row))
                continue
            if _number(fields[3], keyword, row, self.problems):
                self.model.left.add("BOUNDARY", keyword.at(row), "a prescribed motion that is not zero is left out")
            elif fix:
                held.setdefault(name, set()).update(fix)
        for name, axes in held.items():
            nodes = self.placed.nodes_of(name, "", keyword.place)
            fix = "".join(axis for axis in ("xyz" if self.model.dimension == 3 else "xy") if axis in axes)
            if len(nodes) and fix:
                self.model.supports.append(Support(name, nodes, fix))

    def _velocity(self, keyword):
        """One velocity for each set, from a line for each direction."""
        found = {}
        for row in range(len(keyword.lines)):
            fields = keyword.fields(row) + ["", ""]
            direction = int(fields[1]) if fields[1].isdigit() else 0
            if 1 <= direction <= 3:
                value = _last(keyword, row, self.problems)
                found.setdefault(fields[0].upper(), np.zeros(3))[direction - 1] = value * self.units.velocity
            else:
                self.model.left.add("INITIAL CONDITIONS, TYPE=VELOCITY", keyword.at(row), "rotations are left out")
        for name, value in found.items():
            nodes = self.placed.nodes_of(name, "", keyword.place)
            self.model.velocities.append(Velocity(nodes, tuple(value.tolist()), keyword.place))

    def _load(self, keyword):
        for row in range(len(keyword.lines)):
            fields = keyword.fields(row) + [""] * 6
            if fields[1].upper() != "GRAV" or fields[0] or self.model.gravity is not None:
                self.model.left.add(f"DLOAD {fields[1]}", keyword.at(row))
                continue
            size, *direction = [_number(text, keyword, row, self.problems) for text in fields[2:6]]
            self.model.gravity = tuple(size * self.units.acceleration * d for d in direction)


def _last(keyword, row, problems):
    """The number in the third field of a line whose first one is a name."""
    return _number((keyword.fields(row) + ["", "", ""])[2], keyword, row, problems)


def _number(text, keyword, row, problems):
    try:
        return float(text or 0)
    except ValueError:
        problems.add(keyword.at(row), f"\"{text[:30]}\" is not a number (*{keyword.name}) - correct it",
                     "is not a number")
        return 0.0
