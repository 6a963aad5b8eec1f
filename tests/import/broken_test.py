#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Files that are broken: all problems in one message with places, exit code 2, and nothing written.

Environment: PIOLA_PROGRAM; PYTHONPATH finds piola_import. PIOLA_MUTATIONS: number of files changed at random.
"""
import contextlib
import io
import os
import random
import unittest
from pathlib import Path

from decks import STEEL, InFolder, abaqus_mesh, block, dyna_mesh, dyna_set, part_card

X, SOLIDS, GRID = block((3, 3, 3), (30, 30, 30))
HOLD, HOLD_NONE = "%10d%10d%10d\n" % (3, 0, 1), "%10d%10d%10d\n" % (4, 0, 1)
DYNA = ("*KEYWORD\n" + dyna_mesh(X, SOLIDS) + part_card(1, "cube", 1) + STEEL +
        dyna_set("SET_NODE_LIST", 3, [1, 2, 5, 6]) + "*BOUNDARY_SPC_SET\n" + HOLD + "*END\n")
ABAQUS = (abaqus_mesh(X, SOLIDS, "C3D8") + "*SOLID SECTION, ELSET=all, MATERIAL=Steel\n*MATERIAL, NAME=Steel\n"
          "*DENSITY\n7.85e-9\n*ELASTIC\n210000, 0.3\n*PLASTIC\n300, 0\n400, 0.1\n*NSET, NSET=foot, GENERATE\n1, 16, 1\n"
          "*SURFACE, NAME=top\nall, S2\n*BOUNDARY\nfoot, 1, 3\n")


class Dyna(InFolder):
    def broken(self, old, new, *words):
        self.assertIn(old, DYNA)
        return self.refused("cube.k", DYNA.replace(old, new, 1), *words)

    def test_file_that_is_cut_off(self):
        elements = DYNA[:DYNA.index("*PART")].rstrip()
        self.refused("cube.k", elements.rsplit("\n", 1)[0] + "\n", "no line of nodes", "cut off")

    def test_node_that_is_there_twice_at_two_places(self):
        line = "%8d%16.9g%16.9g%16.9g\n" % (7, 1, 2, 3)
        self.broken("*ELEMENT", line + "*ELEMENT", "cube.k", "node 7 is there twice")

    def test_node_that_is_missing(self):
        lines = DYNA.splitlines()
        del lines[2 + 5]
        self.refused("cube.k", "\n".join(lines), "element 2 has the node 6, which is not there")

    def test_element_that_is_turned_over(self):
        nodes = "".join("%8d" % (n + 1) for n in SOLIDS[4])
        turned = "".join("%8d" % (n + 1) for n in SOLIDS[4][[3, 2, 1, 0, 7, 6, 5, 4]])
        self.broken(nodes, turned, "element 5", "volume -1e-06 m^3 (positive)", "wrong order")

    def test_numbers_that_are_none(self):
        self.broken("     200.0", "     2x0.0", "cube.k:", "2x0.0", "is not a number (*MAT_ELASTIC)")
        self.broken("%16.9g" % 10, "%16s" % "ten", "cube.k:", "\"ten\" is not a number (*NODE)")
        self.broken("%16.9g" % 10, "%16s" % "nan", "cube.k:", "is not a number")

    def test_cards_that_are_missing(self):
        self.refused("cube.k", DYNA.replace(part_card(1, "cube", 1), ""), "part 1, which has no *PART")
        self.broken(STEEL, "", "material 1, which is not there")
        self.broken(HOLD, HOLD_NONE, "set of nodes 4, which is not there")
        self.broken("*END", "*INCLUDE\nmore.k\n*END", "more.k", "does not exist")

    def test_impossible_materials(self):
        self.broken("       0.3", "       0.5", "Poisson's ratio is 0.5 (between -1 and 0.5)")
        self.broken("   7.85E-6", "         0", "density is 0 (positive)")

    def test_all_problems_come_at_once(self):
        text = DYNA.replace("       0.3", "       0.7", 1).replace(HOLD, HOLD_NONE)
        self.refused("cube.k", text, "0.7", "set of nodes 4")

    def test_files_that_are_no_keyword_files(self):
        self.refused("noise.k", bytes(range(256)) * 100, "noise.k", "NUL byte")
        self.refused("empty.k", "", "is empty")
        self.refused("letter.k", "Dear colleague\n", "is no keyword file")
        self.refused("self.k", "*KEYWORD\n*INCLUDE\nself.k\n", "includes itself")

    def test_folders_that_cannot_be_written(self):
        Path("cube.k").write_text(DYNA, encoding="ascii")
        Path("file").write_text("", encoding="ascii")
        self.run_import("cube.k", "--units", "SI", "--out", "file", code=2)
        self.run_import("cube.k", "--units", "SI", "--out", "file/below", code=2)
        self.run_import("nothing.k", "--units", "SI", code=2)
        self.run_import(".", "--units", "SI", code=2)

    def test_python_that_is_missing_is_named(self):
        Path("cube.k").write_text(DYNA, encoding="ascii")
        self.assertIn("/no/python3", self.run_import("cube.k", "--units", "SI", code=2, PIOLA_PYTHON="/no/python3"))


class Abaqus(InFolder):
    def broken(self, old, new, *words):
        self.assertIn(old, ABAQUS)
        return self.refused("cube.inp", ABAQUS.replace(old, new, 1), *words, arguments=("--units", "mm,s,tonne"))

    def test_elements(self):
        self.broken("\n2, 2, 18", "\n2, 2, 600", "element 2 (C3D8) has the node 600")
        self.broken("TYPE=C3D8", "TYPE=C3D4", "no multiple of 5")
        self.broken("TYPE=C3D8", "TYPE=S4R", "no solid or plane elements")

    def test_names(self):
        self.broken("MATERIAL=Steel", "MATERIAL=Gold", "GOLD, which is not there")
        self.broken("foot, 1, 3", "hand, 1, 3", "the set HAND is not there")
        self.broken("ELSET=all, MATERIAL", "ELSET=none, MATERIAL", "the set NONE is not there")

    def test_tables(self):
        self.broken("400, 0.1", "400, -0.1", "plastic strains do not grow")
        self.broken("210000, 0.3", "210000, 0.3x", "cube.inp:", "0.3x")

    def test_files_that_are_no_input_files(self):
        self.refused("noise.inp", bytes(range(256)), "NUL byte")
        self.refused("letter.inp", "Dear colleague\n", "is no input file")


class Mutations(InFolder):
    def test_files_changed_at_random_end_with_a_message(self):
        from piola_import.command import main
        chance = random.Random(5)
        for k in range(int(os.environ.get("PIOLA_MUTATIONS", "300"))):
            name, text = (("cube.k", DYNA), ("cube.inp", ABAQUS))[k % 2]
            for _ in range(chance.randint(1, 4)):
                at, count = chance.randrange(len(text)), chance.choice([0, 1, 8, 80])
                new = chance.choice(["", "*", "-", "9", ",", "\n", "*NODE\n", "e", "9" * 19, "\u00e9", "&a", "$"])
                text = text[:at] + new + text[at + count:]
            Path(name).write_text(text, encoding="utf-8")
            with contextlib.redirect_stdout(io.StringIO()), contextlib.redirect_stderr(io.StringIO()) as said:
                code = main([name, "--units", "mm,ms,kg", "--out", "out", "--force"])
            self.assertIn(code, (0, 2), text)
            self.assertEqual(code == 2, said.getvalue().startswith("piola: "), said.getvalue())


if __name__ == "__main__":
    unittest.main()
