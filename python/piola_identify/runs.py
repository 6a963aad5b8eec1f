# SPDX-License-Identifier: Apache-2.0
"""Runs of the cases with values of the parameters."""
import concurrent.futures
import os
import shutil
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from .curves import Expression, interpolate, read_columns
from .problem import Problem


class Measured:
    """A measured curve, and what a run gives in its place."""

    def __init__(self, curve):
        self.curve = curve
        columns, _ = read_columns(curve.file)
        self.x, self.y = Expression(curve.x)(columns), Expression(curve.y)(columns)
        self.run_x, self.run_y = Expression(curve.run_x), Expression(curve.run_y)
        if self.x.shape != self.y.shape or self.x.ndim != 1:
            raise Problem(f"{curve.file}: x = {curve.x!r} and y = {curve.y!r} are not two columns")
        if not (np.all(np.isfinite(self.x)) and np.all(np.isfinite(self.y))):
            raise Problem(f"{curve.file}: x or y has values that are not finite")
        self.scale = curve.error or max(np.abs(self.y).max(), 1e-300)

    def of_run(self, folder):
        columns, _ = read_columns(folder / "history.csv")
        x, y = self.run_x(columns), self.run_y(columns)
        low, high = self.x.min(), self.x.max()
        slack = 1e-3 * (high - low)
        if not (x.min() <= low + slack and x.max() >= high - slack):
            raise Problem(f"the run of {self.curve.name} covers x from {x.min():g} to {x.max():g}, and the measurements "
                          f"go from {low:g} to {high:g} - let the run go on, or cut the file")
        return interpolate(x, y, self.x)


class Runs:
    """Starts runs, several at a time, and keeps their results by the values of the parameters."""

    def __init__(self, fit, jobs, told):
        self.fit, self.told = fit, told
        self.measured = [Measured(curve) for curve in fit.curves]
        self.jobs = jobs or os.cpu_count() or 1
        self.program = os.environ.get("PIOLA_PROGRAM") or shutil.which("piola")
        if not self.program:
            raise Problem("the program piola is not in PATH - start `piola identify`")
        self.folder = Path(tempfile.mkdtemp(prefix="piola-identify-"))
        self.failed = 0
        self._known = {}

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def settings(self, values):
        return [parameter.setting(value) for parameter, value in zip(self.fit.parameters, values)]

    def evaluate(self, all_values):
        """Per list of values the curves of the runs; None where one failed."""
        wanted = [tuple(map(float, values)) for values in all_values]
        new = list(dict.fromkeys(values for values in wanted if values not in self._known))
        tasks = [(values, measured) for values in new for measured in self.measured]
        with concurrent.futures.ThreadPoolExecutor(self.jobs) as pool:
            results = list(pool.map(lambda task: self._run(*task), tasks))
        for n, values in enumerate(new):
            of_values = results[n * len(self.measured):(n + 1) * len(self.measured)]
            self._known[values] = None if any(one is None for one in of_values) else of_values
        return [self._known[values] for values in wanted]

    def command(self, curve, values, folder):
        words = [self.program, "run", str(curve.case), "--out", str(folder), "--quiet", "--no-pictures", "--threads", "1"]
        for setting in [*curve.settings, *self.settings(values)]:
            words += ["--set", setting]
        return words

    def _run(self, values, measured):
        folder = Path(tempfile.mkdtemp(dir=self.folder))
        done = subprocess.run(self.command(measured.curve, values, folder / "run"), capture_output=True, text=True)
        try:
            if done.returncode == 2:
                raise Problem(f"{measured.curve.name}: {done.stderr.strip()}")
            if done.returncode != 0:
                self.failed += 1
                self.told(f"{measured.curve.name} fails with {', '.join(self.settings(values))}: "
                          f"{done.stderr.strip().splitlines()[-1] if done.stderr.strip() else done.returncode}")
                return None
            return measured.of_run(folder / "run")
        finally:
            shutil.rmtree(folder, ignore_errors=True)
