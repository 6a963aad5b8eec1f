// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <string>

namespace piola {

/// A number that measures the quality of a part of the set-up.
struct SetUpCheck {
  std::string name;  ///< with its body or load: "bar.divergence_error"
  double value = 0;
  std::string warning;  ///< for the user; empty: no problem
};

}  // namespace piola
