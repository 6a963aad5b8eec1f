# SPDX-License-Identifier: Apache-2.0
"""The files beside a case: surfaces as OBJ with groups, particles as CSV, outlines and numbers as TOML."""
import json

import numpy as np

from .solids import loops_of, triangles_of


def printable(line):
    """A line without control characters, which a file may have in its names."""
    return "".join(c if c.isprintable() else "?" for c in line)


def text(value):
    """A value of TOML: numbers with twelve digits, lists, tables in one line, texts."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, (int, np.integer)):
        return str(value)
    if isinstance(value, (float, np.floating)):
        found = f"{value:.12g}"
        return found if any(c in found for c in ".en") else found + ".0"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "")
    if isinstance(value, dict):
        return "{ " + ", ".join(f"{key} = {text(item)}" for key, item in value.items()) + " }"
    return "[" + ", ".join(text(item) for item in value) + "]"


def write_surface(path, faces, X, middles=None, patch=None, patches=()):
    """Writes faces as triangles in m, with a group for each patch."""
    used, at = np.unique(faces, return_inverse=True)
    local = {int(node): k for k, node in enumerate(used)}
    if middles:
        edge = {(a, b): m for (a, b), m in middles.items() if a in local and b in local}
        for m in edge.values():
            local.setdefault(m, len(local))
        middles = {tuple(sorted((local[a], local[b]))): local[m] for (a, b), m in edge.items()}
    nodes = np.fromiter(local.keys(), dtype=np.int64, count=len(local))
    triangles, owner, corners = triangles_of(at.reshape(faces.shape), X[nodes], middles)
    kept = np.zeros(len(corners), dtype=bool)
    kept[triangles] = True
    renumbered = np.cumsum(kept)[triangles]
    lines = ["# lengths in m"] + ["v %.9g %.9g %.9g" % tuple(x) for x in corners[kept].tolist()]
    groups = [("", np.arange(len(triangles)))] if patch is None else [
        (name, np.flatnonzero(patch[owner] == k)) for k, name in enumerate(patches)]
    for name, own in groups:
        lines += [f"g {name}"] if name else []
        lines += ["f %d %d %d" % tuple(t) for t in renumbered[own].tolist()]
    path.write_text("\n".join(lines) + "\n", encoding="ascii")


def write_particles(path, X, volume, dimension):
    """Writes particles in SI, one in a line."""
    unit = "m^3" if dimension == 3 else "m^2"
    head = ",".join(f"{axis} [m]" for axis in "xyz"[:dimension]) + f",volume [{unit}]"
    table = np.column_stack([X[:, :dimension], volume])
    lines = [",".join("%.12g" % v for v in row) for row in table.tolist()]
    path.write_text("\n".join([head, *lines]) + "\n", encoding="ascii")


def outline(edges, X):
    """A shape of Piola in two dimensions: polygons inside edges (e, 2), with their holes."""
    loops = [np.array(_without_straight(X[loop][:, :2])) for loop in loops_of(edges)]
    areas = [_area(loop) for loop in loops]
    outer = [k for k, area in enumerate(areas) if area > 0]
    shapes = []
    for k in outer:
        holes = [loops[h] for h, area in enumerate(areas) if area < 0 and _is_inside(loops[h][0], loops[k])
                 and not any(j != k and areas[j] < areas[k] and _is_inside(loops[h][0], loops[j]) for j in outer)]
        shape = {"polygon": loops[k].tolist()} | ({"holes": [hole.tolist() for hole in holes]} if holes else {})
        shapes.append({"extrude": shape})
    return shapes[0] if len(shapes) == 1 else {"union": shapes}


def _without_straight(loop):
    """Corners of a loop at which it turns."""
    before, after = loop - np.roll(loop, 1, axis=0), np.roll(loop, -1, axis=0) - loop
    turn = before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0]
    size = np.linalg.norm(before, axis=1) * np.linalg.norm(after, axis=1)
    return loop[np.abs(turn) > 1e-9 * size].tolist()


def _area(loop):
    x, y = loop.T
    return 0.5 * float(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))


def _is_inside(point, loop):
    a, b = loop, np.roll(loop, -1, axis=0)
    crosses = (a[:, 1] > point[1]) != (b[:, 1] > point[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = a[:, 0] + (point[1] - a[:, 1]) * (b[:, 0] - a[:, 0]) / (b[:, 1] - a[:, 1])
    return bool(np.count_nonzero(crosses & (point[0] < x)) % 2)


def around_edges(edges, X, radius):
    """A shape in two dimensions: all places within a radius of edges; straight runs are one capsule."""
    return _union([{"capsule": {"from": X[a, :2].tolist(), "to": X[b, :2].tolist(), "radius": radius}}
                   for a, b in _runs(edges, X)])


def around_nodes(nodes, X, radius, dimension):
    """A shape: balls or discs around nodes."""
    return _union([{"sphere": {"centre": X[node, :dimension].tolist(), "radius": radius}} for node in nodes])


def _union(shapes):
    return shapes[0] if len(shapes) == 1 else {"union": shapes}


def _runs(edges, X):
    """Joins edges (a, b) that go on straight."""
    after = dict(edges.tolist())
    starts = [a for a in after if a not in set(after.values())] or list(after)[:1]
    runs, left = [], dict(after)
    for start in starts + list(after):
        while start in left:
            end = left.pop(start)
            step = X[end] - X[start]
            while end in left and np.linalg.norm(np.cross(step, X[left[end]] - X[end])) < 1e-9 * (step @ step):
                end = left.pop(end)
            runs.append((start, end))
            start = end
    return runs
