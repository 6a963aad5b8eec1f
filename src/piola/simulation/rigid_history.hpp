// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/case_spec.hpp"
#include "piola/mechanics/rigid_state.hpp"
#include <filesystem>
#include <vector>

namespace piola {

/// Where rigid shapes that are free or turn stood in a run, from its history.csv.
class RigidHistory {
 public:
  /// Without a file or its columns nothing is known.
  RigidHistory(std::filesystem::path const& history, std::vector<RigidSpec> const& rigids);
  /// Centres and turns at a time [s], between the rows around it.
  std::vector<RigidState> at(double time) const;

 private:
  struct Row {
    double time;
    std::vector<RigidState> states;
  };
  std::vector<Row> rows_;
};

}  // namespace piola
