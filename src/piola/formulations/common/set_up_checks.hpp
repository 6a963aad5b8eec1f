// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace piola {

class Formulation;

/// A number that measures the quality of a part of the set-up.
struct SetUpCheck {
  std::string name;  ///< with its body or load: "bar.closure_residual"
  double value = 0;
  std::string warning;  ///< for the user; empty: no problem
};

/// A formulation that measures its set-up, or contains such formulations.
class SetUpChecked {
 public:
  virtual ~SetUpChecked() = default;
  virtual std::vector<SetUpCheck> set_up_checks() const = 0;
};

/// The set-up checks of a formulation, for the log and the summary; empty if it has none.
std::vector<SetUpCheck> set_up_checks_of(Formulation const& formulation);

}  // namespace piola
