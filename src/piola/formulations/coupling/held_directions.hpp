// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/reproducible_sum.hpp"
#include "piola/formulations/common/mirrored_assembly.hpp"
#include "piola/math/tensor.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <map>
#include <vector>

namespace piola {

/// Directions in which supports or mirror planes hold particles under contact. Impulses of contact do not change the
/// velocity along them: the support returns the impulse and does the work of its motion. Supports of surfaces are
/// enforced by the formulation.
class HeldDirections {
 public:
  /// indices: of the particles, by id in the run; count: of all indices.
  HeldDirections(MirroredAssembly const& continued, Assembly const& whole, std::map<std::int64_t, Index> const& indices,
                 std::size_t count);
  /// The impulse [N s] on a particle at x [m] with velocity v [m/s] without its held part, which the reactions take.
  Vec<3> constrain(std::size_t particle, double time, Vec<3> impulse, Vec<3> const& x, Vec<3> const& v);
  /// Moves the reactions since the last call to the impulses of supports. Returns the work [J] of contact that they
  /// took from the motion of supports.
  double transfer_reactions(std::vector<Impulse>& supports);

 private:
  struct HeldDirection {
    std::size_t support;  ///< index of the support, or `plane`
    Direction direction;
    double until;  ///< [s]
  };
  /// A mirror plane, whose reaction is not recorded.
  static constexpr std::size_t plane = static_cast<std::size_t>(-1);

  std::vector<std::vector<HeldDirection>> held_;  ///< by particle
  std::vector<ImpulseSum> reactions_;             ///< by support
  exec::ReproducibleSum work_;
};

}  // namespace piola
