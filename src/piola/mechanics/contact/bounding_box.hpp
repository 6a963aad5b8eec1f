// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <algorithm>

namespace piola::contact {

/// Bounding box of points.
struct BoundingBox {
  Vec<3> low{{1e300, 1e300, 1e300}}, high{{-1e300, -1e300, -1e300}};
  void add(Vec<3> const& y) {
    for (int c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], y[c]);
      high[c] = std::max(high[c], y[c]);
    }
  }
  bool holds(Vec<3> const& y, double margin) const {
    for (int c = 0; c < 3; ++c)
      if (!(y[c] > low[c] - margin && y[c] < high[c] + margin)) return false;
    return true;
  }
};

}  // namespace piola::contact
