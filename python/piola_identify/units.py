# SPDX-License-Identifier: Apache-2.0
"""Units as the program reads them."""
import functools
import re
import subprocess

from .problem import Problem


def reader_of(program):
    """A function that turns a unit into the factor and the offset of its value in SI, by `piola describe unit`."""
    @functools.lru_cache(maxsize=None)
    def si_of(unit):
        if unit in ("-", "1"):
            return 1.0, 0.0
        done = subprocess.run([program, "describe", "unit", "--", unit], capture_output=True, text=True, check=False)
        values = re.findall(r"^[01] .* = (\S+) in SI units$", done.stdout, re.M)
        if done.returncode != 0 or len(values) != 2:
            raise Problem(f"{unit!r} is not a unit (such as MPa, kN, mm, %; - for none)")
        zero, one = map(float, values)
        return one - zero, zero
    return si_of
