// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/shared_lines.hpp"
#include <algorithm>

namespace piola {

SharedLines::At const& SharedLines::at(Index slot) const {
  return set_->lattice_index[static_cast<std::size_t>(order_->id[static_cast<std::size_t>(slot)])];
}

bool SharedLines::is_in_box(At const& at) const {
  for (std::size_t c = 0; c < 3; ++c)
    if (at[c] < first_[c] || at[c] >= first_[c] + size_[c]) return false;
  return true;
}

std::size_t SharedLines::index(At const& at) const {
  std::size_t k = 0;
  for (std::size_t c = 3; c-- > 0;)
    k = k * static_cast<std::size_t>(size_[c]) + static_cast<std::size_t>(at[c] - first_[c]);
  return k;
}

SharedLines::SharedLines(ParticleSet const& set, Body const& body, SlotOrder const& order, Range own)
    : set_(&set), order_(&order), own_(own) {
  At last{};
  for (std::size_t c = 0; c < 3; ++c) {
    first_[c] = body.lattice[c];
    last[c] = -1;
    for (Index i = own.first; i < own.last; ++i) {
      first_[c] = std::min(first_[c], at(i)[c]);
      last[c] = std::max(last[c], at(i)[c]);
    }
    first_[c] = std::max(0, first_[c] - 1);
    last[c] = std::min(body.lattice[c] - 1, last[c] + 1);
    size_[c] = own.first < own.last ? last[c] - first_[c] + 1 : 0;
  }
  slots_.assign(
      static_cast<std::size_t>(size_[0]) * static_cast<std::size_t>(size_[1]) * static_cast<std::size_t>(size_[2]),
      nobody);
  auto const id = [&](Index slot) { return order_->id[static_cast<std::size_t>(slot)]; };
  for (Index i = 0; i < order.particles; ++i) {
    if (!is_in_box(at(i))) continue;
    Index& there = slots_[index(at(i))];
    if (there == nobody || id(there) < id(i)) there = i;
  }
  std::vector<Index> read;
  for (Index i = own.first; i < own.last; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      for (Index const slot : neighbours(i, axis))
        if (slot != nobody) read.push_back(slot);
  pressure_.allocate(order.slots(), 0);
  halo_ = std::make_unique<HaloPlan>(order.slots(), std::move(read));
  halo_->add(pressure_.ref(), 0, 1);
}

std::array<Index, 2> SharedLines::neighbours(Index slot, std::size_t axis) const {
  auto before = at(slot), after = before;
  --before[axis];
  ++after[axis];
  if (!is_in_box(before) || !is_in_box(after)) return {nobody, nobody};
  Index const a = slots_[index(before)], b = slots_[index(after)];
  if (a == nobody || b == nobody) return {nobody, nobody};
  return {a, b};
}

void SharedLines::add_oscillation(Observation& o) {
  halo_->exchange(pressure_.ref());
  for (Index i = own_.first; i < own_.last; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis) {
      auto const [a, b] = neighbours(i, axis);
      if (a != nobody) o.add_second_difference((pressure_.at(b) - 2 * pressure_.at(i) + pressure_.at(a)) / 4);
    }
}

std::size_t SharedLines::bytes() const {
  return slots_.size() * sizeof(Index) + pressure_.bytes() + (halo_ ? halo_->bytes() : 0);
}

}  // namespace piola
