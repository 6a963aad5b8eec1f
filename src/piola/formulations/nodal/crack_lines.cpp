// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/crack_lines.hpp"
#include <algorithm>
#include <tuple>

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

CrackLines::View::View(CrackLines const& lines, std::size_t a) : lines_(lines), a_(a) {
  if (!lines.any_) return;
  // Opening cells measure the opening themselves, from all that they saw before.
  auto const hides_nothing =
      lines.condition_[a] == CellCondition::opening ? CellCondition::opening : CellCondition::intact;
  lines.each_near(a, longest_reach + 1, [&](std::size_t k) {
    if (k != a && lines.condition_[k] > hides_nothing) hiding_.push_back(k);
  });
}

bool CrackLines::View::hides(std::size_t b) const {
  auto const& [X, condition] = std::tie(lines_.X_, lines_.condition_);
  if (a_ == b) return false;
  if (condition[a_] == CellCondition::detached || condition[b] == CellCondition::detached) return true;
  double const square = square_of_distance(X, a_, b);
  if (square < nearest * nearest) return false;
  return std::any_of(hiding_.begin(), hiding_.end(), [&](std::size_t k) {
    if (k == b) return false;
    double at = 0, from_a = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      double const r = X[k][c] - X[a_][c];
      at += r * (X[b][c] - X[a_][c]) / square;
      from_a += r * r;
    }
    return at > 0 && at < 1 && from_a - at * at * square < width * width;
  });
}

}  // namespace piola::nodal
