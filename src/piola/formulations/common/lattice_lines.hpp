// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/contracts.hpp"
#include "piola/math/lanes.hpp"
#include <array>
#include <cstddef>
#include <vector>

namespace piola {

/// Maps lattice positions of a box to particle slots, with access to the previous and next particle along an axis.
class LatticeLines {
 public:
  using At = std::array<int, 3>;
  static constexpr Index no_slot = -1;

  LatticeLines() = default;
  /// Creates empty positions [first, first + size).
  LatticeLines(At const& first, At const& size) : first_(first), size_(size) {
    std::size_t places = 1;
    for (int const n : size) places *= static_cast<std::size_t>(n);
    slot_at_.assign(places, no_slot);
  }
  bool holds(At const& at) const {
    for (std::size_t c = 0; c < 3; ++c)
      if (at[c] < first_[c] || at[c] >= first_[c] + size_[c]) return false;
    return true;
  }
  /// The slot at a position. Precondition: holds(at).
  Index& operator[](At const& at) {
    PIOLA_EXPECTS(holds(at));
    return slot_at_[place(at)];
  }
  /// Slots before and after a position along an axis; `no_slot` for both if either is missing.
  std::array<Index, 2> neighbours(At const& at, std::size_t axis) const {
    At before = at, after = at;
    --before[axis];
    ++after[axis];
    if (!holds(before) || !holds(after)) return {no_slot, no_slot};
    Index const a = slot_at_[place(before)], b = slot_at_[place(after)];
    if (a == no_slot || b == no_slot) return {no_slot, no_slot};
    return {a, b};
  }
  std::size_t bytes() const { return slot_at_.size() * sizeof(Index); }

 private:
  std::size_t place(At const& at) const {
    std::size_t k = 0;
    for (std::size_t c = 3; c-- > 0;)
      k = k * static_cast<std::size_t>(size_[c]) + static_cast<std::size_t>(at[c] - first_[c]);
    return k;
  }

  At first_{}, size_{};
  std::vector<Index> slot_at_;
};

}  // namespace piola
