#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Keyword files of LS-DYNA: masses, sets, conditions, materials by hand, and what is told of the rest.

Environment: PIOLA_PROGRAM.
"""
import csv
import re
import unittest
from pathlib import Path

import numpy as np

from decks import STEEL, InFolder, block, dyna_mesh, dyna_set, part_card

UNITS = ("--units", "mm,ms,kg")


def card(*numbers):
    return "".join("%10s" % ("" if n is None else n) for n in numbers) + "\n"


def deck(material=STEEL, more="", part=None, parts=None, counts=(8, 4, 4), lengths=(40, 20, 20)):
    X, solids, _ = block(counts, lengths)
    return "*KEYWORD\n" + dyna_mesh(X, solids, part) + (parts or part_card(1, "bar", 1)) + material + more + "*END\n"


class Mesh(InFolder):
    def test_mass_is_exact_and_elements_become_a_closed_surface(self):
        case, output, check = self.imported("bar.k", deck(), *UNITS)
        self.assertEqual([b["name"] for b in case["body"]], ["bar"])
        self.assertEqual(case["body"][0]["formulation"], {"name": "nodal"})
        self.assertAlmostEqual(case["body"][0]["shape"]["spacing"], 0.005)
        self.assertIn("1.6e-05 m^3, 0.1256 kg", output)
        self.assertIn("mass 0.1256 kg", check)

    def test_particles_of_elements_have_their_volumes_and_centroids(self):
        case, _, _ = self.imported("bar.k", deck(), *UNITS, "--particles", "elements")
        self.assertEqual(case["body"][0]["shape"], {"points": {"file": "bar.csv"}})
        with open("out/bar.csv", encoding="ascii", newline="") as file:
            rows = np.array([[float(v) for v in row] for row in list(csv.reader(file))[1:]])
        np.testing.assert_allclose(rows[:, 3], 1.25e-7, rtol=1e-12)
        np.testing.assert_allclose(rows.mean(axis=0)[:3], [0.02, 0.01, 0.01], rtol=1e-12)

    def test_old_new_comma_and_long_formats_are_the_same_mesh(self):
        X, solids, _ = block((2, 2, 2), (20, 20, 20))
        old = dyna_mesh(X, solids)
        head = old[:old.index("*ELEMENT")]
        lines = old[old.index("*ELEMENT"):].splitlines()[1:]
        one_line = head + "*ELEMENT_SOLID\n" + "\n".join(a + b for a, b in zip(lines[::2], lines[1::2])) + "\n"
        commas = re.sub(r" +", ",", old.replace("\n ", "\n")).replace("\n,", "\n")
        long = "\n".join(line if line[0] == "*" else "".join("%20s" % word for word in line.split())
                         for line in old.splitlines()) + "\n"
        tail = part_card(1, "cube", 1) + STEEL
        written = []
        for name, text in (("old", "*KEYWORD\n" + old), ("one", one_line), ("commas", commas),
                           ("long", long.replace("*NODE", "*NODE %").replace("SOLID", "SOLID %"))):
            self.imported(f"{name}.k", text + tail, *UNITS)
            written.append(Path("out/cube.obj").read_text(encoding="ascii"))
        self.assertEqual(written[1:], written[:1] * 3)

    def test_degenerate_solids_are_tetrahedra_wedges_and_pyramids(self):
        X = np.array([(0, 0, 0), (10, 0, 0), (10, 10, 0), (0, 10, 0), (0, 0, 10), (10, 0, 10)], dtype=float)
        for nodes, volume in (([0, 1, 3, 4, 4, 4, 4, 4], 1e-6 / 6), ([0, 1, 2, 3, 4, 4, 4, 4], 1e-6 / 3),
                              ([0, 1, 2, 3, 4, 5, 5, 4], 1e-6 / 2)):
            text = "*KEYWORD\n" + dyna_mesh(X, np.array([nodes])) + part_card(1, "one", 1) + STEEL
            Path("one.k").write_text(text, encoding="ascii")
            output = self.run_import("one.k", *UNITS, "--out", "out", "--force")
            found = float(re.search(r"1 elements, (\S+) m\^3", output)[1])
            self.assertAlmostEqual(found / volume, 1, places=7)

    def test_parts_that_share_nodes_are_one_body_others_are_bodies_in_contact(self):
        part = np.repeat([1, 2], 64)
        parts = part_card(1, "left", 1) + part_card(2, "right", 2)
        light = "*MAT_ELASTIC\n" + card(2, "2.7E-6", 70.0, 0.33)
        case, output, check = self.imported("two.k", deck(STEEL + light, "", part, parts), *UNITS)
        self.assertEqual(len(case["body"]), 1)
        self.assertEqual(case["body"][0]["part"][0]["where"], "right")
        self.assertIn("mass 0.0844 kg", check)
        case, _, check = self.imported("two.k", Path("two.k").read_text(encoding="ascii"), *UNITS, "--formulation",
                                       "adaptle")
        self.assertEqual(case["tie"], [{"between": ["left", "right"]}])
        self.assertIn('16 points of "left" and "right"', check)
        X, solids, _ = block((4, 4, 4), (20, 20, 20))
        text = "*KEYWORD\n" + dyna_mesh(np.vstack([X, X + [50, 0, 0]]), np.vstack([solids, solids + 125]), part)
        case, _, check = self.imported("apart.k", text + parts + STEEL + light, *UNITS)
        self.assertEqual([b["name"] for b in case["body"]], ["left", "right"])
        self.assertIn("contact of surfaces: left-right", check)
        self.refused("two.k", Path("two.k").read_text(encoding="ascii"), "left", "right", "different materials",
                     arguments=(*UNITS, "--particles", "elements"))

    def test_included_files_and_parameters_are_followed(self):
        Path("mesh.k").write_text("*KEYWORD\n" + dyna_mesh(*block((2, 2, 2), (20, 20, 20))[:2]) + "*END\n")
        text = ("*KEYWORD\n*PARAMETER\nR dens      7.85E-6\n*INCLUDE\nmesh.k\n" + part_card(1, "cube", 1) +
                "*MAT_ELASTIC\n" + card(1, "&dens", 200.0, 0.3))
        _, output, _ = self.imported("main.k", text, *UNITS)
        self.assertIn("8e-06 m^3, 0.0628 kg", output)


class Sets(InFolder):
    def test_sets_become_patches_and_regions_and_supports_hold_them(self):
        _, _, grid = block((8, 4, 4), (40, 20, 20))
        segments = "".join("%10d" % (n + 1) for n in (grid[8, 0, 0], grid[8, 1, 0], grid[8, 1, 1], grid[8, 0, 1]))
        more = (dyna_set("SET_NODE_LIST_TITLE\nclamped end", 3, (grid[0] + 1).ravel().tolist()) +
                "*BOUNDARY_SPC_SET\n" + card(3, 0, 1, 1, 0) + "*SET_SEGMENT\n" + card(9) + segments + "\n" +
                dyna_set("SET_SOLID", 4, list(range(65, 129))) + dyna_set("SET_NODE_LIST", 8, [int(grid[2, 0, 0]) + 1]))
        case, _, check = self.imported("bar.k", deck(more=more), *UNITS)
        self.assertEqual(case["support"],
                         [{"name": "hold_clamped_end", "body": "bar", "patch": "clamped_end", "fix": "xy"}])
        self.assertRegex(check, r'patch "clamped_end": 0.0004 m\^2 around \(0, 0.01, 0.01\)')
        self.assertRegex(check, r'patch "segments_9": 2.5e-05 m\^2 around \(0.04, 0.0025, 0.0025\)')
        self.assertRegex(check, r'region "solids_4": 64 particles')

    def test_conditions_of_particles_of_elements_hold_the_first_layer(self):
        _, _, grid = block((8, 4, 4), (40, 20, 20))
        end = dyna_set("SET_NODE_LIST", 3, (grid[0] + 1).ravel().tolist())
        more = end + "*BOUNDARY_SPC_SET\n" + card(3, 0, 1, 1, 1)
        _, _, check = self.imported("bar.k", deck(more=more), *UNITS, "--particles", "elements")
        self.assertIn('support of "bar": 16 particles', check)

    def test_velocity_wall_and_end(self):
        more = ("*INITIAL_VELOCITY_GENERATION\n" + card(1, 2, 0.0, -200.0, 0.0, 0.0) + "\n" +
                "*RIGIDWALL_PLANAR\n" + card(0) + card(-0.5, 0, 0, 9.5, 0, 0, 0) +
                "*CONTROL_TERMINATION\n" + card(0.05))
        case, _, check = self.imported("bar.k", deck(more=more), *UNITS)
        self.assertEqual(case["body"][0]["initial_velocity"], [-200.0, 0.0, 0.0])
        self.assertEqual(case["run"]["end"], 5e-5)
        self.assertEqual(case["rigid"][0]["plane"], {"point": [-0.0005, 0.0, 0.0], "normal": [1.0, 0.0, 0.0]})
        self.assertIn("initial speed up to 200 m/s", check)


class Materials(InFolder):
    """Numbers converted by hand from mm, ms, kg: stresses in GPa, densities in kg/mm^3, rates in 1/ms."""

    def material(self, text, number_of_eos=0, **wanted):
        parts = part_card(1, "bar", 1, number_of_eos)
        case, output, _ = self.imported("m.k", deck(text, parts=parts, counts=(3, 3, 3), lengths=(30, 30, 30)), *UNITS)
        self.check_material(case, wanted)
        return output

    def test_plastic_kinematic(self):
        text = "*MAT_PLASTIC_KINEMATIC\n" + card(1, "8.93E-6", 117, 0.35, 0.4, 0.1, 1.0) + card(None, None, 0.6)
        self.material(text, law="isotropic_hardening", density=8930, youngs_modulus=117e9, poissons_ratio=0.35,
                      yield_stress=400e6, hardening_modulus=117e9 * 0.1e9 / 116.9e9, damage="johnson_cook", d1=0.6)
        keys = {"density": 8930, "youngs_modulus": 117e9, "poissons_ratio": 0.35, "yield_stress": 400e6}
        text = "*MAT_003\n" + card(1, "8.93E-6", 117, 0.35, 0.4, 0, 0.0)
        # 0.04 per ms is 40 per s.
        self.material(text + card(0.04, 5), law="isotropic_hardening", hardening_modulus=0,
                      rate_dependence="cowper_symonds", cowper_symonds_c=40, cowper_symonds_p=5, **keys)
        output = self.material(text + card(0.04, 0.2), law="perfectly_plastic", **keys)
        self.assertIn("Cowper and Symonds", output)

    def test_isotropic_elastic_plastic(self):
        # G 80 GPa, K 160 GPa: E = 9 K G / (3 K + G) = 205.714 GPa, nu = (3 K - 2 G) / (2 (3 K + G)) = 2 / 7.
        self.material("*MAT_ISOTROPIC_ELASTIC_PLASTIC\n" + card(1, "7.85E-6", 80, 0.3, 1.5, 160),
                      law="isotropic_hardening", density=7850, youngs_modulus=9 * 160e9 * 80e9 / 560e9,
                      poissons_ratio=2 / 7, yield_stress=300e6,
                      hardening_modulus=1.5e9)

    def test_johnson_cook_with_grueneisen(self):
        # c0 = 3940 mm/ms, which is 3940 m/s; K = rho c0^2 = 139.0 GPa with the shear modulus of the card.
        bulk = 8960 * 3940**2
        text = ("*MAT_JOHNSON_COOK\n" + card(1, "8.96E-6", 46.0, 124, 0.34) +
                card(0.09, 0.292, 0.31, 0.025, 1.09, 1356, 294, "1.E-3") +
                card("383.", -1.2, 3.0, None, 0.54, 4.89, -3.03, 0.014) + card(1.12) +
                "*EOS_GRUNEISEN\n" + card(7, 3940, 1.489, 0, 0, 2.02, 0.47, 0.0) + card(1.0))
        self.material(text, 7, law="johnson_cook", density=8960, youngs_modulus=9 * bulk * 46e9 / (3 * bulk + 46e9),
                      poissons_ratio=(3 * bulk - 92e9) / (2 * (3 * bulk + 46e9)), yield_stress=90e6,
                      hardening_coefficient=292e6, hardening_exponent=0.31, rate_coefficient=0.025,
                      thermal_exponent=1.09, melting_temperature=1356, reference_temperature=294, reference_rate=1.0,
                      specific_heat=383,
                      damage="johnson_cook", d1=0.54, d2=4.89, d3=-3.03, d4=0.014, d5=1.12, spall_pressure=1.2e9,
                      spall="hydrostatic", eos="mie_grueneisen", bulk_sound_speed=3940, hugoniot_s1=1.489,
                      grueneisen_gamma=2.02, grueneisen_slope=0.47)

    def test_simplified_johnson_cook_and_polynomial(self):
        self.material("*MAT_SIMPLIFIED_JOHNSON_COOK\n" + card(1, "7.85E-6", 200, 0.3) +
                      card(0.35, 0.275, 0.36, 0.022, 1e17, 1e28, 1e28, 0.001),
                      law="johnson_cook", density=7850, youngs_modulus=200e9, poissons_ratio=0.3, yield_stress=350e6,
                      hardening_coefficient=275e6, hardening_exponent=0.36, rate_coefficient=0.022, reference_rate=1.0,
                      melting_temperature=2000)
        self.material("*MAT_ELASTIC_PLASTIC_HYDRO\n" + card(1, "2.7E-6", 27.0, 0.3, 0.1, -1.0) +
                      "*EOS_LINEAR_POLYNOMIAL\n" + card(3, 0, 74.2, 60.5, 36.5, 1.96, 0, 0) + card(0, 1), 3,
                      law="isotropic_hardening", density=2700,
                      youngs_modulus=9 * 74.2e9 * 27e9 / (3 * 74.2e9 + 27e9),
                      poissons_ratio=(3 * 74.2 - 54) / (2 * (3 * 74.2 + 27)), yield_stress=300e6,
                      hardening_modulus=100e6, spall_pressure=1e9, eos="polynomial", c1=74.2e9,
                      c2=60.5e9, c3=36.5e9, c4=1.96)

    def test_rubber_has_twice_the_sum_of_its_constants_as_shear_modulus(self):
        output = self.material("*MAT_MOONEY-RIVLIN_RUBBER\n" + card(1, "1.1E-6", 0.49, "4.0E-4", "1.0E-4"),
                               law="mooney_rivlin", density=1100, youngs_modulus=2 * 1e6 * 1.49, poissons_ratio=0.49,
                               c10_fraction=0.8)
        self.assertIn("second invariant", output)
        self.material("*MAT_027\n" + card(1, "1.1E-6", 0.49, "5.0E-4", 0), law="neo_hookean", density=1100,
                      youngs_modulus=2 * 1e6 * 1.49, poissons_ratio=0.49)

    def test_table_that_is_a_line_and_one_that_is_not(self):
        line = "*MAT_PIECEWISE_LINEAR_PLASTICITY\n" + card(1, "7.85E-6", 200, 0.3, 0, 0, 1e21) + card(0, 0, 0, 0)
        keys = {"law": "isotropic_hardening", "density": 7850, "youngs_modulus": 200e9, "poissons_ratio": 0.3,
                "yield_stress": 300e6, "hardening_modulus": 1e9}
        self.material(line + card(0, 0.1, 0.2) + card(0.3, 0.4, 0.5), **keys)
        table = {key: keys[key] for key in ("density", "youngs_modulus", "poissons_ratio")}
        self.material(line + card(0, 0.1, 0.2) + card(0.3, 0.45, 0.5), law="tabulated_hardening",
                      hardening_curve=[[0, 300e6], [0.1, 450e6], [0.2, 500e6]], **table)
        output = self.material(line + card(0, 0.1, 0.2) + card(0.3, 0.45, 0.4), law="tabulated_hardening",
                               hardening_curve=[[0, 300e6], [0.1, 450e6], [0.2, 450e6]], **table)
        self.assertIn("falls with strain", output)

    def test_curve_and_rate_of_a_card(self):
        text = ("*MAT_024\n" + card(1, "7.85E-6", 200, 0.3, 0.2, 0, 1e21) + card(0.04, 5, 9, 0) + card(0) + card(0) +
                "*DEFINE_CURVE_TITLE\nhardening\n" + card(9, 0, 0.01, 2.0) +
                "".join("%20s%20s\n" % row for row in (("0", "0.15"), ("5", "0.2"), ("20", "0.22"))))
        keys = {"density": 7850, "youngs_modulus": 200e9, "poissons_ratio": 0.3, "rate_dependence": "cowper_symonds",
                "cowper_symonds_c": 40, "cowper_symonds_p": 5}
        output = self.material(text, law="tabulated_hardening", **keys,
                               hardening_curve=[[0, 300e6], [0.05, 400e6], [0.2, 440e6]])
        self.assertIn("Everything in the file was understood", output)
        output = self.material(text.replace(card(9, 0, 0.01, 2.0), card(8)), law="isotropic_hardening",
                               yield_stress=200e6, hardening_modulus=0, **keys)
        self.assertIn("LCSS = 9", output)
        self.assertIn("DEFINE_CURVE", output)

    def test_curve_of_many_rows_keeps_those_where_it_bends(self):
        strains = [0.005 * k for k in range(81)]
        rows = "".join("%20.8g%20.8g\n" % (x, 0.3 + 0.2 * (1 - 2.718281828 ** (-10 * x))) for x in strains)
        text = ("*MAT_024\n" + card(1, "7.85E-6", 200, 0.3, 0.2, 0, 1e21) + card(0, 0, 9, 0) + "*DEFINE_CURVE\n" +
                card(9) + rows)
        case, output, _ = self.imported("m.k", deck(text), *UNITS)
        curve = np.array(case["body"][0]["material"]["hardening_curve"])
        self.assertEqual(curve.shape, (32, 2))
        exact = 300e6 + 200e6 * (1 - np.exp(-10 * np.array(strains)))
        self.assertLess(abs(np.interp(strains, *curve.T) - exact).max(), 1e6)
        self.assertRegex(output, r"81 rows: 32 of them are up to 0\.\d+ MPa off")

    def test_table_of_a_card_with_an_equation_of_state(self):
        text = ("*MAT_ELASTIC_PLASTIC_HYDRO\n" + card(1, "2.7E-6", 27.0, 0, 0) + card(0, 0.1, 0.2) + "\n" +
                card(0.3, 0.4, 0.5) + "\n*EOS_LINEAR_POLYNOMIAL\n" + card(3, 0, 74.2) + card(0, 1))
        self.material(text.replace("\n\n", "\n" + card(0) ), 3, law="isotropic_hardening", density=2700,
                      youngs_modulus=9 * 74.2e9 * 27e9 / (3 * 74.2e9 + 27e9),
                      poissons_ratio=(3 * 74.2 - 54) / (2 * (3 * 74.2 + 27)), yield_stress=300e6, hardening_modulus=1e9,
                      eos="polynomial", c1=74.2e9)

    def test_unknown_card_leaves_a_placeholder(self):
        case, output, _ = self.imported("m.k", deck("*MAT_SOIL_AND_FOAM\n" + card(1, "2E-6", 1, 1)), *UNITS)
        self.assertEqual(case["body"][0]["material"], {"name": "steel_4340"})
        self.assertRegex(output, r"MAT_SOIL_AND_FOAM +m.k:\d+: no law of Piola")
        case, _, _ = self.imported("m.k", deck("*MAT_SOIL_AND_FOAM\n" + card(1, "2E-6", 1, 1)), *UNITS, "--material",
                                   "copper_ofhc")
        self.assertEqual(case["body"][0]["material"], {"name": "copper_ofhc"})


class Rest(InFolder):
    def test_everything_else_is_listed_with_line_and_count(self):
        more = "*DEFINE_CURVE\n" + card(1) + "*DEFINE_CURVE\n" + card(2) + "*HOURGLASS\n" + card(1)
        _, output, _ = self.imported("bar.k", deck(more=more), *UNITS)
        self.assertRegex(output, r"DEFINE_CURVE +bar.k:\d+, 2 times: no counterpart")
        self.assertRegex(output, r"HOURGLASS +bar.k:\d+: not needed")

    def test_shells_are_left_out_with_a_sentence(self):
        shells = "*ELEMENT_SHELL\n" + "%8d%8d%8d%8d%8d%8d\n" % (900, 1, 1, 2, 3, 4)
        _, output, _ = self.imported("bar.k", deck(more=shells), *UNITS)
        self.assertIn("1 shells are left out: Piola has no shells", output)
        self.refused("shells.k", "*KEYWORD\n*NODE\n" + shells, "no solid elements", "ELEMENT_SHELL")


if __name__ == "__main__":
    unittest.main()
