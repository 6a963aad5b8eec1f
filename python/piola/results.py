# SPDX-License-Identifier: Apache-2.0
"""Results of a run, read from its folder."""
from __future__ import annotations

import importlib
import json
import os
import warnings
from typing import Dict, Iterable, Iterator, List, Optional, Sequence, Union, overload

import numpy as np

from . import _piola
from .case import Case
from .display import html_table
from .errors import CaseWarning, FileError, UnknownName
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
            raise UnknownName(f"there is no column {name!r} - {advice(name, self)}")
        return self[now]


class Quantities(Dict[str, float]):
    """Values by name, which refuse a name that they do not have with the nearest one."""

    def __missing__(self, name: str) -> float:
        raise UnknownName(f"there is no quantity {name!r} - {advice(name, self)}")


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
        name = present_name(_name(name))
        with _open(self.path) as file:
            data = file["VTKHDF/PointData"]
            stored = _stored_names(data)
            if name != "Position" and name not in stored:
                raise UnknownName(f"{self.path} has no field {name!r} (it has Position, {', '.join(sorted(stored))}) - "
                               f"{advice(name, ['Position', *stored])}")
            order = np.argsort(data["Id"][:], kind="stable")
            return (file["VTKHDF/Points"] if name == "Position" else data[stored[name]])[:][order]

    def __repr__(self) -> str:
        return f"<frame at t = {self.time:.6g} s of {self.path}>"


class Frames(Strict):
    """The frames of a run; times [s]."""
    _settable = ("times",)

    def __init__(self, paths: List[str], times: Sequence[float]):
        self._paths, self.times = paths, np.array(times, dtype=float)

    def __len__(self) -> int:
        return len(self._paths)

    @overload
    def __getitem__(self, number: int) -> Frame: ...

    @overload
    def __getitem__(self, number: slice) -> Frames: ...

    def __getitem__(self, number):
        """One frame by its number, from the end if it is negative, or several by a slice."""
        if isinstance(number, slice):
            return Frames(self._paths[number], self.times[number])
        try:
            return Frame(self._paths[number], float(self.times[number]))
        except IndexError:
            raise IndexError(f"there is no frame {number}: there are {len(self)}, which count from 0") from None
        except TypeError:
            raise TypeError(f"{number!r} is no number of a frame - use frames.at(time) for the one nearest to a "
                            "time") from None

    def __iter__(self) -> Iterator[Frame]:
        return (self[number] for number in range(len(self)))

    def at(self, time: float) -> Frame:
        """The frame that is nearest to a time [s]."""
        if not len(self):
            raise FileError("the run has written no frames: see [output.frames] every")
        return self[int(np.argmin(np.abs(self.times - time)))]

    def __repr__(self) -> str:
        span = f", t = {self.times[0]:.6g} to {self.times[-1]:.6g} s" if len(self) else ""
        return f"<{len(self)} frames{span}>"


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
        return Quantities({name: entry["value"] for name, entry in self.summary.get("quantities", {}).items()})

    @property
    def units(self) -> Dict[str, str]:
        """SI units of the columns of the history, "" where a column does not tell it by its name."""
        return {name: _piola.unit_of_column(name) for name in self.history}

    @property
    def frames(self) -> Frames:
        """The frames as a sequence: frames[3]["Pressure"], frames[-1], frames[2:5], frames.at(0.01), frames.times."""
        index = os.path.join(self.folder, "frames.hdf.series")
        entries = _json(index)["files"] if os.path.exists(index) else []
        return Frames([os.path.join(self.folder, entry["name"]) for entry in entries],
                      [entry["time"] for entry in entries])

    def to_pandas(self):
        """The history as a pandas.DataFrame, indexed by time; attrs["units"] has the unit of each column.

        Raises ImportError without python3-pandas.
        """
        pandas = _optional("pandas")
        table = pandas.DataFrame(dict(self.history)).set_index("time")
        table.attrs["units"] = self.units
        return table

    def to_xarray(self, fields: Optional[Iterable[str]] = None):
        """Fields of all frames (None: all) as an xarray.Dataset with the dimensions time and particle, in the order of
        the particles' ids, and component_3, _6 or _9 with the names of components; attrs["units"] is the SI unit.

        Raises ImportError without python3-xarray, KeyError for fields that the frames do not have.
        """
        xarray = _optional("xarray")
        frames = self.frames
        variables, coords = {}, {"time": ("time", frames.times, {"units": "s"})}
        units = frames[0].units if len(frames) else {}
        wanted = [fields] if isinstance(fields, str) else units if fields is None else fields
        for name in wanted if len(frames) else ():
            values = np.stack([frame[name] for frame in frames])
            dimensions = ["time", "particle"]
            if values.ndim == 3:
                dimensions.append(f"component_{values.shape[2]}")
                coords[dimensions[2]] = (dimensions[2], component_names(values.shape[2]))
            name = _piola.current_output_name(name)
            variables[name] = (dimensions, values, {"units": units[name]})
        return xarray.Dataset(variables, coords)

    def _about(self) -> dict:
        """What a short description says."""
        summary, file = self.summary, os.path.join(self.folder, "case.toml")
        case = Case.read(file)._about() if os.path.exists(file) else {}
        frames = self.frames
        time = summary.get("end_time", frames.times[-1] if len(frames) else None)
        quantities = (f"{name} = {entry['value']} {entry['unit']}".strip()
                      for name, entry in summary.get("quantities", {}).items())
        return {"title": summary.get("title", case.get("title", "")), "status": summary.get("status", "not finished"),
                "bodies": case.get("bodies", ""), "particles": summary.get("particles", ""),
                "time": "" if time is None else f"{time:.6g} s", "steps": summary.get("steps", ""),
                "frames": len(frames), "quantities": ", ".join(quantities), "folder": self.folder}

    def __repr__(self) -> str:
        about = self._about()
        title = about.pop("title")
        return f"<piola.Results {title!r}: " + ", ".join(f"{name} {what}" for name, what in about.items()
                                                         if what != "") + ">"

    def _repr_html_(self) -> str:
        about = self._about()
        return html_table(f"Results: {about.pop('title')}", about)


def component_names(components: int) -> List[str]:
    """Names of the components of a field: x y z, xx yy zz xy yz xz of a symmetric tensor, xx xy xz yx ... of another."""
    named = {3: "x y z", 6: "xx yy zz xy yz xz", 9: "xx xy xz yx yy yz zx zy zz"}
    return named[components].split() if components in named else [str(number) for number in range(components)]


def _optional(name: str):
    """A module that only some functions need."""
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise ImportError(f"{name} is not installed - install Debian's python3-{name}, or 'pip install {name}'") from error


def _name(name: object) -> str:
    if not isinstance(name, str):
        raise TypeError(f"{name!r} is no name of a field - frames have names such as 'Pressure'")
    return name


def _stored_names(data) -> Dict[str, str]:
    """Names in a file, by present names of the fields."""
    return {_piola.current_output_name(name): name for name in data}


def _open(path: str):
    h5py = _optional("h5py")
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
