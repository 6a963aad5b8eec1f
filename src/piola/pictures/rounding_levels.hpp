// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/history.hpp"
#include <filesystem>
#include <map>
#include <string>

namespace piola {

/// The magnitudes below which columns of a run's history contain only round-off.
class RoundingLevels {
 public:
  /// Reads the scales of summary.json by unit; without a summary columns are only compared with each other.
  RoundingLevels(HistoryTable const& table, std::filesystem::path const& folder);

  /// 1e-12 of the largest known scale of a column: that of its unit (summary.json; energies: the largest energy
  /// column), and the largest value among the components of its vector or tensor. Zero if unknown.
  double of(std::string const& column) const;

  /// Whether a level is known for a column and no finite value is above it.
  bool is_rounding(std::string const& column) const;

 private:
  double largest(std::string const& column) const;

  HistoryTable const& table_;
  std::map<std::string, double> scale_;  ///< by unit, SI
};

}  // namespace piola
