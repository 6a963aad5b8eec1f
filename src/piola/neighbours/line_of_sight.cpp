// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/line_of_sight.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

bool LineOfSight::is_blocked(Point const& a, Point const& b) const {
  if (!distance_) return false;
  if (b < a) return is_blocked(b, a);  // the same steps in both directions
  // In spacings. A line that is deeper outside is blocked, and one that is deep for the length of its part outside.
  constexpr double deepest = 0.25, steepest = 0.2, shortest = 0.02;
  // Steps outside are shorter than the depth, so that none passes over the deepest point.
  constexpr double outside_step = 0.25;
  double const length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / spacing_;
  double const at_a = distance_(a) / spacing_, at_b = distance_(b) / spacing_;
  if (at_a > deepest || at_b > deepest) return false;
  if (at_a + at_b < -length) return false;  // balls around both cover the line
  double outside = 0, most = 0;
  for (double s = std::max(-at_a, shortest), end = length - std::max(-at_b, shortest); s < end;) {
    Point X = a;
    for (std::size_t c = 0; c < 3; ++c) X[c] += s / length * (b[c] - a[c]);
    double const d = distance_(X) / spacing_, step = std::max(d > 0 ? outside_step * d : -d, shortest);
    if (d > 0) outside += std::min(step, end - s);
    most = std::max(most, d);
    if (most > deepest) return true;
    s += step;
  }
  return outside > shortest && most > steepest * outside;
}

}  // namespace piola
