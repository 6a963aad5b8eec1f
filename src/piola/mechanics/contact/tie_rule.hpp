// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/expression.hpp"
#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace piola::contact {

/// What holds the surfaces of two bodies, or of a body and a rigid shape, together where they touch at the start.
struct TieRule {
  std::string name;
  std::array<std::size_t, 2> bodies{};  ///< twice the same one with a rigid shape
  std::optional<std::size_t> rigid;     ///< the shape
  bool rigid_first = false;             ///< whether it is named first, before the body
  std::optional<Expression> where;      ///< surface points that are held, by their reference places; nothing: all
  double stiffness = 2;                 ///< C_s: K = C_s Mbar / dpbar
  double strength = 0;                  ///< t_max: largest traction in opening [Pa]; 0: it never fails
  double toughness = 0;                 ///< G_c: energy that failure takes per area [J/m2]
  double shear_weight = 1;              ///< beta: of sliding in the effective opening
  bool fails() const { return strength > 0; }
};

/// Whether some of the ties hold two bodies together, in any order.
template <class Tie>
bool is_tied(std::vector<Tie> const& ties, std::size_t a, std::size_t b) {
  return std::any_of(ties.begin(), ties.end(), [&](TieRule const& tie) {
    if (tie.rigid) return false;
    return (tie.bodies[0] == a && tie.bodies[1] == b) || (tie.bodies[0] == b && tie.bodies[1] == a);
  });
}

}  // namespace piola::contact
