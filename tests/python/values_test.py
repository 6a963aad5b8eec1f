#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Values of cases by key, saved cases, what notebooks show, names that do not exist.

Environment: PYTHONPATH finds piola.
"""
import contextlib
import io
import os
import re
import unittest
from pathlib import Path
from unittest import mock

import numpy as np

import piola
from small_column import InFolder, column


class Values(InFolder):
    def test_values_are_those_of_the_settings(self):
        case = column(**{"body.column.material.density": "2 g/cm^3"})
        self.assertEqual(case["body.column.material.density"], "2 g/cm^3")
        self.assertEqual(case["body.0.shape.box.max"], [1, 2, 1])
        self.assertEqual(case["support.ground.fix"], "xyz")
        for value in (0.1 + 0.2, 7, True, "3 ms", [1.5, "t", 0]):
            case["run.end"] = value
            self.assertEqual(case["run.end"], value)
            self.assertIs(type(case["run.end"]), type(value))
        self.assertEqual(piola.Case(case.to_dict()), case)
        case["body.column.material"]["density"] = 1  # a copy
        self.assertEqual(case["body.column.material.density"], "2 g/cm^3")

    def test_keys_that_do_not_exist(self):
        case = column()
        for key, what in (("run.ende", "'run.ende|did you mean 'end'"), ("bdy", "did you mean 'body'"),
                          ("run.thread", "did you mean 'threads'"), ("run.cfl", "does not give 'cfl'; its default is"),
                          ("body.colum.name", "did you mean 'column'"), ("body.1.name", "has 1 item"),
                          ("body.column.material.densty", "did you mean 'density'"),
                          ("body.column.formulation.variable", "did you mean 'variables'"),
                          ("output.frames.evry", "did you mean 'every'"), ("contact.lw", "did you mean 'law'"),
                          ("contact.law", "does not give 'contact'"), ("rigid.0.name", "does not give 'rigid'"),
                          ("run.end.unit", "single value '4 ms'"),
                          ("run.cfl.unit", "single value - shorten"), ("", "choose one of title"), ("run..end", "''")):
            with self.assertRaisesRegex(KeyError, what):
                case[key]
            self.assertNotIn(key, case)
        self.assertIn("run.end", case)
        for look in (lambda: case[0], lambda: list(case)):
            with self.assertRaises(TypeError):
                look()
        with self.assertRaisesRegex(piola.InputError, "no such case file"):
            piola.Case.read("nowhere.toml")["title"]

    def test_saved_cases(self):
        case = column(**{"title": 'a "quoted" title', "body.column.material.poissons_ratio": 1 / 3})
        case.save("saved.toml")
        self.assertEqual(piola.Case.read("saved.toml"), case)
        runs = piola.Run(case), piola.Run(piola.Case.read("saved.toml"))
        for run in runs:
            run.step(5)
        np.testing.assert_array_equal(runs[0].field("Velocity"), runs[1].field("Velocity"))
        case["run.end"] = 1
        self.assertNotEqual(piola.Case.read("saved.toml"), case)
        os.mkdir("folder")
        case.save("folder")
        self.assertEqual(piola.Case.read("folder"), case)
        text = "# kept\n" + Path("saved.toml").read_text()
        piola.Case(text).save("saved.toml")
        self.assertEqual(Path("saved.toml").read_text(), text)
        with self.assertRaisesRegex(piola.FileError, "nowhere/case.toml: cannot be written"):
            case.save("nowhere/case.toml")
        case.body["column"].initial_velocity = lambda X, t: X
        with self.assertWarnsRegex(piola.CaseWarning, "functions"):
            case.save("saved.toml")
        self.assertNotEqual(piola.Case.read("saved.toml"), case)

    def test_saved_cases_find_their_files(self):
        os.mkdir("a"), os.mkdir("b")
        Path("a/part.stl").write_text("solid")
        shape = {"mesh": {"file": "part.stl"}, "spacing": 0.1}
        Path("a/case.toml").write_text(piola.toml.document_text({"title": "t", "library": ["my.toml"], "body": [
            {"name": "part", "shape": shape, "material": {"library": "law.so"}}]}))
        case = piola.Case.read("a")
        case.save("a/other.toml")
        self.assertEqual(piola.Case.read("a/other.toml"), case)
        case.save("b")
        moved = piola.Case.read("b")
        self.assertTrue(os.path.samefile(moved["body.part.shape.mesh.file"], "a/part.stl"))
        self.assertEqual(moved["library"], [os.path.abspath("a/my.toml")])
        self.assertEqual(moved["body.part.material.library"], os.path.abspath("a/law.so"))


class Notebooks(InFolder):
    def test_descriptions(self):
        case = column(**{"title": "a < b", "quantity": [{"name": "peak", "column": "strain_energy", "take": "maximum",
                                                        "unit": "kJ"}]})
        self.assertRegex(repr(case), "'a < b': bodies column, particles not made yet .*, end 4 ms")
        case.check()
        self.assertIn("particles 54", repr(case))
        run = piola.Run(case, out="results")
        self.assertRegex(repr(run), r"'a < b': status running, time 0 s of 0.004 s, .*column \(54 particles\)")
        self.assertIn("status not finished", repr(piola.Results("results")))
        run.finish()
        results = piola.Results("results")
        for shown in (run, results):
            self.assertRegex(repr(shown), "status completed.*peak = [0-9.]+ kJ")
        self.assertRegex(repr(results), "bodies column, particles 54, time 0.004 s")
        for shown in (case, run, results):
            self.assertIn("a &lt; b", shown._repr_html_())
            self.assertIn("54</td>", shown._repr_html_())
        for wrong in ("[run\n", "title = 3\nbody = 'none'\nrun = 1\n", "body = [1, {}]\n"):
            self.assertIn("piola.Case", repr(piola.Case(wrong)))
            self.assertIn("<table>", piola.Case(wrong)._repr_html_())

    def test_progress(self):
        said, plain, shown = io.StringIO(), piola.Run(column()), piola.Run(column())
        with contextlib.redirect_stdout(said):
            shown.finish(progress=True)
        plain.finish()
        lines = re.split("[\r\n]+", said.getvalue().strip())
        self.assertRegex(lines[0], "^ *0 %, t = 0 s of 0.004 s, step 0, time left unknown yet$")
        self.assertRegex(lines[-1], "^100 %, t = 0.004 s of 0.004 s, step [0-9]+, took 0:00:0[0-9]")
        self.assertEqual(said.getvalue().count("\n"), 1)
        for name, values in plain.history.items():
            np.testing.assert_array_equal(values, shown.history[name], name)

    def test_time_left(self):
        from piola.progress import ProgressLine
        run, said = mock.Mock(time=1.0, end=5.0, steps=0), io.StringIO()
        with mock.patch("time.monotonic") as clock, contextlib.redirect_stdout(said):
            clock.return_value = 100.0
            line = ProgressLine(run)
            clock.return_value, run.time = 110.0, 2.0  # a quarter of what is to be done
            line(run)
            clock.return_value, run.time = 110.1, 3.0  # too soon for another
            line(run)
        self.assertEqual(said.getvalue(), "\r 40 %, t = 2 s of 5 s, step 0, 0:00:30 left")


class Frames(InFolder):
    def test_slices_of_frames(self):
        piola.Run(column(), out="results").finish()
        frames = piola.Results("results").frames
        paths = [frame.path for frame in frames]
        for part in (slice(2, 5), slice(None, None, -1), slice(-2, None), slice(9, 12)):
            self.assertEqual([frame.path for frame in frames[part]], paths[part])
            np.testing.assert_array_equal(frames[part].times, frames.times[part])
        self.assertEqual(frames[1:][-1].path, paths[-1])
        self.assertEqual(frames[np.int64(1)].path, paths[1])
        self.assertEqual(frames[2:5].at(0).path, paths[2])
        for number in (5, -6):
            with self.assertRaisesRegex(IndexError, "there are 5"):
                frames[number]
        with self.assertRaisesRegex(TypeError, "frames.at"):
            frames[1e-3]
        with self.assertRaisesRegex(TypeError, "no name of a field"):
            frames[0][0]

    def test_names_that_do_not_exist(self):
        quantity = {"name": "peak", "column": "strain_energy", "take": "maximum"}
        probe = {"name": "top", "kind": "extent", "body": "column", "axis": "y"}
        run = piola.Run(column(quantity=[quantity], probe=[probe]), out="results")
        run.finish()
        results = piola.Results("results")
        for look, near in ((lambda: results.history["topp"], "top"), (lambda: run.history["Time"], "time"),
                           (lambda: results.history["kinetic_enrgy"], "kinetic_energy"),
                           (lambda: results.quantities["peek"], "peak"),
                           (lambda: results.frames[0]["Presure"], "Pressure"),
                           (lambda: run.field("presure"), "Pressure")):
            with self.assertRaisesRegex(KeyError, f"did you mean '{near}"):
                look()

    def test_optional_packages(self):
        piola.Run(column(), out="results").finish()
        results = piola.Results("results")
        for name, look in (("pandas", results.to_pandas), ("xarray", results.to_xarray),
                           ("h5py", lambda: results.frames[0].fields)):
            with mock.patch.dict("sys.modules", {name: None}), self.assertRaisesRegex(ImportError, f"python3-{name}"):
                look()


if __name__ == "__main__":
    unittest.main(verbosity=1)
