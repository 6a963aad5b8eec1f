# SPDX-License-Identifier: Apache-2.0
"""Runs: cases in motion."""
from __future__ import annotations

import json
import math
import os
import warnings
import weakref
from typing import Any, Callable, Dict, Mapping, NamedTuple, Optional, Union

import numpy as np

from . import _piola
from .case import Case
from .display import html_table
from .errors import CaseWarning, UnknownName
from .progress import ProgressLine
from .results import Columns, present_name
from .strict import Strict, advice

STOP = object()
"""What an observer returns to stop the run; it can go on afterwards."""

Time = Union[float, int, str]


class Field(NamedTuple):
    """A field of the particles: unit in SI, 1, 3, 6 (XX YY ZZ XY YZ XZ) or 9 (row by row) components."""
    unit: str
    components: int


def seconds(time: Time) -> float:
    """A time in seconds, from a number [s] or a text such as "20 ms". Raises InputError."""
    value = _piola.seconds(time) if isinstance(time, str) else float(time)
    if math.isnan(value) or value < 0:
        raise ValueError(f"{time!r} is no time from 0 on")
    return value


class Run(Strict):
    """A run of a case.

    out: the folder for its results (as `piola run --out`; replaced if it holds an earlier run of the same case); None:
    no files at all. force: use the folder even if it holds other things.
    Raises InputError, FileError. Warnings of the case are given as CaseWarning.
    """

    def __init__(self, case: Case, out: Union[None, str, os.PathLike] = None, *, force: bool = False):
        self._start(case, "" if out is None else os.fspath(out), False, force)

    @classmethod
    def resume(cls, folder: Union[str, os.PathLike], case: Optional[Case] = None,
               set: Optional[Mapping[str, Any]] = None) -> "Run":
        """Continues the run in a folder from its newest checkpoint, bit for bit.

        case: needed if functions gave the run something; `set` may make run.end later.
        """
        folder = os.fspath(folder)
        run = cls.__new__(cls)
        case = (case or Case.read(os.path.join(folder, "case.toml"))).copy(set)
        case._of_results, case._read = True, None
        run._start(case, folder, True, False)
        return run

    def _start(self, case: Case, folder: str, resume: bool, force: bool) -> None:
        self._read = case._case()
        self._session = _piola.Session(self._read, folder, resume, force, *case._given())
        self._summary: Optional[dict] = None
        self._warn()

    def _warn(self) -> None:
        for text in self._session.take_warnings():
            warnings.warn(text, CaseWarning, stacklevel=4)

    # What does not change -------------------------------------------------------------------------------------------
    @property
    def X(self) -> np.ndarray:
        """Reference positions [m], (n, 3): a read-only view."""
        return self._session.X

    @property
    def volume(self) -> np.ndarray:
        """Volumes [m^3; per unit thickness in 2D], (n): a read-only view."""
        return self._session.volume

    @property
    def body(self) -> np.ndarray:
        """Number of each particle's body, (n): a read-only view."""
        return self._session.body

    @property
    def mass(self) -> float:
        """Of all bodies and rigid shapes [kg]."""
        return self._session.mass

    @property
    def end(self) -> float:
        """When the run ends [s]."""
        return self._session.end

    @property
    def fields(self) -> Dict[str, Field]:
        """The fields that field() knows."""
        return {name: Field(unit, components) for name, unit, components in self._session.fields}

    # Where it stands ------------------------------------------------------------------------------------------------
    @property
    def time(self) -> float:
        """[s]"""
        return self._session.time

    @property
    def steps(self) -> int:
        """Steps done."""
        return self._session.step

    @property
    def dt(self) -> float:
        """The last step [s]."""
        return self._session.dt

    @property
    def stable_step(self) -> float:
        """The step that the present state asks for [s]."""
        return self._session.stable_step

    @property
    def energy(self) -> Dict[str, float]:
        """Energies and works [J]: kinetic, strain, total, external_work, stabilisation_loss and more."""
        return self._session.energies

    @property
    def momentum(self) -> np.ndarray:
        """Linear momentum [kg m/s], (3)."""
        return np.array(self._session.momentum)

    @property
    def angular_momentum(self) -> np.ndarray:
        """About the origin [kg m^2/s], (3)."""
        return np.array(self._session.angular_momentum)

    @property
    def history(self) -> Columns:
        """The columns of history.csv so far, by name, in SI units."""
        return Columns({name: values for name, (_, values) in self._session.history.items()})

    @property
    def history_units(self) -> Dict[str, str]:
        """Units of the columns."""
        return {name: unit for name, (unit, _) in self._session.history.items()}

    def field(self, name: str, out: Optional[np.ndarray] = None) -> np.ndarray:
        """Values of a field now: a new array (n) or (n, components), or `out` filled.

        Raises KeyError for a field that is not in `fields`, ValueError or TypeError for an array that does not fit.
        """
        name = present_name(name)
        try:
            values = self._session.field(name, out)
        except KeyError:
            raise UnknownName(f"there is no field {name!r} - {advice(name, self.fields)}") from None
        return values if out is None else out

    # Going on -------------------------------------------------------------------------------------------------------
    def step(self, n: int = 1) -> bool:
        """Takes n steps, or fewer if the run ends. Returns whether it has ended."""
        if n < 0:
            raise ValueError("a number of steps from 0 on is needed")
        return self._advance(math.inf, n, False) if n else self.time >= self.end

    def advance(self, until: Time, exact: bool = False) -> bool:
        """Runs to the first step at or after `until` [s, or a text with a unit]; exact: cuts the last step so that it
        ends there, which changes the steps that follow. Returns whether the run has ended.

        Raises PhysicsError once the last state was written, what an observer raised, KeyboardInterrupt.
        """
        return self._advance(seconds(until), -1, exact)

    def _advance(self, until: float, steps: int, exact: bool) -> bool:
        try:
            return self._session.advance(until, steps, exact)
        finally:
            self._warn()

    def finish(self, progress: bool = False) -> dict:
        """Runs to the end (or to where an observer stops it), closes the results and returns the summary, as in
        summary.json. Raises as advance does; close() then gives the summary.

        progress: shows one line on sys.stdout, also in notebooks, with the time left as estimated from the time that it
        took so far. It does not change the bits of the run.
        """
        if self._summary is None:
            line = self.observe(ProgressLine(self)) if progress else None
            try:
                self._advance(math.inf, -1, False)
            finally:
                if line:
                    line.close(self)
        return self.close()

    def close(self) -> dict:
        """Closes the results where the run stands, with a checkpoint if it writes any, and returns the summary."""
        if self._summary is None:
            self._close()
        return self._summary

    def _close(self) -> None:
        self._summary = json.loads(self._session.finish())
        self._warn()

    def __enter__(self) -> "Run":
        return self

    def __exit__(self, *what) -> None:
        self.close()

    def observe(self, call: Optional[Callable] = None, *, every: Union[None, Time] = None) -> Callable:
        """Calls a function with this run now and at each multiple of `every` (None: after each step).

            @run.observe(every="1 ms")
            def see(run): ...

        It may look but not change anything. If it returns STOP the run holds there; what it raises ends advance().
        """
        if call is None:
            return lambda function: self.observe(function, every=every)
        interval = 0.0 if every is None else seconds(every)
        if every is not None and interval == 0:
            raise ValueError("every: a time above 0 is needed")
        me = weakref.ref(self)
        self._session.observe(lambda: call(me()) is STOP, interval)
        return call

    # The state ------------------------------------------------------------------------------------------------------
    def state(self) -> Dict[str, np.ndarray]:
        """All that evolves, by the names of the checkpoint, and where the run stands ("run": time, step, dt, first
        step)."""
        state = dict(self._session.state())
        state["run"] = np.array([self.time, self.steps, self.dt, self._session.first_dt])
        return state

    def load(self, state: Mapping[str, np.ndarray]) -> None:
        """Puts back what state() gave, for a run of the same case that writes no files; its history goes on.

        Raises ValueError if the run writes files, FileError if names or sizes do not fit.
        """
        arrays = {name: values for name, values in state.items() if name != "run"}
        time, step, dt, first = (float(value) for value in state["run"])
        self._session.load(arrays, time, int(step), dt, first)

    @property
    def status(self) -> str:
        """"running" until the results are closed, then as in the summary: completed, stopped or failed."""
        return "running" if self._summary is None else self._summary["status"]

    def _about(self) -> dict:
        """What a short description says."""
        bodies = (f"{name} ({last - first} particles)" for name, first, last in self._read.bodies)
        quantities = (f"{name} = {entry['value']} {entry['unit']}".strip()
                      for name, entry in (self._summary or {}).get("quantities", {}).items())
        return {"status": self.status, "time": f"{self.time:.6g} s of {self.end:.6g} s", "step": self.steps,
                "particles": len(self.X), "bodies": ", ".join(bodies), "quantities": ", ".join(quantities)}

    def __repr__(self) -> str:
        about = ", ".join(f"{name} {what}" for name, what in self._about().items() if what != "")
        return f"<piola.Run {self._read.title!r}: {about}>"

    def _repr_html_(self) -> str:
        return html_table(f"Run: {self._read.title}", self._about())
