// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/cell_marks.hpp"
#include "piola/neighbours/moving_pairs.hpp"
#include "math/random.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <set>
#include <vector>

namespace piola {
namespace {

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

TEST(RankSet, HasWhatWasAddedAndRanksThatDifferBy64) {
  RankSet some;
  EXPECT_TRUE(some.empty());
  some.add(3);
  RankSet more;
  more.add(130);
  some.add(more);
  EXPECT_TRUE(some.has(3) && some.has(130) && some.has(2) && some.has(67));
  EXPECT_FALSE(some.has(4) || some.has(0));
  std::set<int> within_five, within_hundred;
  some.each(5, [&](int rank) { within_five.insert(rank); });
  some.each(100, [&](int rank) { within_hundred.insert(rank); });
  EXPECT_EQ(within_five, (std::set{2, 3}));
  EXPECT_EQ(within_hundred, (std::set{2, 3, 66, 67}));
}

/// Particles of two bodies, of which some of the second flow, dealt to ranks.
struct Cloud {
  int dimension;
  std::vector<std::array<double, 3>> x;
  std::vector<Index> body;
  std::vector<std::uint8_t> flows;
  std::vector<int> owner;
  static constexpr double cell = 0.13;
  static constexpr int ranks = 5;

  explicit Cloud(int dim) : dimension(dim) {
    testing::Random random(17);
    for (int k = 0; k < 900; ++k) {
      double const along = random.in(0, 3);
      x.push_back({along, random.in(0, 0.4), dim == 3 ? random.in(0, 0.4) : 0});
      body.push_back(along > 1 ? 1 : 0);
      flows.push_back(along > 2 ? 1 : 0);
      owner.push_back(std::min(ranks - 1, static_cast<int>(along / 0.7)));
    }
  }
  double distance(std::size_t i, std::size_t j) const {
    return std::hypot(x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]);
  }
};

/// Whoever is within reach of a reader is told to its rank, and nobody who is two cells away.
TEST(CellMarks, TellThoseWithinReachAndNobodyFarAway) {
  for (int const dimension : {2, 3}) {
    Cloud const c(dimension);
    auto const n = static_cast<Index>(c.x.size());
    MovingGrid grid;
    grid.find_cells(c.x[0].data(), 3, n, dimension, Cloud::cell);
    CellMarks marks;
    marks.start(grid.shape(), dimension, true);
    for (Index i = 0; i < n; ++i) marks.add({grid.keys()[i], 1, c.body[at(i)], c.flows[at(i)]}, c.owner[at(i)]);
    marks.finish(true);
    double const far = 2 * Cloud::cell * std::sqrt(dimension);
    int told = 0, near = 0;
    for (Index i = 0; i < n; ++i) {
      std::uint8_t const kinds = marks.told(grid.keys()[i]);
      RankSet const readers = marks.readers(grid.keys()[i]);
      std::set<int> by_flow, by_touch, possible;
      for (Index j = 0; j < n; ++j) {
        double const r = c.distance(at(i), at(j));
        if (r < far) possible.insert(c.owner[at(j)]);
        if (!(r < Cloud::cell)) continue;
        bool const pair_flows = c.flows[at(i)] != 0 || c.flows[at(j)] != 0;
        if (pair_flows && c.body[at(i)] == c.body[at(j)]) by_flow.insert(c.owner[at(j)]);
        if (c.body[at(i)] != c.body[at(j)]) by_touch.insert(c.owner[at(j)]);
      }
      EXPECT_TRUE(by_flow.empty() || (kinds & CellMarks::flow) != 0);
      EXPECT_TRUE(by_touch.empty() || (kinds & CellMarks::touch) != 0);
      for (auto const* some : {&by_flow, &by_touch})
        for (int const rank : *some) EXPECT_TRUE(readers.has(rank)) << i << " to " << rank;
      readers.each(Cloud::ranks, [&](int rank) { EXPECT_TRUE(possible.contains(rank)) << i << " to " << rank; });
      told += kinds != 0 ? 1 : 0;
      near += by_flow.empty() && by_touch.empty() ? 0 : 1;
    }
    EXPECT_GT(near, 100);
    EXPECT_LT(told, 2 * n / 3) << "two thirds of the cloud neither flow nor are near another body";
  }
}

TEST(CellMarks, TellNothingWhereNothingFlowsOrTouches) {
  CellMarks marks;
  marks.start({4, 4, 1}, 2, true);
  marks.add({5, 2, 0, 0}, 0);
  marks.add({6, 1, 1, 0}, 1);
  marks.finish(false);
  EXPECT_EQ(marks.told(5), 0);
  EXPECT_TRUE(marks.readers(5).empty());
  marks.finish(true);
  EXPECT_EQ(marks.told(5), CellMarks::touch);
  EXPECT_TRUE(marks.readers(5).has(1));
}

/// Two bodies in one cell, of which each rank knows one.
TEST(CellMarks, KnowOfBodiesThatShareACell) {
  CellMarks::Cell mine{5, 1, 0, 0};
  mine.add(0, false);
  EXPECT_EQ(mine.body, 0);
  mine.add(1, true);
  EXPECT_EQ(mine.body, CellMarks::several);
  EXPECT_EQ(mine.particles, 3);
  CellMarks marks;
  marks.start({4, 4, 1}, 2, true);
  marks.add(mine, 1);
  marks.finish(true);
  EXPECT_EQ(marks.reads(5), CellMarks::flow | CellMarks::touch);
}

}  // namespace
}  // namespace piola
