// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/ordering.hpp"
#include <algorithm>
#include <array>
#include <numeric>

namespace piola {

SlotOrder pencil_order(ParticleSet const& set, Body const& body) {
  constexpr int rows = 8;
  auto const longest =
      static_cast<std::size_t>(std::max_element(body.lattice.begin(), body.lattice.end()) - body.lattice.begin());
  std::array<std::size_t, 3> const axis{longest, longest == 0 ? 1U : 0U, longest == 2 ? 1U : 2U};
  auto const key = [&](std::int64_t id) {
    auto const& at = set.lattice_index[static_cast<std::size_t>(id)];
    int const x = at[axis[0]], y = at[axis[1]], z = at[axis[2]];
    // Particles on rings may share a lattice index.
    return std::array{z / rows, y / rows, z, y, x, static_cast<int>(id - body.first)};
  };
  SlotOrder order;
  order.particles = static_cast<Index>(body.last - body.first);
  order.id.resize(static_cast<std::size_t>(order.particles));
  std::iota(order.id.begin(), order.id.end(), body.first);
  std::sort(order.id.begin(), order.id.end(), [&](auto a, auto b) { return key(a) < key(b); });
  auto const size = (order.id.size() + SlotOrder::alignment - 1) / SlotOrder::alignment * SlotOrder::alignment;
  order.id.resize(size, SlotOrder::no_particle);
  return order;
}

}  // namespace piola
