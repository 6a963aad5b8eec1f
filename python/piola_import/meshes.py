# SPDX-License-Identifier: Apache-2.0
"""Reads meshes by meshio (Gmsh, VTK, Exodus, Nastran, MED, ...) and CAD files by the program gmsh into a Model."""
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

from .model import ImportProblems, Model, name_of
from .solids import PYRAMID, TETRAHEDRON, TETRAHEDRON_EDGES, WEDGE

# Type of meshio -> places of the eight (or four) corners; nodes in the middle of edges are read of tetra10 alone.
SOLIDS = {"tetra": TETRAHEDRON, "tetra10": TETRAHEDRON, "wedge": WEDGE, "wedge15": WEDGE, "wedge18": WEDGE,
          "pyramid": PYRAMID, "pyramid13": PYRAMID, "pyramid14": PYRAMID, "hexahedron": list(range(8)),
          "hexahedron20": list(range(8)), "hexahedron24": list(range(8)), "hexahedron27": list(range(8))}
FACES = {"triangle": [0, 1, 2, 2], "triangle6": [0, 1, 2, 2], "triangle7": [0, 1, 2, 2], "quad": [0, 1, 2, 3],
         "quad8": [0, 1, 2, 3], "quad9": [0, 1, 2, 3]}
LINES = {"line": [0, 1], "line3": [0, 1]}
STRAIGHT = {"tetra", "wedge", "pyramid", "hexahedron", "triangle", "quad", "line", "vertex", "tetra10"}
# Fields of cells that number parts, the first one that a file has counts.
PART_FIELDS = ("gmsh:physical", "medit:ref", "cell_tags", "nastran:ref", "flac3d:group", "MaterialIds", "material",
               "PartId", "part", "Part", "ElementBlockIds", "ObjectId", "gmsh:geometrical")
PER_TURN = 48  # elements of gmsh around a circle: its polygon has an area that is 0.3 % small
CAD = (".step", ".stp", ".brep", ".iges", ".igs")


def read_mesh(path, units, problems, spacing=None):
    """The model of a mesh. spacing [m]: of elements that gmsh makes of a CAD file."""
    if Path(path).suffix.lower() in CAD:
        return _read_cad(path, units, problems, spacing)
    found = _meshio_of(path, problems)
    return _model_of(path, found, units, problems) if found is not None else Model()


def _meshio_of(path, problems):
    try:
        import meshio
    except ImportError:
        raise ImportProblems(f"{path}: this kind of file needs meshio for {sys.executable} - install the package "
                             "python3-meshio (apt install python3-meshio), or pip install meshio") from None
    if not Path(path).is_file():
        problems.add(path, "cannot be read (no such file) - check the name")
        return None
    try:
        return meshio.read(path)
    except (Exception, SystemExit) as error:  # its readers raise whatever a broken file leads them to
        text = " ".join(str(error).split())[:200]
        problems.add(path, f"cannot be read as a mesh ({text or type(error).__name__}) - is it complete, and does its "
                     "ending tell its format?")
        return None


def _read_cad(path, units, problems, spacing):
    """Meshes a CAD file with tetrahedra; only their surface is used later."""
    program = shutil.which("gmsh")
    if program is None:
        raise ImportProblems(f"{path}: CAD files need the program gmsh - install it (apt install gmsh), or export the "
                             "surface as STL from the CAD program and name it in shape.mesh")
    if spacing is None:
        raise ImportProblems(f"{path}: a CAD file has no elements from which a spacing follows - give --spacing")
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "mesh.msh"
        command = [program, "-3", "-v", "1", "-format", "msh22", "-clmax", repr(spacing / units.length), "-clcurv",
                   str(PER_TURN), "-o", str(out), str(path)]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0 or not out.is_file():
            problems.add(path, f"gmsh cannot mesh it: {' '.join((done.stderr + done.stdout).split())[:300]}")
            return Model()
        return _model_of(path, _meshio_of(out, problems), units, problems)


def _model_of(path, mesh, units, problems):
    """Solids with their faces as sets; or plane elements in z = 0; or a closed surface."""
    model = Model()
    X = np.asarray(mesh.points, dtype=float)
    model.X = np.zeros((len(X), 3))
    model.X[:, :X.shape[1]] = X[:, :3] * units.length
    if not np.isfinite(model.X).all():
        problems.add(path, "has coordinates that are no finite numbers - export it again")
        return model
    kinds = {block.type for block in mesh.cells}
    flat = not kinds & set(SOLIDS) and bool(len(X)) and np.ptp(model.X[:, 2]) == 0
    table = SOLIDS if kinds & set(SOLIDS) else FACES
    if not kinds & set(table):
        problems.add(path, f"has no solids and no surface (it has {', '.join(sorted(kinds)) or 'nothing'})")
        return model
    tags, names = _tags(mesh)
    _check_corners(path, mesh, len(X), problems)
    problems.stop_if_any()
    elements, part, rows = _take(mesh, table, tags)
    _name_parts(model, part, names, 2 if table is FACES else 3)
    if table is SOLIDS or flat:
        model.dimension, model.assumption = (2, "plane_strain") if flat else (3, None)
        model.elements, model.element_ids = elements, np.arange(1, len(elements) + 1)
        _curve(model, mesh)
        _take_sets(model, mesh, tags, names, LINES if flat else FACES, rows)
    else:
        model.faces, model.face_part = elements, model.part
        model.part = None
    left = kinds - set(SOLIDS) - set(FACES) - set(LINES) - {"vertex"}
    for kind in sorted(left):
        model.left.add(f"cells of type {kind}", path)
    for kind in sorted((kinds & set(table)) - STRAIGHT):
        model.left.add(f"cells of type {kind}", path, "nodes in the middle of edges are left out: edges are straight")
    return model


def _check_corners(path, mesh, count, problems):
    for block in mesh.cells:
        data = np.asarray(block.data)
        if data.size and data.dtype != object and (data.min() < 0 or data.max() >= count):
            problems.add(path, f"cells of type {block.type} have nodes that are not there - export it again")


def _tags(mesh):
    """A number for each cell of each block, and names by (dimension, number)."""
    fields = [field for field in PART_FIELDS if field in mesh.cell_data]
    tags = [np.zeros(len(block.data), dtype=np.int64) for block in mesh.cells]
    if fields:
        tags = [np.asarray(data).reshape(len(block.data), -1)[:, 0].astype(np.int64)
                for block, data in zip(mesh.cells, mesh.cell_data[fields[0]])]
    names = {}
    for name, value in (mesh.field_data or {}).items():
        value = np.ravel(value)
        if len(value) >= 2:
            names[int(value[1]), int(value[0])] = name
    return tags, names


def _take(mesh, table, tags):
    """Corners and tags of all cells of the kinds of a table, and the first row of each block of the mesh."""
    corners, part, rows, at = [], [], {}, 0
    for k, block in enumerate(mesh.cells):
        if block.type in table:
            corners.append(np.asarray(block.data)[:, table[block.type]].astype(np.int64))
            part.append(tags[k])
            rows[k] = at
            at += len(block.data)
    return np.vstack(corners), np.concatenate(part), rows


def _name_parts(model, tags, names, dimension):
    known, model.part = np.unique(tags, return_inverse=True)
    taken = model.taken = set()
    for tag in known.tolist():
        text = names.get((dimension, tag)) or ("body" if len(known) == 1 else f"part {tag}")
        model.parts.append(name_of(text, taken, "part"))
        model.materials.append(None)


def _curve(model, mesh):
    """Nodes in the middle of edges of tetrahedra."""
    at, curved = 0, []
    for block in mesh.cells:
        if block.type == "tetra10":
            curved.append(np.column_stack([at + np.arange(len(block.data)), block.data]))
        at += len(block.data) if block.type in SOLIDS else 0
    if curved:
        model.curved = np.vstack(curved).astype(np.int64)
        edges = np.sort(model.curved[:, 1:5][:, TETRAHEDRON_EDGES], axis=2).reshape(-1, 2)
        model.middles = dict(zip(map(tuple, edges.tolist()), model.curved[:, 5:].ravel().tolist()))


def _take_sets(model, mesh, tags, names, table, rows):
    """Faces with tags as surfaces; sets of points and cells under their names."""
    dimension = 2 if table is FACES else 1
    faces, tag = {}, None
    for k, block in enumerate(mesh.cells):
        if block.type in table:
            for tag in np.unique(tags[k]).tolist():
                chosen = np.asarray(block.data)[tags[k] == tag][:, table[block.type]].astype(np.int64)
                faces.setdefault(tag, []).append(chosen)
    for tag, found in faces.items():
        if tag or names:
            name = name_of(names.get((dimension, tag), f"faces {tag}"), model.taken, "faces")
            model.surfaces[name] = np.vstack(found)
    for name, points in (getattr(mesh, "point_sets", None) or {}).items():
        model.node_sets[name_of(name, model.taken, "nodes")] = np.unique(np.asarray(points, dtype=np.int64))
    for name, cells in (getattr(mesh, "cell_sets", None) or {}).items():
        chosen = [np.asarray(own, dtype=np.int64) + rows[k] for k, own in enumerate(cells)
                  if own is not None and k in rows and len(own)]
        if chosen and not name.startswith("gmsh:"):
            model.element_sets[name_of(name, model.taken, "cells")] = np.concatenate(chosen)
