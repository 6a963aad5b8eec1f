# SPDX-License-Identifier: Apache-2.0
"""Groups the elements of a model into bodies, and says what its sets are of each: patches, regions, or all of it."""
from dataclasses import dataclass, field

import numpy as np

from .model import name_of
from .solids import curved_tetrahedra, edges_of, faces_of, hull, keys_of, volumes_and_centroids

TETRAHEDRA_PER_PARTICLE = 5  # a mesh has five to six tetrahedra per node
LEAST_ACROSS = 3             # particles that nodal needs across a body


@dataclass
class Body:
    """A body: parts that share nodes. `rows` are its elements, `surface` its outer faces (edges in 2D)."""
    name: str
    parts: list
    rows: np.ndarray
    surface: np.ndarray
    spacing: float
    volume: float
    patch: np.ndarray = None                     # of each face: index into patches
    patches: list = field(default_factory=list)  # names; empty: no sets, and Piola finds patches itself
    patches_of: dict = field(default_factory=dict)  # set -> names of patches


def measure(model, problems):
    """Exact volumes and centroids of all elements; those without a positive volume are problems."""
    corners = model.X[model.elements][..., :model.dimension]
    volume, centroid = volumes_and_centroids(corners)
    if model.curved is not None:
        at = model.curved[:, 0]
        volume[at], centroid[at] = curved_tetrahedra(model.X[model.curved[:, 1:]])
    what = "area" if model.dimension == 2 else "volume"
    unit = "m^2" if model.dimension == 2 else "m^3"
    for k in np.flatnonzero(~(volume > 0)):
        problems.add(f"element {model.element_ids[k]}", f"has the {what} {volume[k]:.4g} {unit} (positive) - its nodes "
                     "are in the wrong order, or it is folded", f"has no positive {what}")
    problems.stop_if_any()
    return volume, centroid


def bodies_of(model, volume, wanted_spacing, mixed):
    """Bodies in the order of parts: those that share nodes are one body; without `mixed` only if of one material.

    Returns the bodies and the pairs of them that share nodes.
    """
    sharing = _sharing(model)
    joined = [pair for pair in sharing if mixed or _alike(model, *pair)]
    root = _roots(len(model.parts), joined)
    bodies = []
    for parts in [[k for k, r in enumerate(root) if r == first] for first in sorted(set(root))]:
        rows = np.flatnonzero(np.isin(model.part, parts))
        if len(rows) == 0:
            continue
        parts = sorted(parts, key=lambda part: -float(f"{volume[model.part == part].sum():.6e}"))
        elements = model.elements[rows]
        surface = hull(faces_of(elements) if model.dimension == 3 else edges_of(elements))
        total = float(volume[rows].sum())
        narrowest = np.ptp(model.X[elements.ravel(), :model.dimension], axis=0).min()
        of_mesh = (total / _particles(model, rows))**(1 / model.dimension)
        spacing = wanted_spacing or min(of_mesh, narrowest / LEAST_ACROSS)
        bodies.append(Body(model.parts[parts[0]], parts, rows, surface, spacing, total))
    at = {part: k for k, body in enumerate(bodies) for part in body.parts}
    return bodies, sorted({(at[a], at[b]) for a, b in sharing if at[a] != at[b]})


def _alike(model, a, b):
    first, second = model.materials[a], model.materials[b]
    return first is second or (first is not None and second is not None and first.keys == second.keys)


def _particles(model, rows):
    """Particles that resolve a body as its mesh does: one per element, of tetrahedra one for five."""
    simplex = (model.elements[rows, 4:] == model.elements[rows, 4:5]).all(axis=1) & (
        model.elements[rows, 2] == model.elements[rows, 3]) if model.dimension == 3 else np.zeros(len(rows), dtype=bool)
    return max(1.0, (~simplex).sum() + simplex.sum() / TETRAHEDRA_PER_PARTICLE)


def _sharing(model):
    """Pairs of parts that share nodes."""
    count = model.elements.shape[1]
    pairs = np.unique(np.column_stack([model.elements.ravel(), np.repeat(model.part, count)]), axis=0)
    shared = pairs[1:, 0] == pairs[:-1, 0]
    return np.unique(np.column_stack([pairs[:-1, 1], pairs[1:, 1]])[shared], axis=0).tolist()


def _roots(count, pairs):
    """For each of `count` things the lowest one to which pairs connect it."""
    root = list(range(count))

    def find(k):
        while root[k] != k:
            k = root[k]
        return k
    for a, b in pairs:
        first, second = sorted((find(a), find(b)))
        root[second] = first
    return [find(k) for k in range(count)]


def are_among(faces, others):
    """For each face whether it is one of the others, whatever the order of its corners."""
    if len(others) == 0:
        return np.zeros(len(faces), dtype=bool)
    _, code = np.unique(np.concatenate([keys_of(faces), keys_of(others)]), return_inverse=True)
    return np.isin(code[:len(faces)], code[len(faces):])


class Selection:
    """A set as a body has it: all of it, whole elements, faces of its surface, or single nodes."""

    def __init__(self, model, body, nodes=None, faces=None):
        self.whole, self.rows, self.nodes = False, np.zeros(0, dtype=np.int64), np.zeros(0, dtype=np.int64)
        self.faces = np.zeros(len(body.surface), dtype=bool)
        if faces is not None:
            if faces.shape[1] == body.surface.shape[1]:
                self.faces = are_among(body.surface, faces)
            return
        chosen = np.zeros(len(model.X), dtype=bool)
        chosen[nodes] = True
        inside = chosen[model.elements[body.rows]].all(axis=1)
        self.whole = bool(inside.all())
        self.rows = body.rows[inside]
        self.faces = chosen[body.surface].all(axis=1)
        own = np.zeros(len(model.X), dtype=bool)
        own[model.elements[body.rows]] = True
        self.nodes = np.flatnonzero(chosen & own)


def selections(model, body):
    """Selections of all sets by name; sets that the body does not have are left out."""
    found = {}
    for name, faces in model.surfaces.items():
        found[name] = Selection(model, body, faces=faces)
    for name, nodes in model.node_sets.items():
        found[name] = Selection(model, body, nodes=nodes)
    return {name: s for name, s in found.items() if s.faces.any() or len(s.nodes)}


def make_patches(body, chosen):
    """Cuts the surface into patches: one for each combination of sets that its faces belong to."""
    sets = [name for name, s in chosen.items() if s.faces.any() and not len(s.rows)]
    if not sets:
        return
    belongs = np.column_stack([chosen[name].faces for name in sets])
    kinds, body.patch = np.unique(belongs, axis=0, return_inverse=True)
    body.patch = body.patch.ravel()
    taken = set()
    for kind in kinds:
        names = [name for name, inside in zip(sets, kind) if inside]
        body.patches.append(name_of("_and_".join(names) or "other", taken, "patch"))
        for name in names:
            body.patches_of.setdefault(name, []).append(body.patches[-1])
