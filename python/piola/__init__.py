# SPDX-License-Identifier: Apache-2.0
"""Piola: smoothed particle hydrodynamics of solids that deform, flow and break.

    import piola
    case = piola.Case.read("case.toml", set={"run.end": "20 ms"})
    run = piola.Run(case, out="results")
    run.finish()

Arrays are numpy's, in SI units and in the order of the particles' ids. Case describes what is to be run, Run runs it,
Results reads what a run has written, study runs a case many times. docs/user/python.md is the manual.
"""
from ._piola import version as __version__
from .case import Case
from .errors import CaseWarning, FileError, InputError, PhysicsError, Problem
from .results import Results
from .run import STOP, Run
from .studies import study

__all__ = ["Case", "CaseWarning", "FileError", "InputError", "PhysicsError", "Problem", "Results", "Run", "STOP",
           "study", "__version__"]
