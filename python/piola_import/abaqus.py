# SPDX-License-Identifier: Apache-2.0
"""Reads input files of Abaqus (*.inp) into a Model: flat files, and files with parts, instances and an assembly."""
import numpy as np

from .abaqus_conditions import Conditions
from .abaqus_lines import read_keywords
from .abaqus_materials import OPTIONS, READ, material_of
from .abaqus_parts import ASSUMPTIONS, ELEMENTS, FACES, Container, Instance, place_of_instance, plain_type, shape_of
from .materials import problems_of
from .model import Model, name_of, rows_of, sorted_nodes, whole
from .solids import TETRAHEDRON_EDGES

SILENT = {"HEADING", "PREPRINT", "PART", "END PART", "ASSEMBLY", "END ASSEMBLY", "INSTANCE", "END INSTANCE", "STEP",
          "END STEP", "NODE", "SYSTEM"}
BY_ITSELF = {"OUTPUT", "NODE OUTPUT", "ELEMENT OUTPUT", "CONTACT OUTPUT", "ENERGY OUTPUT", "RESTART", "BULK VISCOSITY",
             "SECTION CONTROLS", "CONTACT", "CONTACT INCLUSIONS", "CONTACT PROPERTY ASSIGNMENT", "SURFACE INTERACTION",
             "SURFACE BEHAVIOR", "FILE OUTPUT", "EL FILE", "NODE FILE", "MONITOR", "PRINT", "NODE PRINT", "EL PRINT"}


def read_abaqus(path, units, problems):
    """The model of an input file. Adds to `problems` what makes it unusable."""
    keywords = read_keywords(path, problems)
    if not any(k.name in ("NODE", "ELEMENT", "MATERIAL") for k in keywords):
        if not problems.texts:
            problems.add(path, "is no input file of Abaqus: no *NODE, *ELEMENT or *MATERIAL")
        return Model()
    return _Reader(path, keywords, units, problems).read()


class _Reader:
    """Sorts keywords into parts, places their instances, and then reads sets, sections and conditions."""

    def __init__(self, path, keywords, units, problems):
        self.path, self.keywords, self.units, self.problems = path, keywords, units, problems
        self.model, self.names = Model(), set()
        self.flat = Container()                     # the file outside of parts
        self.parts, self.instances = {"": self.flat}, []
        self.materials, self.others = {}, []
        self.spelled = {}                           # names as the file writes them, by their form in upper case

    def read(self):
        self._sort()
        if self.flat.nodes:
            self.instances.insert(0, Instance("", self.flat))
        self._check_types()
        self.problems.stop_if_any()
        placed = _Placed(self)
        placed.build()
        placed.name_sets()
        Conditions(self.others, placed, self.units, self.problems).read()
        return self.model

    def _sort(self):
        """Goes through the keywords once; `here` is the part, instance or file that they belong to."""
        here, material = self.flat, None
        for keyword in self.keywords:
            name = keyword.name
            self.spelled |= {value.upper(): value for value in keyword.parameters.values()}
            if name == "PART":
                here = self.parts.setdefault(keyword.get("NAME"), Container(keyword.get("NAME")))
            elif name == "INSTANCE":
                part = self.parts.get(keyword.get("PART"))
                if part is None:
                    self.problems.add(keyword.place, f"*INSTANCE names the part {keyword.get('PART')}, which is not "
                                      "there - correct the name")
                    part = Container()
                own = Container(part.name, list(part.nodes), list(part.elements), dict(part.node_sets),
                                dict(part.element_sets), list(part.sections), list(part.surfaces))
                here = own
                self.instances.append(place_of_instance(keyword, own, self.problems))
            elif name in ("END PART", "END INSTANCE", "ASSEMBLY", "END ASSEMBLY"):
                here = self.flat
            elif name == "MATERIAL":
                material = self.materials.setdefault(keyword.get("NAME"), {"": keyword})
                continue
            elif material is not None and name in OPTIONS:
                material[name] = keyword
                if name not in READ:
                    self.model.left.add(name, keyword.place, "no counterpart")
                continue
            elif not self._take(keyword, here):
                self.others.append(keyword)
            material = None

    def _take(self, keyword, here):
        """Mesh, sets and sections; whether the keyword is one of these."""
        name, problems = keyword.name, self.problems
        if name == "NODE":
            here.nodes.append(keyword.table(4, problems))
            if keyword.get("NSET"):
                here.node_sets.setdefault(keyword.get("NSET"), []).append(
                    ("", [whole(here.nodes[-1][:, 0], keyword.place, problems)]))
        elif name == "ELEMENT":
            self._take_elements(keyword, here)
        elif name in ("NSET", "ELSET"):
            sets = here.node_sets if name == "NSET" else here.element_sets
            sets.setdefault(keyword.get(name), []).append((keyword.get("INSTANCE"), _members(keyword, problems)))
        elif name == "SOLID SECTION":
            here.sections.append((keyword.get("ELSET"), keyword.get("MATERIAL"), keyword.place))
        elif name == "SURFACE":
            here.surfaces.append((keyword.get("NAME"), keyword.get("TYPE") or "ELEMENT", keyword))
        elif name in SILENT:
            return True
        elif name in BY_ITSELF:
            self.model.left.add(name, keyword.place, "not needed: Piola has its own")
        else:
            return False
        return True

    def _take_elements(self, keyword, here):
        kind = plain_type(keyword.get("TYPE"))
        if kind is None:
            self.model.left.add(f"ELEMENT, TYPE={keyword.get('TYPE')}", keyword.place,
                                f"{len(keyword.lines):,} elements are left out: solids and plane elements are read")
            return
        if kind in ("C3D15", "C3D20", "CPE6", "CPE8", "CPS6", "CPS8", "CAX6", "CAX8"):
            self.model.left.add(f"ELEMENT, TYPE={keyword.get('TYPE')}", keyword.place,
                                "nodes in the middle of edges are left out: edges are straight")
        count = ELEMENTS[kind][0] + 1
        numbers = keyword.numbers_of_all(self.problems)
        if numbers is None:
            return
        if len(numbers) % count:
            self.problems.add(keyword.place, f"the lines of *ELEMENT, TYPE={kind} hold {len(numbers):,} numbers, which "
                              f"is no multiple of {count} - the file is cut off or a line is too short")
            return
        rows = numbers.reshape(-1, count)
        here.elements.append((kind, rows))
        if keyword.get("ELSET"):
            here.element_sets.setdefault(keyword.get("ELSET"), []).append(("", [rows[:, 0]]))

    def _check_types(self):
        """All elements are solid, or all are plane of one kind."""
        kinds = {kind[:3] for instance in self.instances for kind, _ in instance.part.elements}
        if not kinds:
            self.problems.add(self.path, "has no solid or plane elements" + (
                "" if self.instances else ": no part has an *INSTANCE in an *ASSEMBLY"))
        elif len(kinds) > 1:
            self.problems.add(self.path, f"has elements of several kinds of section ({', '.join(sorted(kinds))}) - "
                              "import them one by one")
        elif "C3D" not in kinds:
            self.model.dimension, self.model.assumption = 2, ASSUMPTIONS[kinds.pop()]


def _is_number(text):
    return text.isdigit() and len(text) < 16


def _members(keyword, problems):
    """Arrays of numbers and names of sets."""
    members, numbers = [], []
    for row in range(len(keyword.lines)):
        texts = [text for text in keyword.fields(row) if text]
        if "GENERATE" in keyword.parameters:
            first, last, step = (int(v) for v in (keyword.values(row, problems, 3)))
            if 0 <= last - first < 10**8:
                members.append(np.arange(first, last + 1, max(step, 1)))
            continue
        numbers += [int(text) for text in texts if _is_number(text)]
        members += [text.upper() for text in texts if not _is_number(text)]
    return members + [np.array(numbers, dtype=np.int64)]


class _Placed:
    """The instances as one mesh, and their sets as rows of it."""

    def __init__(self, reader):
        self.reader, self.model, self.problems = reader, reader.model, reader.problems
        self.ids, self.first_node, self.element_ids, self.first_element = {}, {}, {}, {}
        self.kinds = []                             # entry of FACES of each element

    def build(self):
        nodes, elements, numbers, curved = [], [], [], []
        at = count = 0
        self.instances = {instance.name: instance for instance in self.reader.instances}
        for name, instance in self.instances.items():
            rows = np.vstack([np.zeros((0, 4)), *instance.part.nodes])
            ids = whole(rows[:, 0], self.reader.path, self.problems)
            ids, X = sorted_nodes(ids, rows[:, 1:], self.reader.path, self.problems)
            self.ids[name], self.first_node[name], self.first_element[name] = ids, at, count
            nodes.append(instance.moved(X) * self.reader.units.length)
            own = [np.zeros(0, dtype=np.int64)]
            for kind, table in instance.part.elements:
                found = self._rows_of(ids, table, kind) + at
                elements.append(found[:, ELEMENTS[kind][1]])
                if kind == "C3D10":
                    curved.append(np.column_stack([count + np.arange(len(table)), found]))
                self.kinds += [shape_of(kind)] * len(table)
                own.append(table[:, 0])
                count += len(table)
            self.element_ids[name] = np.concatenate(own)
            numbers.append(self.element_ids[name])
            if len(np.unique(numbers[-1])) < len(numbers[-1]):
                self.problems.add(self.reader.path, f"element numbers are there twice{f' in {name}' if name else ''} - "
                                  "renumber them")
            at += len(ids)
        self.problems.stop_if_any()
        model = self.model
        model.X, model.elements, model.element_ids = np.vstack(nodes), np.vstack(elements), np.concatenate(numbers)
        if curved:
            model.curved = np.vstack(curved)
            edges = np.sort(model.curved[:, 1:5][:, TETRAHEDRON_EDGES], axis=2).reshape(-1, 2)
            model.middles = dict(zip(map(tuple, edges.tolist()), model.curved[:, 5:].ravel().tolist()))
        self.kinds = np.array(self.kinds)
        self._sections()

    def _rows_of(self, ids, table, kind):
        rows = rows_of(ids, table[:, 1:])
        for k, n in zip(*np.nonzero(rows < 0)):
            self.problems.add(self.reader.path, f"element {table[k, 0]} ({kind}) has the node {table[k, n + 1]}, which "
                              "is not there", "has a node which is not there")
        return rows

    def _sections(self):
        """Parts by *SOLID SECTION; elements without one are a part without material."""
        model = self.model
        model.part = np.full(len(model.elements), -1)
        for name, instance in self.instances.items():
            for elset, material, place in instance.part.sections:
                rows = self.elements_of(elset, name, place)
                model.part[rows] = len(model.parts)
                of_instance = name if len(instance.part.sections) == 1 else f"{name} {elset}"
                model.parts.append(name_of(self._spelled(of_instance if name else elset), self.reader.names, "part"))
                model.materials.append(self._material(material, place))
        if (model.part < 0).any():
            model.part[model.part < 0] = len(model.parts)
            model.parts.append(name_of("no section", self.reader.names, "part"))
            model.materials.append(None)

    def _material(self, name, place):
        options = self.reader.materials.get(name)
        if options is None:
            self.problems.add(place, f"names the material {name}, which is not there - add *MATERIAL, NAME={name}")
            return None
        material = material_of(self._spelled(name), options, self.reader.units, self.problems)
        if material is None:
            self.model.left.add(f"MATERIAL, NAME={name}", options[""].place,
                                "no law of Piola has these options: give the material")
            return None
        for text in problems_of(material):
            self.problems.add(options[""].place, f"{material.name}: {text} - correct it")
        return material

    def _spelled(self, name):
        return " ".join(self.reader.spelled.get(word, word) for word in name.split(" "))

    def elements_of(self, name, instance, place, depth=0):
        """Rows of the elements of a set of an instance, or of the assembly."""
        return self._resolve(name, instance, place, "element_sets", self.element_ids, self.first_element, depth)

    def nodes_of(self, name, instance, place, depth=0):
        """Rows of the nodes of a set; a number is one node."""
        return self._resolve(name, instance, place, "node_sets", self.ids, self.first_node, depth)

    def _resolve(self, name, instance, place, kind, ids, first, depth):
        if isinstance(name, str) and "." in name and name.split(".")[0] in self.instances:
            instance, name = name.split(".", 1)
        if isinstance(name, str) and _is_number(name):
            name = np.array([int(name)])
        if not isinstance(name, str):
            order = np.argsort(ids.get(instance, []), kind="stable")
            at = rows_of(ids.get(instance, np.zeros(0, dtype=int))[order], name)
            return order[at[at >= 0]] + first.get(instance, 0)
        for owner in (instance, ""):
            holder = self.instances[owner].part if owner in self.instances else self.reader.flat
            members = getattr(holder, kind).get(name)
            if members is not None and depth < 20:
                rows = [np.zeros(0, dtype=np.int64)]
                for of, parts in members:
                    rows += [self._resolve(part, of or owner, place, kind, ids, first, depth + 1) for part in parts]
                return np.unique(np.concatenate(rows))
        if kind == "node_sets" and depth < 20 and any(
                name in getattr(holder, "element_sets") for holder in (self.reader.flat, *(
                    i.part for key, i in self.instances.items() if key == instance))):
            return np.unique(self.model.elements[self.elements_of(name, instance, place, depth + 1)])
        self.problems.add(place, f"the set {name} is not there - correct the name")
        return np.zeros(0, dtype=np.int64)

    def name_sets(self):
        """All sets and surfaces under names of the case."""
        model, names = self.model, self.reader.names
        holders = [(name, instance.part) for name, instance in self.instances.items()]
        holders += [] if "" in self.instances else [("", self.reader.flat)]
        for owner, part in holders:
            lead = f"{owner} " if owner and len(self.instances) > 1 else ""
            for text in part.node_sets:
                if text and len(rows := self.nodes_of(text, owner, self.reader.path)):
                    model.node_sets[name_of(self._spelled(lead + text), names, "nodes")] = rows
            for text in part.element_sets:
                if text and not text.startswith("_") and len(rows := self.elements_of(text, owner, self.reader.path)):
                    model.element_sets[name_of(self._spelled(lead + text), names, "elements")] = rows
            for text, kind, keyword in part.surfaces:
                self._surface(name_of(self._spelled(lead + text), names, "surface"), kind, keyword, owner)

    def _surface(self, name, kind, keyword, owner):
        faces = []
        for row in range(len(keyword.lines)):
            text, face = (keyword.fields(row) + ["", ""])[:2]
            if kind == "NODE":
                self.model.node_sets[name] = self.nodes_of(text.upper(), owner, keyword.at(row))
                continue
            rows = self.elements_of(text.upper(), owner, keyword.at(row))
            number = face.upper().removeprefix("S")
            if not number.isdigit():
                self.model.left.add("SURFACE", keyword.at(row), "lines without a face S1 to S6 are left out")
                continue
            for shape in np.unique(self.kinds[rows]):
                if 0 < int(number) <= len(FACES[shape]):
                    own = rows[self.kinds[rows] == shape]
                    faces.append(self.model.elements[own][:, FACES[shape][int(number) - 1]])
        if faces:
            self.model.surfaces[name] = np.vstack(faces)
