// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/ordering.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <array>

namespace piola {

SlotOrder order_by_rows(ParticleSet const& set, Body const& body, std::array<std::size_t, 3> const& axis,
                        std::vector<std::size_t> const& row_order) {
  PIOLA_EXPECTS(body.first >= 0 && body.first <= body.last);
  PIOLA_EXPECTS(body.last <= static_cast<std::int64_t>(set.lattice_index.size()));
  PIOLA_EXPECTS(axis[0] < 3 && axis[1] < 3 && axis[2] < 3);
  PIOLA_EXPECTS(axis[0] != axis[1] && axis[1] != axis[2] && axis[2] != axis[0]);
  auto const& lattice_index = set.lattice_index.seen();
  auto const row_of = [&](std::int64_t id) {
    auto const& at = lattice_index[static_cast<std::size_t>(id)];
    auto const row = static_cast<std::size_t>(at[axis[2]]) * static_cast<std::size_t>(body.lattice[axis[1]]) +
                     static_cast<std::size_t>(at[axis[1]]);
    PIOLA_EXPECTS(row < row_order.size());
    return row_order[row];
  };
  // A counting sort: sorting millions of particles by comparison would take seconds.
  std::vector<std::size_t> begin(row_order.size() + 1, 0);
  for (auto id = body.first; id < body.last; ++id) ++begin[row_of(id) + 1];
  for (std::size_t r = 0; r < row_order.size(); ++r) begin[r + 1] += begin[r];
  SlotOrder order;
  order.particles = static_cast<Index>(body.last - body.first);
  auto const slots = (static_cast<std::size_t>(order.particles) + SlotOrder::alignment - 1) / SlotOrder::alignment *
                     SlotOrder::alignment;
  order.id.assign(slots, SlotOrder::no_particle);
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (auto id = body.first; id < body.last; ++id) order.id[next[row_of(id)]++] = id;
  // Within a row ids mostly are in order already. Particles on rings may share a lattice index.
  auto const along = [&](std::int64_t a, std::int64_t b) {
    int const x = lattice_index[static_cast<std::size_t>(a)][axis[0]],
              y = lattice_index[static_cast<std::size_t>(b)][axis[0]];
    return x != y ? x < y : a < b;
  };
  for (std::size_t r = 0; r < row_order.size(); ++r) {
    auto const first = order.id.begin() + static_cast<std::ptrdiff_t>(begin[r]),
               last = order.id.begin() + static_cast<std::ptrdiff_t>(begin[r + 1]);
    if (!std::is_sorted(first, last, along)) std::sort(first, last, along);
  }
  PIOLA_ENSURES(order.slots() % SlotOrder::alignment == 0 && order.slots() >= order.particles);
  return order;
}

std::array<std::size_t, 3> row_axes(Body const& body) {
  auto const longest =
      static_cast<std::size_t>(std::max_element(body.lattice.begin(), body.lattice.end()) - body.lattice.begin());
  return {longest, longest == 0 ? 1U : 0U, longest == 2 ? 1U : 2U};
}

SlotOrder pencil_order(ParticleSet const& set, Body const& body) {
  constexpr std::size_t rows = 8;
  auto const axis = row_axes(body);
  auto const wide = static_cast<std::size_t>(std::max(1, body.lattice[axis[1]])),
             high = static_cast<std::size_t>(std::max(1, body.lattice[axis[2]]));
  std::vector<std::size_t> row_order(wide * high);
  std::size_t next = 0;
  for (std::size_t k = 0; k < high; k += rows)
    for (std::size_t j = 0; j < wide; j += rows)
      for (std::size_t z = k; z < std::min(k + rows, high); ++z)
        for (std::size_t y = j; y < std::min(j + rows, wide); ++y) row_order[z * wide + y] = next++;
  PIOLA_ENSURES(next == row_order.size());
  return order_by_rows(set, body, axis, row_order);
}

}  // namespace piola
