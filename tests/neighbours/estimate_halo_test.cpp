// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/estimate_halo.hpp"
#include "piola/domain/bisection.hpp"
#include "piola/domain/halo_plan.hpp"
#include "piola/particles/ordering.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <numeric>

namespace piola {
namespace {

using Points = std::vector<std::array<double, 3>>;

Points lattice(std::array<int, 3> const& n) {
  Points X;
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) X.push_back({1.0 * i, 1.0 * j, 1.0 * k});
  return X;
}

TEST(HaloCount, OfTwoHalvesOfALatticeIsTheLayersWithinReach) {
  Points const X = lattice({10, 6, 5});
  std::vector<int> owner;
  for (auto const& x : X) owner.push_back(x[0] < 4 ? 0 : 1);
  for (auto const& [reach, layers] : {std::pair{0.5, 0}, {1.0, 0}, {1.5, 1}, {2.0, 1}, {2.5, 2}}) {
    auto const reads = count_halos(X, owner, 2, reach);
    ASSERT_EQ(reads[0].empty() ? 0 : reads[0].at(1), 30 * layers) << reach;
    ASSERT_EQ(reads[1].empty() ? 0 : reads[1].at(0), 30 * layers) << reach;
  }
}

TEST(HaloCount, IsWhatAllPairsSay) {
  Points X;
  std::vector<int> owner;
  for (int k = 0; k < 300; ++k) {
    X.push_back({0.37 * (k * 7919 % 97), 0.41 * (k * 104729 % 89), 0.29 * (k * 1299709 % 83)});
    owner.push_back(k * k % 5);
  }
  double const reach = 6;
  std::vector<std::map<int, std::int64_t>> expected(5);
  for (std::size_t b = 0; b < X.size(); ++b)
    for (int r = 0; r < 5; ++r) {
      bool read = false;
      for (std::size_t a = 0; a < X.size(); ++a) {
        double square = 0;
        for (std::size_t c = 0; c < 3; ++c) square += (X[a][c] - X[b][c]) * (X[a][c] - X[b][c]);
        read = read || (owner[a] == r && square < reach * reach);
      }
      if (read && owner[b] != r) expected[static_cast<std::size_t>(r)][owner[b]] += 1;
    }
  EXPECT_EQ(count_halos(X, owner, 5, reach), expected);
}

/// Recursive coordinate bisection: some particles are halved across the longest side of their box, again and again. M.
/// J. Berger, S. H. Bokhari, IEEE Trans. Comput. C-36 (1987) 570-580.
void bisect(Points const& X, std::span<std::size_t> some, int rank, int ranks, std::vector<int>& owner) {
  if (ranks == 1) {
    for (std::size_t const k : some) owner[k] = rank;
    return;
  }
  std::size_t longest = 0;
  double length = -1;
  for (std::size_t c = 0; c < 3; ++c) {
    auto const [low, high] =
        std::minmax_element(some.begin(), some.end(), [&](std::size_t a, std::size_t b) { return X[a][c] < X[b][c]; });
    if (X[*high][c] - X[*low][c] <= length) continue;
    length = X[*high][c] - X[*low][c];
    longest = c;
  }
  int const left = ranks / 2;
  std::size_t const middle = some.size() * static_cast<std::size_t>(left) / static_cast<std::size_t>(ranks);
  std::nth_element(some.begin(), some.begin() + static_cast<std::ptrdiff_t>(middle), some.end(),
                   [&](std::size_t a, std::size_t b) {
                     return X[a][longest] != X[b][longest] ? X[a][longest] < X[b][longest] : a < b;
                   });
  bisect(X, some.first(middle), rank, left, owner);
  bisect(X, some.subspan(middle), rank + left, ranks - left, owner);
}

struct Halo {
  std::int64_t most = 0;  ///< that a rank reads of others
  std::size_t neighbours = 0;
};

Halo largest_halo(Points const& X, std::vector<int> const& owner, int ranks, double reach) {
  Halo h;
  for (auto const& of_rank : count_halos(X, owner, ranks, reach)) {
    std::int64_t sum = 0;
    for (auto const& [other, count] : of_rank) sum += count;
    h.most = std::max(h.most, sum);
    h.neighbours = std::max(h.neighbours, of_rank.size());
  }
  return h;
}

/// Who has which particle where each rank has its share of an order.
std::vector<int> owners(ParticleSet const& set, SlotOrder const& order, int ranks) {
  std::vector<int> owner(set.X.size());
  for (int r = 0; r < ranks; ++r) {
    Range const own = even_range_of_rank(order.slots(), r, ranks);
    for (Index slot = own.first; slot < std::min(own.last, order.particles); ++slot)
      owner[static_cast<std::size_t>(order.id[static_cast<std::size_t>(slot)])] = r;
  }
  return owner;
}

/// The tables of records 25 and 0110. Runs of pencils are planks along the longest side where bisection of particles
/// makes cubes; bisection of leaves lies between them.
TEST(HaloCount, OfRunsOfPencilsAndOfBisection) {
  for (auto const& particles : {std::array{26, 157, 26}, {48, 48, 48}, {120, 80, 24}}) {
    ShapeSpec box;
    box.kind = ShapeSpec::Kind::box;
    box.dimension = 3;
    box.particles = particles;
    for (std::size_t c = 0; c < 3; ++c) box.max[c] = particles[c] - 1;
    ParticleSet set;
    fill(box, "box", set);
    Body const& body = set.bodies[0];
    SlotOrder const pencils = pencil_order(set, body);
    Points const X(set.X.begin(), set.X.end());
    for (int const ranks : {2, 3, 4, 8, 16, 32}) {
      std::vector<int> halved(X.size());
      std::vector<std::size_t> all(X.size());
      std::iota(all.begin(), all.end(), std::size_t{0});
      bisect(X, all, 0, ranks, halved);
      constexpr double reach = 2.4;  // of the default filter of jst_sph, in spacings
      Halo const runs = largest_halo(X, owners(set, pencils, ranks), ranks, reach),
                 leaves = largest_halo(X, owners(set, bisected(set, body, pencils, ranks), ranks), ranks, reach),
                 finest = largest_halo(X, halved, ranks, reach);
      fmt::print(
          "{} on {} ranks: {} particles each, {} of {} ranks read by runs, {} of {} by bisection of leaves, "
          "{} of {} of particles\n",
          fmt::join(particles, " x "), ranks, X.size() / static_cast<std::size_t>(ranks), runs.most, runs.neighbours,
          leaves.most, leaves.neighbours, finest.most, finest.neighbours);
      EXPECT_LE(leaves.most, runs.most);
      EXPECT_GE(static_cast<double>(leaves.most), 0.9 * static_cast<double>(finest.most));
    }
  }
}

}  // namespace
}  // namespace piola
