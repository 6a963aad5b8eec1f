// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/line_of_sight.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>
#include <utility>

namespace piola::nodal {

LineOfSight::LineOfSight(SetUp const& from, Points const& X, std::array<double, 3> const& h)
    : from_(from), X_(X), h_(h) {
  if (!from.body.outline.distance) return;
  spacing_ = *std::min_element(h.begin(), h.begin() + from.set.dimension);
  distance_.resize(X.size());
  exec_host::parallel_for(static_cast<Index>(X.size()), [&](Index a) {
    distance_[static_cast<std::size_t>(a)] = depth(X_[static_cast<std::size_t>(a)]);
  });
}

double LineOfSight::depth(std::array<double, 3> X) const {
  for (std::size_t c = 0; c < 3; ++c) {
    X[c] *= h_[c];
    if (from_.images == nullptr) continue;
    for (bool const upper : {false, true})
      if (from_.images->has_plane(c, upper)) {
        double const plane = from_.images->plane(c, upper);
        if (upper ? X[c] > plane : X[c] < plane) X[c] = 2 * plane - X[c];
      }
  }
  return from_.body.outline.distance(X) / spacing_;
}

bool LineOfSight::is_blocked(std::size_t a, std::size_t b) const {
  if (distance_.empty()) return false;
  if (a > b) std::swap(a, b);  // the same steps in both directions
  // A line that is deeper outside is blocked, and one that is deep for the length of its part outside.
  constexpr double deepest = 0.25, steepest = 0.2, shortest = 0.02;
  std::array<double, 3> along{};
  double square = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    along[c] = X_[b][c] - X_[a][c];
    square += along[c] * along[c];
  }
  double const length = std::sqrt(square);
  if (distance_[a] + distance_[b] < -length) return false;  // balls around both cover the line
  double outside = 0, most = 0;
  for (double s = std::max(-distance_[a], shortest), end = length - std::max(-distance_[b], shortest); s < end;) {
    std::array<double, 3> X = X_[a];
    for (std::size_t c = 0; c < 3; ++c) X[c] += s / length * along[c];
    double const d = depth(X), step = std::max(std::abs(d), shortest);
    if (d > 0) outside += std::min(step, end - s);
    most = std::max(most, d);
    if (most > deepest) return true;
    s += step;
  }
  return outside > shortest && most > steepest * outside;
}

}  // namespace piola::nodal
