# SPDX-License-Identifier: Apache-2.0
"""Regions of a case: the insides of elements, and the neighbourhoods of faces and nodes."""
import numpy as np

from .files import around_edges, around_nodes, outline, write_surface
from .solids import edges_of, faces_of, hull

NEAR = 0.75  # spacings around faces and nodes, within which the first layer of particles lies


class Regions:
    """Makes regions, with their files, when they are asked for. `entries` are the tables [[region]] by name."""

    def __init__(self, model, folder):
        self.model, self.folder, self.entries = model, folder, {}

    def part_of(self, rows):
        """The part that has just these elements, or None."""
        parts = range(len(self.model.parts))
        return next((k for k in parts if np.array_equal(rows, np.flatnonzero(self.model.part == k))), None)

    def of_part(self, part):
        """The inside of a part, under its name."""
        return self.of_rows(self.model.parts[part], np.flatnonzero(self.model.part == part))

    def of_rows(self, name, rows):
        """The inside of elements; returns the name, for formulas."""
        if name not in self.entries:
            elements = self.model.elements[rows]
            if self.model.dimension == 2:
                self.entries[name] = {"shape": outline(hull(edges_of(elements)), self.model.X)}
            else:
                file = f"region_{name}.obj"
                write_surface(self.folder / file, hull(faces_of(elements)), self.model.X, self.model.middles)
                self.entries[name] = {"shape": {"mesh": {"file": file, "unit": "m"}}}
        return name

    def of_faces(self, name, faces, spacing):
        """The particles next to faces."""
        within = float(f"{NEAR * spacing:.4g}")
        if self.model.dimension == 2:
            self.entries[name] = {"shape": around_edges(faces, self.model.X, within)}
        else:
            file = f"region_{name}.obj"
            write_surface(self.folder / file, faces, self.model.X)
            self.entries[name] = {"near": {"file": file, "unit": "m", "within": within}}
        return name

    def of_nodes(self, name, nodes, spacing):
        """The particles next to nodes."""
        radius = float(f"{NEAR * spacing:.4g}")
        self.entries[name] = {"shape": around_nodes(nodes, self.model.X, radius, self.model.dimension)}
        return name
