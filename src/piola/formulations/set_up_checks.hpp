// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>
#include <vector>

namespace piola {

class Formulation;

/// A number that tells how good a part of the set-up is.
struct SetUpCheck {
  std::string name;  ///< with the body or the load that it belongs to: "bar.closure_residual"
  double value = 0;
  std::string warning;  ///< for the user; empty: all is well
};

/// A formulation that measures its set-up, or is made of such.
class SetUpChecked {
 public:
  virtual ~SetUpChecked() = default;
  virtual std::vector<SetUpCheck> set_up_checks() const = 0;
};

/// How good the set-up of a formulation is, for the log and the summary; nothing where it does not measure it.
std::vector<SetUpCheck> set_up_checks_of(Formulation const& formulation);

}  // namespace piola
