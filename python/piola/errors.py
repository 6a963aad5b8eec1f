# SPDX-License-Identifier: Apache-2.0
"""What can go wrong, as exceptions and warnings."""
import re
from typing import NamedTuple


class Problem(NamedTuple):
    """One thing that is wrong with a case; line and column count from 1, 0 where there is none."""
    line: int
    column: int
    text: str


class InputError(ValueError):
    """A case, file or setting cannot be used. The message has one problem in a line."""

    @property
    def problems(self) -> list:
        """All of them, as Problem(line, column, text)."""
        found = []
        for line in str(self).splitlines():
            place = re.match(r"(?:.*?):(\d+):(\d+): (.*)", line)
            found.append(Problem(int(place[1]), int(place[2]), place[3]) if place else Problem(0, 0, line))
        return found


class PhysicsError(RuntimeError):
    """The physics left its admissible range: the message names particle, place, step, values and likely causes."""


class FileError(OSError):
    """A file or folder cannot be read or written."""


class UnknownName(KeyError):
    """A key, column, field or quantity that does not exist: a KeyError whose text is shown as it is."""

    def __str__(self) -> str:
        return self.args[0]


class CaseWarning(UserWarning):
    """A case or an answer that is doubtful."""
