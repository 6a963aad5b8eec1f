// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Meaning of a column of a table. The first three are components of a position.
enum class CloudColumn { x, y, z, volume, kernel_volume, body, unused };

/// The columns of a table, from its header.
struct CloudHeader {
  int dimension = 0;  ///< 0: the header cannot be used
  char separator = ',';
  std::vector<CloudColumn> columns;
  std::vector<double> factor;              ///< of each column, to SI
  std::string names;                       ///< "x, y, volume"
  std::vector<std::string_view> not_used;  ///< names of columns that mean nothing here
  std::array<bool, 7> has{};               ///< by CloudColumn
};

/// Reads the header, line number `line` of the file. What is wrong with it is added to `problems`.
CloudHeader read_cloud_header(std::string_view text, std::string const& place, double length_unit,
                              std::vector<std::string>& problems);

}  // namespace piola
