// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/common/lattice_line_halo.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>

namespace piola {

LatticeLines::At const& LatticeLineHalo::at(Index slot) const {
  return set_->lattice_index[static_cast<std::size_t>(slots_.of(slot))];
}

LatticeLineHalo::LatticeLineHalo(ParticleSet const& set, Body const& body, Slots slots, Range own, Partition const& cut)
    : set_(&set), slots_(slots), own_(own) {
  PIOLA_EXPECTS(own.first <= own.last && own.last <= cut.whole().last);
  LatticeLines::At first{}, size{};  // bounding box of local particles and their neighbours
  for (std::size_t c = 0; c < 3; ++c) {
    int lowest = body.lattice[c], highest = -1;
    for (Index i = own.first; i < own.last; ++i) {
      lowest = std::min(lowest, at(i)[c]);
      highest = std::max(highest, at(i)[c]);
    }
    first[c] = std::max(0, lowest - 1);
    size[c] = own.first < own.last ? std::min(body.lattice[c] - 1, highest + 1) - first[c] + 1 : 0;
  }
  lines_ = LatticeLines(first, size);
  // The largest id wins where several particles share a position.
  for (Index i = 0; i < slots.particles; ++i) {
    if (!lines_.holds(at(i))) continue;
    Index& there = lines_[at(i)];
    if (there == LatticeLines::no_slot || slots.of(there) < slots.of(i)) there = i;
  }
  std::vector<Index> read;
  for (Index i = own.first; i < own.last; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (Index const slot : lines_.neighbours(at(i), axis))
        if (slot != LatticeLines::no_slot) read.push_back(slot);
  pressure_.allocate(cut.whole().last, 0);
  halo_ = std::make_unique<HaloPlan>(cut, std::move(read));
  halo_->add(pressure_.ref(), 0, 1);
}

void LatticeLineHalo::add_oscillation(DiagnosticsSum& o) {
  halo_->exchange(pressure_.ref());
  for (Index i = own_.first; i < own_.last; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto const [a, b] = lines_.neighbours(at(i), axis);
      if (a != LatticeLines::no_slot)
        o.add_second_difference((pressure_.at(b) - 2 * pressure_.at(i) + pressure_.at(a)) / 4);
    }
}

std::size_t LatticeLineHalo::bytes() const { return lines_.bytes() + pressure_.bytes() + (halo_ ? halo_->bytes() : 0); }

}  // namespace piola
