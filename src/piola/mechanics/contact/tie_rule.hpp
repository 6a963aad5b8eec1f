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

/// Ties the surfaces of two bodies, or of a body and a rigid shape, where they are in contact at the start.
struct TieRule {
  std::string name;
  std::array<std::size_t, 2> bodies{};  ///< with a rigid shape: twice the index of the body
  std::optional<std::size_t> rigid;     ///< index of the shape
  bool rigid_first = false;             ///< whether the shape is named first
  std::optional<Expression> where;      ///< condition on the reference position of tied surface points; empty: all
  double stiffness = 2;                 ///< C_s: K = C_s Mbar / dpbar
  double strength = 0;                  ///< t_max: largest opening traction [Pa]; 0: it never fails
  double toughness = 0;                 ///< G_c: fracture energy per area [J/m2]
  double shear_weight = 1;              ///< beta: weight of sliding in the effective opening
  bool fails() const { return strength > 0; }
};

/// Whether some of the ties connect two given bodies, in any order.
template <class Tie>
bool is_tied(std::vector<Tie> const& ties, std::size_t a, std::size_t b) {
  return std::any_of(ties.begin(), ties.end(), [&](TieRule const& tie) {
    if (tie.rigid) return false;
    return (tie.bodies[0] == a && tie.bodies[1] == b) || (tie.bodies[0] == b && tie.bodies[1] == a);
  });
}

}  // namespace piola::contact
