#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Meshes by meshio, clouds of points, units and how fast large files are read.

Environment: PIOLA_PROGRAM. Skipped without meshio: what needs it.
"""
import importlib.util
import re
import shutil
import subprocess
import tempfile
import time
import tomllib
import unittest
from pathlib import Path

import numpy as np

from decks import STEEL, InFolder, block, dyna_mesh, part_card

HAS_MESHIO = importlib.util.find_spec("meshio") is not None


@unittest.skipUnless(HAS_MESHIO, "python3-meshio is not installed")
class Meshes(InFolder):
    def setUp(self):
        super().setUp()
        import meshio
        self.meshio = meshio
        self.X, self.solids, self.grid = block((4, 4, 4), (4, 4, 4))

    def check_of(self, name, *arguments):
        """Output of the import of a mesh, and the case."""
        output = self.run_import(name, "--units", "cm", "--out", "out", "--force", *arguments)
        return output, tomllib.loads(Path("out/case.toml").read_text(encoding="utf-8"))

    def test_formats_give_the_same_volume(self):
        mesh = self.meshio.Mesh(self.X, [("hexahedron", self.solids)])
        for name in ("cube.vtu", "cube.vtk", "cube.msh", "cube.mesh", "cube.su2", "cube.xdmf"):
            mesh.write(name)
            output, case = self.check_of(name)
            self.assertIn("64 elements, 6.4e-05 m^3", output, name)
            self.assertEqual(case["body"][0]["material"], {"name": "steel_4340"})
            self.assertIn("placeholder", output)

    def test_physical_groups_of_gmsh_are_parts_and_patches(self):
        g = self.grid
        faces = np.stack([g[0, :-1, :-1], g[0, 1:, :-1], g[0, 1:, 1:], g[0, :-1, 1:]], axis=-1).reshape(-1, 4)
        mesh = self.meshio.Mesh(
            self.X, [("hexahedron", self.solids), ("quad", faces)],
            cell_data={"gmsh:physical": [np.repeat([1, 2], 32), np.full(16, 5)],
                       "gmsh:geometrical": [np.repeat([1, 2], 32), np.full(16, 5)]},
            field_data={"steel part": np.array([1, 3]), "rubber": np.array([2, 3]), "clamp": np.array([5, 2])})
        self.meshio.write("cube.msh", mesh, file_format="gmsh22", binary=False)
        output, case = self.check_of("cube.msh")
        self.assertIn("parts steel_part, rubber; patches other, clamp", output)
        self.assertEqual(case["body"][0]["part"][0]["where"], "rubber")

    def test_curved_tetrahedra_of_ten_nodes(self):
        e, corners = 0.3, np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], dtype=float)
        edges = np.array([[0, 1], [1, 2], [0, 2], [0, 3], [1, 3], [2, 3]])
        nodes = np.vstack([corners, corners[edges].mean(axis=1)])
        nodes[:, 0] += e * nodes[:, 0]**2
        self.meshio.Mesh(nodes, [("tetra10", np.arange(10)[None])]).write("one.vtu")
        self.assertIn(f"{1e-6 * (1 / 6 + e / 12):.8g}", self.check_of("one.vtu")[0])

    def test_closed_surfaces_are_taken_and_open_ones_refused(self):
        X = np.array([[0, 0, 0], [3, 0, 0], [0, 3, 0], [0, 0, 3]], dtype=float)
        faces = np.array([[0, 2, 1], [0, 1, 3], [1, 2, 3], [0, 3, 2]])
        self.meshio.Mesh(X, [("triangle", faces)]).write("tetrahedron.vtu")
        self.assertIn("4.5e-06 m^3", self.check_of("tetrahedron.vtu")[0])
        self.meshio.Mesh(X, [("triangle", faces[1:])]).write("open.vtu")
        self.assertIn("is not closed", self.run_import("open.vtu", "--units", "cm", code=2))

    def test_broken_meshes_are_refused(self):
        self.meshio.Mesh(self.X, [("hexahedron", self.solids)]).write("cube.vtu")
        data = Path("cube.vtu").read_bytes()
        for name, content in (("cut.vtu", data[:len(data) // 2]), ("noise.msh", bytes(range(256)) * 40),
                              ("empty.vtk", b""), ("text.msh", b"no mesh at all\n"), ("odd.foo", b"1 2 3\n")):
            self.refused(name, content, name, "cannot be read as a mesh", arguments=("--units", "mm"))
        self.meshio.Mesh(self.X, [("hexahedron", self.solids[:, [3, 2, 1, 0, 7, 6, 5, 4]])]).write("turned.vtu")
        self.refused("turned.vtu", Path("turned.vtu").read_bytes(), "element 1", "positive", "59 more",
                     arguments=("--units", "mm"))

    def test_files_of_cad_need_gmsh_and_a_spacing(self):
        self.refused("part.step", "ISO-10303-21;", "gmsh", arguments=("--units", "mm", "--spacing", "1mm"))
        if shutil.which("gmsh"):
            self.refused("part.step", "ISO-10303-21;", "--spacing", arguments=("--units", "mm"))

    @unittest.skipUnless(shutil.which("gmsh"), "gmsh is not installed")
    def test_bodies_of_cad_have_their_volume(self):
        Path("plate.geo").write_text('SetFactory("OpenCASCADE");\nBox(1) = {0, 0, 0, 10, 4, 4};\n'
                                     "Cylinder(2) = {5, 2, -1, 0, 0, 6, 1};\n"
                                     "BooleanDifference{ Volume{1}; Delete; }{ Volume{2}; Delete; }\n",
                                     encoding="ascii")
        subprocess.run(["gmsh", "-0", "-v", "1", "plate.geo", "-o", "plate.step"], check=True,
                       stdout=subprocess.DEVNULL)
        output = self.run_import("plate.step", "--units", "mm", "--spacing", "0.5mm")
        found = float(re.search(r"elements, (\S+) m\^3", output)[1])
        self.assertAlmostEqual(found / (1e-9 * (160 - 4 * np.pi)), 1, delta=5e-4)


class Points(InFolder):
    def test_table_is_taken_as_it_is(self):
        rows = [f"{x},{y},{z},1" for x in range(4) for y in range(4) for z in range(4)]
        case, _, check = self.imported("cloud.csv", "\n".join(["x [mm],y [mm],z [mm],volume [mm^3]", *rows]) + "\n")
        self.assertEqual(case["body"][0]["shape"], {"points": {"file": "points.csv"}})
        self.assertIn("64 particles", check)
        self.refused("plain.csv", "x,y,z,volume\n0,0,0,1\n", "names no units", arguments=())
        self.refused("head.csv", "0,0,0,1\n", "no column x", arguments=())

    def test_positions_with_names_become_bodies(self):
        rows = [f"{name} {x + at} {y} {z}" for name, at in (("Cu", 0), ("Al", 30)) for x in range(4) for y in range(4)
                for z in range(4)]
        case, _, check = self.imported("atoms.xyz", "\n".join(["128", "comment", *rows]) + "\n", "--units", "mm",
                                       "--spacing", "1mm")
        self.assertEqual([b["name"] for b in case["body"]], ["Al", "Cu"])
        self.assertIn("128 particles", check)
        self.refused("cut.xyz", "128\n\n" + "\n".join(rows[:100]), "promises 128 points and has 100",
                     arguments=("--units", "mm", "--spacing", "1mm"))
        self.refused("none.xyz", "1 2 3\n", "--spacing", arguments=("--units", "mm"))


class Units(InFolder):
    def test_all_spellings_give_the_same_case(self):
        text = "*KEYWORD\n" + dyna_mesh(*block((3, 3, 3), (30, 30, 30))[:2]) + part_card(1, "cube", 1) + STEEL
        Path("cube.k").write_text(text, encoding="ascii")
        cases = []
        for units in ("mm,ms,kg", "kg-mm-ms", "ms/kg/mm"):
            self.run_import("cube.k", "--units", units, "--out", "out", "--force")
            cases.append(Path("out/case.toml").read_text(encoding="utf-8"))
        self.assertEqual(cases[1:], cases[:1] * 2)

    def test_missing_and_odd_units_are_refused(self):
        text = "*KEYWORD\n" + dyna_mesh(*block((3, 3, 3), (30, 30, 30))[:2]) + part_card(1, "cube", 1) + STEEL
        for units, words in (((), ("does not say its units", "--units mm,ms,kg")),
                             (("--units", "mm,ms"), ("too few units",)),
                             (("--units", "mm,parsec,kg"), ("parsec", "allowed")),
                             (("--units", "mm,cm,kg"), ("two units",)),
                             (("--units", "mm,ms,kg", "--spacing", "-3"), ("--spacing", "no length"))):
            self.refused("cube.k", text, *words, arguments=units)

    def test_existing_cases_are_kept_unless_forced(self):
        text = "*KEYWORD\n" + dyna_mesh(*block((3, 3, 3), (30, 30, 30))[:2]) + part_card(1, "cube", 1) + STEEL
        Path("cube.k").write_text(text, encoding="ascii")
        self.run_import("cube.k", "--units", "SI")
        self.assertIn("--force", self.run_import("cube.k", "--units", "SI", code=2))
        self.run_import("cube.k", "--units", "SI", "--force")


class Large(InFolder):
    def test_a_hundred_thousand_elements_take_seconds(self):
        text = "*KEYWORD\n" + dyna_mesh(*block((100, 50, 20), (100, 50, 20))[:2]) + part_card(1, "slab", 1) + STEEL
        Path("slab.k").write_text(text, encoding="ascii")
        start = time.process_time(), time.monotonic()
        with tempfile.TemporaryDirectory() as folder:
            output = self.run_import("slab.k", "--units", "mm,ms,kg", "--out", f"{folder}/out", "--particles",
                                     "elements")
        self.assertIn("100,000 elements, 0.0001 m^3, 0.785 kg", output)
        self.assertLess(time.monotonic() - start[1], 60)  # about 3 s on an idle core


if __name__ == "__main__":
    unittest.main()
