# SPDX-License-Identifier: Apache-2.0
"""Runs of the cases with values of the parameters."""
import concurrent.futures
import os
import shutil
import signal
import subprocess
import tempfile
from pathlib import Path

import numpy as np

from . import units
from .curves import Expression, interpolate, read_columns
from .problem import Problem

COMPLETED, BAD_INPUT, STOPPED = 0, 2, 4  # exit codes of a run
COVERED = 1e-3  # of the range of the measured x: how much a run may leave out at its ends


class Measured:
    """A measured curve, and what a run gives in its place."""

    def __init__(self, curve, si_of):
        self.curve = curve
        columns = read_columns(curve.file, si_of)
        self.x, self.y = (Expression(text)(columns) for text in (curve.x, curve.y))
        known = np.isfinite(self.x) & np.isfinite(self.y)
        if known.sum() < 2:
            raise Problem(f"{curve.file}: x = {curve.x!r} and y = {curve.y!r} have {known.sum()} points of finite numbers")
        self.x, self.y = self.x[known], self.y[known]
        self.run_x, self.run_y = Expression(curve.run_x), Expression(curve.run_y)
        self.scale = curve.error or max(np.abs(self.y).max(), 1e-300)

    def of_run(self, folder):
        """y of a run at the measured x. Raises Problem for columns that there are not, ValueError for a run that cannot
        be compared."""
        columns = read_columns(folder / "history.csv")
        x, y = self.run_x(columns), self.run_y(columns)
        known = np.isfinite(x) & np.isfinite(y)
        x, y = x[known], y[known]
        low, high = self.x.min(), self.x.max()
        slack = COVERED * (high - low)
        if len(x) < 2:
            raise ValueError(f"{self.curve.run_x!r} and {self.curve.run_y!r} are finite in {len(x)} rows of its history")
        if not (x.min() <= low + slack and x.max() >= high - slack):
            raise ValueError(f"it covers x from {x.min():g} to {x.max():g}, and the measurements go from {low:g} to "
                             f"{high:g} - let the run go on, or cut the file")
        return interpolate(x, y, self.x)


def _measured(curves, si_of):
    """All measured curves. Raises Problem with all that is wrong, a line each."""
    measured, problems = [], []
    for curve in curves:
        try:
            measured.append(Measured(curve, si_of))
        except Problem as error:
            problems.append(f"curve {curve.name}: {error}")
    if problems:
        raise Problem("\n".join(problems))
    return measured


class Runs:
    """Starts runs, several at a time, and keeps their results by the values of the parameters."""

    def __init__(self, fit, jobs):
        self.fit, self.told = fit, print
        self.program = os.environ.get("PIOLA_PROGRAM") or shutil.which("piola")
        if not self.program:
            raise Problem("the program piola is not in PATH - start `piola identify`")
        if jobs < 0:
            raise Problem(f"--jobs is {jobs} (allowed: from 1 on; 0 for the number of cores)")
        self.jobs = jobs or os.cpu_count() or 1
        self.measured = _measured(fit.curves, units.reader_of(self.program))
        self.folder = Path(tempfile.mkdtemp(prefix="piola-identify-"))
        self.failed = 0
        self._known = {}
        self._worked = False  # whether any run had a result: an error of input is then one of the values

    def close(self):
        shutil.rmtree(self.folder, ignore_errors=True)

    def settings(self, values):
        return [parameter.setting(value) for parameter, value in zip(self.fit.parameters, values)]

    def evaluate(self, all_values):
        """Per list of values the curves of the runs; None where one failed. KeyboardInterrupt if one was stopped."""
        wanted = [tuple(map(float, values)) for values in all_values]
        new = list(dict.fromkeys(values for values in wanted if values not in self._known))
        tasks = [(values, measured) for values in new for measured in self.measured]
        pool = concurrent.futures.ThreadPoolExecutor(self.jobs)
        try:
            results = list(pool.map(lambda task: self._run(*task), tasks))
        finally:
            pool.shutdown(cancel_futures=True)
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
        done = subprocess.run(self.command(measured.curve, values, folder / "run"), capture_output=True, text=True,
                              check=False)
        said = done.stderr.strip()
        try:
            if done.returncode in (STOPPED, -signal.SIGINT):
                raise KeyboardInterrupt
            if done.returncode == BAD_INPUT and not self._worked:
                raise Problem(f"curve {measured.curve.name}: {said}")
            if done.returncode != COMPLETED:
                raise ValueError(said.splitlines()[-1] if said else f"exit code {done.returncode}")
            curve = measured.of_run(folder / "run")
            self._worked = True
            return curve
        except ValueError as error:
            self.failed += 1
            self.told(f"the run of {measured.curve.name} with {', '.join(self.settings(values))} fails: {error}")
            return None
        finally:
            shutil.rmtree(folder, ignore_errors=True)
