// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include "piola/particles/body_range.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <limits>
#include <vector>

namespace piola {

/// Finds the particle of a body nearest to a place, the lowest id of several. Distances in spacings; ids relative to
/// the first particle of the body. Thread-safe.
class NearestParticle {
 public:
  using Place = std::array<double, 3>;
  NearestParticle(ParticleSet const& set, Body const& body)
      : scaled_(scaled(set, body)), near_(scaled_, 1), far_(scaled_, 3) {
    PIOLA_EXPECTS(is_range_in(body, set) && body.first < body.last);
    PIOLA_EXPECTS(body.spacing[0] > 0 && body.spacing[1] > 0 && body.spacing[2] > 0);
    for (std::size_t c = 0; c < 3; ++c) per_spacing_[c] = 1 / body.spacing[c];
  }
  std::size_t operator()(Place const& X) const {
    Place const at{X[0] * per_spacing_[0], X[1] * per_spacing_[1], X[2] * per_spacing_[2]};
    Found found = among(near_, at);
    if (!(found.square <= 1)) found = among(far_, at);
    if (found.square <= 9) return found.particle;
    found = {};
    for (std::size_t a = 0; a < scaled_.size(); ++a) consider(a, at, found);
    return found.particle;
  }

 private:
  struct Found {
    std::size_t particle = 0;
    double square = std::numeric_limits<double>::infinity();
  };
  static std::vector<Place> scaled(ParticleSet const& set, Body const& body) {
    std::vector<Place> points(set.X.begin() + body.first, set.X.begin() + body.last);
    for (auto& p : points)
      for (std::size_t c = 0; c < 3; ++c) p[c] /= body.spacing[c];
    return points;
  }
  void consider(std::size_t a, Place const& at, Found& found) const {
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) square += (scaled_[a][c] - at[c]) * (scaled_[a][c] - at[c]);
    if (square < found.square || (square == found.square && a < found.particle)) found = {a, square};
  }
  Found among(CellGrid const& grid, Place const& at) const {
    Found found;
    grid.visit(at, [&](Index a) { consider(static_cast<std::size_t>(a), at, found); });
    return found;
  }

  std::vector<Place> scaled_;
  CellGrid near_, far_;
  Place per_spacing_{};
};

}  // namespace piola
