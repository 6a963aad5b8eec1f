// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface.hpp"
#include <vector>

namespace piola::contact {

/// Pairs excluded from self-contact: surface points whose host particles are nearer than four spacings along bonds of
/// the reference configuration, each at most 1.5 spacings long. The straight distance is no criterion: it is short
/// across a slit.
class SelfContactExclusions {
 public:
  SelfContactExclusions() = default;
  SelfContactExclusions(ParticleSet const& particles, std::size_t body, HostParticles const& hosts, double spacing);
  /// Whether two host particles of the body are neighbours; true for equal ones.
  bool hold(Index host, Index other) const;

 private:
  Index first_ = 0;  ///< first host particle of the body
  std::vector<std::vector<Index>> near_;
};

}  // namespace piola::contact
