# SPDX-License-Identifier: Apache-2.0
"""Keyword files of LS-DYNA as blocks of lines, and their fields: fixed columns, commas, or long format."""
import re
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

MOST_INCLUDES = 1000
FORTRAN = re.compile(rb"^([-+]?[0-9.]+)[dDqQ]?([-+][0-9]+)$")


@dataclass
class Block:
    """A keyword with its lines, without comments."""
    keyword: str
    place: str                                   # FILE:LINE of the keyword
    file: str
    lines: list = field(default_factory=list)
    numbers: list = field(default_factory=list)  # of the lines in the file
    long: bool = False                           # fields of 20 columns
    parameters: dict = field(default_factory=dict)

    def at(self, row):
        """FILE:LINE of a line."""
        return f"{self.file}:{self.numbers[row]}" if row < len(self.numbers) else self.place

    def fields(self, row, widths=(10,) * 8):
        """The fields of a line as texts; empty ones where it ends early, or if there is no such line."""
        line = self.lines[row] if row < len(self.lines) else ""
        if "," in line:
            found = [text.strip() for text in line.split(",")]
        else:
            widths = [20] * len(widths) if self.long else widths
            found = [line[end - width:end].strip() for end, width in zip(np.cumsum(widths), widths)]
        found += [""] * (len(widths) - len(found))
        return [self.parameters.get(text[1:].lower(), text) if text.startswith("&") else text for text in found]

    def card(self, row, problems, count=8, widths=None):
        """The numbers of a line, 0 for empty fields; what is no number is a problem."""
        return numbers_of(self.fields(row, widths or (10,) * count)[:count], problems, self.at(row), self.keyword)


def numbers_of(fields, problems, place, keyword):
    """The numbers of texts, 0 for empty ones; what is no number is a problem at this place, and 0."""
    found = []
    for text in fields:
        try:
            found.append(number(text.encode()))
        except ValueError:
            problems.add(place, f"\"{text[:30]}\" is not a number (*{keyword}) - correct it", "is not a number")
            found.append(0.0)
    return found


def number(text):
    """A number of bytes, empty: 0; also as Fortran writes it (1.5D+3, 1.5-3). Raises ValueError."""
    text = text.strip()
    if not text:
        return 0.0
    found = FORTRAN.match(text)
    value = float(found[1] + b"e" + found[2]) if found else float(text)
    if not np.isfinite(value):
        raise ValueError("not finite")
    return value


def table(block, rows, widths, count, problems):
    """Numbers (n, count) of many lines alike, as floats; what is no number is a problem."""
    lines = block.lines if rows is None else [block.lines[row] for row in rows]
    widths = [20] * len(widths) if block.long else list(widths)
    if any("," in line or "&" in line for line in lines):
        at = range(len(lines)) if rows is None else rows
        return np.array([block.card(row, problems, count, widths) for row in at]).reshape(-1, count)
    total = sum(widths)
    bytes_ = np.array([line.encode("ascii", "replace")[:total].ljust(total) for line in lines], dtype=f"S{total}")
    if len(lines) == 0:
        return np.zeros((0, count))
    letters = bytes_.view("S1").reshape(len(lines), total)
    columns, start = [], 0
    for width in widths[:count]:
        column = np.char.strip(np.ascontiguousarray(letters[:, start:start + width]).view(f"S{width}").ravel())
        start += width
        column[column == b""] = b"0"
        columns.append(_numbers(column, block, rows, problems))
    return np.stack(columns, axis=1)


def _numbers(column, block, rows, problems):
    try:
        values = column.astype(float)
        if np.isfinite(values).all():
            return values
    except ValueError:
        pass
    values = np.zeros(len(column))
    for k, text in enumerate(column):
        try:
            values[k] = number(text)
        except ValueError:
            row = k if rows is None else rows[k]
            problems.add(block.at(row), f"\"{text.decode('ascii', 'replace')[:30]}\" is not a number "
                         f"(*{block.keyword}) - correct the field", "is not a number")
    return values


def read_text(path, problems):
    """The text of a file; None, with a problem, if it cannot be read or is no text."""
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        problems.add(path, f"cannot be read ({error.strerror}) - check the name")
        return None
    if b"\0" in data or not data.strip():
        problems.add(path, "is empty" if not data.strip() else "is no text (it holds a NUL byte): a keyword file is "
                     "expected - export it as text")
        return None
    try:
        return data.decode("utf-8")
    except UnicodeDecodeError:
        return data.decode("latin-1")


class Blocks:
    """Reads a keyword file and the files that it includes into blocks."""

    def __init__(self, problems):
        self.problems, self.blocks, self.parameters = problems, [], {}
        self.open, self.folders, self.count, self.long = [], [], 0, False

    def read(self, path):
        path = Path(path)
        self.count += 1
        if path.resolve() in self.open or self.count > MOST_INCLUDES:
            self.problems.add(path, "includes itself - remove that *INCLUDE")
            return self.blocks
        text = read_text(path, self.problems)
        if text is None:
            return self.blocks
        self.open.append(path.resolve())
        block = None
        for at, line in enumerate(text.splitlines(), 1):
            if line.startswith("$"):
                continue
            if line.startswith("*"):
                self._close(block, path)
                if line[1:].split()[:1] in (["END"], ["end"]):
                    block = None
                    break
                block = self._start(line, path, at)
            elif block is not None and line.strip():
                block.lines.append(line.rstrip())
                block.numbers.append(at)
        self._close(block, path)
        self.open.pop()
        return self.blocks

    def _start(self, line, path, at):
        words = line[1:].upper().split()
        keyword = words[0] if words else ""
        long = self.long or keyword.endswith("+") or "%" in words[1:] or keyword.endswith("%")
        if keyword == "KEYWORD" and "LONG=Y" in "".join(words):
            self.long = True
        return Block(keyword.rstrip("+-%"), f"{path}:{at}", str(path), long=long and "-" not in words[1:],
                     parameters=self.parameters)

    def _close(self, block, path):
        """Keeps a block, or reads what it includes."""
        if block is None:
            return
        if block.keyword == "INCLUDE_PATH":
            self.folders += [Path(line.strip()) for line in block.lines]
        elif block.keyword == "INCLUDE":
            for row, line in enumerate(block.lines):
                self._include(line.strip(), path, block.at(row))
        elif block.keyword in ("PARAMETER", "PARAMETER_LOCAL"):
            self._take_parameters(block)
        else:
            self.blocks.append(block)

    def _include(self, name, path, place):
        places = [Path(path).parent / name] + [folder / name for folder in self.folders]
        found = next((file for file in places if file.is_file()), None)
        if found is None:
            self.problems.add(place, f"includes \"{name}\", which does not exist - put it beside the file")
        else:
            self.read(found)

    def _take_parameters(self, block):
        for row in range(len(block.lines)):
            fields = block.fields(row)
            for name, value in zip(fields[::2], fields[1::2]):
                if name:
                    self.parameters[name[1:].strip().lower() if name[0].upper() in "RIC" else name.lower()] = value
