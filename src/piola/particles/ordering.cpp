// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/ordering.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/hash.hpp"
#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace piola {

SlotOrder order_by_rows(ParticleSet const& set, Body const& body, std::array<std::size_t, 3> const& axis,
                        std::vector<std::size_t> const& rank) {
  auto const& lattice_index = set.lattice_index.seen();
  auto const row_of = [&](std::int64_t id) {
    auto const& at = lattice_index[static_cast<std::size_t>(id)];
    auto const row = static_cast<std::size_t>(at[axis[2]]) * static_cast<std::size_t>(body.lattice[axis[1]]) +
                     static_cast<std::size_t>(at[axis[1]]);
    PIOLA_EXPECTS(row < rank.size());
    return rank[row];
  };
  // A counting sort: sorting millions of particles by comparison would take seconds.
  std::vector<std::size_t> begin(rank.size() + 1, 0);
  for (auto id = body.first; id < body.last; ++id) ++begin[row_of(id) + 1];
  for (std::size_t r = 0; r < rank.size(); ++r) begin[r + 1] += begin[r];
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
  for (std::size_t r = 0; r < rank.size(); ++r) {
    auto const first = order.id.begin() + static_cast<std::ptrdiff_t>(begin[r]),
               last = order.id.begin() + static_cast<std::ptrdiff_t>(begin[r + 1]);
    if (!std::is_sorted(first, last, along)) std::sort(first, last, along);
  }
  return order;
}

std::array<std::size_t, 3> row_axes(Body const& body) {
  auto const longest =
      static_cast<std::size_t>(std::max_element(body.lattice.begin(), body.lattice.end()) - body.lattice.begin());
  return {longest, longest == 0 ? 1U : 0U, longest == 2 ? 1U : 2U};
}

namespace {

Shuffle shuffle_of_tests;

constexpr std::size_t tile_size = exec::block_size, leaf_size = exec::leaf_size;

/// Permutation of `count` places: tiles are permuted within their kind; tiles of a negative kind and an incomplete tile
/// stay.
std::vector<std::size_t> dealt_places(std::size_t count, Shuffle const& shuffle, std::vector<int> const& kind,
                                      std::size_t tile) {
  struct SlotPermutation {
    int kind;
    std::uint64_t owner, place;
    std::size_t tile;
  };
  std::vector<SlotPermutation> tiles;
  std::vector<std::size_t> places;  // kind after kind
  for (std::size_t k = 0; k < kind.size(); ++k) {
    if (kind[k] < 0) continue;
    std::uint64_t const random = hash_mix(shuffle.seed * 0x9E3779B97F4A7C15U + k);
    tiles.push_back({kind[k], random % static_cast<std::uint64_t>(shuffle.owners), hash_mix(random), k});
    places.push_back(k);
  }
  std::sort(tiles.begin(), tiles.end(), [](SlotPermutation const& a, SlotPermutation const& b) {
    return std::tie(a.kind, a.owner, a.place, a.tile) < std::tie(b.kind, b.owner, b.place, b.tile);
  });
  std::stable_sort(places.begin(), places.end(), [&](std::size_t a, std::size_t b) { return kind[a] < kind[b]; });
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  for (std::size_t k = 0; k < tiles.size(); ++k) {
    if (shuffle.moved != nullptr && tiles[k].tile != places[k]) ++*shuffle.moved;
    auto const to = numbers.begin() + static_cast<std::ptrdiff_t>(places[k] * tile);
    std::iota(to, to + static_cast<std::ptrdiff_t>(tile), tiles[k].tile * tile);
  }
  return numbers;
}

SlotOrder dealt_out(SlotOrder const& order, Shuffle const& shuffle, std::vector<int> const& kind, std::size_t tile) {
  SlotOrder dealt = order;
  auto const numbers = dealt_places(static_cast<std::size_t>(order.particles), shuffle, kind, tile);
  for (std::size_t k = 0; k < numbers.size(); ++k) dealt.id[k] = order.id[numbers[k]];
  return dealt;
}

std::vector<int> one_kind(std::size_t count, std::size_t tile) { return std::vector<int>(count / tile, 0); }

}  // namespace

Shuffle set_shuffle(Shuffle const& shuffle) { return std::exchange(shuffle_of_tests, shuffle); }

Shuffle const& current_shuffle() { return shuffle_of_tests; }

std::vector<std::size_t> shuffled_indices(std::size_t count, Shuffle const& shuffle) {
  return dealt_places(count, shuffle, shuffle.owners > 0 ? one_kind(count, tile_size) : std::vector<int>{}, tile_size);
}

SlotOrder pencil_order(ParticleSet const& set, Body const& body) {
  constexpr std::size_t rows = 8;
  auto const axis = row_axes(body);
  auto const wide = static_cast<std::size_t>(std::max(1, body.lattice[axis[1]])),
             high = static_cast<std::size_t>(std::max(1, body.lattice[axis[2]]));
  std::vector<std::size_t> rank(wide * high);
  std::size_t next = 0;
  for (std::size_t k = 0; k < high; k += rows)
    for (std::size_t j = 0; j < wide; j += rows)
      for (std::size_t z = k; z < std::min(k + rows, high); ++z)
        for (std::size_t y = j; y < std::min(j + rows, wide); ++y) rank[z * wide + y] = next++;
  return order_by_rows(set, body, axis, rank);
}

SlotOrder shuffled_order(ParticleSet const& set, Body const& body) {
  SlotOrder order = pencil_order(set, body);
  if (shuffle_of_tests.owners == 0) return order;
  auto const kinds = one_kind(static_cast<std::size_t>(order.particles), leaf_size);
  return dealt_out(order, shuffle_of_tests, kinds, leaf_size);
}

SlotOrder shuffled_within_parts(ParticleSet const& set, SlotOrder const& order) {
  if (shuffle_of_tests.owners == 0) return order;
  std::vector<int> kind = one_kind(static_cast<std::size_t>(order.particles), tile_size);
  for (std::size_t k = 0; k < kind.size(); ++k) {
    auto const part = [&](std::size_t slot) {
      return static_cast<int>(part_of(set, static_cast<std::size_t>(order.id[slot])));
    };
    int const first = part(k * tile_size);
    kind[k] = part((k + 1) * tile_size - 1) == first ? first : -1;
  }
  return dealt_out(order, shuffle_of_tests, kind, tile_size);
}

bool shuffle_forces_lists() { return shuffle_of_tests.owners > 0 || shuffle_of_tests.lists; }

}  // namespace piola
