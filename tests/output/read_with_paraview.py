#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Opens the index of a results folder as a user of ParaView does, with the reader that ParaView itself chooses.

Usage: read_with_paraview.py RESULTS PARTICLES
"""
import json
import sys
from pathlib import Path

from paraview.simple import OpenDataFile, UpdatePipeline

results, particles = Path(sys.argv[1]), int(sys.argv[2])
index = results / "frames.hdf.series"
times = [frame["time"] for frame in json.loads(index.read_text())["files"]]
reader = OpenDataFile(str(index))
assert reader is not None, "ParaView finds no reader"
assert list(reader.TimestepValues) == times, (list(reader.TimestepValues), times)
ranges = []
for time in times:
    UpdatePipeline(time, reader)
    information = reader.GetDataInformation()
    assert information.GetNumberOfPoints() == particles, information.GetNumberOfPoints()
    velocity = reader.PointData["Velocity"]
    assert velocity.GetNumberOfComponents() == 3 and reader.PointData["CauchyStress"].GetNumberOfComponents() == 6
    ranges.append(velocity.GetRange(0))
assert abs(ranges[0][1] - 5 * 2) < 5 * 0.3, ranges[0]  # 5*Z at the uppermost particles
assert ranges[0] != ranges[-1], "all times show the same frame"
print("good")
