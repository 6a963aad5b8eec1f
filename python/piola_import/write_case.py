# SPDX-License-Identifier: Apache-2.0
"""Writes a model as a case: case.toml, a surface or particles for each body, and regions for its sets."""
from dataclasses import dataclass, field

import numpy as np

from .bodies import bodies_of, make_patches, measure, selections
from .files import outline, printable, text, write_particles, write_surface
from .model import name_of
from .regions import Regions

MOST_NODES = 200          # of a set without faces, each of which becomes a ball
HYPERELASTIC = {"neo_hookean", "mooney_rivlin", "saint_venant_kirchhoff"}
PLACEHOLDER = "steel_4340"


@dataclass
class Options:
    """What the command line chose."""
    source: str                 # the file that was read
    particles: bool = False     # one particle per element, in place of packed surfaces
    formulation: str = ""
    spacing: float = None       # [m]
    material: str = ""          # of the library, for parts without one


@dataclass
class Section:
    """Lines of case.toml, and the files beside it."""
    lines: list = field(default_factory=list)

    def add(self, *lines):
        self.lines += lines

    def table(self, head, entries, comment=()):
        self.lines += ["", *(f"# {printable(line)}" for line in comment), head]
        self.lines += [f"{key} = {text(value)}" for key, value in entries.items() if value is not None]


class CaseWriter:
    """Writes the bodies of a mesh, with what the file says of them."""

    def __init__(self, model, folder, options, problems):
        self.model, self.folder, self.options = model, folder, options
        self.volume, self.centroid = measure(model, problems)
        mixed = not options.particles and options.formulation in ("", "nodal")
        self.bodies, self.sharing = bodies_of(model, self.volume, options.spacing, mixed)
        self.regions = Regions(model, folder)
        self.taken = {*model.parts, *model.node_sets, *model.element_sets, *model.surfaces}
        self.notes = []
        if (model.assumption == "plane_stress" and mixed) or self._takes_jst_sph():
            self._take_elastic_law()
        for a, b in self.sharing if options.particles else []:
            problems.add(options.source, f"the parts {self.bodies[a].name} and {self.bodies[b].name} share nodes and "
                         "have different materials, but particles of elements cannot be joined or tied - leave out "
                         "--particles elements")
        problems.stop_if_any()

    def _takes_jst_sph(self):
        """Elastic particles of elements are stable under jst_sph alone, which refuses rigid shapes for them."""
        by_default = self.options.particles and not self.options.formulation and not self.model.walls
        return by_default or self.options.formulation == "jst_sph"

    def _take_elastic_law(self):
        """Plane stress of nodal, and jst_sph, are for hyperelastic laws: elastic materials get one."""
        for material in filter(None, self.model.materials):
            if material.keys == material.keys | {"law": "elastic"} and "eos" not in material.keys:
                material.keys["law"] = "saint_venant_kirchhoff"
                material.notes.append("saint_venant_kirchhoff takes the place of elastic: the same at small strain")

    def write(self):
        """Writes all files; returns lines that say what the bodies are."""
        self._name_supports()
        self._check_velocities()
        about, sections = [], Section()
        for body in self.bodies:
            chosen = selections(self.model, body)
            self._body(body, chosen, sections)
            about.append(self._about(body))
        self._whole_case(sections)
        return about

    def _name_supports(self):
        """Each support gets the set of nodes that has its nodes, or becomes one."""
        sets = {np.unique(nodes).tobytes(): name for name, nodes in self.model.node_sets.items()}
        self.fixed = {}
        for support in self.model.supports:
            key = np.unique(support.nodes).tobytes()
            if key not in sets:
                sets[key] = name_of(support.name, self.taken, "hold")
                self.model.node_sets[sets[key]] = support.nodes
            name = sets[key]
            self.fixed[name] = "".join(a for a in "xyz" if a in self.fixed.get(name, "") + support.fix)

    def _check_velocities(self):
        """Lists initial velocities of single nodes, which no particle can have."""
        for velocity in self.model.velocities:
            nodes = np.zeros(len(self.model.X), dtype=bool)
            nodes[velocity.nodes] = True
            if not nodes[self.model.elements].all(axis=1).any():
                self.model.left.add("initial velocity", velocity.place, "its nodes make no whole element: left out")

    def _whole_case(self, sections):
        model, case = self.model, Section()
        case.add(f"title = {text('Imported from ' + self.options.source)}")
        if model.assumption == "axisymmetric":
            case.add('geometry = "axisymmetric"')
        end = model.end or 10 * max(self._crossing(body) for body in self.bodies)
        comment = [] if model.end else ["Placeholder: ten times the way of a pressure wave through the largest body."]
        case.table("[run]", {"end": float(f"{end:.4g}")}, comment)
        for name, entry in self.regions.entries.items():
            case.table("[[region]]", {"name": name, **entry})
        for wall in model.walls:
            d = model.dimension
            case.table("[[rigid]]", {"name": name_of("wall", self.taken, "wall"),
                                     "plane": {"point": list(wall.point[:d]), "normal": list(wall.normal[:d])}})
        for a, b in self.sharing:
            case.table("[[tie]]", {"between": [self.bodies[a].name, self.bodies[b].name]})
        (self.folder / "case.toml").write_text("\n".join(case.lines + sections.lines) + "\n", encoding="utf-8")

    def _crossing(self, body):
        """Time of a pressure wave through a body [s]; of an unknown material at 5 km/s."""
        X = self.model.X[self.model.elements[body.rows]].reshape(-1, 3)
        material = self.model.materials[body.parts[0]]
        return float(np.ptp(X, axis=0).max()) / (material.wave_speed() if material else 5000.0)

    def _body(self, body, chosen, sections):
        model = self.model
        material = model.materials[body.parts[0]]
        if not self.options.particles and model.dimension == 3:
            make_patches(body, chosen)
        keys, comment = self._material_keys(material, body.name)
        formulation = self._formulation(material)
        sections.table("[[body]]", {"name": body.name, "shape": self._shape(body), "material": keys,
                                    "formulation": formulation, "initial_velocity": self._velocity(body)}, comment)
        for part in body.parts[1:]:
            keys, comment = self._material_keys(model.materials[part], model.parts[part])
            sections.table("[[body.part]]", {"name": model.parts[part], "where": self.regions.of_part(part),
                                             "material": keys}, comment)
        self._conditions(body, chosen, sections)

    def _shape(self, body):
        model = self.model
        if self.options.particles:
            name = f"{body.name}.csv"
            write_particles(self.folder / name, self.centroid[body.rows], self.volume[body.rows], model.dimension)
            return {"points": {"file": name}}
        spacing = {"spacing": float(f"{body.spacing:.4g}")}
        if model.dimension == 2:
            return spacing | outline(body.surface, model.X)
        name = f"{body.name}.obj"
        write_surface(self.folder / name, body.surface, model.X, model.middles, body.patch, body.patches)
        return spacing | {"mesh": {"file": name, "unit": "m"}}

    def _material_keys(self, material, owner):
        if material is not None:
            return material.keys, [f"{owner}: {material.name}; SI units."] + [f"{n[0].upper()}{n[1:]}."
                                                                             for n in material.notes]
        name = self.options.material or PLACEHOLDER
        if not self.options.material:
            self.notes.append(f"{owner} has no material that Piola has: {name} is a placeholder")
        comment = [] if self.options.material else [f"{owner}: placeholder, the file gives no material that Piola has."]
        return {"name": name}, comment

    def _formulation(self, material):
        """The one that was chosen; else nodal for surfaces, and for particles one that takes them with the law."""
        yields = material is None or material.keys["law"] not in HYPERELASTIC | {"elastic"}
        plane_stress = self.model.assumption == "plane_stress"
        if self.options.particles:
            name = "jst_sph" if material and material.keys["law"] in HYPERELASTIC else "adaptle"
        else:
            name = "adaptle" if plane_stress and yields else "nodal"
        name = self.options.formulation or name
        tied = name == "adaptle" and self.sharing
        return ({"name": name} | ({"assumption": "plane_stress"} if plane_stress and name != "jst_sph" else {})
                | ({"description": "total_lagrangian"} if tied else {}))

    def _velocity(self, body):
        """Numbers or formulas of the initial velocity, None at rest; of several cards the last one counts."""
        terms, d = ["0.0"] * self.model.dimension, self.model.dimension
        for velocity in self.model.velocities:
            nodes = np.zeros(len(self.model.X), dtype=bool)
            nodes[velocity.nodes] = True
            inside = nodes[self.model.elements[body.rows]].all(axis=1)
            value = [text(float(v)) for v in velocity.value[:d]]
            if inside.all():
                terms = value
            elif inside.any():
                region = self._moving_region(body.rows[inside])
                terms = [old if old == v else f"{region} ? {v} : {old if '?' not in old else f'({old})'}"
                         for v, old in zip(value, terms)]
        if all(term == "0.0" for term in terms):
            return None
        return [float(term) if "?" not in term else term for term in terms]

    def _moving_region(self, rows):
        part = self.regions.part_of(rows)
        if part is not None:
            return self.regions.of_part(part)
        return self.regions.of_rows(name_of("moving", self.taken, "moving"), rows)

    def _conditions(self, body, chosen, sections):
        """Supports of a body, gravity, and regions of the sets that have no patch."""
        for name, selection in chosen.items():
            places = self._places(body, name, selection, name in self.fixed)
            for place in places if name in self.fixed else []:
                label = name_of(name if name.startswith("hold") else f"hold_{name}", self.taken, "hold")
                sections.table("[[support]]", {"name": label, "body": body.name, **place,
                                               "fix": self._fix(self.fixed[name])})
        for name, rows in self.model.element_sets.items():
            own = np.intersect1d(rows, body.rows)
            if len(own) == len(rows) < len(body.rows) and self.regions.part_of(own) is None:
                self.regions.of_rows(name, own)
        if self.model.gravity:
            gravity = list(self.model.gravity[:self.model.dimension])
            sections.table("[[load]]", {"body": body.name, "acceleration": gravity})

    def _fix(self, axes):
        return axes if self.model.dimension == 3 else axes.replace("z", "") or axes

    def _places(self, body, name, selection, is_support):
        """Keys that say where a set is: patches, a region, or everything. Makes the regions that are wanted."""
        if name in body.patches_of:
            return [{"patch": patch} for patch in body.patches_of[name]]
        if selection.whole:
            return [{"where": "1 > 0"}]
        own = name if len(self.bodies) == 1 else f"{name}_{body.name}"
        if len(selection.rows):
            return [{"where": self.regions.of_rows(own, selection.rows)}]
        if selection.faces.any():
            return [{"where": self.regions.of_faces(own, body.surface[selection.faces], body.spacing)}]
        if is_support and len(selection.nodes) <= MOST_NODES:
            return [{"where": self.regions.of_nodes(own, selection.nodes, body.spacing)}]
        if is_support or len(selection.nodes) > 0:
            self.notes.append(f"the set {name} of {body.name} has no whole face or element: left out")
        return []

    def _about(self, body):
        model = self.model
        mass = [model.materials[p].keys["density"] * float(self.volume[model.part == p].sum()) for p in body.parts
                if model.materials[p] is not None]
        known = len(mass) == len(body.parts) and model.dimension == 3
        what = f"{len(body.rows):,} particles" if self.options.particles else f"spacing {body.spacing * 1e3:.4g} mm"
        unit = "m^3" if model.dimension == 3 else "m^2"
        parts = f", parts {', '.join(model.parts[p] for p in body.parts)}" if len(body.parts) > 1 else ""
        patches = f"; patches {', '.join(body.patches)}" if body.patches else ""
        return (f"  body {body.name}: {len(body.rows):,} elements, {body.volume:.8g} {unit}"
                f"{f', {sum(mass):.8g} kg' if known else ''}; {what}{parts}{patches}")
