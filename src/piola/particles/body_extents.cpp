// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/body_extents.hpp"
#include "piola/base/contracts.hpp"
#include "piola/particles/body_range.hpp"
#include <algorithm>

namespace piola {

BodyExtents extents_of(ParticleSet const& set, Body const& body) {
  PIOLA_EXPECTS(is_range_in(body, set) && body.first < body.last);
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  BodyExtents ends{};
  ends.low = ends.high = set.X[static_cast<std::size_t>(body.first)];
  for (auto id = body.first; id < body.last; ++id)
    for (std::size_t c = 0; c < 3; ++c) {
      ends.low[c] = std::min(ends.low[c], set.X[static_cast<std::size_t>(id)][c]);
      ends.high[c] = std::max(ends.high[c], set.X[static_cast<std::size_t>(id)][c]);
    }
  ends.tolerance = 1e-6 * *std::min_element(body.spacing.begin(), body.spacing.begin() + set.dimension);
  for (std::size_t c = 0; c < 3; ++c) {
    ends.at[c] = {ends.low[c], ends.high[c]};
    if (body.outline.min[c] < ends.low[c] - ends.tolerance && body.outline.max[c] > ends.high[c] + ends.tolerance)
      ends.at[c] = {body.outline.min[c], body.outline.max[c]};
  }
  if (touches_axis(set, body)) ends.at[0][0] = 0;
  return ends;
}

bool touches_axis(ParticleSet const& set, Body const& body) {
  if (!set.axisymmetric || body.first == body.last) return false;
  constexpr double rounding = 1e-6, half_a_cell = 0.75;  // spacings
  if (body.outline.max[0] > body.outline.min[0]) return body.outline.min[0] < rounding * body.spacing[0];
  double low = set.X[static_cast<std::size_t>(body.first)][0];
  for (auto id = body.first; id < body.last; ++id) low = std::min(low, set.X[static_cast<std::size_t>(id)][0]);
  return low < half_a_cell * body.spacing[0];
}

}  // namespace piola
