# SPDX-License-Identifier: Apache-2.0
"""The command line: reads one file, writes one folder."""
import argparse
import signal
import sys
import time
from pathlib import Path

from . import report
from .fit import LeastSquares
from .problem import Problem, read_fit
from .runs import Runs

COMPLETED, NOT_CONVERGED, BAD_INPUT, STOPPED = 0, 1, 2, 4


def main(arguments):
    """Exit code 0: found; 1: not converged within the evaluations; 2: the input is wrong; 4: stopped by the user."""
    options = _parser().parse_args(arguments)
    try:
        return _identify(options)
    except Problem as error:
        for line in str(error).splitlines():
            print(f"piola: {line}", file=sys.stderr)
    except OSError as error:
        print(f"piola: {error.filename or options.file}: {error.strerror}", file=sys.stderr)
    return BAD_INPUT


def _parser():
    parser = argparse.ArgumentParser(prog="piola identify", description="Finds parameters of a case, such as of a law, "
                                     "from measured curves by least squares over runs.")
    parser.add_argument("file", help="parameters and curves, such as fit.toml")
    parser.add_argument("--out", "-o", default="", help="the folder to write (default: the name of the file)")
    parser.add_argument("--jobs", type=int, default=0, help="runs at a time (default: the number of cores)")
    parser.add_argument("--force", action="store_true", help="replace what an earlier identification wrote")
    return parser


class _Progress:
    """A line per evaluation, and the log that keeps them."""

    def __init__(self, folder, fit):
        self.names = [p.name for p in fit.parameters]
        self.most, self.begin = fit.evaluations, time.monotonic()
        self.log = open(folder / "log.txt", "w", encoding="utf-8")

    def tell(self, text):
        self.log.write(text + "\n")
        self.log.flush()
        print(text, file=sys.stderr)

    def __call__(self, count, cost, best, values):
        spent = time.monotonic() - self.begin
        left = spent / count * max(self.most - count, 0)
        named = ", ".join(f"{name} {value:.5g}" for name, value in zip(self.names, values))
        self.tell(f"{count:3}: residual {cost:.4g}, best {best:.4g}   {named}   {spent:.0f} s, at most {left:.0f} s left")


def _stop(*_):
    raise KeyboardInterrupt


def _solve(solver):
    """What is found, and the exit code; the best values so far if the search cannot go on."""
    try:
        found = solver.solve()
        return found, COMPLETED if found.converged else NOT_CONVERGED
    except KeyboardInterrupt:
        return solver.unfinished("stopped"), STOPPED
    except Problem as error:
        found = solver.unfinished(str(error))
        if found is None:
            raise
        return found, NOT_CONVERGED


def _identify(options):
    fit = read_fit(options.file)
    folder = Path(options.out or Path(options.file).stem)
    if (folder / "result.toml").exists() and not options.force:
        raise Problem(f"{folder}/result.toml is there already - --force replaces it, --out names another folder")
    runs = Runs(fit, options.jobs)
    signal.signal(signal.SIGTERM, _stop)
    try:
        folder.mkdir(parents=True, exist_ok=True)
        progress = _Progress(folder, fit)
        runs.told = progress.tell
        found, code = _solve(LeastSquares(fit, runs, progress))
        if found is None:
            progress.tell("stopped before the first evaluation")
            return code
        report.write_result(folder, fit, found, runs.failed)
        if code != STOPPED:
            for line in report.write_curves(folder, runs, [p.start for p in fit.parameters], found):
                progress.tell(line)
    except KeyboardInterrupt:
        return STOPPED
    finally:
        runs.close()
    print(f"{'found' if found.converged else 'NOT CONVERGED'} after {found.evaluations} evaluations, residual "
          f"{found.residual:.3g}" + (f", {runs.failed} runs failed" if runs.failed else ""))
    if not found.converged:
        print(f"  {found.message}")
    print(report.table_of(fit, found))
    print(f"written to {folder}: result.toml, log.txt"
          + ("" if code == STOPPED else ", curves.csv, curves.svg, and a run of each curve with these values"))
    return code
