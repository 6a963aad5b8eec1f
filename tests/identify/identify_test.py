#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""`piola identify`: finds two constants of Johnson and Cook's law from a curve that their differential equation gives,
and says what is wrong with its input."""
import os
import shutil
import signal
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
y = "stress"
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

    def holds_the_truth(self, fit):
        done = self.identify(fit)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        result = tomllib.loads((self.folder / "fit/result.toml").read_text())
        for parameter, truth, spread in zip(result["parameter"], (90, 292), (5, 10)):
            self.assertLess(parameter["low"], truth)
            self.assertGreater(parameter["high"], truth)
            self.assertLess(parameter["high"] - parameter["low"], spread)

    def test_finds_the_truth_within_its_intervals(self):
        self.holds_the_truth(FIT)
        self.assertTrue((self.folder / "fit/tension_fitted/case.toml").is_file())
        self.assertEqual(len((self.folder / "fit/curves.csv").read_text().splitlines()), 31)
        self.assertIn("<svg", (self.folder / "fit/curves.svg").read_text())
        again = self.identify()
        self.assertEqual(again.returncode, 2)
        self.assertIn("--force", again.stderr)

    def test_units_signs_and_weights_change_nothing(self):
        rows = [[float(number) for number in line.split(",")]
                for line in (self.folder / "curve.csv").read_text().splitlines()[1:]]
        (self.folder / "curve.csv").write_text("\ufeffTrue strain [%],stress [kPa]\n# compression\n" + "".join(
            f"{-100 * strain},{1000 * stress}\n" for strain, stress in rows))
        self.holds_the_truth(FIT.replace('"strain"', '"True strain"').replace('"1000 * time"', '"-1000 * time"')
                             .replace('x = "True', 'error = 1e3\nx = "True'))

    def test_trials_that_fail_are_told_and_do_not_end_it(self):
        fit = FIT.replace("hardening_coefficient", "poissons_ratio").replace("least = 50\nmost = 1000\nunit = \"MPa\"",
                                                                            "least = 0.1\nmost = 0.9")
        done = self.identify(fit, "--jobs", "2", start=0.495)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        self.assertIn("poissons_ratio=0.50", done.stderr)
        self.assertIn("fails", (self.folder / "fit/log.txt").read_text())
        self.assertGreater(tomllib.loads((self.folder / "fit/result.toml").read_text())["failed_runs"], 0)

    def test_keeps_the_best_values_when_stopped(self):
        (self.folder / "fit.toml").write_text(FIT.format(evaluations=30, start=250, case="tension.toml",
                                                         column="cube.von_mises_stress"))
        run = subprocess.Popen([PROGRAM, "identify", "fit.toml"], cwd=self.folder, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True, start_new_session=True)
        run.stderr.readline()  # the first evaluation
        os.killpg(run.pid, signal.SIGINT)
        told = run.communicate(timeout=60)[1]
        self.assertEqual(run.returncode, 4, told)
        result = tomllib.loads((self.folder / "fit/result.toml").read_text())
        self.assertFalse(result["converged"])
        self.assertAlmostEqual(result["parameter"][0]["value"], 120, 3)

    def test_parameters_that_change_nothing_have_no_interval(self):
        done = self.identify(column="time")
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("do not tell the parameters apart", done.stdout)
        self.assertNotIn("low", tomllib.loads((self.folder / "fit/result.toml").read_text())["parameter"][0])

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
        self.refusal("of one value", column="log(time, time)")
        self.refusal("0 rows", "values at the start", column="log(-cube.von_mises_stress)")
        self.refusal("evaluations is 0", evaluations=0)
        (self.folder / "curve.csv").write_text("strain,stress [MPa]\n# measured\n0.1,abc\n")
        self.refusal("line 3", "abc")
        (self.folder / "curve.csv").write_text("strain,stress [MPaa]\n0.1,200\n0.2,300\n")
        self.refusal("'MPaa' is not a unit")
        (self.folder / "curve.csv").write_text("strain,stress [MPa]\n0.1,200\n0.2,300\n")
        self.refusal("2 measured points cannot tell 2 parameters")
        (self.folder / "curve.csv").write_text("strain,stress [MPa]\n0.1,200\n0.9,300\n0.95,310\n")
        self.refusal("covers x from", "let the run go on")
        done = self.identify(FIT.replace("least", "lest", 1))
        self.assertEqual(done.returncode, 2)
        self.assertIn("did you mean 'least'", done.stderr)
        self.assertIn("needs least", done.stderr)
        for before, after, told in (('"tension"', '"../x"', "as for a file"), ('x = "strain"', 'x = 3', "1.x is 3"),
                                    ('"B"', '"A"', "have the name"), ('"strain"', '"strain(1)"', "allowed")):
            done = self.identify(FIT.replace(before, after, 1))
            self.assertEqual((done.returncode, told in done.stderr), (2, True), done.stderr)
        self.assertIn("--jobs is -1", self.identify(FIT, "--jobs=-1").stderr)

    def test_a_key_that_the_case_has_not_is_its_error(self):
        done = self.identify(FIT.replace("yield_stress", "yield_stres"))
        self.assertEqual(done.returncode, 2)
        self.assertIn("yield_stres", done.stderr)


if __name__ == "__main__":
    if not os.access(PROGRAM, os.X_OK):
        print("skipped: the program is not built")
        sys.exit(77)
    unittest.main()
