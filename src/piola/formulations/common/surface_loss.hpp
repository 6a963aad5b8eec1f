// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace piola {

/// Interface of formulations whose particles may lose their surface points, because they or a reference neighbour
/// become Eulerian. The formulation itself then keeps such particles apart from other bodies. All results are equal on
/// all ranks.
class SurfaceLoss {
 public:
  virtual ~SurfaceLoss() = default;
  /// Number of particles that have lost their surface since the start.
  virtual std::int64_t surfaces_lost() const = 0;
  /// id: in the formulation.
  virtual bool has_lost_surface(std::int64_t id) const = 0;
};

}  // namespace piola
