# SPDX-License-Identifier: Apache-2.0
"""What a reader found in a file, in SI units, and the lists of what is wrong and of what was not understood."""
from dataclasses import dataclass, field

import numpy as np

MOST_OF_ONE_KIND = 5  # problems of one kind that are listed one by one


class ImportProblems(Exception):
    """A file cannot be used; one problem in a line."""


class Problems:
    """Collects everything that is wrong, with its place; of many of one kind the first few and their number."""

    def __init__(self):
        self.texts, self.counts = [], {}

    def add(self, place, text, kind=None):
        if kind is not None:
            self.counts[kind] = self.counts.get(kind, 0) + 1
            if self.counts[kind] > MOST_OF_ONE_KIND:
                return
        self.texts.append(f"{place}: {text}")

    def stop_if_any(self):
        if self.texts:
            more = [f"{count - MOST_OF_ONE_KIND:,} more problems like \"{kind}\""
                    for kind, count in self.counts.items() if count > MOST_OF_ONE_KIND]
            raise ImportProblems("\n".join(self.texts + more))


class Left:
    """Keywords that were not understood, or not in full: first place, number of places, and what that means."""

    def __init__(self):
        self.entries = {}

    def add(self, keyword, place, reason="no counterpart"):
        self.entries.setdefault((keyword, reason), {})[str(place)] = True

    def lines(self):
        return [f"  {keyword}  {next(iter(places))}{f', {len(places):,} times' if len(places) > 1 else ''}: {reason}"
                for (keyword, reason), places in self.entries.items()]


@dataclass
class Material:
    """A material as the keys of Piola, in SI; `notes` say what the card has and these keys have not."""
    name: str
    keys: dict
    notes: list = field(default_factory=list)

    def wave_speed(self):
        """Speed of pressure waves at rest [m/s]."""
        k = self.keys
        nu = k.get("poissons_ratio", 0.3)
        modulus = k["youngs_modulus"] * (1 - nu) / ((1 + nu) * (1 - 2 * nu))
        return (modulus / k["density"])**0.5


@dataclass
class Velocity:
    """Initial velocity of sets of nodes (rows of X), or of everything; unset components are kept."""
    nodes: np.ndarray
    value: tuple
    place: str


@dataclass
class Support:
    """Nodes that are held along some axes; `name` is for a set of nodes that has no other one."""
    name: str
    nodes: np.ndarray
    fix: str


@dataclass
class Wall:
    """A rigid half space; the normal points towards the bodies."""
    point: tuple
    normal: tuple


@dataclass
class Model:
    """Nodes, elements, sets and cards. Elements are rows of `elements`: eight corners in 3D, four in 2D."""
    X: np.ndarray = None                 # (n, 3) [m]
    elements: np.ndarray = None          # (m, 8) or (m, 4) rows of X
    element_ids: np.ndarray = None
    part: np.ndarray = None              # (m,) index into parts
    parts: list = field(default_factory=list)        # names
    materials: list = field(default_factory=list)    # one per part, or None
    middles: dict = field(default_factory=dict)      # (corner, corner) -> node in the middle of the edge
    curved: np.ndarray = None            # (k, 11): element, then its ten nodes: tetrahedra with nodes on edges
    faces: np.ndarray = None             # (f, 4) rows of X: a closed surface in place of elements
    face_part: np.ndarray = None
    node_sets: dict = field(default_factory=dict)    # name -> rows of X
    element_sets: dict = field(default_factory=dict)  # name -> rows of elements
    surfaces: dict = field(default_factory=dict)     # name -> (f, 4) or (f, 2) rows of X
    velocities: list = field(default_factory=list)
    supports: list = field(default_factory=list)
    walls: list = field(default_factory=list)
    gravity: tuple = None
    end: float = None                    # [s]
    dimension: int = 3
    assumption: str = None               # 2D: plane_strain, plane_stress, axisymmetric
    notes: list = field(default_factory=list)
    left: Left = field(default_factory=Left)


def name_of(text, taken, lead):
    """A name that a case may have: letters, digits and _, not used before; `lead` stands before a digit."""
    name = "".join(c if c.isascii() and (c.isalnum() or c == "_") else "_" for c in text.strip()).strip("_")[:40]
    if not name or not name[0].isalpha() or name in RESERVED:
        name = f"{lead}_{name}".rstrip("_")
    unique, k = name, 2
    while unique in taken:
        unique, k = f"{name}_{k}", k + 1
    taken.add(unique)
    return unique


# Names that formulas of a case have.
RESERVED = {"X", "Y", "Z", "NX", "NY", "NZ", "t", "pi", "depth", "sin", "cos", "tan", "asin", "acos", "atan", "atan2",
            "exp", "log", "sqrt", "abs", "pow", "min", "max"}


def rows_of(ids, wanted):
    """Rows at which sorted `ids` have the wanted ones; -1 where they have not."""
    wanted = np.asarray(wanted, dtype=np.int64)
    if len(ids) == 0:
        return np.full(wanted.shape, -1, dtype=np.int64)
    at = np.clip(np.searchsorted(ids, wanted), 0, len(ids) - 1)
    return np.where(ids[at] == wanted, at, -1)


def whole(values, place, problems):
    """Numbers as int64; those that are no whole numbers up to 1e15 are problems."""
    odd = ~((np.abs(values) < 1e15) & (values == np.floor(values)))
    if odd.any():
        problems.add(place, f"{values[odd].ravel()[0]:g} is no number of a node, element or set (a whole number is "
                     "expected) - correct it")
    return np.where(odd, 0, values).astype(np.int64)


def sorted_nodes(ids, X, place, problems):
    """Nodes sorted by id; a number that is there twice at different places is a problem."""
    order = np.argsort(ids, kind="stable")
    ids, X = ids[order], X[order]
    if not np.isfinite(X).all():
        bad = ids[~np.isfinite(X).all(axis=1)][0]
        problems.add(place, f"node {bad} has a coordinate that is no finite number - correct it")
    same = np.flatnonzero(ids[1:] == ids[:-1]) + 1
    for k in same:
        if (X[k] != X[k - 1]).any():
            problems.add(place, f"node {ids[k]} is there twice, at different places - remove one", "node twice")
    keep = np.ones(len(ids), dtype=bool)
    keep[same] = False
    return ids[keep], X[keep]
