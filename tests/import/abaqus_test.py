#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Input files of Abaqus: masses, instances, sets, plane elements, materials by hand.

Environment: PIOLA_PROGRAM.
"""
import re
import unittest
from pathlib import Path

import numpy as np

from decks import CORNERS, InFolder, abaqus_mesh, block

UNITS = ("--units", "mm,s,tonne")
STEEL = "*MATERIAL, NAME=Steel\n*DENSITY\n7.85e-9,\n*ELASTIC\n210000., 0.3\n"
SECTION = "*SOLID SECTION, ELSET=all, MATERIAL=Steel\n,\n"


def flat(material=STEEL, more="", counts=(4, 4, 4), lengths=(40, 40, 40)):
    X, solids, _ = block(counts, lengths)
    return "*HEADING\n" + abaqus_mesh(X, solids, "C3D8R") + SECTION + material + more


class Mesh(InFolder):
    def test_mass_is_exact(self):
        _, output, check = self.imported("cube.inp", flat(), *UNITS)
        self.assertIn("6.4e-05 m^3, 0.5024 kg", output)
        self.assertIn("mass 0.5024 kg", check)

    def test_every_kind_of_solid_has_its_volume(self):
        c = np.array(CORNERS, dtype=float)
        edges = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
        corners = c[[0, 1, 3, 4]]
        ten = np.vstack([corners, [corners[[a, b]].mean(axis=0) for a, b in edges]])
        for kind, nodes, volume in (("C3D4", corners, 1 / 6), ("C3D10M", ten, 1 / 6), ("C3D5", c[:5], 1 / 3),
                                    ("C3D6", c[[0, 1, 3, 4, 5, 7]], 1 / 2), ("C3D8I", c, 1)):
            text = abaqus_mesh(nodes, [range(len(nodes))], kind) + SECTION + STEEL
            Path("one.inp").write_text(text, encoding="ascii")
            output = self.run_import("one.inp", "--units", "m,s,tonne", "--out", "out", "--force")
            self.assertAlmostEqual(float(re.search(r"1 elements, (\S+) m\^3", output)[1]), volume, places=7, msg=kind)

    def test_instances_are_moved_and_turned(self):
        X, solids, _ = block((4, 2, 2), (4, 1, 1))
        part = "*PART, NAME=Rod\n" + abaqus_mesh(X, solids, "C3D8") + SECTION + "*END PART\n"
        text = (part + "*ASSEMBLY, NAME=A\n*INSTANCE, NAME=Rod-1, PART=Rod\n*END INSTANCE\n"
                "*INSTANCE, NAME=Rod-2, PART=Rod\n10., 0., 0.\n10., 0., 0., 10., 0., 1., 90.\n*END INSTANCE\n"
                "*NSET, NSET=root, INSTANCE=Rod-2\n1, 2, 3\n 4, 5, 6\n 7, 8, 9\n*END ASSEMBLY\n" + STEEL +
                "*BOUNDARY\nroot, ENCASTRE\n")
        case, _, check = self.imported("two.inp", text, *UNITS, "--spacing", "0.25mm")
        self.assertEqual([b["name"] for b in case["body"]], ["Rod_1", "Rod_2"])
        # Shifted by 10 along x, then turned by 90 degrees about z through (10, 0, 0): the rod goes along y from there.
        self.assertEqual(case["support"], [{"name": "hold_root", "body": "Rod_2", "patch": "root", "fix": "xyz"}])
        self.assertRegex(check, r'patch "root": 1e-06 m\^2 around \(0.0095, \S+, 0.0005\) m, normal \(\S+, -1, 0\)')

    def test_surfaces_by_faces_of_elements_are_patches(self):
        X, solids, _ = block((3, 3, 3), (3, 3, 3))
        areas = []
        for face in range(1, 7):
            more = f"*SURFACE, NAME=pushed, TYPE=ELEMENT\nall, S{face}\n"
            _, _, check = self.imported("cube.inp", abaqus_mesh(X, solids, "C3D8") + SECTION + STEEL + more, *UNITS)
            areas.append(re.search(r'patch "pushed": (\S+) m\^2 around .* normal \((.*)\)', check).groups())
        self.assertEqual([float(area) for area, _ in areas], [9e-6] * 6)
        normals = [tuple(round(float(v)) for v in normal.split(",")) for _, normal in areas]
        self.assertEqual(normals, [(0, 0, -1), (0, 0, 1), (0, -1, 0), (1, 0, 0), (0, 1, 0), (-1, 0, 0)])

    def test_plane_and_axisymmetric_elements(self):
        nodes = [(x, y, 0) for y in range(4) for x in range(4)]
        quads = [(4 * j + i, 4 * j + i + 1, 4 * j + i + 5, 4 * j + i + 4) for j in range(3) for i in range(3)]
        for kind, keys in (("CPE4R", {}), ("CPS4", {"assumption": "plane_stress"}), ("CAX4R", {})):
            held = "*NSET, NSET=base\n1, 2, 3, 4\n*BOUNDARY\nbase, 2, 2\n"
            text = abaqus_mesh(nodes, quads, kind) + SECTION + STEEL + held
            case, output, check = self.imported("plate.inp", text, *UNITS)
            self.assertIn("9e-06 m^2", output)
            self.assertEqual(case["body"][0]["formulation"], {"name": "nodal", **keys})
            law = "saint_venant_kirchhoff" if kind == "CPS4" else "elastic"
            self.assertEqual(case["body"][0]["material"]["law"], law)
            self.assertEqual(case.get("geometry"), "axisymmetric" if kind == "CAX4R" else None)
            self.assertIn("3 particles where base, held in y", check)
        mass = 7.85e3 * 3.141592653589793 * 3e-3**2 * 3e-3
        self.assertAlmostEqual(float(re.search(r"mass (\S+) kg", check)[1]) / mass, 1, places=3)

    def test_plate_with_a_hole_keeps_its_hole(self):
        nodes = [(x, y, 0) for y in range(6) for x in range(6)]
        quads = [(6 * j + i, 6 * j + i + 1, 6 * j + i + 7, 6 * j + i + 6) for j in range(5) for i in range(5)
                 if not (1 <= i <= 3 and j == 2)]
        case, _, check = self.imported("frame.inp", abaqus_mesh(nodes, quads, "CPE4") + SECTION + STEEL, *UNITS,
                                       "--spacing", "0.25mm")
        self.assertEqual(len(case["body"][0]["shape"]["extrude"]["holes"]), 1)
        self.assertIn("volume 2.2e-05 m^2", check)


class Materials(InFolder):
    """Converted by hand from mm, s, tonne: stresses in MPa, densities in tonne/mm^3."""

    def material(self, options, **wanted):
        text = flat(f"*MATERIAL, NAME=Steel\n{options}", counts=(3, 3, 3), lengths=(30, 30, 30))
        case, output, _ = self.imported("m.inp", text, *UNITS)
        self.check_material(case, wanted)
        return output

    def test_bilinear_plasticity(self):
        output = self.material("*DENSITY\n7.85e-9\n*ELASTIC\n210000, 0.3\n*PLASTIC\n300, 0\n400, 0.1\n500, 0.2\n",
                               law="isotropic_hardening", density=7850, youngs_modulus=210e9, poissons_ratio=0.3,
                               yield_stress=300e6, hardening_modulus=1e9)
        self.assertIn("Everything in the file was understood", output)
        output = self.material("*DENSITY\n7.85e-9\n*ELASTIC\n210000, 0.3\n*PLASTIC\n300, 0\n430, 0.1\n500, 0.2\n"
                               "*RATE DEPENDENT\n40, 5\n", law="tabulated_hardening", density=7850,
                               youngs_modulus=210e9, poissons_ratio=0.3, rate_dependence="cowper_symonds",
                               hardening_curve=[[0, 300e6], [0.1, 430e6], [0.2, 500e6]], cowper_symonds_c=40,
                               cowper_symonds_p=5)
        self.assertIn("Everything in the file was understood", output)

    def test_johnson_cook_with_damage_turns_the_sign_of_d3(self):
        self.material("*DENSITY\n7.83e-9\n*ELASTIC\n200000, 0.29\n*SPECIFIC HEAT\n477e6\n"
                      "*INELASTIC HEAT FRACTION\n0.8\n"
                      "*PLASTIC, HARDENING=JOHNSON COOK\n792, 510, 0.26, 1.03, 1793, 293\n"
                      "*RATE DEPENDENT, TYPE=JOHNSON COOK\n0.014, 1.0\n"
                      "*DAMAGE INITIATION, CRITERION=JOHNSON COOK\n0.05, 3.44, 2.12, 0.002, 0.61, 1793, 293, 1.0\n",
                      law="johnson_cook", density=7830, youngs_modulus=200e9, poissons_ratio=0.29, yield_stress=792e6,
                      hardening_coefficient=510e6, hardening_exponent=0.26, thermal_exponent=1.03,
                      melting_temperature=1793, reference_temperature=293, rate_coefficient=0.014, reference_rate=1.0,
                      specific_heat=477,
                      heat_fraction=0.8, damage="johnson_cook", d1=0.05, d2=3.44, d3=-2.12, d4=0.002, d5=0.61)

    def test_hyperelastic_constants_and_compressibility(self):
        # mu = 2 C10 = 1 MPa, K = 2 / D1 = 50 MPa: E = 9 K mu / (3 K + mu), nu = (3 K - 2 mu) / (2 (3 K + mu)).
        elastic = {"youngs_modulus": 9 * 50e6 * 1e6 / 151e6, "poissons_ratio": 148 / 302}
        rubber = "*DENSITY\n1.1e-9\n*HYPERELASTIC, "
        self.material(rubber + "NEO HOOKE\n0.5, 0.04\n", law="neo_hookean", density=1100, **elastic)
        self.material(rubber + "MOONEY-RIVLIN\n0.4, 0.1, 0.04\n", law="mooney_rivlin", density=1100, c10_fraction=0.8,
                      **elastic)
        output = self.material(rubber + "NEO HOOKE\n0.5, 0\n", law="neo_hookean", density=1100,
                               youngs_modulus=9 * 20e6 * 1e6 / 61e6, poissons_ratio=58 / 122)
        self.assertIn("20 shear moduli", output)

    def test_shock_equation_of_state_with_a_shear_modulus(self):
        bulk = 8930 * 3940**2
        self.material("*DENSITY\n8.93e-9\n*ELASTIC, TYPE=SHEAR\n47700\n*EOS, TYPE=USUP\n3.94e6, 1.489, 2.02\n"
                      "*PLASTIC\n120, 0\n",
                      law="perfectly_plastic", density=8930, youngs_modulus=9 * bulk * 47.7e9 / (3 * bulk + 47.7e9),
                      poissons_ratio=(3 * bulk - 95.4e9) / (2 * (3 * bulk + 47.7e9)), yield_stress=120e6,
                      eos="mie_grueneisen", bulk_sound_speed=3940, hugoniot_s1=1.489, grueneisen_gamma=2.02)


class Rest(InFolder):
    def test_conditions_and_what_is_left(self):
        more = ("*NSET, NSET=foot, GENERATE\n1, 25, 1\n*INITIAL CONDITIONS, TYPE=VELOCITY\nwhole, 3, -5000.\n"
                "*AMPLITUDE, NAME=ramp\n0, 0, 1, 1\n*STEP\n*DYNAMIC, EXPLICIT\n, 2e-4\n*BOUNDARY\nfoot, XSYMM\n"
                "foot, 3, 3, 1.5\n*DLOAD\n, GRAV, 9810., 0, 0, -1\n*END STEP\n")
        text = flat(more=more).replace("*NODE\n", "*NODE, NSET=Whole\n")
        case, output, _ = self.imported("cube.inp", text, *UNITS)
        self.assertEqual(case["body"][0]["initial_velocity"], [0.0, 0.0, -5.0])
        self.assertEqual(case["run"]["end"], 2e-4)
        self.assertEqual(case["support"][0] | {"name": ""}, {"name": "", "body": "all", "patch": "foot", "fix": "x"})
        self.assertEqual(case["load"], [{"body": "all", "acceleration": [0.0, 0.0, -9.81]}])
        self.assertRegex(output, r"AMPLITUDE +cube.inp:\d+: no counterpart")
        self.assertRegex(output, r"BOUNDARY +cube.inp:\d+: a prescribed motion that is not zero is left out")


if __name__ == "__main__":
    unittest.main()
