# SPDX-License-Identifier: Apache-2.0
"""Writes cases of clouds of points, and of closed surfaces, which have no elements."""
import numpy as np

from .files import text, write_surface
from .model import name_of
from .solids import enclosed_volume, hull, triangles_of
from .write_case import PLACEHOLDER, Section


def _case(folder, source, shapes, options):
    """case.toml of bodies by name and shape, with a placeholder for what such a file does not say."""
    case = Section()
    case.add(f"title = {text('Imported from ' + source)}")
    case.table("[run]", {"end": 1e-3}, ["Placeholder."])
    for name, shape, formulation in shapes:
        comment = [] if options.material else ["Placeholder: the file gives no material."]
        case.table("[[body]]", {"name": name, "shape": shape, "material": {"name": options.material or PLACEHOLDER},
                                "formulation": {"name": options.formulation or formulation}}, comment)
    (folder / "case.toml").write_text("\n".join(case.lines) + "\n", encoding="utf-8")


def write_cloud(cloud, folder, options):
    """A table of points: a body for each name in its column body. Returns what the bodies are."""
    if cloud.text:
        (folder / "points.csv").write_text(cloud.text, encoding="utf-8")
    else:
        names = cloud.bodies and cloud.body_of
        rows = [",".join(["%.12g" % v for v in (*x, volume)] + ([names[k]] if names else []))
                for k, (x, volume) in enumerate(zip(cloud.X.tolist(), cloud.volume))]
        head = "x [m],y [m],z [m],volume [m^3]" + (",body" if names else "")
        (folder / "points.csv").write_text("\n".join([head, *rows]) + "\n", encoding="utf-8")
    points = {"file": "points.csv"} | ({"unit": cloud.length_unit} if cloud.length_unit else {})
    taken = set()
    bodies = [(name_of(body, taken, "body"), {"points": points | {"body": body}}, "adaptle")
              for body in cloud.bodies or []] or [("body", {"points": points}, "adaptle")]
    _case(folder, options.source, bodies, options)
    return [f"  body {name}: particles of points.csv" for name, _, _ in bodies]


def write_hulls(model, folder, options, problems):
    """Closed surfaces: a body for each part. Returns what the bodies are."""
    bodies, about = [], []
    for k, name in enumerate(model.parts):
        faces = model.faces[model.face_part == k]
        if len(hull(edges_of_faces(faces))):
            problems.add(options.source, f"the surface {name} is not closed: sides belong to one face alone - mesh the "
                         "solid, or mend it by repair of shape.mesh")
            continue
        triangles, _, corners = triangles_of(faces, model.X)
        volume = enclosed_volume(triangles, corners)
        size = float(np.ptp(model.X[faces.ravel()], axis=0).max())
        spacing = options.spacing or min(size / 20, abs(volume)**(1 / 3) / 10)
        write_surface(folder / f"{name}.obj", faces, model.X)
        shape = {"spacing": float(f"{spacing:.4g}"), "mesh": {"file": f"{name}.obj", "unit": "m", "repair": "orient"}}
        bodies.append((name, shape, "nodal"))
        about.append(f"  body {name}: a surface of {len(faces):,} faces, {abs(volume):.8g} m^3; spacing "
                     f"{spacing * 1e3:.4g} mm")
    problems.stop_if_any()
    _case(folder, options.source, bodies, options)
    return about


def edges_of_faces(faces):
    """The sides of faces (f, 4), triangles with their last corner twice."""
    sides = np.stack([faces, np.roll(faces, -1, axis=1)], axis=-1).reshape(-1, 2)
    return sides[sides[:, 0] != sides[:, 1]]
