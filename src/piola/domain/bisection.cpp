// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/bisection.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/halo_plan.hpp"
#include "piola/exec/device_loops.hpp"
#include <algorithm>
#include <array>
#include <limits>
#include <numeric>
#include <span>
#include <vector>

namespace piola {
namespace {

using Point = std::array<double, 3>;

constexpr auto leaf = static_cast<std::size_t>(exec::leaf_size);

/// Around some particles.
struct Box {
  Point low{std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity(),
            std::numeric_limits<double>::infinity()},
      high{-low[0], -low[1], -low[2]};
  void add(Point const& from, Point const& to) {
    for (std::size_t c = 0; c < 3; ++c) {
      low[c] = std::min(low[c], from[c]);
      high[c] = std::max(high[c], to[c]);
    }
  }
  double length(std::size_t c) const { return high[c] - low[c]; }
  double middle(std::size_t c) const { return low[c] + high[c]; }
};

class Bisection {
 public:
  Bisection(std::vector<Box> leaves, double reach, double spacing)
      : leaves_(std::move(leaves)), reach_(reach), spacing_(spacing) {}

  /// ends[k]: leaves of the parts 0 to k. Sorts `some` into the parts, in each by number.
  void cut(std::span<std::size_t> some, std::span<std::size_t const> ends, std::size_t before) const {
    if (ends.size() < 2 || some.empty()) return std::sort(some.begin(), some.end());
    std::size_t const half = ends.size() / 2, left = ends[half - 1] - before, c = best_axis(some);
    std::nth_element(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(left), some.end(),
                     [&](std::size_t a, std::size_t b) {
                       double const x = leaves_[a].middle(c), y = leaves_[b].middle(c);
                       return x != y ? x < y : a < b;
                     });
    cut(some.first(left), ends.first(half), before);
    cut(some.subspan(left), ends.subspan(half), before + left);
  }

 private:
  /// Estimate for cuts across an axis: particles within the support radius of a cut are those of the part over its
  /// length. Leaves that lie along the axis end at different places along it.
  std::size_t best_axis(std::span<std::size_t const> some) const {
    Box all;
    Point lengths{};
    for (std::size_t const k : some) {
      all.add(leaves_[k].low, leaves_[k].high);
      for (std::size_t c = 0; c < 3; ++c) lengths[c] += leaves_[k].length(c);
    }
    std::size_t best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < 3; ++c) {
      double const share = (reach_ + lengths[c] / static_cast<double>(some.size())) / (all.length(c) + spacing_);
      if (share < least) {
        least = share;
        best = c;
      }
    }
    return best;
  }

  std::vector<Box> leaves_;
  double reach_, spacing_;
};

}  // namespace

SlotOrder bisected(ParticleSet const& set, Body const& body, SlotOrder const& order, int ranks) {
  PIOLA_EXPECTS(ranks >= 1);
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  PIOLA_EXPECTS(order.particles == body.last - body.first && order.particles <= order.slots());
  if (ranks == 1) return order;
  std::size_t const whole = static_cast<std::size_t>(order.particles) / leaf;
  std::vector<Box> boxes(whole);
  for (std::size_t k = 0; k < whole * leaf; ++k) {
    Point const& X = set.X[static_cast<std::size_t>(order.id[k])];
    boxes[k / leaf].add(X, X);
  }
  std::vector<std::size_t> ends;
  for (int r = 0; r < ranks; ++r)
    ends.push_back(std::min(whole, static_cast<std::size_t>(even_range_of_rank(order.slots(), r, ranks).last) / leaf));
  double const spacing = *std::max_element(body.spacing.begin(), body.spacing.begin() + set.dimension);
  constexpr double reach = 2;  // spacings
  std::vector<std::size_t> from(whole);
  std::iota(from.begin(), from.end(), std::size_t{0});
  Bisection(std::move(boxes), reach * spacing, spacing).cut(from, ends, 0);
  SlotOrder permuted = order;
  for (std::size_t k = 0; k < whole; ++k)
    std::copy_n(order.id.begin() + static_cast<std::ptrdiff_t>(from[k] * leaf), leaf,
                permuted.id.begin() + static_cast<std::ptrdiff_t>(k * leaf));
  PIOLA_ENSURES(permuted.slots() == order.slots());
  return permuted;
}

}  // namespace piola
