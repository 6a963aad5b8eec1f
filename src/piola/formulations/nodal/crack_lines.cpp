// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/crack_lines.hpp"

namespace piola::nodal {
namespace {

/// Particles up to this distance are nearest neighbours, diagonal ones of a square included.
constexpr double nearest = 1.45;
/// A line passes a particle that is nearer than this.
constexpr double width = 0.5;

}  // namespace

CrackLines::CrackLines(Points const& X)
    : X_(X), condition_(X.size(), CellCondition::intact), grid_(X, longest_reach + 1) {}

void CrackLines::set(std::size_t a, CellCondition condition) {
  condition_[a] = condition;
  any_ = any_ || condition != CellCondition::intact;
}

bool CrackLines::block(std::size_t a, std::size_t b) const {
  if (!any_ || a == b) return false;
  if (condition_[a] == CellCondition::detached || condition_[b] == CellCondition::detached) return true;
  double const square = square_of_distance(X_, a, b);
  if (square < nearest * nearest) return false;
  std::array<double, 3> middle{}, along{};
  for (std::size_t c = 0; c < 3; ++c) {
    along[c] = X_[b][c] - X_[a][c];
    middle[c] = X_[a][c] + 0.5 * along[c];
  }
  // Opening cells measure the opening themselves, from all that they saw before.
  auto const hides_nothing = condition_[a] == CellCondition::opening ? CellCondition::opening : CellCondition::intact;
  bool blocked = false;
  grid_.visit(middle, [&](Index other) {
    auto const k = static_cast<std::size_t>(other);
    if (blocked || condition_[k] <= hides_nothing || k == a || k == b) return;
    double at = 0, from_a = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double const r = X_[k][c] - X_[a][c];
      at += r * along[c] / square;
      from_a += r * r;
    }
    blocked = at > 0 && at < 1 && from_a - at * at * square < width * width;
  });
  return blocked;
}

}  // namespace piola::nodal
