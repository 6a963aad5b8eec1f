# SPDX-License-Identifier: Apache-2.0
"""Supports, initial velocities, rigid walls and the end of the run of a keyword file of LS-DYNA."""
import numpy as np

from .lsdyna_cards import table
from .model import Support, Velocity, Wall, whole

AXES = "xyz"


class Conditions:
    """Reads the keywords that are neither mesh nor material into the model of the reader."""

    def __init__(self, reader):
        self.reader, self.model, self.units, self.problems = reader, reader.model, reader.units, reader.problems

    def take(self, block):
        """Supports, initial velocities, walls, the end; whether the keyword is one of these."""
        keyword = block.keyword.removesuffix("_ID")
        first = int(block.keyword.endswith("_ID"))
        if keyword == "CONTROL_TERMINATION":
            self.model.end = (block.card(0, self.problems)[0] * self.units.time) or None
        elif keyword in ("BOUNDARY_SPC_SET", "BOUNDARY_SPC_NODE"):
            self._constraint(block, first, keyword.endswith("SET"))
        elif keyword in ("INITIAL_VELOCITY", "INITIAL_VELOCITY_NODE", "INITIAL_VELOCITY_GENERATION"):
            self._velocity(block, keyword)
        elif keyword == "RIGIDWALL_PLANAR":
            tail, head = np.split(np.array(block.card(first + 1, self.problems)[:6]) * self.units.length, 2)
            self.model.walls.append(Wall(tuple(tail), tuple((head - tail) / max(np.linalg.norm(head - tail), 1e-300))))
            if block.card(first + 1, self.problems)[6]:
                self.model.left.add(block.keyword, block.place, "its friction is left out: write contact.friction")
        else:
            return False
        return True

    def _constraint(self, block, first, of_set):
        for row in range(first, len(block.lines), 1 + first):
            number, system, *dofs = block.card(row, self.problems)[:5]
            fix = "".join(axis for axis, dof in zip(AXES, dofs) if dof)
            if system:
                self.model.left.add(block.keyword, block.at(row), "its local coordinates (CID) are left out")
            elif fix and not of_set:
                self.reader.held.setdefault(fix, []).append(int(number))
            elif fix:
                title, ids = self.reader.sets["NODE"].get(int(number), (None, []))
                if title is None:
                    self.problems.add(block.at(row), f"holds the set of nodes {number:g}, which is not there - add it")
                self._support(title, ids, fix)

    def hold_nodes(self):
        """Supports of single nodes, by the axes that are held."""
        for fix, ids in self.reader.held.items():
            self._support(f"hold_{fix}", np.unique(ids), fix)

    def _support(self, name, ids, fix):
        rows = self.reader.rows(ids)
        if len(rows):
            self.model.supports.append(Support(name, rows, fix))

    def _velocity(self, block, keyword):
        everything = np.arange(len(self.model.X))
        if keyword == "INITIAL_VELOCITY":
            number = int(block.card(0, self.problems)[0])
            nodes = self.reader.rows(self.reader.sets["NODE"].get(number, ("", []))[1]) if number else everything
            self._start(nodes, block.card(1, self.problems)[:3], block, block.card(1, self.problems)[3:6])
        elif keyword == "INITIAL_VELOCITY_NODE":
            rows = table(block, None, (10,) * 4, 4, self.problems)
            for value in np.unique(rows[:, 1:], axis=0):
                nodes = whole(rows[(rows[:, 1:] == value).all(axis=1), 0], block.place, self.problems)
                self._start(self.reader.rows(nodes), value, block, [])
        else:
            for row in range(0, len(block.lines), 2):
                number, kind, spin, *value = block.card(row, self.problems)[:6]
                self._start(self._generation(int(number), int(kind), everything), value, block, [spin])

    def _generation(self, number, kind, everything):
        """Nodes of a set of parts (1), a part (2) or a set of nodes (3); number 0: all."""
        if number == 0:
            return everything
        if kind == 3:
            return self.reader.rows(self.reader.sets["NODE"].get(number, ("", []))[1])
        parts = [number] if kind == 2 else self.reader.sets["PART"].get(number, ("", np.array([])))[1].tolist()
        known = self.reader.part_rows
        rows = [self.model.elements[known[pid]].ravel() for pid in parts if pid in known]
        return np.unique(np.concatenate(rows)) if rows else everything[:0]

    def _start(self, nodes, value, block, turning):
        if any(turning):
            self.model.left.add(block.keyword, block.place, "its rotation is left out: write it as formulas")
        value = tuple(float(v) * self.units.velocity for v in value)
        self.model.velocities.append(Velocity(nodes, value, block.place))
