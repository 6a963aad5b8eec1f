# SPDX-License-Identifier: Apache-2.0
"""Ranks: the largest memory of a rank is what `piola check --ranks` says, within 25 %, and less than that of a run on
one rank.

Needs a program with MPI and mpirun; is skipped otherwise. PIOLA_RANKS_TESTS=quick takes a part of it.
"""
import re
import sys
import tempfile
from pathlib import Path

from on_ranks import PROGRAM, QUICK, SOURCE, expect, finish, piola, skip_without_ranks

sys.path.insert(0, str(SOURCE / "bench"))
from ranks_memory import largest_of_ranks, write_case  # noqa: E402

WITHIN = 0.25
UNITS = {"kB": 1e3, "MB": 1e6, "GB": 1e9}


def said(case, ranks):
    """In bytes."""
    told = piola(1, "check", case, "--ranks", ranks, "--threads", "1").stdout
    number, unit = re.search(r"particles and ([\d.]+) ([kMG]B) of memory each", told).groups()
    return float(number) * UNITS[unit]


def compare(name, n, formulation, more, ranks, work):
    case = work / "case.toml"
    write_case(case, n, formulation, more)
    taken = largest_of_ranks(PROGRAM, ranks, case, work)
    estimate = said(case, ranks)
    print(f"{name} on {ranks} ranks: taken {taken[-1] / 1e6:.0f} to {taken[0] / 1e6:.0f} MB, "
          f"said {estimate / 1e6:.0f} MB", flush=True)
    expect(abs(estimate / taken[0] - 1) <= WITHIN, f"{name} on {ranks} ranks")
    return taken


skip_without_ranks()
with tempfile.TemporaryDirectory() as folder:
    for name, n, formulation, more, share in (
            ("lattice", 48, "jst_sph", "", 0.75), ("cloud", 28, "jst_sph", "jitter", 0.95),
            ("lattice of nodal", 40, "nodal", "", 0.75), ("cloud of nodal", 28, "nodal", "jitter", 0.8),
            ("lattice of adaptle", 48, "adaptle", "", 0.65), ("impact of adaptle", 40, "adaptle", "impact", 0.75),
            ("flow of adaptle", 40, "adaptle", "flow", 0.75),
            # Too many to be built for a look: small parts say what all take.
            ("parts of the flow of adaptle", 60, "adaptle", "flow", 0.75)):
        if QUICK and name.startswith("parts"):
            continue
        for ranks in (3,) if QUICK or name.startswith("parts") else (2, 3, 5):
            taken = compare(name, n, formulation, more, ranks, Path(folder))
            alone = largest_of_ranks(PROGRAM, 1, Path(folder) / "case.toml", Path(folder))
            expect(taken[-1] < share * alone[0], f"{name}: one of {ranks} ranks takes {taken[-1]} bytes of {alone[0]}")
finish()
