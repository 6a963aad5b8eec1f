#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`piola identify`: finds two constants of Johnson and Cook's law from a curve that their differential equation gives,
and says what is wrong with its input."""
import os
import shutil
import subprocess
import sys
import tempfile
import tomllib
import unittest
from pathlib import Path

ROOT, PROGRAM = Path(os.environ["PIOLA_SOURCE_DIR"]), os.environ.get("PIOLA_PROGRAM", "")
sys.path.insert(0, str(Path(__file__).parent))
FIT = """evaluations = {evaluations}
[[parameter]]
key = "body.cube.material.yield_stress"
name = "A"
start = 120
least = 20
most = 400
unit = "MPa"
scale = "log"
[[parameter]]
key = "body.cube.material.hardening_coefficient"
name = "B"
start = {start}
least = 50
most = 1000
unit = "MPa"
[[curve]]
name = "tension"
case = "{case}"
file = "curve.csv"
x = "strain"
y = "stress * 1e6"
run_x = "1000 * time"
run_y = "{column}"
"""


@unittest.skipIf(subprocess.run(["/usr/bin/python3", "-c", "import scipy"], capture_output=True).returncode,
                 "scipy is not installed")
class Identify(unittest.TestCase):
    def setUp(self):
        import numpy
        import johnson_cook_point
        self.folder = Path(tempfile.mkdtemp())
        self.addCleanup(shutil.rmtree, self.folder)
        shutil.copy(ROOT / "examples/identify/tension.toml", self.folder)
        johnson_cook_point.write_curve(self.folder / "curve.csv", 1000, 1e6, numpy.random.default_rng(3))

    def identify(self, text=None, *words, **changes):
        values = {"evaluations": 30, "start": 250, "case": "tension.toml", "column": "cube.von_mises_stress"} | changes
        (self.folder / "fit.toml").write_text((text or FIT).format(**values))
        return subprocess.run([PROGRAM, "identify", "fit.toml", *words], cwd=self.folder, capture_output=True,
                              text=True, timeout=240)

    def test_the_case_has_the_stress_of_the_law(self):
        import numpy
        import johnson_cook_point
        subprocess.run([PROGRAM, "run", "tension.toml", "--out", "run", "--quiet"], cwd=self.folder, check=True)
        text = (self.folder / "run/history.csv").read_text()
        lines = [line for line in text.splitlines() if not line.startswith("#")]
        names = lines[0].split(",")
        rows = numpy.array([[float(row.split(",")[names.index(name)]) for name in ("time", "cube.von_mises_stress")]
                            for row in lines[1:]])
        strains, stresses = johnson_cook_point.tension(johnson_cook_point.COPPER, 1000)
        law = numpy.interp(1000 * rows[:, 0], strains, stresses)
        late = rows[:, 0] > 1e-5
        self.assertGreater(late.sum(), 90)
        self.assertLess(abs(rows[late, 1] / law[late] - 1).max(), 3e-4)

    def test_finds_the_truth_within_its_intervals(self):
        done = self.identify()
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = tomllib.loads((self.folder / "fit/result.toml").read_text())
        for parameter, truth, spread in zip(result["parameter"], (90, 292), (5, 10)):
            self.assertLess(parameter["low"], truth)
            self.assertGreater(parameter["high"], truth)
            self.assertLess(parameter["high"] - parameter["low"], spread)
        self.assertTrue((self.folder / "fit/tension_fitted/case.toml").is_file())
        self.assertEqual(len((self.folder / "fit/tension.csv").read_text().splitlines()), 31)
        again = self.identify()
        self.assertEqual(again.returncode, 2)
        self.assertIn("--force", again.stderr)

    def refusal(self, *words, **changes):
        done = self.identify(None, "--out", "other", **changes)
        self.assertEqual(done.returncode, 2, done.stdout + done.stderr)
        self.assertNotIn("Traceback", done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)

    def test_says_what_is_wrong(self):
        self.refusal("no file", "none.toml", "start = 5", case="none.toml", start=5)
        self.refusal("no column", "cube.von_mises_stress", column="cube.stress")
        self.refusal("allowed: columns", column="open('x')")
        (self.folder / "curve.csv").write_text("strain,stress [MPa]\n0.1,abc\n")
        self.refusal("row 2", "abc")
        (self.folder / "curve.csv").write_text("strain,stress [MPa]\n0.1,200\n0.9,300\n0.95,310\n")
        self.refusal("covers x from", "let the run go on")
        done = self.identify(FIT.replace("least", "lest", 1))
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'least'", done.stderr)
        self.assertIn("needs least", done.stderr)

    def test_a_key_that_the_case_has_not_is_its_error(self):
        done = self.identify(FIT.replace("yield_stress", "yield_stres"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("yield_stres", done.stderr)


if __name__ == "__main__":
    if not os.access(PROGRAM, os.X_OK):
        print("skipped: the program is not built")
        sys.exit(77)
    unittest.main()
