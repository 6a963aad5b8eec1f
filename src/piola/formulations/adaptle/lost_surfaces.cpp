// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/lost_surfaces.hpp"
#include "piola/base/contracts.hpp"
#include "piola/formulations/adaptle/subscript.hpp"

namespace piola::adaptle {

void LostSurfaces::lose(ParticleSet const& set, Index slot, double reach) {
  PIOLA_EXPECTS(reach >= 0);
  std::size_t const id = at(slot);
  int const b = set.body[id];
  Body const& body = set.bodies[at(b)];
  std::unique_ptr<CellGrid>& grid = places_[b];
  if (!grid) {
    auto const first = set.X.begin() + static_cast<std::ptrdiff_t>(body.first);
    grid = std::make_unique<CellGrid>(
        std::vector<std::array<double, 3>>(first, first + static_cast<std::ptrdiff_t>(body.last - body.first)), reach);
  }
  auto const& X = set.X[id];
  grid->visit(X, [&](Index k) {
    std::int64_t const other = body.first + k;
    double square = 0;
    for (std::size_t c = 0; c < 3; ++c) square += (set.X[at(other)][c] - X[c]) * (set.X[at(other)][c] - X[c]);
    std::uint8_t& lost = lost_[at(other)];
    if (lost != 0 || !(square <= reach * reach)) return;
    lost = 1;
    count_ += 1;
  });
}

}  // namespace piola::adaptle
