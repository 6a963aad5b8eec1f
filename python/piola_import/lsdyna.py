# SPDX-License-Identifier: Apache-2.0
"""Reads keyword files of LS-DYNA (*.k, *.key, *.dyn) into a Model."""
import numpy as np

from .lsdyna_cards import Blocks, table
from .lsdyna_conditions import Conditions
from .lsdyna_materials import Card, grueneisen, kind_of, linear_polynomial
from .materials import problems_of
from .model import Model, name_of, rows_of, sorted_nodes, whole
from .solids import TETRAHEDRON, TETRAHEDRON_EDGES

# Keywords whose work Piola does by itself or without settings.
BY_ITSELF = ("CONTROL_", "DATABASE_", "HOURGLASS", "SECTION_SOLID", "CONTACT_AUTOMATIC", "CONTACT_ERODING")
SILENT = {"KEYWORD", "TITLE", "COMMENT", "NODE", "END"}


def read_lsdyna(path, units, problems):
    """The model of a keyword file. Adds to `problems` what makes it unusable."""
    blocks = Blocks(problems).read(path)
    if blocks or not problems.texts:
        return _Reader(path, blocks, units, problems).read()
    return Model()


class _Reader:
    """Takes the blocks in the order in which they depend on each other: nodes, elements, sets, cards."""

    def __init__(self, path, blocks, units, problems):
        self.path, self.blocks, self.units, self.problems = path, blocks, units, problems
        self.model, self.names = Model(), set()
        self.sets = {"NODE": {}, "PART": {}, "SOLID": {}}  # by number: name and ids
        self.held = {}                                     # axes -> ids of nodes
        self.curves = set()                                # numbers of those that materials have

    def read(self):
        if not any(b.keyword in ("NODE", "PART") or b.keyword.startswith(("ELEMENT", "MAT_")) for b in self.blocks):
            self.problems.add(self.path, "is no keyword file of LS-DYNA: no *NODE, *ELEMENT, *PART or *MAT")
            return self.model
        self._nodes()
        self._elements()
        for block in self.blocks:
            self._sets(block)
        self._parts()
        self._name_sets()
        conditions = Conditions(self)
        for block in self.blocks:
            self._card(block, conditions)
        conditions.hold_nodes()
        return self.model

    def _of(self, *keywords):
        return [block for block in self.blocks if block.keyword in keywords]

    def _nodes(self):
        found = [table(block, None, (8, 16, 16, 16, 8, 8), 5, self.problems) for block in self._of("NODE")]
        rows = np.vstack([np.zeros((0, 5)), *found])
        self.ids, self.model.X = sorted_nodes(whole(rows[:, 0], self.path, self.problems),
                                              rows[:, 1:4] * self.units.length, self.path, self.problems)
        for code in np.unique(rows[:, 4]):
            if 0 < code < 8:
                fix = ("x", "y", "z", "xy", "yz", "xz", "xyz")[int(code) - 1]
                self.held.setdefault(fix, []).extend(whole(rows[rows[:, 4] == code, 0], self.path, self.problems))

    def _elements(self):
        found = [_solids_of(block, self.problems) for block in self._of("ELEMENT_SOLID")]
        rows = np.vstack([np.zeros((0, 12), dtype=np.int64), *found])
        ids, order, count = np.unique(rows[:, 0], return_index=True, return_counts=True)
        for twice in ids[count > 1]:
            self.problems.add(self.path, f"element {twice} is there twice - remove one", "element twice")
        rows = rows[order]
        nodes = rows_of(self.ids, rows[:, 2:])
        lost = (nodes < 0) & (rows[:, 2:] != 0)
        lost[:, :8] = nodes[:, :8] < 0
        for k, n in zip(*np.nonzero(lost)):
            self.problems.add(self.path, f"element {rows[k, 0]} has the node {rows[k, n + 2]}, which is not there",
                              "has a node which is not there")
        model = self.model
        model.element_ids, self.part_ids = rows[:, 0], rows[:, 1]
        model.elements = nodes[:, :8]
        _straighten(model, nodes, rows[:, 2:])

    def _parts(self):
        cards = self._part_cards()
        known = np.unique(self.part_ids)
        self.model.part = np.searchsorted(known, self.part_ids)
        for pid in known.tolist():
            title, mid, eos, place = cards.get(pid, (f"part {pid}", 0, 0, self.path))
            if pid not in cards:
                self.problems.add(self.path, f"elements belong to part {pid}, which has no *PART - add it")
            self.model.parts.append(name_of(title or f"part {pid}", self.names, "part"))
            self.model.materials.append(self._material(mid, eos, place) if mid else None)
        self.part_rows = {pid: np.flatnonzero(self.model.part == k) for k, pid in enumerate(known.tolist())}

    def _part_cards(self):
        """Title, material, equation of state and place of each part."""
        cards = {}
        for block in self._of("PART"):
            for row in range(0, len(block.lines) - 1, 2):
                pid, _, mid, eos = block.card(row + 1, self.problems)[:4]
                cards[int(pid)] = (block.lines[row].strip(), int(mid), int(eos), block.at(row + 1))
        return cards

    def _material(self, mid, eos, place):
        for block in self.blocks:
            first = int(block.keyword.endswith("_TITLE"))
            if not block.keyword.startswith("MAT_") or _id_of(block, first) != mid:
                continue
            kind = kind_of(block.keyword)
            keys, notes = self._eos(eos)
            material = kind(Card(block, first, self.units, self.problems, keys, self._curve)) if kind else None
            if material is None:
                self.model.left.add(block.keyword, block.place, "no law of Piola has these numbers: give the material")
                return None
            material.notes += notes
            if material.keys["law"] in ("neo_hookean", "mooney_rivlin"):
                keys = {}
            material.keys = material.keys | keys
            for text in problems_of(material):
                self.problems.add(block.place, f"*{block.keyword}, {material.name}: {text} - correct it")
            return material
        self.problems.add(place, f"the part has material {mid}, which is not there - add its *MAT card")
        return None

    def _curve(self, number):
        """Points of a *DEFINE_CURVE whose abscissas grow, scaled and moved as it says; None if there is none."""
        for block in self.blocks:
            first = int(block.keyword.endswith("_TITLE"))
            if block.keyword.removesuffix("_TITLE") != "DEFINE_CURVE" or _id_of(block, first) != number:
                continue
            _, _, scale_a, scale_o, offset_a, offset_o = block.card(first, self.problems)[:6]
            rows = [block.card(row, self.problems, 2, (20, 20)) for row in range(first + 1, len(block.lines))]
            points = [((scale_a or 1.0) * (a + offset_a), (scale_o or 1.0) * (o + offset_o)) for a, o in rows]
            if not all(b[0] > a[0] for a, b in zip(points, points[1:])):
                return None
            self.curves.add(number)
            return points
        return None

    def _eos(self, eos):
        """Keys and notes of an equation of state."""
        for block in self.blocks:
            first = int(block.keyword.endswith("_TITLE"))
            if not eos or not block.keyword.startswith("EOS_") or _id_of(block, first) != eos:
                continue
            row = block.card(first, self.problems)
            kind = block.keyword.removeprefix("EOS_").removesuffix("_TITLE")
            if kind in ("GRUNEISEN", "004", "4"):
                return grueneisen(row, self.units)
            if kind in ("LINEAR_POLYNOMIAL", "001", "1"):
                return linear_polynomial(row, block.card(first + 1, self.problems)[0], self.units)
            self.model.left.add(block.keyword, block.place, "the pressure is that of the elastic constants")
        return {}, []

    def _sets(self, block):
        """Sets of nodes, parts, solids and segments, with and without a title."""
        words = block.keyword.split("_")
        if words[0] != "SET" or len(words) < 2 or words[1] not in ("NODE", "PART", "SOLID", "SEGMENT"):
            return
        extra = set(words[2:]) - {"LIST", "TITLE", "GENERATE"}
        if extra:
            self.model.left.add(block.keyword, block.place, "this way of making a set is not read")
            return
        first = int("TITLE" in words)
        number = _id_of(block, first)
        title = block.lines[0].strip() if first and block.lines else f"{words[1].lower()}s_{number}"
        rows = list(range(first + 1, len(block.lines)))
        if words[1] == "SEGMENT":
            self._segments(title, self._ids(block, rows, 4), block)
            return
        ids = self._ids(block, rows, 8).ravel()
        ids = ids[ids > 0]
        if "GENERATE" in words:
            ids = np.concatenate([np.arange(a, b + 1) for a, b in zip(ids[::2], ids[1::2]) if b - a < 10**8] or [ids])
        self.sets[words[1]][number] = (title, ids)

    def _ids(self, block, rows, count):
        return whole(table(block, rows, (10,) * count, count, self.problems), block.place, self.problems)

    def _segments(self, title, corners, block):
        rows = rows_of(self.ids, corners)
        rows[:, 3] = np.where(corners[:, 3] == 0, rows[:, 2], rows[:, 3])
        if (rows < 0).any():
            self.problems.add(block.place, f"the segments of {title} have nodes that are not there - correct them")
        else:
            self.model.surfaces[name_of(title, self.names, "segments")] = rows

    def _name_sets(self):
        """Sets of nodes and solids by their names."""
        for title, ids in self.sets["NODE"].values():
            if len(rows := self.rows(ids)):
                self.model.node_sets[name_of(title, self.names, "nodes")] = rows
        order = np.argsort(self.model.element_ids)
        for title, ids in self.sets["SOLID"].values():
            at = rows_of(self.model.element_ids[order], ids)
            self.model.element_sets[name_of(title, self.names, "solids")] = order[at[at >= 0]]
        for title, ids in self.sets["PART"].values():
            rows = [self.part_rows[pid] for pid in ids.tolist() if pid in self.part_rows]
            if rows:
                self.model.element_sets[name_of(title, self.names, "parts")] = np.concatenate(rows)

    def rows(self, ids):
        """Rows of nodes, those left out that no file has (unused nodes of other programs)."""
        rows = rows_of(self.ids, ids)
        return rows[rows >= 0]

    def _card(self, block, conditions):
        """All that is no mesh and no material."""
        keyword, left = block.keyword, self.model.left
        if keyword in SILENT | {"PART", "ELEMENT_SOLID"} or keyword.startswith(("SET_NODE", "SET_PART", "SET_SOLID",
                                                                               "SET_SEGMENT")):
            return
        if keyword.startswith("DEFINE_CURVE") and _id_of(block, int(keyword.endswith("_TITLE"))) in self.curves:
            return
        if keyword.startswith(("MAT_", "EOS_")):
            if kind_of(keyword) is None and keyword.startswith("MAT_"):
                left.add(keyword, block.place, "no law of Piola has these numbers: give the material")
        elif keyword.startswith("ELEMENT_SHELL"):
            left.add(keyword, block.place, f"{len(block.lines):,} shells are left out: Piola has no shells - mesh the "
                     "part with solids, three or more through its thickness")
        elif keyword.startswith("ELEMENT_"):
            left.add(keyword, block.place, f"elements in {len(block.lines):,} lines are left out")
        elif not conditions.take(block):
            by_itself = keyword.startswith(BY_ITSELF)
            left.add(keyword, block.place, "not needed: Piola has its own" if by_itself else "no counterpart")


def _id_of(block, row):
    text = block.fields(row)[0]
    try:
        return int(float(text))
    except ValueError:
        return None


def _solids_of(block, problems):
    """Element, part and ten nodes (0: none) of each element; old cards have one line, new ones two."""
    if not block.lines:
        return np.zeros((0, 12), dtype=np.int64)
    head = block.lines[0]
    short = len(head.split(",")) <= 2 if "," in head else len(head.rstrip()) <= (40 if block.long else 16)
    count = len(block.lines)
    if not short:
        rows = table(block, None, (8,) * 10, 10, problems)
        return whole(np.hstack([rows, np.zeros((count, 2))]), block.place, problems)
    if count % 2:
        problems.add(block.at(count - 1), "the element has no line of nodes: the file is cut off - export it again")
        count -= 1
    heads = table(block, list(range(0, count, 2)), (8, 8), 2, problems)
    nodes = table(block, list(range(1, count, 2)), (8,) * 10, 10, problems)
    return whole(np.hstack([heads, nodes]), block.place, problems)


def _straighten(model, nodes, given):
    """Gives tetrahedra, which LS-DYNA writes as n1 n2 n3 n4 n4 ..., or with ten nodes, their form of eight corners."""
    solids = model.elements
    ten = (given[:, 8:] > 0).all(axis=1)
    flat = (solids[:, 4:] == solids[:, 3:4]).all(axis=1) | ten
    model.elements = np.where(flat[:, None], solids[:, TETRAHEDRON], solids)
    if ten.any():
        model.curved = np.column_stack([np.flatnonzero(ten), nodes[ten]])
        edges = np.sort(nodes[ten][:, :4][:, TETRAHEDRON_EDGES], axis=2).reshape(-1, 2)
        model.middles = dict(zip(map(tuple, edges.tolist()), nodes[ten][:, 4:].ravel().tolist()))
