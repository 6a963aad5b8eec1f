#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a run with piola.Results as pandas and xarray hold it: read_as_tables.py FOLDER PARTICLES.

Needs no compiled part of the module. Compares with what h5py and the csv module read.
"""
import csv
import importlib
import sys
import types
from pathlib import Path

import h5py
import numpy as np

SOURCE = Path(__file__).resolve().parents[2] / "python/piola"


def reader():
    """python/piola/results.py, without the library that the package loads."""
    package = types.ModuleType("piola")
    package.__path__ = [str(SOURCE)]
    sys.modules["piola"] = package
    return importlib.import_module("piola.results")


def main(folder, particles):
    results = reader().Results(folder)
    table = results.to_pandas()
    with open(Path(folder) / "history.csv", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert table.index.name == "time" and len(table) == len(rows) > 1, table
    assert [str(time) for time in table.index] == [str(float(row["time"])) for row in rows]
    assert table["kinetic_energy"].iloc[-1] == float(rows[-1]["kinetic_energy"])

    data = results.to_xarray()
    assert data.sizes["particle"] == particles and data.sizes["time"] == len(results.frames) > 1, data
    with h5py.File(sorted((Path(folder) / "frames").glob("*.hdf"))[-1]) as file:
        order = np.argsort(file["VTKHDF/PointData/Id"][:])
        for name in ("Pressure", "CauchyStress", "Velocity"):
            assert np.array_equal(data[name][-1], file[f"VTKHDF/PointData/{name}"][:][order]), name
    assert data.Pressure.attrs["units"] == "Pa" and np.any(data.Pressure[-1] != 0)


main(sys.argv[1], int(sys.argv[2]))
