// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/reference_pairs.hpp"
#include <algorithm>
#include <map>
#include <tuple>

namespace piola {
namespace {

/// One lane's neighbour at a distance in memory and a lattice offset.
struct LanePair {
  int group;  // 0 inner, 1 outer
  std::int32_t delta, offset;
  int lane;
  auto key() const { return std::tuple{group, offset, delta}; }
};

/// The entries of one group of lanes in the order of sums: group, delta, offset, lanes present.
using Shape = std::vector<std::array<std::int32_t, 4>>;

/// Entries of the lanes from slot `first` on; visit(slot, f) calls f for each pair of a slot.
template <class Visit>
Shape shape_of(Index first, int lanes, Visit const& visit) {
  std::vector<LanePair> pairs;
  for (int lane = 0; lane < lanes; ++lane)
    visit(first + lane, [&](auto const& p) {
      pairs.push_back({p.inner ? 0 : 1, p.b - (first + lane), p.offset, lane});
    });
  std::sort(pairs.begin(), pairs.end(), [](auto const& a, auto const& b) { return a.key() < b.key(); });
  Shape shape;
  for (std::size_t k = 0; k < pairs.size();) {
    std::int32_t present = 0;
    auto const key = pairs[k].key();
    std::array<std::int32_t, 4> entry{pairs[k].group, pairs[k].delta, pairs[k].offset, 0};
    for (; k < pairs.size() && pairs[k].key() == key; ++k) present |= 1 << pairs[k].lane;
    entry[3] = present;
    shape.push_back(entry);
  }
  return shape;
}

}  // namespace

void ReferencePairs::make_stencils() {
  int const W = options_.lanes;
  std::int32_t const full = (1 << W) - 1;
  auto const add = [&](Shape const& shape, int group, std::int32_t(&run)[2]) {
    run[0] = static_cast<std::int32_t>(stencils_.entries.size());
    for (auto const& e : shape) {
      if (e[0] != group) continue;
      bool const masked = e[3] != full;
      stencils_.entries.push_back({e[1], e[2], masked ? static_cast<std::int32_t>(stencils_.weights.size()) : -1});
      for (int lane = 0; masked && lane < W; ++lane) stencils_.weights.push_back(((e[3] >> lane) & 1) != 0 ? 1.0 : 0.0);
    }
    run[1] = static_cast<std::int32_t>(stencils_.entries.size());
  };
  auto const& kind = corrections_.kind;
  std::map<std::vector<std::int32_t>, std::int32_t> pattern_of;
  std::vector<std::int32_t> kinds;
  for (Index first = 0; first < slots_; first += W) {
    auto const from = kind.begin() + first;
    // Most groups of lanes equal the previous one; otherwise the kinds determine the pattern.
    if (kinds.empty() || !std::equal(kinds.begin(), kinds.end(), from)) {
      kinds.assign(from, from + W);
      auto const next = static_cast<std::int32_t>(stencils_.patterns.size());
      auto const [at, is_new] = pattern_of.try_emplace(kinds, next);
      if (is_new) {
        Shape const shape = shape_of(first, W, [&](Index slot, auto const& f) { visit(slot, f); });
        StencilPattern p{};
        add(shape, 0, p.inner);
        add(shape, 1, p.outer);
        stencils_.patterns.push_back(p);
      }
      stencils_.pattern_of.push_back(at->second);
    } else {
      stencils_.pattern_of.push_back(stencils_.pattern_of.back());
    }
  }
}

void ReferencePairs::make_list() {
  auto const W = static_cast<std::int64_t>(options_.lanes);
  bool const equal_supports = options_.h_laplacian <= 0 || options_.h_laplacian == options_.h_gradient;
  auto const padded = [W](std::int64_t pairs) { return (pairs + W - 1) / W * W; };
  auto const slots = static_cast<std::size_t>(slots_);
  lists_.begin.assign(slots + 1, 0);
  lists_.inner.assign(slots, 0);
  each_part([&](Index, Index first, Index end) {
    for (Index a = first; a < end; ++a) {
      std::int64_t inner = 0, outer = 0;
      visit(a, [&](Pair const& p) { ++(p.inner ? inner : outer); });
      lists_.inner[static_cast<std::size_t>(a)] = static_cast<std::int32_t>(padded(inner));
      lists_.begin[static_cast<std::size_t>(a) + 1] = padded(inner) + padded(outer);
    }
  });
  for (std::size_t a = 0; a < slots; ++a) lists_.begin[a + 1] += lists_.begin[a];
  auto const size = static_cast<std::size_t>(lists_.begin.back());
  lists_.neighbour.resize(size);
  lists_.s.assign(size, 0);
  if (!equal_supports) lists_.l.assign(size, 0);
  if (options_.kernel_table) lists_.kernel.assign(size, 0);
  each_part([&](Index, Index first, Index end) {
    for (Index a = first; a < end; ++a) {
      auto const slot = static_cast<std::size_t>(a);
      auto const begin = static_cast<std::size_t>(lists_.begin[slot]);
      std::fill(lists_.neighbour.begin() + lists_.begin[slot], lists_.neighbour.begin() + lists_.begin[slot + 1], a);
      std::size_t inner = begin, outer = begin + static_cast<std::size_t>(lists_.inner[slot]);
      visit(a, [&](Pair const& p) {
        std::size_t const k = p.inner ? inner++ : outer++;
        lists_.neighbour[k] = p.b;
        if (p.inner) lists_.s[k] = s_of(p.r2);
        if (!equal_supports) lists_.l[k] = l_of(p.r2);
        if (options_.kernel_table) lists_.kernel[k] = kernel_of(p.r2);
      });
    }
  });
}

}  // namespace piola
