// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// The particles of one body, read from a file. Lengths in m, volumes in m^dimension; unused components are zero.
struct PointCloud {
  int dimension = 3;
  std::vector<std::array<double, 3>> X;
  std::vector<double> volume;          ///< sums to the volume of the body
  std::vector<double> kernel_volume;   ///< the volume again unless the file gives it
  double spacing = 0;                  ///< (total volume / number of points)^(1 / dimension)
  std::array<double, 3> min{}, max{};  ///< box around the points; the body may reach half a spacing beyond it
  std::vector<std::string> notes;      ///< notes for the user that require no change
};

/// Settings of the case file for a file of points.
struct CloudOptions {
  double length_unit = 1;                   ///< m; of a table whose header gives no units; volumes are in its power
  std::optional<double> total_volume = {};  ///< [m^dimension], divided equally among the points
  std::string body = {};                    ///< only the rows of this body; empty: all rows
  std::string group = {};                   ///< of an HDF5 file of another program; empty: the file itself
};

/// Reads a table (CSV with a header: x[,y[,z]], and volume, kernel_volume, body if they are there; docs/user/clouds.md)
/// or, if the name ends in .hdf, .h5, .hdf5 or .vtkhdf, a frame of an earlier run or the lists of numbers in an HDF5
/// file of another program, which are called as the columns of a table. What is wrong with the file or with
/// the points in it is added to `problems`, everything at once, and the cloud is not to be used then. Never throws on a
/// bad file. Checked are: numbers that are finite and not absurd, positive volumes, enough points, no two too close,
/// volumes that fit the distances, a gradient that can be formed everywhere.
PointCloud read_cloud(std::string const& path, CloudOptions const& options, std::vector<std::string>& problems);

/// Reads the text of a table. `name` replaces the file name in messages.
PointCloud read_cloud_text(std::string_view text, std::string const& name, CloudOptions const& options,
                           std::vector<std::string>& problems);

}  // namespace piola
