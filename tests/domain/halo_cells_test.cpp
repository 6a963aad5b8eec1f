// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/halo_cells.hpp"
#include "piola/neighbours/cell_list.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <vector>

namespace piola {
namespace {

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

TEST(QuantisedBounds, IsAsFarAsItsNearestPlace) {
  QuantisedBounds box;
  box.add({0.25, 0.5, 0});
  box.add({0.75, 0.5, 0});
  EXPECT_EQ(box.bounds({}).square_from({0.5, 0.5, 0}), 0);
  EXPECT_NEAR(box.bounds({}).square_from({-0.75, 0.5, 0}), 1, 1e-12);
  // Bounds exceed the farthest position by at most 1/256 of a cell.
  EXPECT_NEAR(box.bounds({}).square_from({1.75, 1.5, 0}), 2, 0.02);
  EXPECT_LE(box.bounds({}).square_from({1.75, 1.5, 0}), 2);
  box.add({1.5, 0.5, 0});  // a position outside its cell makes the bounds infinite
  EXPECT_EQ(box.bounds({}).square_from({100, 0, 0}), 0);
}

/// Particles of two bodies, distributed over ranks; a part of the second body is Eulerian.
struct Cloud {
  int dimension;
  std::vector<std::array<double, 3>> x;
  std::vector<Index> body;
  std::vector<std::uint8_t> is_eulerian;
  std::vector<int> owner;
  static constexpr double cell = 0.13;
  static constexpr int ranks = 5;

  explicit Cloud(int dim) : dimension(dim) {
    testing::Random random(17);
    for (int k = 0; k < 900; ++k) {
      double const along = random.in(0, 3);
      x.push_back({along, random.in(0, 0.4), dim == 3 ? random.in(0, 0.4) : 0});
      body.push_back(along > 1 ? 1 : 0);
      is_eulerian.push_back(along > 2 ? 1 : 0);
      owner.push_back(std::min(ranks - 1, static_cast<int>(along / 0.7)));
    }
  }
  double distance(std::size_t i, std::size_t j) const {
    return std::hypot(x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]);
  }
};

/// A particle is exported to each rank with an interacting particle within one cell size, and to no rank whose
/// particles are all farther away than (1 + sqrt(dimension)) cell sizes.
TEST(HaloCells, TellThoseWithinReachAndNobodyFarAway) {
  for (int const dimension : {2, 3}) {
    Cloud const c(dimension);
    auto const n = static_cast<Index>(c.x.size());
    CellList grid;
    grid.find_cells(c.x[0].data(), 3, n, dimension, Cloud::cell, {0.01, 0.02, 0.03});
    std::map<std::pair<Index, int>, HaloCells::Cell> cells;
    for (Index i = 0; i < n; ++i) {
      Index const key = grid.keys()[i];
      std::array<double, 3> place = grid.where(i);
      for (std::size_t d = 0; d < 3; ++d) place[d] -= grid.corner(key)[d];
      cells.try_emplace({key, c.owner[at(i)]}, HaloCells::Cell{key, c.body[at(i)]})
          .first->second.add(c.body[at(i)], c.is_eulerian[at(i)] != 0, place);
    }
    HaloCells marks;
    marks.start(grid.shape(), dimension);
    for (auto const& [place, cell] : cells) marks.add(cell, place.second);
    marks.finish(true);
    double const reach = grid.search_radius_in_cells(), far = (1 + std::sqrt(dimension)) * Cloud::cell;
    int exported = 0, near = 0;
    for (Index i = 0; i < n; ++i) {
      std::uint8_t const kinds = marks.exports(grid.keys()[i]);
      std::set<int> by_flow, by_touch, possible, readers;
      for (HaloCells::Reader const& reader : marks.readers(grid.keys()[i], c.owner[at(i)]))
        if (reader.box.bounds(grid.corner(reader.cell)).square_from(grid.where(i)) <= reach * reach)
          readers.insert(reader.rank);
      for (Index j = 0; j < n; ++j) {
        double const r = c.distance(at(i), at(j));
        if (c.owner[at(j)] == c.owner[at(i)]) continue;
        if (r < far) possible.insert(c.owner[at(j)]);
        if (!(r < Cloud::cell)) continue;
        bool const pair_flows = c.is_eulerian[at(i)] != 0 || c.is_eulerian[at(j)] != 0;
        if (pair_flows && c.body[at(i)] == c.body[at(j)]) by_flow.insert(c.owner[at(j)]);
        if (c.body[at(i)] != c.body[at(j)]) by_touch.insert(c.owner[at(j)]);
      }
      EXPECT_TRUE(by_flow.empty() || (kinds & HaloCells::flow) != 0);
      EXPECT_TRUE(by_touch.empty() || (kinds & HaloCells::touch) != 0);
      EXPECT_TRUE(std::ranges::includes(readers, by_flow)) << i;
      EXPECT_TRUE(std::ranges::includes(readers, by_touch)) << i;
      EXPECT_TRUE(std::ranges::includes(possible, readers)) << i;
      exported += readers.empty() ? 0 : 1;
      near += by_flow.empty() && by_touch.empty() ? 0 : 1;
    }
    EXPECT_GT(near, 30);
    EXPECT_LT(exported, 2 * near);
  }
}

/// Sending and receiving ranks derive the same pairs of ranks. Cells behind a contact surface export nothing.
TEST(HaloCells, LetBothSidesKnowWhoMeets) {
  for (bool const touching : {false, true}) {
    HaloCells marks;
    marks.start({9, 5, 1}, 2);
    // Along x: three cells of one body, each on a rank of its own, then two cells of the other body.
    for (Index k = 0; k < 5; ++k)
      for (Index row : {9, 18, 27}) marks.add({row + k + 1, k < 3 ? 0 : 1}, k < 3 ? static_cast<int>(k) : 3);
    marks.finish(touching);
    using Pairs = std::set<std::pair<int, int>>;  // sending rank, receiving rank
    Pairs by_sender, by_receiver;
    for (Index k = 0; k < 5; ++k)
      for (Index row : {9, 18, 27}) {
        int const own = k < 3 ? static_cast<int>(k) : 3;
        for (HaloCells::Reader const& reader : marks.readers(row + k + 1, own)) by_sender.insert({own, reader.rank});
        marks.each_exporter(row + k + 1, own, [&](int rank) { by_receiver.insert({rank, own}); });
      }
    EXPECT_EQ(by_sender, by_receiver);
    EXPECT_EQ(by_sender, touching ? (Pairs{{2, 3}, {3, 2}}) : Pairs{});
  }
}

TEST(HaloCells, TellNothingWhereNothingFlowsOrTouches) {
  HaloCells marks;
  marks.start({4, 4, 1}, 2);
  marks.add({5, 0}, 0);
  marks.add({6, 1}, 1);
  marks.finish(false);
  EXPECT_EQ(marks.exports(5), 0);
  EXPECT_TRUE(marks.readers(5, 0).empty());
  marks.finish(true);
  EXPECT_EQ(marks.exports(5), HaloCells::touch);
  ASSERT_EQ(marks.readers(5, 0).size(), 1);
  EXPECT_EQ(marks.readers(5, 0).front().rank, 1);
  std::set<int> others;
  marks.each_exporter(6, 1, [&](int rank) { others.insert(rank); });
  EXPECT_EQ(others, std::set{0});
}

/// Two bodies in one cell, of which each rank knows one.
TEST(HaloCells, KnowOfBodiesThatShareACell) {
  HaloCells::Cell mine{5, 0};
  mine.add(0, false, {0.5, 0.5, 0});
  EXPECT_EQ(mine.body, 0);
  mine.add(1, true, {0.5, 0.5, 0});
  EXPECT_EQ(mine.body, HaloCells::several);
  HaloCells marks;
  marks.start({4, 4, 1}, 2);
  marks.add(mine, 1);
  marks.finish(true);
  EXPECT_EQ(marks.reads(5), HaloCells::flow | HaloCells::touch);
}

}  // namespace
}  // namespace piola
