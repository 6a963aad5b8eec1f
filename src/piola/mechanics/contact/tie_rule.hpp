// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace piola::contact {

/// What holds the surfaces of two bodies together where they touch at the start.
struct TieRule {
  std::string name;
  std::array<std::size_t, 2> bodies{};
  std::optional<Expression> where;  ///< surface points that are held, by their reference places; nothing: all
  double stiffness = 2;             ///< C_s: K = C_s Mbar / dpbar
  double strength = 0;              ///< t_max: largest traction in opening [Pa]; 0: it never fails
  double toughness = 0;             ///< G_c: energy that failure takes per area [J/m2]
  double shear_weight = 1;          ///< beta: of sliding in the effective opening
  bool fails() const { return strength > 0; }
};

}  // namespace piola::contact
