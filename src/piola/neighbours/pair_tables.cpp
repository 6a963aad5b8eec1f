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
  auto key() const { return std::tuple{group, delta, offset}; }
};

/// The entries of one group of lanes in comparable form: group, delta, offset, lanes present.
using Shape = std::vector<std::array<std::int32_t, 4>>;

Shape shape_of(std::vector<LanePair>& pairs) {
  std::sort(pairs.begin(), pairs.end(), [](auto const& a, auto const& b) { return a.key() < b.key(); });
  Shape shape;
  for (std::size_t k = 0; k < pairs.size();) {
    std::int32_t lanes = 0;
    auto const key = pairs[k].key();
    std::array<std::int32_t, 4> entry{pairs[k].group, pairs[k].delta, pairs[k].offset, 0};
    for (; k < pairs.size() && pairs[k].key() == key; ++k) lanes |= 1 << pairs[k].lane;
    entry[3] = lanes;
    shape.push_back(entry);
  }
  return shape;
}

}  // namespace

void ReferencePairs::make_stencils() {
  int const W = options_.lanes;
  std::int32_t const full = (1 << W) - 1;
  std::map<Shape, std::int32_t> known;
  std::int64_t lanes_present = 0, lanes_all = 0;
  std::vector<LanePair> pairs;
  auto const add = [&](Shape const& shape, int group, bool masked, std::int32_t(&run)[2]) {
    run[0] = static_cast<std::int32_t>(entries_.size());
    for (auto const& e : shape) {
      if (e[0] != group || (e[3] != full) != masked) continue;
      entries_.push_back({e[1], e[2], static_cast<std::int32_t>(weights_.size())});
      for (int lane = 0; masked && lane < W; ++lane) weights_.push_back(((e[3] >> lane) & 1) != 0 ? 1.0 : 0.0);
    }
    run[1] = static_cast<std::int32_t>(entries_.size());
  };
  for (Index first = 0; first < static_cast<Index>(id_.size()); first += W) {
    pairs.clear();
    for (int lane = 0; lane < W && first + lane < particles_; ++lane)
      visit(first + lane, [&](Pair const& p) {
        pairs.push_back({p.inner ? 0 : 1, p.b - (first + lane), p.offset, lane});
      });
    Shape const shape = shape_of(pairs);
    lanes_present += static_cast<std::int64_t>(pairs.size());
    lanes_all += static_cast<std::int64_t>(shape.size()) * W;
    auto const [at, is_new] = known.try_emplace(shape, static_cast<std::int32_t>(patterns_.size()));
    if (is_new) {
      StencilPattern p{};
      add(shape, 0, false, p.inner);
      add(shape, 0, true, p.inner_masked);
      add(shape, 1, false, p.outer);
      add(shape, 1, true, p.outer_masked);
      patterns_.push_back(p);
    }
    pattern_of_.push_back(at->second);
  }
  fill_ = lanes_all > 0 ? static_cast<double>(lanes_present) / static_cast<double>(lanes_all) : 0;
}

void ReferencePairs::make_list() {
  auto const W = static_cast<std::size_t>(options_.lanes);
  bool const equal_supports = options_.h_laplacian <= 0 || options_.h_laplacian == options_.h_gradient;
  auto const pad = [&](Index a) {
    while (list_neighbour_.size() % W != 0) {
      list_neighbour_.push_back(a);
      list_s_.push_back(0);
      if (!equal_supports) list_l_.push_back(0);
      if (options_.kernel_table) list_kernel_.push_back(0);
    }
  };
  auto const add = [&](Pair const& p) {
    list_neighbour_.push_back(p.b);
    list_s_.push_back(p.inner ? s_of(p.r2) : 0);
    if (!equal_supports) list_l_.push_back(l_of(p.r2));
    if (options_.kernel_table) list_kernel_.push_back(kernel_of(p.r2));
  };
  for (Index a = 0; a < static_cast<Index>(id_.size()); ++a) {
    list_begin_.push_back(static_cast<std::int64_t>(list_neighbour_.size()));
    auto const run = [&](bool inner) {
      if (a < particles_)
        visit(a, [&](Pair const& p) {
          if (p.inner == inner) add(p);
        });
      pad(a);
    };
    run(true);
    list_inner_.push_back(
        static_cast<std::int32_t>(static_cast<std::int64_t>(list_neighbour_.size()) - list_begin_.back()));
    run(false);
  }
  list_begin_.push_back(static_cast<std::int64_t>(list_neighbour_.size()));
}

}  // namespace piola
