// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include <filesystem>
#include <vector>

namespace piola {

/// Poses of free or rotating rigid shapes during a run, from its history.csv.
class RigidHistory {
 public:
  /// Empty if the file or its columns are missing.
  RigidHistory(std::filesystem::path const& history, std::vector<RigidSpec> const& rigids);
  /// Centres and rotations at a time [s], interpolated between rows.
  std::vector<RigidState> at(double time) const;

 private:
  struct Row {
    double time;
    std::vector<RigidState> states;
  };
  std::vector<Row> rows_;
};

}  // namespace piola
