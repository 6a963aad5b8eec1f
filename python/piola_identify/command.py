# SPDX-License-Identifier: Apache-2.0
"""The command line: reads one file, writes one folder."""
import argparse
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


def _identify(options):
    fit = read_fit(options.file)
    folder = Path(options.out or Path(options.file).stem)
    if (folder / "result.toml").exists() and not options.force:
        raise Problem(f"{folder}/result.toml is there already - --force replaces it, --out names another folder")
    folder.mkdir(parents=True, exist_ok=True)
    progress = _Progress(folder, fit)
    runs = Runs(fit, options.jobs, progress.tell)
    solver = LeastSquares(fit, runs, progress)
    try:
        found = solver.solve()
        report.write_result(folder, fit, found, runs.failed)
        before, after = report.write_curves(folder, runs, [p.start for p in fit.parameters], found)
        picture = report.draw(folder, runs, before, after)
    except KeyboardInterrupt:
        best = solver.outer(solver.best[1]) if solver.best[1] is not None else []
        progress.tell(f"stopped; best so far: {', '.join(runs.settings(best)) or 'nothing'}")
        return STOPPED
    finally:
        runs.close()
    print(f"{'found' if found.converged else 'NOT CONVERGED'} after {found.evaluations} evaluations, residual "
          f"{found.residual:.3g}" + (f", {runs.failed} runs failed" if runs.failed else ""))
    print(report.table_of(fit, found))
    print(f"written to {folder}: result.toml, log.txt, curves, cases with these values"
          + (f", {picture}" if picture else " (fit.png needs the package python3-matplotlib)"))
    return COMPLETED if found.converged else NOT_CONVERGED
