#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Cases that were imported really run: their motion against closed forms.

Environment: PIOLA_PROGRAM.
"""
import csv
import json
import math
import subprocess
import unittest
from pathlib import Path

from decks import PROGRAM, InFolder, abaqus_mesh, block, dyna_mesh, dyna_set, part_card

L, E, DENSITY = 1.0, 1e6, 1000.0  # m, Pa, kg/m^3: waves of 31.6 m/s
PERIOD = 4 * L / math.sqrt(E / DENSITY)
PROBE = """
[[probe]]
name = "end"
body = "bar"
kind = "average"
where = "X > 0.9"
quantities = ["displacement_x"]

[[quantity]]
name = "period"
column = "end.displacement_x"
take = "oscillation_period"

[output.history]
every = "1 ms"
"""


class Runs(InFolder):
    def run_case(self, *arguments):
        """Runs out/case.toml; returns summary.json and the rows of history.csv."""
        done = subprocess.run([PROGRAM, "run", "out/case.toml", "--out", "results", "--quiet", *arguments],
                              capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        with open("results/history.csv", encoding="utf-8", newline="") as file:
            return json.loads(Path("results/summary.json").read_text(encoding="utf-8")), list(csv.DictReader(file))

    def clamped_bar(self, *arguments):
        """Period of the lowest longitudinal mode of a bar of LS-DYNA that is clamped by a set of nodes; nu = 0."""
        X, solids, grid = block((16, 4, 4), (L, 0.25, 0.25))
        text = ("*KEYWORD\n" + dyna_mesh(X, solids) + part_card(1, "bar", 1) + "*MAT_ELASTIC\n" +
                "%10d%10g%10g%10g\n" % (1, DENSITY, E, 0) +
                dyna_set("SET_NODE_LIST", 1, (grid[0] + 1).ravel().tolist()) + "*BOUNDARY_SPC_SET\n" +
                "".join("%10d" % n for n in (1, 0, 1, 1, 1)) + "\n*CONTROL_TERMINATION\n%10g\n" % (3 * PERIOD))
        Path("bar.k").write_text(text, encoding="ascii")
        self.run_import("bar.k", "--units", "SI", "--out", "out", *arguments)
        with open("out/case.toml", "a", encoding="utf-8") as file:
            file.write(PROBE)
        summary, _ = self.run_case("--set", 'body.bar.initial_velocity=["0.01*sin(pi*X/2)", "0", "0"]')
        return summary["quantities"]["period"]["value"]

    def test_packed_bar_swings_with_the_period_of_theory(self):
        self.assertAlmostEqual(self.clamped_bar() / PERIOD, 1, delta=0.001)

    def test_bar_of_elements_swings_faster_by_the_layer_that_is_held(self):
        # The layer of particles that is held lies half a spacing, L/32, inside: an error of first order.
        found = self.clamped_bar("--particles", "elements") / PERIOD
        self.assertGreater(found, 1 - 2 / 32)
        self.assertLess(found, 1 - 0.5 / 32)

    def test_block_of_abaqus_falls_freely(self):
        X, solids, _ = block((3, 3, 3), (0.3, 0.3, 0.3))
        text = (abaqus_mesh(X, solids, "C3D8") + "*SOLID SECTION, ELSET=all, MATERIAL=Rubber\n*MATERIAL, NAME=Rubber\n"
                "*DENSITY\n1000\n*HYPERELASTIC, NEO HOOKE\n2e5, 1e-6\n*NSET, NSET=Whole, GENERATE\n1, 64\n"
                "*INITIAL CONDITIONS, TYPE=VELOCITY\nWhole, 1, 2.0\n*STEP\n*DYNAMIC, EXPLICIT\n, 0.1\n*DLOAD\n"
                ", GRAV, 9.81, 0, 0, -1\n*END STEP\n")
        Path("cube.inp").write_text(text, encoding="ascii")
        self.run_import("cube.inp", "--units", "SI", "--out", "out")
        _, rows = self.run_case()
        mass, last = 27.0, rows[-1]
        time = float(next(value for key, value in last.items() if key.split(" ")[0].split("[")[0] == "time"))
        self.assertAlmostEqual(time, 0.1, places=12)
        value = {key.split(" ")[0].split("[")[0]: float(text) for key, text in last.items() if text}
        # Corners of a surface are read in single precision, 6e-8; the mass is of their third power.
        for key, wanted in (("linear_momentum_x", 2 * mass), ("linear_momentum_z", -9.81 * 0.1 * mass),
                            ("kinetic_energy", 0.5 * mass * (2**2 + 0.981**2))):
            self.assertAlmostEqual(value[key] / wanted, 1, delta=2e-7, msg=key)


if __name__ == "__main__":
    unittest.main()
