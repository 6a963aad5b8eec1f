#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Reads a frame with h5py and checks it against the VTKHDF 1.0 layout.

Usage: read_frame.py FRAME.hdf TIME PARTICLES       exit status 0: good, 1: not, 77: h5py is missing
"""
import sys

try:
    import h5py
    import numpy
except ImportError:
    print("skipped: python3-h5py is not installed")
    sys.exit(77)

path, time, particles = sys.argv[1], float(sys.argv[2]), int(sys.argv[3])
with h5py.File(path, "r") as file:
    vtk = file["VTKHDF"]
    assert list(vtk.attrs["Version"]) == [1, 0], vtk.attrs["Version"]
    assert vtk.attrs["Type"] in (b"UnstructuredGrid", "UnstructuredGrid"), vtk.attrs["Type"]
    for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
        assert vtk[name].shape == (1,) and vtk[name][0] == particles, name
    assert vtk["Points"].shape == (particles, 3) and vtk["Points"].dtype == numpy.float32
    assert (vtk["Connectivity"][:] == numpy.arange(particles)).all()
    assert (vtk["Offsets"][:] == numpy.arange(particles + 1)).all()
    assert vtk["Types"].dtype == numpy.uint8 and (vtk["Types"][:] == 1).all()
    assert vtk["FieldData/TimeValue"].dtype == numpy.float64 and vtk["FieldData/TimeValue"][0] == time
    data = vtk["PointData"]
    assert (data["Id"][:] == numpy.arange(particles)).all()
    assert data["CauchyStress"].shape == (particles, 6) and data["CauchyStress"].dtype == numpy.float32
    expected = (1e6 * numpy.sin(0.3 * numpy.arange(particles))).astype(numpy.float32)
    assert (data["Pressure"][:] == expected).all()
print("good")
