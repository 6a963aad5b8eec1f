# SPDX-License-Identifier: Apache-2.0
"""Cases: what is to be run."""
from __future__ import annotations

import copy as copying
import os
import warnings
from typing import Any, Callable, Mapping, Optional, Union

import numpy as np

from . import _piola
from .display import html_table
from .errors import CaseWarning, FileError, InputError
from .keys import value_at, with_absolute_files
from .strict import Strict, advice
from .toml import document_text, value_text


class Body(Strict):
    """What functions give one body of a case instead of the case file.

    initial_velocity [m/s] and initial_displacement [m]: functions of (X, t) that are called once, with all points X of
    the body (n, 3) [m] and t = 0, and return (n, 3); or such arrays; or None for what the case file says.
    """
    _settable = ("initial_velocity", "initial_displacement")

    def __init__(self):
        self.initial_velocity: Optional[Any] = None
        self.initial_displacement: Optional[Any] = None


class Support(Strict):
    """velocity [m/s]: a function of (X, t) that is called once for each instant with all points X of the support (n, 3)
    [m] and the time t [s], and returns (n, 3), of which the fixed directions count; None for what the case file says.
    """
    _settable = ("velocity",)

    def __init__(self):
        self.velocity: Optional[Callable] = None


class _Named(Strict, dict):
    """Bodies or supports by name; supports also by number."""

    def __init__(self, kind, make):
        super().__init__()
        self._kind, self._make = kind, make

    def __missing__(self, name):
        entry = self._make()
        self[name] = entry
        return entry

    def __setitem__(self, name, entry):
        if not isinstance(entry, self._make):
            can = " or ".join(f"case.{self._kind}[{name!r}].{key} = ..." for key in self._make._settable)
            raise TypeError(f"case.{self._kind}[{name!r}] cannot be {entry!r} - set {can}")
        super().__setitem__(name, entry)


def _seconds_text(time: Any) -> str:
    return f"{time} s" if isinstance(time, (int, float)) else str(time)


class Case(Strict):
    """A case: a text in TOML, or a dict of the same structure, with settings that replace values of it.

    Nothing is read or checked before check(), particles or Run ask for it. Raises InputError then, with all that is
    wrong.
    """
    _settable = ("body", "support")

    def __init__(self, source: Union[str, Mapping], set: Optional[Mapping[str, Any]] = None):
        if not isinstance(source, (str, Mapping)):
            raise TypeError("a case is made of a text in TOML or of a dict; Case.read(path) reads a file")
        self._file = ""
        self._text = source if isinstance(source, str) else document_text(dict(source))
        self._settings: dict = {}
        self._read = None
        self._written: Optional[tuple] = None  # the text with the settings and its values
        self._of_results = False  # the files that it names are those that a results folder keeps
        self.body = _Named("body", Body)
        self.support = _Named("support", Support)
        for key, value in (set or {}).items():
            self[key] = value

    @classmethod
    def read(cls, path: Union[str, os.PathLike], set: Optional[Mapping[str, Any]] = None) -> "Case":
        """The case of a file, or of the case.toml in a folder; `set` as in __setitem__."""
        case = cls("", set)
        case._file = os.fspath(path)
        return case

    def __setitem__(self, key: str, value: Any) -> None:
        """Replaces a value: case["run.end"] = "20 ms", case["body.column.material.poissons_ratio"] = 0.499.

        The same keys as those of --set on the command line. Raises ValueError, TypeError for values that no case file
        can hold.
        """
        value_text(value)
        self._settings[key] = value
        self._read = self._written = None

    def __getitem__(self, key: str) -> Any:
        """A copy of a value as it is written, with the settings: case["run.end"] may be "20 ms" or 0.02.

        The same keys as in __setitem__. Raises KeyError with the nearest valid key where the case gives none, and
        InputError if the case cannot be read.
        """
        return value_at(self._document()[1], key)

    def __contains__(self, key: str) -> bool:
        """Whether the case gives a value."""
        try:
            value_at(self._document()[1], key)
        except KeyError:
            return False
        return True

    __iter__ = None  # else [] with numbers would be tried

    def __eq__(self, other: Any) -> bool:
        """Whether another case has the same values, as they are written, and the same Python functions."""
        if not isinstance(other, Case):
            return NotImplemented
        mine, others = self._functions(), other._functions()
        return (self._document()[1] == other._document()[1] and mine.keys() == others.keys()
                and all(np.array_equal(mine[name], others[name]) for name in mine))

    def to_dict(self) -> dict:
        """All values as they are written, with the settings: Case(case.to_dict()) is the same case."""
        return copying.deepcopy(self._document()[1])

    def save(self, path: Union[str, os.PathLike]) -> None:
        """Writes the case with its settings to a case file, or to the case.toml of a folder, which is replaced.

        Files that the case names get absolute paths if it moves to another folder. Functions cannot be written, which
        a CaseWarning says. Raises InputError, FileError.
        """
        path = os.path.join(path, "case.toml") if os.path.isdir(path) else os.fspath(path)
        text, values = self._document()
        folder = self._folder()
        if folder != os.path.dirname(os.path.abspath(path)):
            moved = with_absolute_files(values, folder)
            text = text if moved == values else document_text(moved)
        if self._functions():
            warnings.warn(f"{path}: the Python functions of the case are not in the file", CaseWarning, stacklevel=2)
        try:
            with open(path + ".part", "w", encoding="utf-8") as file:
                file.write(text)
            os.replace(path + ".part", path)
        except OSError as error:
            raise FileError(f"{path}: cannot be written ({error.strerror}) - give a file in a folder that you may "
                            "write to") from error

    def copy(self, set: Optional[Mapping[str, Any]] = None) -> "Case":
        """Another case like this one, with more settings."""
        other = copying.copy(self)
        other._settings = dict(self._settings)
        other.body, other.support = copying.deepcopy(self.body), copying.deepcopy(self.support)
        for key, value in (set or {}).items():
            other[key] = value
        return other

    def overrides(self) -> list:
        """The settings as "key=value"."""
        return [f"{key}={value_text(value)}" for key, value in self._settings.items()]

    def check(self) -> list:
        """Reads the case and builds its particles and its formulation. Returns what looks doubtful, a text each.

        Raises InputError with all that is wrong.
        """
        self._known_names(self._case())
        return _piola.warnings(self._case())

    @property
    def title(self) -> str:
        return self._case().title

    @property
    def bodies(self) -> list:
        """Names of the bodies."""
        return [name for name, _, _ in self._case().bodies]

    @property
    def X(self) -> np.ndarray:
        """Reference positions of all particles [m], (n, 3), read-only."""
        return self._case().X

    @property
    def volume(self) -> np.ndarray:
        """Volumes of all particles [m^3; m^2 per unit thickness in 2D], (n), read-only."""
        return self._case().volume

    def __repr__(self) -> str:
        about = self._about()
        title = about.pop("title", "")
        return f"<piola.Case {title!r}: " + ", ".join(f"{name} {what}" for name, what in about.items() if what) + ">"

    def _repr_html_(self) -> str:
        about = self._about()
        return html_table(f"Case: {about.pop('title', '')}", about)

    def _about(self) -> dict:
        """What a short description says. Makes no particles, which may take long."""
        about = {"file": self._file}
        try:
            values = self._document()[1]
        except InputError as error:
            return {**about, "problems": str(error)}
        bodies, run = values.get("body", []), values.get("run", {})
        names = [body.get("name", "?") for body in bodies if isinstance(body, dict)] if isinstance(bodies, list) else []
        made = len(self._read.X) if self._read is not None else "not made yet (check() makes them)"
        return {"title": values.get("title", ""), "bodies": ", ".join(map(str, names)), "particles": made,
                "end": _seconds_text(run.get("end", "")) if isinstance(run, dict) else "", **about}

    def _document(self) -> tuple:
        """The text with the settings, and its values."""
        if self._written is None:
            self._written = _piola.document(self._file, self._text, "case", self.overrides())
        return self._written

    def _folder(self) -> str:
        """Where relative paths in the case start."""
        file = os.path.abspath(self._file) if self._file else ""
        return os.getcwd() if not file else file if os.path.isdir(file) else os.path.dirname(file)

    def _case(self):
        if self._read is None:
            self._read = _piola.read(self._file, self._text, "case", self.overrides(), self._of_results)
        return self._read

    def _functions(self) -> dict:
        """The functions and arrays that were set, by place."""
        return {(name, key): getattr(entry, key) for named in (self.body, self.support)
                for name, entry in named.items() for key in entry._settable if getattr(entry, key) is not None}

    def _known_names(self, case) -> None:
        problems = []
        bodies, supports = [name for name, _, _ in case.bodies], list(case.supports)
        for key in self.body:
            if key not in bodies:
                problems.append(f"there is no body {key!r} (bodies: {', '.join(bodies)}) - {advice(str(key), bodies)}")
        for key in self.support:
            if key not in supports and not (isinstance(key, int) and 0 <= key < len(supports)):
                problems.append(f"there is no support {key!r} (supports: {', '.join(supports) or 'none'}) - "
                                f"{advice(str(key), supports)}")
        if problems:
            raise InputError("\n".join(problems))

    def _given(self) -> tuple:
        """Initial velocities, initial displacements, velocities of supports, as the library takes them."""
        case = self._case()
        self._known_names(case)
        ranges = {name: (first, last) for name, first, last in case.bodies}
        velocity, displacement = {}, {}
        for name, body in self.body.items():
            X = case.X[slice(*ranges[name])]
            for what, out in ((body.initial_velocity, velocity), (body.initial_displacement, displacement)):
                if what is not None:
                    out[name] = np.asarray(what(X.copy(), 0.0) if callable(what) else what, dtype=float)
        moved = {case.supports[key] if isinstance(key, int) else key: support.velocity
                 for key, support in self.support.items() if support.velocity is not None}
        return velocity, displacement, moved
