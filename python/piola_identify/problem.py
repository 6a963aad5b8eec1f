# SPDX-License-Identifier: Apache-2.0
"""The file that says what is to be found from what."""
import difflib
import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

KEYS = {"": {"parameter", "curve", "evaluations"},
        "parameter": {"key", "name", "start", "least", "most", "unit", "scale"},
        "curve": {"name", "case", "set", "file", "x", "y", "run_x", "run_y", "error"}}
NEEDED = {"parameter": ("key", "start", "least", "most"), "curve": ("case", "file", "x", "y", "run_x", "run_y")}


FILE_NAME = r"[A-Za-z0-9_+-][A-Za-z0-9_.+ -]*"  # what curves may be called, as their results are files


class Problem(Exception):
    """What is wrong with the input, a line each."""


@dataclass
class Parameter:
    key: str      # as in --set
    name: str
    start: float
    least: float
    most: float
    unit: str     # of the three numbers; empty: SI
    log: bool     # whether its logarithm is varied

    def setting(self, value):
        text = repr(float(value))
        return f'{self.key}="{text} {self.unit}"' if self.unit else f"{self.key}={text}"

    def inner(self, value):
        return math.log(value) if self.log else value

    def outer(self, value):
        return math.exp(value) if self.log else value


@dataclass
class Curve:
    name: str
    case: Path
    file: Path
    x: str       # columns of the file, or formulas in them
    y: str
    run_x: str   # columns of history.csv, or formulas in them
    run_y: str
    error: float  # standard deviation of y; 0: unknown, equal in all points
    settings: list = field(default_factory=list)


@dataclass
class Fit:
    parameters: list
    curves: list
    evaluations: int


class _Reader:
    def __init__(self, path):
        self.path, self.problems = Path(path), []

    def add(self, text):
        self.problems.append(f"{self.path}: {text}")

    def check(self, table, kind, name):
        for key in table:
            if key not in KEYS[kind]:
                near = difflib.get_close_matches(key, KEYS[kind], 1)
                self.add(f"{name} has an unknown key {key!r}"
                         + (f" - did you mean {near[0]!r}?" if near else f" (allowed: {', '.join(sorted(KEYS[kind]))})"))
        for key in NEEDED.get(kind, ()):
            if key not in table:
                self.add(f"{name} needs {key}")

    def number(self, table, key, name, preset=math.nan):
        value = table.get(key)
        if key not in table:
            return preset
        if isinstance(value, bool) or not isinstance(value, (int, float)) or not abs(value) < math.inf:
            self.add(f"{name}.{key} is {value!r} (allowed: a finite number)")
            return math.nan
        return float(min(max(value, -1e308), 1e308))

    def text(self, table, key, name, preset=""):
        value = table.get(key, preset)
        if not isinstance(value, str) or (key in table and not value.strip() and key != "unit"):
            self.add(f"{name}.{key} is {value!r} (allowed: a text)")
            return preset
        return value

    def unique(self, kind, entries, what):
        names = [getattr(entry, what) for entry in entries]
        for name in sorted({name for name in names if name and names.count(name) > 1}):
            self.add(f"{names.count(name)} {kind}s have the {what} {name!r} - give each its own")

    def parameter(self, table, number):
        name = f"parameter {number}"
        self.check(table, "parameter", name)
        start, least, most = (self.number(table, key, name) for key in ("start", "least", "most"))
        if not (least < most and least <= start <= most) and not math.isnan(start + least + most):
            self.add(f"{name}: start = {start:g} is not between least = {least:g} and most = {most:g}")
        scale = table.get("scale", "linear")
        if scale not in ("linear", "log"):
            self.add(f"{name}.scale is {scale!r} (allowed: \"linear\", \"log\")")
        if scale == "log" and not least > 0:
            self.add(f"{name}: scale = \"log\" needs least above 0")
        key = self.text(table, "key", name).strip()
        return Parameter(key, self.text(table, "name", name, key.rsplit(".", 1)[-1]), start, least, most,
                         self.text(table, "unit", name), scale == "log")

    def curve(self, table, number):
        name = f"curve {number}"
        self.check(table, "curve", name)
        error = self.number(table, "error", name, 0.0)
        if "error" in table and not error > 0:
            self.add(f"{name}.error is {error:g} (allowed: above 0, in SI; leave it out if it is unknown)")
        settings = table.get("set", [])
        if not (isinstance(settings, list) and all(isinstance(one, str) for one in settings)):
            self.add(f"{name}.set is {settings!r} (allowed: a list of texts as after --set)")
            settings = []
        title = self.text(table, "name", name, f"curve_{number}")
        if not re.fullmatch(FILE_NAME, title):
            self.add(f"{name}.name is {title!r} (allowed: letters, digits, blanks and _ . + -, as for a file)")
        texts = {key: self.text(table, key, name) for key in ("case", "file", "x", "y", "run_x", "run_y")}
        for key in ("case", "file"):
            texts[key] = self.path.parent / texts[key]
            if isinstance(table.get(key), str) and not texts[key].is_file():
                self.add(f"{name}.{key}: no file {texts[key]}")
        return Curve(name=title, error=error, settings=settings, **texts)


def read_fit(path):
    """Raises Problem with all that is wrong, a line each."""
    reader = _Reader(path)
    try:
        document = tomllib.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, UnicodeDecodeError, tomllib.TOMLDecodeError) as error:
        raise Problem(f"{path}: {error}") from error
    reader.check(document, "", "the file")
    lists = {kind: document.get(kind, []) for kind in ("parameter", "curve")}
    for kind, tables in lists.items():
        if not isinstance(tables, list) or not tables or not all(isinstance(table, dict) for table in tables):
            reader.add(f"has no [[{kind}]] - write one for each")
            lists[kind] = []
    parameters = [reader.parameter(table, n) for n, table in enumerate(lists["parameter"], 1)]
    curves = [reader.curve(table, n) for n, table in enumerate(lists["curve"], 1)]
    for kind, entries, what in (("parameter", parameters, "key"), ("parameter", parameters, "name"),
                                ("curve", curves, "name")):
        reader.unique(kind, entries, what)
    evaluations = document.get("evaluations", 30)
    if not isinstance(evaluations, int) or isinstance(evaluations, bool) or evaluations < 1:
        reader.add(f"evaluations is {evaluations!r} (allowed: a whole number from 1 on)")
    if reader.problems:
        raise Problem("\n".join(reader.problems))
    return Fit(parameters, curves, evaluations)
