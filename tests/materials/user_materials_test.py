#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Material laws of users: the examples compile, pass `piola test-material`, run, resume; libraries that break the rules
are refused in one sentence, and laws that crash are named."""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

ROOT, PROGRAM = Path(os.environ["PIOLA_SOURCE_DIR"]), os.environ.get("PIOLA_PROGRAM", "")
EXAMPLES, HEADERS = ROOT / "examples/user-materials", ROOT / "src/piola/materials"
VOCE = {"density": 8930, "youngs_modulus": "117 GPa", "poissons_ratio": 0.35, "yield_stress": "400 MPa"}
LAW = """#include "piola_material.h"
#include <math.h>
#include <stdlib.h>
%(before)s
static const piola_parameter parameters[] = {{"stiffness", "Pa", "Young's modulus", 0, HUGE_VAL, NAN}};
static int update(const piola_points *at) {
  for (int p = 0; p < at->count; ++p) {
    for (int c = 0; c < 9; ++c)
      at->stress[c * at->stride + p] = at->parameters[0] * (at->F_new[c * at->stride + p] - (c %% 4 == 0));
    at->energy[p] = 0;
    %(inside)s
  }
  return 0;
}
static const piola_material law = {
  .interface_version = %(version)s, .name = "%(name)s", .about = "", .stress = %(stress)s,
  .properties = PIOLA_ELASTIC, .parameter_count = %(count)s, .parameters = parameters, .history_count = %(history)s,
  .update = update};
const piola_material *piola_materials(int version, int *count) { *count = 1; return &law; }
"""
WELL = {"before": "", "inside": "", "version": "PIOLA_MATERIAL_INTERFACE", "name": "mine",
        "stress": "PIOLA_FIRST_PIOLA", "count": "1", "history": "0"}


def run(*words, cwd):
    return subprocess.run([str(w) for w in words], cwd=cwd, capture_output=True, text=True, timeout=120)


def table(values):
    return ", ".join(f"{key} = {json.dumps(value)}" for key, value in values.items())


class UserMaterials(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)

    def compile(self, source, library, *more):
        command = ["cc", "-O2", "-Wall", "-Wextra", "-Werror", "-shared", "-fPIC", "-I", HEADERS, source, *more, "-o",
                   library, "-lm"]
        done = run(*command, cwd=self.folder)
        self.assertEqual(done.returncode, 0, done.stderr)

    def compile_vumat(self):
        run("gfortran", "-O2", "-c", "-fPIC", EXAMPLES / "linear_hardening_vumat.f", "-o", "vumat.o", cwd=self.folder)
        self.compile(EXAMPLES / "vumat.c", "vumat.so", "vumat.o", "-DVUMAT_PROPS=4", "-DVUMAT_STATES=1", "-lgfortran")

    def broken(self, **changes):
        (self.folder / "law.c").write_text(LAW % (WELL | changes))
        run("cc", "-shared", "-fPIC", "-I", HEADERS, "law.c", "-o", "law.so", "-lm", cwd=self.folder)
        return self.folder / "law.so"

    def case(self, material, end="20 us", more=""):
        file = self.folder / "case.toml"
        file.write_text(f"""title = "Own law"
[run]
end = "{end}"
threads = 2
[output.checkpoints]
every = "10 us"
[output.frames]
every = "10 us"
fields = ["Displacement", "CauchyStress"{more}]
[[body]]
name = "block"
shape = {{ box = {{ min = [0, 0, 0], max = [0.1, 0.1, 0.2] }}, particles = [4, 4, 8] }}
material = {{ {table(material)} }}
formulation = {{ name = "nodal" }}
initial_velocity = ["-1000*X", "0", "1000*Z"]
""")
        return file

    def piola(self, *words):
        return run(PROGRAM, *words, cwd=self.folder)

    def test_examples_pass_their_checks(self):
        self.compile(EXAMPLES / "neo_hookean.c", "neo_hookean.so")
        self.compile(EXAMPLES / "voce.c", "voce.so")
        laws = {"neo_hookean": ["density=1100 kg/m^3", "mu=6 MPa", "kappa=57 MPa"],
                "voce": [f"{key}={value}" for key, value in VOCE.items()] + ["saturation=2e8", "hardening_rate=10"]}
        if shutil.which("gfortran"):
            run("gfortran", "-O2", "-shared", "-fPIC", EXAMPLES / "piola_material.f90", EXAMPLES / "maxwell.f90", "-o",
                "maxwell.so", cwd=self.folder)
            self.compile_vumat()
            laws["maxwell"] = ["density=1100", "bulk_modulus=57 MPa", "shear_modulus=6 MPa", "decaying_modulus=6 MPa",
                               "relaxation_time=1 ms"]
            laws["vumat"] = ["density=8930", "prop1=117e9", "prop2=0.35", "prop3=400e6", "prop4=100e6"]
        for law, parameters in laws.items():
            done = self.piola("test-material", f"./{law}.so", *parameters)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_a_vumat_computes_what_piolas_own_law_does(self):
        if not shutil.which("gfortran"):
            self.skipTest("gfortran is not installed")
        self.compile_vumat()
        props = {"prop1": 117e9, "prop2": 0.35, "prop3": 400e6, "prop4": 100e6}
        ours = VOCE | {"law": "isotropic_hardening", "hardening_modulus": "100 MPa"}
        energies = []
        for folder, material in (("theirs", {"library": "vumat.so", "density": 8930} | props), ("ours", ours)):
            done = self.piola("run", self.case(material, end="60 us"), "-o", folder, "--quiet", "--no-pictures")
            self.assertEqual(done.returncode, 0, done.stderr)
            rows = [line.split(",") for line in (self.folder / folder / "history.csv").read_text().splitlines()
                    if not line.startswith("#")]
            energies.append(float(rows[-1][rows[0].index("kinetic_energy")]))
        self.assertAlmostEqual(energies[0] / energies[1], 1, delta=0.01)

    def test_runs_write_the_history_and_resume_with_equal_bits(self):
        import h5py
        self.compile(EXAMPLES / "voce.c", "voce.so")
        material = {"library": "voce.so"} | VOCE
        done = self.piola("run", self.case(material, more=', "plastic_strain"'), "-o", "whole", "--no-pictures")
        self.assertEqual(done.returncode, 0, done.stderr)
        frames = sorted((self.folder / "whole/frames").glob("*.hdf"))
        with h5py.File(frames[-1]) as file:
            strain = file["VTKHDF/PointData/plastic_strain"][:]
        self.assertGreater(strain.max(), 0.005)
        self.piola("run", self.case(material, end="10 us", more=', "plastic_strain"'), "-o", "part", "--no-pictures")
        (self.folder / "voce.so").unlink()  # the results folder has its own
        done = self.piola("resume", "part", "--set", "run.end=20 us")
        self.assertEqual(done.returncode, 0, done.stderr)
        bits = [json.loads((self.folder / name / "summary.json").read_text())["bits"] for name in ("whole", "part")]
        self.assertEqual(*bits)

    def refusal(self, library, *words, **parameters):
        done = self.piola("check", self.case({"library": str(library), "density": 1000} | parameters))
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_libraries_that_break_the_rules_are_refused(self):
        self.refusal("none.so", "none.so", "build the library")
        (self.folder / "text.so").write_text("not a library")
        self.refusal("text.so", "cannot load the library", "text.so")
        self.compile(EXAMPLES / "voce.c", "other.so", "-Dpiola_materials=other_name")
        self.refusal("other.so", "no function piola_materials()")
        for words, change in ((["interface_version 7"], {"version": "7"}), (["valid name"], {"name": "my law"}),
                              (["stress = 9"], {"stress": "9"}), (["parameter_count = 99"], {"count": "99"}),
                              (["PIOLA_ELASTIC", "history"], {"history": "2"})):
            self.refusal(self.broken(**change).rename(self.folder / f"{words[0].split()[0]}.so"), *words)
        good = self.broken().rename(self.folder / "good.so")
        self.refusal(good, "stiffness", "Young's modulus")
        self.refusal(good, "stiffness", stiffness=-1)
        self.refusal(good, "refuses its parameters", "shear modulus", stiffness=0)

    def test_errors_in_a_law_are_found_or_named(self):
        wrong = self.broken()
        done = self.piola("test-material", wrong, "density=1000", "stiffness=1e6")
        self.assertEqual(done.returncode, 3, done.stderr)
        for check in ("objective", "symmetric", "derivative"):
            self.assertRegex(done.stdout, f"FAIL.*{check}")
        crash = self.broken(inside="if (at->F_new[p] < 0.995) *(volatile double *)8 = 0;", name="hits").rename(
            self.folder / "crash.so")
        done = self.piola("run", self.case({"library": "crash.so", "density": 1000, "stiffness": 1e9}, end="1 ms"),
                          "--no-pictures")
        self.assertLess(done.returncode, 0)
        self.assertIn("the law hits crashed in its library", done.stderr)
        self.broken(inside="if (at->F_new[p] < 0.995) return 42;", name="stops").rename(self.folder / "fails.so")
        done = self.piola("run", self.case({"library": "fails.so", "density": 1000, "stiffness": 1e9}, end="1 ms"),
                          "-o", "failed", "--no-pictures")
        self.assertEqual(done.returncode, 3, done.stderr)
        self.assertIn("code 42", done.stderr)


if __name__ == "__main__":
    if not os.access(PROGRAM, os.X_OK):
        print("skipped: the program is not built")
        sys.exit(77)
    unittest.main()
