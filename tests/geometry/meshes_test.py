#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The surfaces in cases/geometry/meshes are what their script makes, closed, with the volumes of what they show."""
import collections
import math
import os
import pathlib
import struct
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(os.environ.get("PIOLA_SOURCE_DIR", pathlib.Path(__file__).resolve().parent.parent.parent))
FOLDER = ROOT / "cases/geometry/meshes"
failures = []


def expect(condition, words):
    if not condition:
        failures.append(words)


def run(*arguments):
    return subprocess.run([sys.executable, FOLDER / "make_meshes", *arguments], capture_output=True, text=True,
                          check=False)


def stl(path):
    data = path.read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    expect(len(data) == 84 + 50 * count, f"{path.name}: {len(data)} bytes for {count} faces")
    expect(not data.startswith(b"solid"), f"{path.name}: begins like a text")
    for k in range(count):
        values = struct.unpack_from("<12f", data, 84 + 50 * k)
        yield values[3:6], values[6:9], values[9:12]


def obj(path):
    groups, places = {}, []
    for line in path.read_text().splitlines():
        word, *rest = line.split()
        if word == "g":
            faces = groups.setdefault(rest[0], [])
        elif word == "v":
            places.append(tuple(map(float, rest)))
        elif word == "f":
            faces.append(tuple(places[int(k) - 1] for k in rest))
    return groups


def check_surface(name, faces, volume, tolerance, holes):
    """Every edge twice, once each way; Euler's number 2 - 2 holes; the volume by tetrahedra from a place outside."""
    faces = list(faces)
    edges = collections.Counter((f[k], f[k - 1]) for f in faces for k in range(3))
    expect(all(count == 1 and edges[b, a] == 1 for (a, b), count in list(edges.items())), f"{name}: is not closed")
    corners = {corner for f in faces for corner in f}
    euler = len(corners) - len(edges) // 2 + len(faces)
    expect(euler == 2 - 2 * holes, f"{name}: Euler's number {euler}, not {2 - 2 * holes}")
    total = 0
    for f in faces:
        (a, b, c), (d, e, g), (h, i, j) = ([x - 100 for x in corner] for corner in f)
        total += (a * (e * j - g * i) - b * (d * j - g * h) + c * (d * i - e * h)) / 6
    expect(abs(total / volume - 1) < tolerance, f"{name}: volume {total}, not {volume}")


with tempfile.TemporaryDirectory() as folder:
    made = pathlib.Path(folder)
    result = run("--out", folder)
    expect(result.returncode == 0, result.stderr)
    names = ["assembly.obj", "bracket.stl", "notched_bar.stl"]
    expect(sorted(p.name for p in made.iterdir()) == names, "other files than expected")
    for name in names:
        expect((made / name).read_bytes() == (FOLDER / name).read_bytes(), f"{name}: is not what make_meshes writes")
        expect((FOLDER / name).stat().st_size < 100_000, f"{name}: is too large for the repository")
    readme = (FOLDER / "README.md").read_text()
    for line in result.stdout.splitlines():
        words = line.replace(",", "").split()
        for value in (words[words.index("volume") + 1], words[words.index("area") + 1]):
            expect(f"| {value} |" in readme, f"README.md: says nothing of {value} in '{line}'")

    # Volumes of the true solids; polygons of 64, 48 and 32 sides lose 0.2 to 0.7 % of their circles.
    section = 8 * (50 + 40 - 8) + 36 * (1 - math.pi / 4)
    check_surface("bracket", stl(made / "bracket.stl"), 30 * section - math.pi * 8 * (25 + 16), 0.001, 2)
    groove = math.pi * 2 ** 2 / 2 * 2 * math.pi * (10 - 4 * 2 / (3 * math.pi))
    check_surface("notched bar", stl(made / "notched_bar.stl"), math.pi * 100 * 60 - groove, 0.004, 0)
    groups = obj(made / "assembly.obj")
    expect(list(groups) == ["plate", "stud"], "assembly: other groups")
    check_surface("plate", groups["plate"], 24 * 24 * 4, 1e-12, 0)
    check_surface("stud", groups["stud"], math.pi * 36 * 10, 0.008, 0)
    expect(max(z for f in groups["plate"] for _, _, z in f) == min(z for f in groups["stud"] for _, _, z in f),
           "assembly: the parts do not touch")

    result = run("--big", "5000", str(made / "knot.stl"))
    expect(result.returncode == 0, result.stderr)
    knot = list(stl(made / "knot.stl"))
    expect(abs(len(knot) - 5000) < 100, f"knot: {len(knot)} faces")
    check_surface("knot", knot, 35682.4, 0.05, 1)
    for wrong in (["--big"], ["--big", "many", "x.stl"], ["--out"], ["x"]):
        expect(run(*wrong).returncode == 2, f"{wrong}: is not refused")

print("\n".join(failures + [f"meshes_test: {len(failures)} failures"]))
sys.exit(1 if failures else 0)
