// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <filesystem>
#include <string>
#include <vector>

namespace piola {

/// A list of numbers in an HDF5 file of another program.
struct DataColumn {
  std::string name;
  std::string unit;  ///< of the attribute `unit` or `units`; empty: there is none
  std::vector<double> values;
};

/// The numbers of one group.
struct DataColumns {
  std::vector<DataColumn> columns;  ///< by name; a table of places is the columns x, y, z
  std::vector<std::string> others;  ///< names of what is neither a list of numbers nor places
};

/// Reads the lists of a group ("/" for the file itself). A table of two or three columns that is called points,
/// positions, position, coordinates, xyz or X (small and capital letters alike) counts as places. A copy of this
/// process reads, because HDF5 can crash on damaged files. Throws FileError: "PATH: ...".
DataColumns read_data_columns(std::filesystem::path const& path, std::string const& group);

}  // namespace piola
