// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface.hpp"
#include <vector>

namespace piola::contact {

/// Which surface points of a body do not touch each other because they are neighbours in the body itself: their
/// particles are nearer than four spacings along bonds of the reference configuration, each at most 1.5 spacings long.
/// The straight distance would not do: it is short across a slit.
class OwnNeighbours {
 public:
  OwnNeighbours() = default;
  OwnNeighbours(ParticleSet const& particles, std::size_t body, Carriers const& carriers, double spacing);
  /// Whether two carriers of the body are neighbours; each is its own.
  bool hold(Index carrier, Index other) const;

 private:
  Index first_ = 0;  ///< carrier of the body
  std::vector<std::vector<Index>> near_;
};

}  // namespace piola::contact
