// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <cstdint>

namespace piola {

/// Implemented by formulations whose particles may lose the surface points that they carry: because they turn Eulerian,
/// or a reference neighbour does. The formulation itself keeps such particles apart from other bodies from then on. All
/// answers are the same on all ranks.
class SurfaceLoss {
 public:
  virtual ~SurfaceLoss() = default;
  /// Number of particles that have lost their surface since the start.
  virtual std::int64_t surfaces_lost() const = 0;
  /// id: of the formulation.
  virtual bool has_lost_surface(std::int64_t id) const = 0;
};

}  // namespace piola
