# SPDX-License-Identifier: Apache-2.0
"""Nodes, elements and sets of a part of Abaqus, and of its instances in the assembly."""
from dataclasses import dataclass, field

import numpy as np

from .solids import PYRAMID, TETRAHEDRON, WEDGE

# Element type -> number of nodes that are read, places among the corners, kind of section.
ELEMENTS = {"C3D4": (4, TETRAHEDRON), "C3D10": (10, TETRAHEDRON), "C3D6": (6, WEDGE), "C3D15": (15, WEDGE),
            "C3D5": (5, PYRAMID), "C3D8": (8, list(range(8))), "C3D20": (20, list(range(8))),
            **{f"{kind}{count}": (count, places) for kind in ("CPE", "CPS", "CAX")
               for count, places in ((3, [0, 1, 2, 2]), (6, [0, 1, 2, 2]), (4, [0, 1, 2, 3]), (8, [0, 1, 2, 3]))}}
ASSUMPTIONS = {"CPE": "plane_strain", "CPS": "plane_stress", "CAX": "axisymmetric"}
# Faces S1 to S6 as places among the corners, by the places of the element.
FACES = {"TETRAHEDRON": [[0, 1, 2, 2], [0, 4, 1, 1], [1, 4, 2, 2], [2, 4, 0, 0]],
         "WEDGE": [[0, 1, 2, 2], [4, 6, 5, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 4, 0]],
         "PYRAMID": [[0, 1, 2, 3], [0, 4, 1, 1], [1, 4, 2, 2], [2, 4, 3, 3], [3, 4, 0, 0]],
         "HEXAHEDRON": [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]],
         "TRIANGLE": [[0, 1], [1, 2], [2, 0]], "QUADRILATERAL": [[0, 1], [1, 2], [2, 3], [3, 0]]}


def shape_of(kind):
    """The entry of FACES for a type of element."""
    count, places = ELEMENTS[kind]
    if len(places) == 4:
        return "TRIANGLE" if count in (3, 6) else "QUADRILATERAL"
    return {4: "TETRAHEDRON", 10: "TETRAHEDRON", 6: "WEDGE", 15: "WEDGE", 5: "PYRAMID"}.get(count, "HEXAHEDRON")


def plain_type(text):
    """C3D8R, C3D10M, CPE4RT, ... without what follows the number of nodes; None for other elements."""
    kind = text.upper()
    found = [known for known in ELEMENTS if kind.startswith(known) and not kind[len(known):len(known) + 1].isdigit()]
    return found[0] if found else None


@dataclass
class Container:
    """What stands in one *PART, or in a file without parts. Sets have names in upper case."""
    name: str = ""
    nodes: list = field(default_factory=list)      # arrays (n, 4): number, x, y, z
    elements: list = field(default_factory=list)   # (type, array (n, 1 + nodes))
    node_sets: dict = field(default_factory=dict)  # name -> list of numbers
    element_sets: dict = field(default_factory=dict)
    sections: list = field(default_factory=list)   # (set of elements, material, place)
    surfaces: list = field(default_factory=list)   # (name, type, lines, place)


@dataclass
class Instance:
    """A part in the assembly, moved by `shift` and turned by `turn`."""
    name: str
    part: Container
    shift: np.ndarray = field(default_factory=lambda: np.zeros(3))
    turn: np.ndarray = field(default_factory=lambda: np.eye(3))

    def moved(self, X):
        return (X + self.shift) @ self.turn.T + self.about

    about: np.ndarray = field(default_factory=lambda: np.zeros(3))


def turn_about(a, b, degrees):
    """Rotation matrix and shift of a rotation about the axis from a to b."""
    axis = (b - a) / max(np.linalg.norm(b - a), 1e-300)
    cross = np.array([[0, -axis[2], axis[1]], [axis[2], 0, -axis[0]], [-axis[1], axis[0], 0]])
    angle = np.radians(degrees)
    turn = np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross
    return turn, a - turn @ a


def place_of_instance(keyword, container, problems):
    """An instance by the lines of *INSTANCE: a shift, then a rotation about an axis by degrees."""
    instance = Instance(keyword.get("NAME"), container)
    if keyword.lines:
        instance.shift = np.array(keyword.values(0, problems, 3))
    if len(keyword.lines) > 1:
        row = np.array(keyword.values(1, problems, 7))
        instance.turn, instance.about = turn_about(row[:3], row[3:6], row[6])
    return instance
