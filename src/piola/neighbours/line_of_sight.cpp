// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/line_of_sight.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

/// In spacings. A line that is deeper outside is blocked, and one that is deep for the length of its part outside.
constexpr double deepest = 0.25, steepest = 0.2, shortest = 0.02;
/// Slits that are narrower than twice this do not count.
constexpr double narrowest = 1e-6;

/// Whether a line crosses a narrow slit just behind s, up to where the distance from the surface has risen to about
/// zero. Across a slit the distance rises above zero, then falls as steeply. distance_at(s): in spacings, negative
/// inside.
template <class F>
bool crosses_slit(F const& distance_at, double s) {
  double low = s, high = s + 4 * shortest;
  while (high - low > narrowest) {  // the maximum, by thirds
    double const third = (high - low) / 3;
    if (distance_at(low + third) < distance_at(high - third))
      low += third;
    else
      high -= third;
  }
  double const top = distance_at(low), fall = low - s + shortest;
  return top > narrowest && top - distance_at(low + fall) > 2 * steepest * fall;
}

}  // namespace

bool LineOfSight::is_blocked(Point const& a, Point const& b) const {
  if (!distance_) return false;
  if (b < a) return is_blocked(b, a);  // the same steps in both directions
  // Steps outside are shorter than the depth, so that none passes over the deepest point.
  constexpr double outside_step = 0.25;
  double const length = std::hypot(b[0] - a[0], b[1] - a[1], b[2] - a[2]) / spacing_;
  double const at_a = distance_(a) / spacing_, at_b = distance_(b) / spacing_;
  if (at_a > deepest || at_b > deepest) return false;
  if (at_a + at_b < -length) return false;  // balls around both cover the line
  auto const distance_at = [&](double s) {
    Point X = a;
    for (std::size_t c = 0; c < 3; ++c) X[c] += s / length * (b[c] - a[c]);
    return distance_(X) / spacing_;
  };
  double outside = 0, most = 0, before = 0, distance_before = at_a;
  for (double s = std::max(-at_a, shortest), end = length - std::max(-at_b, shortest); s < end;) {
    double const d = distance_at(s), step = std::max(d > 0 ? outside_step * d : -d, shortest);
    bool const rises = d - distance_before > 2 * steepest * (s - before);
    if (rises && std::abs(d) < shortest && crosses_slit(distance_at, s)) return true;
    before = s;
    distance_before = d;
    if (d > 0) outside += std::min(step, end - s);
    most = std::max(most, d);
    if (most > deepest) return true;
    s += step;
  }
  return outside > shortest && most > steepest * outside;
}

}  // namespace piola
