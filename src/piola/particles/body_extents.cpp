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
  return ends;
}

}  // namespace piola
