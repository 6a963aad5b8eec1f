#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The module piola, used as a script would.

Environment: PYTHONPATH finds piola; PIOLA_PROGRAM and PIOLA_SOURCE_DIR.
"""
import ast
import contextlib
import gc
import importlib.util
import inspect
import io
import os
import re
import resource
import signal
import subprocess
import threading
import unittest
import warnings
from pathlib import Path

import numpy as np

import piola
from small_column import InFolder, column

SOURCE = Path(os.environ["PIOLA_SOURCE_DIR"])
PROGRAM = os.environ["PIOLA_PROGRAM"]


class Runs(InFolder):
    def test_parts_are_the_program_bit_for_bit(self):
        run = piola.Run(column(), out="parts")
        run.step(7)
        run.advance("1.5 ms")
        self.assertGreaterEqual(run.time, 1.5e-3)
        self.assertEqual(run.finish()["status"], "completed")
        subprocess.run([PROGRAM, "run", "parts/case.toml", "--out", "whole", "--quiet"], check=True)
        self.assertEqual(Path("parts/history.csv").read_bytes(), Path("whole/history.csv").read_bytes())
        frames = [piola.Results(name).frames[-1] for name in ("parts", "whole")]
        for field in frames[0].fields:
            np.testing.assert_array_equal(frames[0][field], frames[1][field])

    def test_observers_change_nothing(self):
        plain, watched = piola.Run(column()), piola.Run(column())
        watched.observe(lambda run: run.field("Pressure"))
        plain.finish(), watched.finish()
        for name, values in plain.history.items():
            np.testing.assert_array_equal(values, watched.history[name], name)

    def test_without_a_folder_nothing_is_written(self):
        run = piola.Run(column())
        run.finish()
        self.assertEqual(os.listdir("."), [])
        self.assertEqual(len(run.history["time"]), 41)
        self.assertEqual(run.history_units["total_energy"], "J")

    def test_exactly(self):
        run = piola.Run(column())
        self.assertFalse(run.advance(1e-3, exact=True))
        self.assertEqual(run.time, 1e-3)
        self.assertTrue(run.advance(1))
        self.assertEqual(run.time, 4e-3)
        self.assertTrue(run.step())

    def test_views_are_read_only_and_outlive_the_run(self):
        run = piola.Run(column())
        X, volume = run.X, run.volume
        with self.assertRaises(ValueError):
            X[0, 0] = 1
        copy, total = X.copy(), volume.sum()
        del run
        gc.collect()
        np.testing.assert_array_equal(X, copy)
        self.assertAlmostEqual(total, 2, delta=1e-12)

    def test_fields(self):
        run = piola.Run(column(**{"body.column.formulation": {"name": "jst_sph"}}))
        run.advance("1 ms")
        self.assertEqual(run.fields["CauchyStress"], ("Pa", 6))
        stress, velocity = run.field("CauchyStress"), np.empty((len(run.X), 3))
        self.assertEqual(stress.shape, (len(run.X), 6))
        self.assertIs(run.field("Velocity", out=velocity), velocity)
        np.testing.assert_allclose(run.field("Position"), run.X + run.field("Displacement"), rtol=0, atol=1e-15)
        momentum = (1000 * run.volume[:, None] * velocity).sum(0)
        np.testing.assert_allclose(momentum, run.momentum, rtol=1e-10, atol=1e-9)
        with self.assertRaisesRegex(KeyError, "no field 'Presure' - did you mean 'Pressure'"):
            run.field("Presure")
        with self.assertRaisesRegex(ValueError, r"\(54, 3\)"):
            run.field("Velocity", out=np.empty((3, 3)))
        with self.assertRaises(TypeError):
            run.field("Velocity", out=np.empty((54, 3), dtype=np.float32))

    def test_observer_stops_and_goes_on(self):
        run, seen = piola.Run(column()), []

        @run.observe(every="1 ms")
        def see(run):
            seen.append(run.time)
            return piola.STOP if len(seen) == 2 else None

        self.assertFalse(run.advance(1))
        self.assertLess(run.time, 1.1e-3)
        self.assertTrue(run.advance(1))
        self.assertEqual(len(seen), 5)

    def test_observer_raises(self):
        run = piola.Run(column(), out="results")

        @run.observe(every="1 ms")
        def see(run):
            if run.time > 2e-3:
                raise ZeroDivisionError("as planned")

        with self.assertRaisesRegex(ZeroDivisionError, "as planned"):
            run.finish()
        self.assertLess(run.time, 2.2e-3)
        self.assertEqual(run.close()["status"], "stopped")
        again = piola.Run.resume("results")
        self.assertEqual(again.finish()["status"], "completed")
        plain = piola.Run(column())
        plain.finish()
        np.testing.assert_array_equal(piola.Results("results").history["kinetic_energy"],
                                      plain.history["kinetic_energy"])

    def test_interrupt(self):
        warnings.simplefilter("ignore")  # by then most of the energy is gone
        run = piola.Run(column(**{"run.end": "100 s"}))
        threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with self.assertRaises(KeyboardInterrupt):
            run.finish()
        self.assertGreater(run.steps, 0)

    def test_state(self):
        run = piola.Run(column())
        run.step(20)
        state = run.state()
        run.step(20)
        later = run.field("Velocity")
        other = piola.Run(column())
        other.load(state)
        self.assertEqual(other.steps, 20)
        other.step(20)
        np.testing.assert_array_equal(other.field("Velocity"), later)
        with self.assertRaisesRegex(ValueError, "out=None"):
            piola.Run(column(), out="results").load(state)
        with self.assertRaises(piola.FileError):
            other.load({"run": state["run"]})

    def test_failure(self):
        run = piola.Run(column(**{"run.min_step": "1 s"}), out="results")
        with self.assertRaisesRegex(piola.PhysicsError, "time step collapsed"):
            run.finish()
        self.assertEqual(run.close()["status"], "failed")
        with self.assertRaisesRegex(ValueError, "finished"):
            run.step()

    def test_no_leak(self):
        def grow(times):
            case = column(**{"run.threads": 1})
            case._case()
            for _ in range(times):
                piola.Run(case).step(1)
            gc.collect()
            return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        first = grow(100)
        self.assertLess(grow(1000) - first, 1024)  # kB


class Cases(InFolder):
    def test_all_problems(self):
        case = piola.Case("[run]\nend = 'soon'\n[[body]]\nname = 'a'\ncolour = 3\n")
        with self.assertRaises(piola.InputError) as caught:
            case.check()
        lines = [problem.line for problem in caught.exception.problems]
        self.assertIn(2, lines)
        self.assertIn(5, lines)
        with self.assertRaisesRegex(piola.InputError, "no such case file"):
            piola.Case.read("nowhere.toml").check()
        for bad in (float("nan"), object(), {"a": {1}}):
            with self.assertRaises((ValueError, TypeError)):
                column()["run.end"] = bad

    def test_dicts_are_case_files(self):
        Path("case.toml").write_text((SOURCE / "cases/nodal/cantilever/case.toml").read_text())
        import tomllib
        as_dict = tomllib.loads(Path("case.toml").read_text())
        a, b = piola.Run(piola.Case.read("case.toml")), piola.Run(piola.Case(as_dict))
        a.step(3), b.step(3)
        np.testing.assert_array_equal(a.field("Velocity"), b.field("Velocity"))

    def test_tables_are_arrays(self):
        t = np.linspace(0, 0.01, 11)
        pull = {"body.column.initial_velocity": [0, 0, 0], "support.ground.velocity": [0, "-30*t", 0]}
        by_formula = piola.Run(column(**pull))
        pull["support.ground.velocity"] = [0, {"table": np.column_stack([t, -30 * t]), "after": "error"}, 0]
        by_table = piola.Run(column(**pull))
        by_formula.step(5), by_table.step(5)
        np.testing.assert_allclose(by_table.field("Velocity"), by_formula.field("Velocity"), rtol=1e-9, atol=1e-12)
        self.assertGreater(np.abs(by_table.field("Velocity")).max(), 0)

    def test_warnings(self):
        odd = {"body.column.material.youngs_modulus": 10}
        self.assertTrue(column(**odd).check())
        with self.assertWarns(piola.CaseWarning):
            piola.Run(column(**odd))
        self.assertEqual(column().check(), [])

    def test_initial_functions(self):
        by_formula, by_function = column(), column(**{"body.column.initial_velocity": [0, 0, 0]})
        asked = []

        def velocity(X, t):
            asked.append((X.shape, t))
            return np.stack([3 * X[:, 1], 0 * X[:, 0], 0 * X[:, 0]], axis=1)

        by_function.body["column"].initial_velocity = velocity
        runs = [piola.Run(by_formula, out="formula"), piola.Run(by_function, out="function")]
        for run in runs:
            run.finish()
        self.assertEqual(asked, [((54, 3), 0.0)])
        self.assertEqual(Path("formula/history.csv").read_bytes(), Path("function/history.csv").read_bytes())

    def test_initial_arrays(self):
        case = column(**{"body.column.initial_velocity": [0, 0, 0]})
        case.body["column"].initial_displacement = 1e-3 * case.X
        self.assertAlmostEqual(float(np.median(piola.Run(case).field("Jacobian"))), 1.001 ** 3, delta=1e-9)
        for wrong in (np.zeros((3, 3)), np.full((54, 3), np.nan)):
            case.body["column"].initial_displacement = wrong
            with self.assertRaisesRegex(piola.InputError, "initial_displacement of body 'column'"):
                piola.Run(case)
        case.body["colum"].initial_velocity = wrong
        with self.assertRaisesRegex(piola.InputError, "no body 'colum'.*did you mean 'column'"):
            piola.Run(case)

    def test_attributes_that_do_not_exist_are_refused(self):
        case = column()
        for thing, name, near in ((case.body["column"], "initial_velocty", "initial_velocity"),
                                  (case.body["column"], "velocity", "initial_velocity"),
                                  (case.body["column"], "Initial_Displacement", "initial_displacement"),
                                  (case.support[0], "velocty", "velocity"),
                                  (case, "bodies_", "body"), (case, "suport", "support"),
                                  (case.body, "column", "")):
            with self.assertRaisesRegex(AttributeError, f"no attribute '{name}'.*{near}"):
                setattr(thing, name, 1)
        for thing, name in ((case, "title"), (case, "X")):
            with self.assertRaisesRegex(AttributeError, f"'{name}' of Case cannot be set"):
                setattr(thing, name, 1)
        with self.assertRaisesRegex(TypeError, r"set case.body\['column'\].initial_velocity = ..."):
            case.body["column"] = {"initial_velocity": 1}
        self.assertIsNone(case.body["column"].initial_velocity)
        copy = case.copy()
        with self.assertRaises(AttributeError):
            copy.body["column"].initial_velocty = 1

    def test_runs_and_results_take_no_attributes(self):
        run = piola.Run(column(), out="results")
        run.finish()
        results = piola.Results("results")
        for thing, name in ((run, "ende"), (run, "end"), (results, "foldr"), (results.frames, "time"),
                            (results.frames[0], "field")):
            with self.assertRaises(AttributeError, msg=name):
                setattr(thing, name, 1)
        with self.assertRaisesRegex(KeyError, "did you mean 'Velocity'"):
            results.frames[0]["velocity"]

    def test_support_functions(self):
        for formulation in ("jst_sph", "nodal", "adaptle"):
            settings = {"body.column.formulation": {"name": formulation}, "body.column.initial_velocity": [0, 0, 0]}
            if formulation == "adaptle":
                settings["body.column.material.law"] = "elastic"
            by_formula = column(**settings, **{"support.0.velocity": ["sin(1000 * t) * X", "t", 0]})
            by_function = column(**settings)
            times = []

            def velocity(X, t):
                times.append(t)
                return np.stack([np.sin(1000 * t) * X[:, 0], np.full(len(X), t), 0 * X[:, 0]], axis=1)

            by_function.support["ground"].velocity = velocity
            a, b = piola.Run(by_formula), piola.Run(by_function)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                a.finish(), b.finish()
            self.assertEqual(len(times), len(set(times)), formulation)
            np.testing.assert_allclose(a.field("Velocity"), b.field("Velocity"), rtol=0, atol=1e-9, err_msg=formulation)
            self.assertGreater(np.abs(a.field("Velocity")).max(), 0.1)

    def test_support_functions_that_fail(self):
        for wrong, error in ((lambda X, t: 1 / 0, ZeroDivisionError), (lambda X, t: X[:2], ValueError),
                             (lambda X, t: X * np.nan, ValueError)):
            case = column()
            case.support[0].velocity = wrong
            with self.assertRaises(error):
                piola.Run(case).finish()

    def test_a_key_counts_as_given_wherever_it_comes_from(self):
        def squares(contact=None, **settings):
            def square(name, x):
                return {"name": name, "formulation": {"name": "jst_sph"},
                        "shape": {"box": {"min": [x, 0], "max": [x + 1, 1]}, "particles": [6, 6]},
                        "material": {"law": "neo_hookean", "density": 1000, "youngs_modulus": 1e7,
                                     "poissons_ratio": 0.3}}
            case = {"title": "two", "run": {"end": 1}, "body": [square("a", 0), square("b", 3)]}
            return piola.Case({**case, **({"contact": contact} if contact else {})}, set=settings)

        def idle(case):
            return [text for text in case.check() if "contact.law has no effect" in text]

        self.assertEqual(len(idle(squares({"law": "linear"}))), 1)
        self.assertEqual(len(idle(squares(**{"contact.law": "linear"}))), 1)
        self.assertEqual(len(idle(squares(**{"contact": {"law": "linear"}}))), 1)
        self.assertEqual(len(idle(squares({"scale": 2}, **{"contact.law": "linear"}))), 1)
        changed = squares({"scale": 2})
        self.assertEqual(idle(changed), [])
        changed["contact.law"] = "linear"
        self.assertEqual(len(idle(changed)), 1)


class Folders(InFolder):
    def test_results(self):
        with piola.Run(column(), out="results") as run:
            run.finish()
            last = run.field("Pressure")
        results = piola.Results("results")
        self.assertEqual(len(results.frames), 5)
        np.testing.assert_allclose(results.frames.times, [0, 1e-3, 2e-3, 3e-3, 4e-3], atol=1e-4)
        np.testing.assert_allclose(results.frames[-1]["Pressure"], last, rtol=1e-5, atol=1)
        self.assertEqual(results.frames.at(2e-3).path, results.frames[2].path)
        self.assertEqual(set(results.history), set(run.history))
        self.assertEqual(results.summary["status"], "completed")
        with self.assertRaisesRegex(KeyError, "no field"):
            results.frames[0]["Nothing"]
        with self.assertRaises(piola.FileError):
            piola.Results("elsewhere")

    def test_names_of_the_previous_release(self):
        import h5py
        case = column(**{"run.machine": "scalar", "body.column.formulation": {"name": "nodal"}})
        self.assertIn('"machine" is now "instruction_set"', case.check()[0])
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with piola.Run(case, out="results") as run:
                run.finish()
        least, field = run.history["cell_jacobian_min"], run.field("CellJacobianMin")
        for look in (lambda: run.history["least_jacobian"], lambda: run.field("LeastJacobian"),
                     lambda: piola.Results("results").history["least_jacobian"],
                     lambda: piola.Results("results").frames[-1]["LeastJacobian"]):
            with self.assertRaisesRegex(piola.CaseWarning, "is now 'cell_jacobian_min'|is now 'CellJacobianMin'"):
                look()
        history = Path("results/history.csv")
        history.write_text(history.read_text().replace("cell_jacobian_min", "least_jacobian"))
        results = piola.Results("results")
        with h5py.File(results.frames[-1].path, "a") as file:
            file["VTKHDF/PointData"].move("CellJacobianMin", "LeastJacobian")
        np.testing.assert_array_equal(results.history["cell_jacobian_min"], least)
        np.testing.assert_allclose(results.frames[-1]["CellJacobianMin"], field, rtol=1e-6)
        self.assertIn("CellJacobianMin", results.frames[-1].fields)
        self.assertEqual(results.frames[-1].units["CellJacobianMin"], "1")
        with self.assertRaises(KeyError):
            results.history["nothing"]

    def test_units_of_frames(self):
        run = piola.Run(column(), out="results")
        run.finish()
        units = piola.Results("results").frames[0].units
        self.assertEqual(set(units), set(piola.Results("results").frames[0].fields))
        for name, (unit, _) in run.fields.items():
            self.assertEqual(units.get(name, unit), unit, name)
        self.assertEqual((units["Position"], units["CauchyStress"]), ("m", "Pa"))

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "needs python3-pandas")
    def test_pandas(self):
        run = piola.Run(column(), out="results")
        run.finish()
        table = piola.Results("results").to_pandas()
        self.assertEqual(table.index.name, "time")
        self.assertEqual(set(table.columns), set(run.history) - {"time"})
        np.testing.assert_array_equal(table["kinetic_energy"].to_numpy(), run.history["kinetic_energy"])
        np.testing.assert_array_equal(table.index.to_numpy(), run.history["time"])
        self.assertEqual(table.attrs["units"]["kinetic_energy"], "J")
        for name, unit in piola.Results("results").units.items():
            self.assertEqual(unit, run.history_units[name], name)

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "needs python3-xarray")
    def test_xarray(self):
        piola.Run(column(), out="results").finish()
        results = piola.Results("results")
        data = results.to_xarray()
        self.assertEqual(dict(data.sizes), {"time": 5, "particle": 54, "component_3": 3, "component_6": 6,
                                            "component_9": 9})
        np.testing.assert_array_equal(data.time, results.frames.times)
        self.assertEqual((data.Pressure.attrs["units"], data.time.attrs["units"]), ("Pa", "s"))
        for name in results.frames[3].fields:
            np.testing.assert_array_equal(data[name].isel(time=3), results.frames[3][name], name)
        stress = data.CauchyStress.sel(component_6="xy").isel(time=3)
        np.testing.assert_array_equal(stress, results.frames[3]["CauchyStress"][:, 3])
        self.assertEqual(data.component_9.values[5], "yz")
        self.assertEqual(set(results.to_xarray(["Pressure"]).data_vars), {"Pressure"})
        with self.assertRaisesRegex(KeyError, "did you mean 'Pressure'"):
            results.to_xarray("presure")

    def test_study(self):
        key = "body.column.material.poissons_ratio"
        case = column(**{"run.threads": 1, "quantity": [{"name": "peak", "column": "strain_energy", "take": "maximum",
                                                        "unit": "J"}]})
        rows = piola.study(case, {key: [0.1, 0.2, 0.3], "run.end": ["1 ms", "2 ms"]}, out="study", jobs=2)
        self.assertEqual([row["status"] for row in rows], ["completed"] * 6)
        self.assertEqual(len({row["peak"] for row in rows}), 6)
        self.assertEqual(len(Path("study/study.csv").read_text().splitlines()), 7)
        stamp = os.stat("study/run-1/summary.json").st_mtime_ns
        again = piola.study(case, {key: [0.1, 0.2, 0.3], "run.end": ["1 ms", "2 ms"]}, out="study", jobs=2)
        self.assertEqual(rows, again)
        self.assertEqual(os.stat("study/run-1/summary.json").st_mtime_ns, stamp)
        with self.assertRaisesRegex(piola.InputError, "0.9"):
            piola.study(case, {key: [0.1, 0.9]}, out="other")
        self.assertFalse(os.path.exists("other/run-1"))

    def test_study_reports_no_results_of_other_runs(self):
        peak = {"name": "peak", "column": "strain_energy", "take": "maximum"}
        case = column(**{"run.threads": 1, "quantity": [peak]})
        first = piola.study(case, {"title": ["one"]}, out="study", jobs=1)
        self.assertIn("peak", first[0])
        with self.assertWarnsRegex(piola.CaseWarning, "holds the results of another case"):
            second = piola.study(case, {"title": ["two"]}, out="study", jobs=1)
        self.assertEqual(second, [{"folder": first[0]["folder"], "title": "two", "status": "failed"}])
        self.assertEqual(Path("study/study.csv").read_text().splitlines()[1].split(",")[-1], "failed")
        self.assertEqual(piola.study(case, {"title": ["one"]}, out="study", jobs=1), first)

    def test_results_of_functions_are_taken_for_no_others(self):
        case = column(**{"run.threads": 1})
        case.body["column"].initial_velocity = lambda X, t: 0.1 * X
        run = piola.Run(case, out="results")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", piola.CaseWarning)  # of what the scheme dissipates
            run.finish()
        self.assertEqual(piola.Results("results").summary["identity"]["run"], "")


class Manual(InFolder):
    def test_everything_is_explained(self):
        for one in (piola.Case, piola.Run, piola.Results, piola.study, piola.InputError, piola.PhysicsError):
            self.assertTrue(inspect.getdoc(one), one)
            for name, member in inspect.getmembers(one):
                if not name.startswith("_") and getattr(member, "__module__", "").startswith("piola"):
                    self.assertTrue(inspect.getdoc(member), f"{one}.{name}")

    def test_types_of_the_compiled_module(self):
        tree = ast.parse((Path(piola.__file__).parent / "_piola.pyi").read_text())
        told = {}
        for node in tree.body:
            if isinstance(node, ast.ClassDef):
                told[node.name] = {one.name for one in node.body} - {"__init__"}
            elif isinstance(node, (ast.FunctionDef, ast.AnnAssign)):
                told[node.name if isinstance(node, ast.FunctionDef) else node.target.id] = None
        there = {name: {one for one in vars(value) if not one.startswith("_")} if inspect.isclass(value) else None
                 for name, value in vars(piola._piola).items() if not name.startswith("__")}
        self.assertEqual(told, there)
        # Arguments by name, as pybind11 writes them into the first line of the docstring.
        functions = [(piola._piola, one) for one in tree.body if isinstance(one, ast.FunctionDef)]
        functions += [(getattr(piola._piola, kind.name), one) for kind in tree.body if isinstance(kind, ast.ClassDef)
                      for one in kind.body if isinstance(one, ast.FunctionDef) and not one.decorator_list]
        for owner, function in functions:
            line = getattr(owner, function.name).__doc__.splitlines()[0]
            for argument in function.args.args:
                self.assertRegex(line, rf"\b{argument.arg}: ", line)

    def test_clouds_written_by_h5py(self):
        text = (SOURCE / "docs/user/clouds.md").read_text()
        (block,) = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        exec(compile(block, "clouds.md", "exec"), {})  # pylint: disable=exec-used
        case = piola.Case({
            "title": "cloud",
            "run": {"end": "10 us"},
            "body": [{
                "name": "block",
                "formulation": {"name": "jst_sph"},
                "shape": {"points": {"file": str(Path("cloud.h5").resolve())}},
                "initial_velocity": ["1 m/s", 0, 0],
                "material": {"law": "neo_hookean", "density": 1000, "youngs_modulus": 1e9, "poissons_ratio": 0.3}}]})
        run = piola.Run(case)
        self.assertEqual(run.X.shape, (1000, 3))
        self.assertAlmostEqual(run.X.max(), 9.5e-3, 15)

    def test_names_of_the_page(self):
        text = (SOURCE / "docs/user/python.md").read_text()
        names = set(re.findall(r"`(?:piola\.R|r)un\.(\w+)", text))
        self.assertGreater(len(names), 20)
        run = piola.Run(column())
        self.assertEqual([name for name in names if not hasattr(run, name)], [])
        self.assertEqual([name for name in dir(piola.Run) if not name.startswith("_") and name not in names],
                         [])

    def test_examples_of_the_page(self):
        text = (SOURCE / "docs/user/python.md").read_text()
        blocks = re.findall(r"^```python\n(.*?)^```", text, re.M | re.S)
        self.assertGreater(len(blocks), 4)
        self.assertLess(len([line for line in blocks[0].splitlines() if line.strip()]), 40)
        space, said = {}, io.StringIO()
        with contextlib.redirect_stdout(said):
            for number, block in enumerate(blocks):
                exec(compile(block, f"python.md, block {number + 1}", "exec"), space)  # pylint: disable=exec-used
        self.assertEqual([row["status"] for row in space["rows"]], ["completed"] * 10)
        self.assertIn("strain energy", said.getvalue())


if __name__ == "__main__":
    unittest.main(verbosity=1)
