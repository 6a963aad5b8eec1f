# SPDX-License-Identifier: Apache-2.0
"""Results of a run, read from its folder."""
from __future__ import annotations

import json
import os
import warnings
from typing import Dict, Iterator, List, Union

import numpy as np

from . import _piola
from .errors import CaseWarning, FileError
from .strict import Strict, advice


def present_name(name: str) -> str:
    """The present name of a column or field, with a CaseWarning for a name of the previous minor release."""
    now = _piola.current_output_name(name)
    if now != name:
        warnings.warn(f"{name!r} is now {now!r} - write this, since the next minor release refuses the other",
                      CaseWarning, stacklevel=3)
    return now


class Columns(Dict[str, np.ndarray]):
    """Columns by name. A name of the previous minor release gives the column of today."""

    def __missing__(self, name: str) -> np.ndarray:
        now = present_name(name)
        if now not in self:
            raise KeyError(name)
        return self[now]


def read_table(path: str) -> Columns:
    """The columns of a CSV file with a header; empty cells are nan."""
    with open(path, encoding="utf-8") as file:
        names = [_piola.current_output_name(name) for name in file.readline().strip().split(",")]
        rows = [[float(cell) if cell else np.nan for cell in line.rstrip("\n").split(",")] for line in file]
    values = np.array([row for row in rows if len(row) == len(names)]).reshape(-1, len(names))
    return Columns({name: values[:, column] for column, name in enumerate(names)})


class Frame(Strict):
    """One instant: fields by name, read when they are asked for, in the order of the particles' ids.

    Shapes: (n), or (n, components). "Position" is where the particles are [m]; "Body" numbers their bodies.
    """
    _settable = ("path", "time")

    def __init__(self, path: str, time: float):
        self.path, self.time = path, time

    @property
    def fields(self) -> List[str]:
        """The names that [] knows."""
        with _open(self.path) as file:
            return ["Position"] + sorted(_stored_names(file["VTKHDF/PointData"]))

    @property
    def units(self) -> Dict[str, str]:
        """The SI unit of each field, e.g. {"Pressure": "Pa"}."""
        with _open(self.path) as file:
            data = file["VTKHDF/PointData"]
            stored = _stored_names(data)
            return {"Position": "m"} | {name: _text(data[stored[name]].attrs.get("unit", "")) for name in sorted(stored)}

    def __getitem__(self, name: str) -> np.ndarray:
        name = present_name(name)
        with _open(self.path) as file:
            data = file["VTKHDF/PointData"]
            stored = _stored_names(data)
            if name != "Position" and name not in stored:
                raise KeyError(f"{self.path} has no field {name!r} (it has Position, {', '.join(sorted(stored))}) - "
                               f"{advice(name, ['Position', *stored])}")
            order = np.argsort(data["Id"][:], kind="stable")
            return (file["VTKHDF/Points"] if name == "Position" else data[stored[name]])[:][order]

    def __repr__(self) -> str:
        return f"<frame at t = {self.time:.6g} s of {self.path}>"


class Frames(Strict):
    """The frames of a run; times [s]."""
    _settable = ("times",)

    def __init__(self, folder: str):
        index = os.path.join(folder, "frames.hdf.series")
        entries = _json(index)["files"] if os.path.exists(index) else []
        self.times = np.array([entry["time"] for entry in entries], dtype=float)
        self._paths = [os.path.join(folder, entry["name"]) for entry in entries]

    def __len__(self) -> int:
        return len(self._paths)

    def __getitem__(self, number: int) -> Frame:
        return Frame(self._paths[number], float(self.times[number]))

    def __iter__(self) -> Iterator[Frame]:
        return (self[number] for number in range(len(self)))

    def at(self, time: float) -> Frame:
        """The frame that is nearest to a time [s]."""
        if not len(self):
            raise FileError("the run has written no frames: see [output.frames] every")
        return self[int(np.argmin(np.abs(self.times - time)))]


class Results(Strict):
    """What a run has written to its folder so far. Needs numpy, and h5py for frames. Raises FileError."""
    _settable = ("folder",)

    def __init__(self, folder: Union[str, os.PathLike]):
        self.folder = os.fspath(folder)
        if not os.path.exists(os.path.join(self.folder, "log.txt")):
            raise FileError(f"{self.folder}: holds no results of a run - give the folder that the run wrote to")

    @property
    def history(self) -> Columns:
        """The columns of history.csv, in SI units."""
        return read_table(os.path.join(self.folder, "history.csv"))

    @property
    def summary(self) -> dict:
        """summary.json; empty as long as the run goes on."""
        path = os.path.join(self.folder, "summary.json")
        return _json(path) if os.path.exists(path) else {}

    @property
    def quantities(self) -> Dict[str, float]:
        """The measured quantities of the summary, by name."""
        return {name: entry["value"] for name, entry in self.summary.get("quantities", {}).items()}

    @property
    def frames(self) -> Frames:
        """The frames as a sequence: frames[3]["Pressure"], frames[-1], frames.at(0.01), frames.times."""
        return Frames(self.folder)

    def to_pandas(self):
        """The history as a pandas.DataFrame, indexed by time."""
        import pandas
        return pandas.DataFrame(self.history).set_index("time")

    def to_xarray(self):
        """All fields of all frames as an xarray.Dataset with the dimensions time and particle, in the order of the
        particles' ids; attrs["units"] of each variable is its SI unit."""
        import xarray
        frames = list(self.frames)
        units = frames[0].units if frames else {}
        variables = {}
        for name in frames[0].fields if frames else []:
            values = np.stack([frame[name] for frame in frames])
            more = () if values.ndim == 2 else (f"component_{values.shape[2]}",)
            variables[name] = (("time", "particle") + more, values, {"units": units[name]})
        return xarray.Dataset(variables, coords={"time": ("time", self.frames.times, {"units": "s"})})


def _stored_names(data) -> Dict[str, str]:
    """Names in a file, by present names of the fields."""
    return {_piola.current_output_name(name): name for name in data}


def _open(path: str):
    import h5py
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise FileError(f"{path}: cannot be read ({error})") from error


def _text(value) -> str:
    return value.decode() if isinstance(value, bytes) else str(value)


def _json(path: str) -> dict:
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except (OSError, ValueError) as error:
        raise FileError(f"{path}: cannot be read ({error})") from error
