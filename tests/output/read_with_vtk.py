#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads all frames of a results folder with vtkHDFReader and compares them with the case of tools/check_readers.

Usage: read_with_vtk.py RESULTS PARTICLES
"""
import json
import sys
from pathlib import Path

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOHDF import vtkHDFReader

results, particles = Path(sys.argv[1]), int(sys.argv[2])
frames = json.loads((results / "frames.hdf.series").read_text())["files"]
assert len(frames) == 5, len(frames)
for number, frame in enumerate(frames):
    reader = vtkHDFReader()
    assert reader.CanReadFile(str(results / frame["name"])), frame
    reader.SetFileName(str(results / frame["name"]))
    reader.Update()
    grid = reader.GetOutput()
    assert grid.GetNumberOfPoints() == particles and grid.GetNumberOfCells() == particles, grid.GetNumberOfPoints()
    data = grid.GetPointData()
    ids = vtk_to_numpy(data.GetArray("Id"))
    assert sorted(ids) == list(range(particles))
    velocity, stress = (vtk_to_numpy(data.GetArray(name)) for name in ("Velocity", "CauchyStress"))
    assert velocity.shape == (particles, 3) and stress.shape == (particles, 6), (velocity.shape, stress.shape)
    points = vtk_to_numpy(grid.GetPoints().GetData())
    if number == 0:  # initial_velocity = ["5*Z", "0", "0"]
        assert abs(velocity[:, 0] - 5 * points[:, 2]).max() < 1e-5 and not velocity[:, 1:].any()
        assert points[:, 2].min() >= 0 and points[:, 2].max() <= 2
print("good")
