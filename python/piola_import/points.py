# SPDX-License-Identifier: Apache-2.0
"""Reads clouds of points: tables with a header (CSV) are taken as they are, lists of positions (XYZ) become a table."""
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from .lsdyna_cards import number, read_text


@dataclass
class Cloud:
    """Points that go to the case as a table: its text, or positions and volumes [m, m^d]."""
    text: str = ""
    X: np.ndarray = None
    volume: np.ndarray = None
    bodies: list = None
    length_unit: str = ""     # of a table without units
    dimension: int = 3


def read_csv(path, units_text, problems):
    """A table with a header of names; Piola itself checks its rows."""
    text = read_text(path, problems)
    if text is None:
        return None
    lines = [line for line in text.lstrip("\ufeff").splitlines() if line.strip() and not line.lstrip().startswith("#")]
    mark = ";" if ";" in lines[0] else ","
    header = [name.strip().strip('"') for name in lines[0].split(mark)]
    names = [name.split("[")[0].strip().lower() for name in header]
    if "x" not in names:
        problems.add(path, f"has no column x (its header is \"{lines[0][:60]}\") - name the columns x, y, z, volume in "
                     "the first line")
        return None
    has_units = any("[" in name for name in header)
    if not has_units and not units_text:
        problems.add(path, "names no units - write them in the header (x [mm]), or give --units mm")
    if "volume" not in names:
        problems.add(path, "has no column volume - add it, or write shape.points with the volume of the body by hand")
    bodies = None
    if "body" in names:
        at = names.index("body")
        rows = [line.split(mark) for line in lines[1:]]
        bodies = sorted({row[at].strip().strip('"') for row in rows if len(row) > at})
    return Cloud(text=text, bodies=bodies, dimension=3 if "z" in names else 2,
                 length_unit="" if has_units else units_text)


def read_xyz(path, units, spacing, problems):
    """Rows of positions, also behind a name and below a number of rows; the volume of each is spacing^3."""
    text = read_text(path, problems)
    if text is None:
        return None
    rows, bodies = [], []
    lines = text.splitlines()
    first = 2 if lines[0].strip().isdigit() else 0
    for at, line in enumerate(lines[first:], first + 1):
        words = line.replace(",", " ").split()
        if not words or line.lstrip().startswith(("#", "//")):
            continue
        named = not _is_number(words[0])
        try:
            rows.append([number(word.encode()) for word in words[named:named + 3]])
            bodies.append(words[0] if named else "")
        except ValueError:
            problems.add(f"{path}:{at}", f"\"{line.strip()[:40]}\" is no position (x y z, or a name and x y z)",
                         "is no position")
            continue
        if len(rows[-1]) < 3:
            problems.add(f"{path}:{at}", "has fewer than three numbers (x y z)", "has fewer than three numbers")
            rows.pop(), bodies.pop()
    if first and len(rows) != int(lines[0]) and not problems.texts:
        problems.add(path, f"promises {int(lines[0]):,} points and has {len(rows):,} - the file is cut off")
    if spacing is None:
        problems.add(path, "has no volumes - give --spacing: each point then has its third power as volume")
    problems.stop_if_any()
    X = np.array(rows) * units.length
    names = sorted(set(bodies)) if any(bodies) else None
    cloud = Cloud(X=X, volume=np.full(len(X), spacing**3), bodies=names)
    cloud.body_of = bodies
    return cloud


def _is_number(word):
    try:
        number(word.encode())
        return True
    except ValueError:
        return False


def kind_of(path):
    """"csv", "xyz" or nothing, by the ending."""
    return {".csv": "csv", ".xyz": "xyz", ".txt": "csv"}.get(Path(path).suffix.lower(), "")
