// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Where points come from, for messages about them.
struct CloudSource {
  std::string file;
  bool lines = true;              ///< points are lines of a text, otherwise particles of a frame
  std::vector<std::int64_t> row;  ///< line (from 1) or particle (from 0) of each point

  /// "FILE:7" or "FILE, particle 6", in front of a message.
  std::string place(std::size_t point) const;
  /// "line 7" or "particle 6", inside a message.
  std::string name(std::size_t point) const;
};

/// The points of a file in their order there, in SI units, unchecked.
struct CloudTable {
  CloudSource source;
  int dimension = 3;
  std::vector<std::array<double, 3>> X;
  std::vector<double> volume, kernel_volume;  ///< empty if the file does not give them
  std::vector<int> body;                      ///< index into bodies; empty if the file does not give it
  std::vector<std::string> bodies;
  std::vector<std::string> notes;
};

/// Reads a table of points. `length_unit` [m] counts where the header gives no units.
CloudTable read_cloud_table(std::string_view text, std::string const& name, double length_unit,
                            std::vector<std::string>& problems);

}  // namespace piola
