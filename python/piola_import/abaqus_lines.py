# SPDX-License-Identifier: Apache-2.0
"""Input files of Abaqus as keywords with parameters and lines of data."""
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from .lsdyna_cards import MOST_INCLUDES, numbers_of, read_text


@dataclass
class Keyword:
    """A keyword, its parameters (upper case names) and its lines of data."""
    name: str
    parameters: dict
    place: str
    file: str
    lines: list = field(default_factory=list)
    numbers: list = field(default_factory=list)

    def at(self, row):
        return f"{self.file}:{self.numbers[row]}" if row < len(self.numbers) else self.place

    def get(self, name):
        """A parameter in upper case, as Abaqus compares names; empty if it is not there."""
        return self.parameters.get(name, "").upper()

    def fields(self, row):
        return [text.strip() for text in self.lines[row].split(",")] if row < len(self.lines) else []

    def values(self, row, problems, count=8):
        """The numbers of a line, 0 for what is missing; what is no number is a problem."""
        return numbers_of((self.fields(row) + [""] * count)[:count], problems, self.at(row), self.name)

    def table(self, count, problems):
        """Numbers (n, count) of lines alike; lines that end early have zeros."""
        rows = [line.split(",")[:count] for line in self.lines]
        try:
            values = np.array([[float(text) if text.strip() else 0.0 for text in row] + [0.0] * (count - len(row))
                               for row in rows])
            if np.isfinite(values).all():
                return values.reshape(-1, count)
        except ValueError:
            pass
        return np.array([self.values(row, problems, count) for row in range(len(rows))]).reshape(-1, count)

    def numbers_of_all(self, problems):
        """Whole numbers of all lines in one list: of elements whose nodes go on in the next line."""
        try:
            return _integers(",".join(line.rstrip(" ,") for line in self.lines))
        except (ValueError, OverflowError):
            pass
        for row, line in enumerate(self.lines):
            try:
                _integers(line.rstrip(" ,"))
            except (ValueError, OverflowError):
                problems.add(self.at(row), f"\"{line[:40]}\" is no list of whole numbers (*{self.name}) - correct it",
                             "is no list of whole numbers")
        return None


def _integers(text):
    return np.array(list(map(int, text.split(","))) if text else [], dtype=np.int64)


def read_keywords(path, problems, count=0):
    """The keywords of a file and of those that it includes."""
    if count > min(MOST_INCLUDES, 50):
        problems.add(path, "includes itself - remove that *INCLUDE")
        return []
    text = read_text(path, problems)
    found = []
    for at, line in enumerate(text.splitlines() if text is not None else [], 1):
        line = line.strip()
        if line.startswith("**") or not line:
            continue
        if line.startswith("*"):
            name, *given = line[1:].rstrip(",").split(",")
            found.append(Keyword(" ".join(name.upper().split()), _parameters(given), f"{path}:{at}", str(path)))
        elif found and found[-1].lines == [] and found[-1].parameters.pop("", None) is not None:
            found[-1].parameters |= _parameters(line.rstrip(",").split(","))
        elif found:
            found[-1].lines.append(line)
            found[-1].numbers.append(at)
    return _with_includes(found, path, problems, count)


def _parameters(given):
    found = {}
    for text in given:
        key, _, value = text.partition("=")
        found[" ".join(key.upper().split())] = value.strip().strip('"')
    return found


def _with_includes(found, path, problems, count):
    everything = []
    for keyword in found:
        if keyword.name != "INCLUDE":
            everything.append(keyword)
            continue
        name = keyword.parameters.get("INPUT", "")
        file = Path(path).parent / name
        if not name or not file.is_file():
            problems.add(keyword.place, f"includes \"{name}\", which does not exist - put it beside the file")
        else:
            everything += read_keywords(file, problems, count + 1)
    return everything
