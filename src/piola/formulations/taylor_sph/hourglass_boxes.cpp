// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/hourglass_boxes.hpp"
#include <algorithm>

namespace piola::taylor_sph {

HourglassBoxes::HourglassBoxes(ParticleSet const& set, Body const& body, Options const& options) {
  if (set.dimension > 1 && options.hourglass > 0) boxes_ = lattice_cells(set, body);
}

void HourglassBoxes::make_tables(Particles const& particles, int lanes) {
  if (empty()) return;
  int const D = particles.dimension();
  auto const corners = static_cast<std::size_t>(boxes_.corners);
  Index const boxes = aligned(boxes_.count());
  corner_.assign(at(boxes) * corners, 0);
  box_of_.assign(particles.particles_in_slots().size() * corners, -1);
  for (Index b = 0; b < boxes; ++b)
    for (std::size_t k = 0; k < corners; ++k) {
      Index const slot = particles.slot(boxes_.of(std::min(b, boxes_.count() - 1))[k]);
      corner_[(at(b / lanes) * corners + k) * at(lanes) + at(b % lanes)] = slot;
      if (b >= boxes_.count()) continue;
      // A particle is the opposite corner of each of its boxes: corner k of one box only.
      box_of_[at(slot) * corners + k] = b * boxes_.corners + static_cast<Index>(k);
    }
  int const patterns = D == 2 ? 1 : 4, fields = D + D * (D + 1) / 2;
  pattern_.assign(at(boxes) * at(patterns * fields), 0);
}

void HourglassBoxes::set_views(BodyState& state) {
  if (!empty()) state.hourglass = {aligned(boxes_.count()), corner_.data(), pattern_.data(), box_of_.data()};
}

std::size_t HourglassBoxes::bytes() const {
  return sizeof(Index) * (corner_.size() + box_of_.size()) + sizeof(double) * pattern_.size();
}

}  // namespace piola::taylor_sph
