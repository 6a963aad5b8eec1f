// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "formulations/small_bodies.hpp"
#include <limits>
#include <map>

/// Comparison of parts with mirror planes and the whole bodies that they stand for.
namespace piola::testing {

inline ParticleSet box_between(int dimension, Point const& low, Point const& high, std::array<int, 3> n,
                               ShapeSpec::Placement placement = ShapeSpec{}.placement, double jitter = 0) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.placement = placement;
  shape.jitter = jitter;
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
    shape.min[c] = low[c];
    shape.max[c] = high[c];
    shape.particles[c] = n[c];
  }
  ParticleSet set;
  fill(shape, "box", set);
  return set;
}

/// Largest difference of a field between the particles of `part` and the particles of `whole` at the same reference
/// position (equal to 1e-6 m). Infinite if `whole` has no particle there.
inline double apart(Assembly const& part, Formulation const& f, Assembly const& whole, Formulation const& g,
                    std::string const& field, std::size_t components) {
  auto const key = [](Point const& X) {
    return std::array{std::lround(X[0] * 1e6), std::lround(X[1] * 1e6), std::lround(X[2] * 1e6)};
  };
  std::map<std::array<long, 3>, std::size_t> place;
  for (std::size_t k = 0; k < whole.particles.X.size(); ++k) place[key(whole.particles.X[k])] = k;
  Values const a = sample(f, field, part.particles.X.size()), b = sample(g, field, whole.particles.X.size());
  double most = 0;
  for (std::size_t k = 0; k < part.particles.X.size(); ++k) {
    auto const found = place.find(key(part.particles.X[k]));
    if (found == place.end()) return std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < components; ++c)
      most = std::max(most, std::fabs(a[components * k + c] - b[components * found->second + c]));
  }
  return most;
}

}  // namespace piola::testing
