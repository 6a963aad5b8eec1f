// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_list.hpp"
#include "piola/formulations/adaptle/state.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <iterator>
#include <limits>

namespace piola {
namespace {

using Point = std::array<double, 3>;
using Points = std::vector<Point>;

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

/// Points, their groups, and the lists that a machine makes of them.
struct Search {
  int dimension;
  Points x;
  double radius;
  std::vector<std::int32_t> group = {};
  bool across = false;
  Index capacity = 512;

  /// Numbers of the neighbours of every point, in the order of the list.
  std::vector<std::vector<Index>> lists(std::string const& name) const {
    adaptle::Backend const& backend = *adaptle::find_backend(name.c_str());
    auto const n = static_cast<Index>(x.size());
    CellList grid;
    grid.find_cells(x[0].data(), 3, n, dimension, radius);
    grid.sort({n});
    std::vector<std::int32_t> sorted_group(x.size() + 16);
    std::vector<Index> target;
    for (Index k = 0; k < n; ++k) {
      target.push_back(k);
      if (!group.empty()) sorted_group[at(k)] = group[at(grid.slots()[k])];
    }
    double const reach = 1 + grid.slack();
    std::vector<float> const square(2, static_cast<float>(reach * reach));
    std::vector<Index> list(x.size() * at(capacity), -1), length(x.size()), found(x.size());
    CellListSearch s;
    s.dimension = dimension;
    s.sources = n;
    for (int c = 0; c < 3; ++c) s.place[c] = grid.place(c);
    s.group = group.empty() ? nullptr : sorted_group.data();
    s.across = across;
    s.cell = grid.cells();
    s.begin = grid.begins();
    s.cells = grid.shape();
    s.reach = square.data();
    s.targets = n;
    s.target = target.data();
    s.capacity = capacity;
    s.list = list.data();
    s.length = length.data();
    s.found = found.data();
    backend.search(s);
    std::vector<std::vector<Index>> r(x.size());
    for (Index k = 0; k < n; ++k) {
      Index const i = grid.slots()[k];
      EXPECT_EQ(grid.sorted()[i], k);
      EXPECT_EQ(length[at(k)] % backend.lanes, 0);
      EXPECT_LT(length[at(k)] - found[at(k)], backend.lanes);
      for (Index m = 0; m < length[at(k)]; ++m) {
        Index const entry = list[at(k) * at(capacity) + at(m)];
        if (m < found[at(k)])
          r[at(i)].push_back(grid.slots()[entry]);
        else
          EXPECT_EQ(entry, n);  // the filler
      }
    }
    return r;
  }
  double distance(Index i, Index j) const {
    auto const &a = x[at(i)], &b = x[at(j)];
    return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
  }
  bool related(Index i, Index j) const { return group.empty() || (group[at(i)] == group[at(j)]) != across; }
};

Points cloud(int dimension, int n, std::uint32_t seed) {
  testing::Random random(seed);
  Points x(static_cast<std::size_t>(n));
  for (auto& p : x) p = {random.in(-1, 2), random.in(5, 6), dimension == 3 ? random.in(0, 1) : 0};
  return x;
}

/// All pairs within the radius are listed once; none that is farther than `slack` times the radius.
void expect_all_pairs(Search const& s, double slack = 1e-4) {
  for (auto names = adaptle::backend_names(); *names != nullptr; ++names) {
    auto const lists = s.lists(*names);
    auto const n = static_cast<Index>(s.x.size());
    std::size_t pairs = 0;
    for (Index i = 0; i < n; ++i) {
      std::vector<Index> sorted = lists[at(i)];
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(std::adjacent_find(sorted.begin(), sorted.end()), sorted.end()) << "listed twice";
      for (Index j = 0; j < n; ++j) {
        bool const listed = std::binary_search(sorted.begin(), sorted.end(), j);
        double const r = s.distance(i, j);
        bool const pair = i != j && s.related(i, j);
        if (pair && r >= s.radius && r <= s.radius * (1 + slack)) continue;
        EXPECT_EQ(listed, pair && r < s.radius) << *names << " " << i << " " << j;
      }
      pairs += sorted.size();
    }
    EXPECT_GT(pairs, s.x.size() / 2) << "nothing to compare";
  }
}

TEST(MovingPairs, AreAllPairsWithinTheRadius) {
  expect_all_pairs({2, cloud(2, 900, 1), 0.11});
  expect_all_pairs({3, cloud(3, 900, 2), 0.23});
  expect_all_pairs({2, cloud(2, 60, 3), 10});  // one cell
  expect_all_pairs({3, cloud(3, 37, 4), 10});
}

TEST(MovingPairs, AreAllPairsWithParticlesFarAway) {
  for (int const dimension : {2, 3}) {
    Points x = cloud(dimension, 500, 5);
    for (double const far : {40.0, -300.0, 1e4}) {
      x.push_back({far, 5.5, 0});
      x.push_back({far + 0.01, 5.5 - far, 0});
      x.push_back({far, 5.5 + 0.02, 0});
    }
    // Distances lose digits of single precision over the whole extent.
    expect_all_pairs({dimension, x, dimension == 2 ? 0.13 : 0.25}, 0.2);
  }
}

TEST(MovingPairs, AreAllPairsWithParticlesAtTheEndOfTheWorld) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  for (int const dimension : {2, 3})
    for (double const far : {1e30, -1e30, 1e300, infinity, nan}) {
      Points x = cloud(dimension, 500, 7);
      x.push_back({far, 5.5, 0});
      x[0] = {far, far, dimension == 3 ? far : 0};
      expect_all_pairs({dimension, x, dimension == 2 ? 0.13 : 0.25}, 0.2);
    }
}

TEST(MovingPairs, KeepToTheirGroupOrCrossIt) {
  for (int const dimension : {2, 3})
    for (bool const across : {false, true}) {
      Search s{dimension, cloud(dimension, 700, 6), dimension == 2 ? 0.12 : 0.25};
      for (std::size_t k = 0; k < s.x.size(); ++k) s.group.push_back(s.x[k][0] + 0.2 * s.x[k][1] > 1.5 ? 1 : 0);
      s.across = across;
      if (across)
        for (std::size_t k = 0; k < s.x.size(); k += 3) s.group[k] = 1 - s.group[k];
      expect_all_pairs(s);
    }
}

TEST(MovingPairs, ComeInTheSameOrderFromEveryMachine) {
  if (*std::next(adaptle::backend_names()) == nullptr) GTEST_SKIP() << "this build has one machine";
  for (int const dimension : {2, 3}) {
    Search const s{dimension, cloud(dimension, 1500, 8), dimension == 2 ? 0.11 : 0.2};
    auto const first = s.lists("auto");
    for (auto names = adaptle::backend_names(); *names != nullptr; ++names) EXPECT_EQ(s.lists(*names), first) << *names;
  }
}

/// Cells stay where they are when others go far: so does the order of neighbours. The slack follows from how far they
/// go: pairs just beyond the radius do not count.
TEST(MovingPairs, ComeInTheSameOrderHoweverFarOthersReach) {
  for (int const dimension : {2, 3}) {
    Search s{dimension, cloud(dimension, 900, 11), dimension == 2 ? 0.11 : 0.2};
    auto const lists_within = [&s] {
      auto lists = s.lists("auto");
      for (Index i = 0; i < 900; ++i)
        std::erase_if(lists[at(i)], [&](Index j) { return !(s.distance(i, j) < s.radius); });
      lists.resize(900);
      return lists;
    };
    auto const before = lists_within();
    Point const far[] = {{-3.03, 4.1, 0}, {2.9, 7.77, dimension == 3 ? -1.234 : 0}, {0, 3.3, dimension == 3 ? 2.5 : 0}};
    for (Point const& p : far) {
      s.x.push_back(p);
      EXPECT_EQ(lists_within(), before);
    }
  }
}

TEST(MovingPairs, TellHowMuchRoomALongListNeeds) {
  Search s{2, cloud(2, 200, 9), 10};
  adaptle::Backend const& backend = *adaptle::find_backend("auto");
  CellList grid;
  grid.find_cells(s.x[0].data(), 3, 200, 2, s.radius);
  grid.sort({200});
  std::vector<Index> list(32, -1), length(1), found(1);
  Index const target = 17;
  float const reach = 1.01F;
  CellListSearch q;
  q.dimension = 2;
  q.sources = 200;
  for (int c = 0; c < 3; ++c) q.place[c] = grid.place(c);
  q.cell = grid.cells();
  q.begin = grid.begins();
  q.cells = grid.shape();
  q.reach = &reach;
  q.targets = 1;
  q.target = &target;
  q.capacity = 32;
  q.list = list.data();
  q.length = length.data();
  q.found = found.data();
  backend.search(q);
  EXPECT_EQ(found[0], 199);
  EXPECT_GE(length[0], 199);
  EXPECT_EQ(list, std::vector<Index>(32, -1)) << "a list that is too long is not stored";
}

TEST(CellList, StaysFineBesideAParticleFarAway) {
  auto const fullest = [](Points const& x) {
    CellList grid;
    grid.find_cells(x[0].data(), 3, static_cast<Index>(x.size()), 3, 0.05);
    grid.sort({static_cast<Index>(x.size())});
    Index most = 0;
    for (Index c = 0; c < grid.cell_count(); ++c) most = std::max(most, grid.begins()[c + 1] - grid.begins()[c]);
    EXPECT_LT(grid.slack(), 0.1);
    EXPECT_LT(grid.cell_count(), 8 * std::ssize(x) + 200000);
    return most;
  };
  Points x = cloud(3, 3000, 11);
  Index const alone = fullest(x);
  x.push_back({1e30, 0, 0});
  EXPECT_LE(fullest(x), alone + 1);
  x.push_back({-1e25, 1e30, std::numeric_limits<double>::quiet_NaN()});
  EXPECT_LE(fullest(x), alone + 2);
}

TEST(CellList, SortsByCellsAndWithinACellByNumber) {
  Points const x = cloud(3, 400, 10);
  CellList grid;
  grid.find_cells(x[0].data(), 3, 400, 3, 0.3);
  grid.sort({400});
  EXPECT_EQ(grid.begins()[grid.cell_count()], 400);
  for (Index k = 1; k < 400; ++k) {
    Index const before = grid.cells()[k - 1], cell = grid.cells()[k];
    EXPECT_LE(before, cell);
    EXPECT_TRUE(before < cell || grid.slots()[k - 1] < grid.slots()[k]);
    EXPECT_LE(grid.begins()[cell], k);
    EXPECT_GT(grid.begins()[cell + 1], k);
  }
}

/// Of a part of the particles, in the cells and with the places of all: what a rank sorts.
TEST(CellList, SortsAPartAsItSortsAll) {
  for (int const dimension : {2, 3}) {
    Points x = cloud(dimension, 700, 12);
    x.push_back({4e4, 5.5, 0});
    x.push_back({0, -1e30, 0});
    auto const n = static_cast<Index>(x.size());
    std::array const origin{0.013, 5.2, 0.1};
    CellList all, some;
    all.find_cells(x[0].data(), 3, n, dimension, 0.11, origin);
    all.sort({n});
    std::vector<Index> part;
    for (Index i = 0; i < n; ++i)
      if (i % 3 != 1) part.push_back(i);
    SlotList const chosen{static_cast<Index>(part.size()), part.data()};
    int asked = 0;
    some.lay(bounds_of(x[0].data(), 3, {n}, dimension), n, dimension, 0.11, origin, [&](std::size_t axis) {
      ++asked;
      std::vector<double> along;
      for (Index i = n - 1; i >= 0; --i) along.push_back(x[at(i)][axis]);
      return along;
    });
    EXPECT_GT(asked, 0);
    some.find_cells(x[0].data(), 3, chosen);
    some.sort(chosen);
    EXPECT_EQ(some.slack(), all.slack());
    EXPECT_EQ(some.shape(), all.shape());
    ASSERT_EQ(some.count(), chosen.count);
    Index k = 0;
    for (Index of_all = 0; of_all < n; ++of_all) {
      Index const i = all.slots()[of_all];
      if (i % 3 == 1) continue;
      EXPECT_EQ(some.slots()[k], i);
      EXPECT_EQ(some.cells()[k], all.cells()[of_all]);
      EXPECT_EQ(some.sorted()[i], k);
      for (int c = 0; c < dimension; ++c) EXPECT_EQ(some.place(c)[k], all.place(c)[of_all]);
      ++k;
    }
  }
}

}  // namespace
}  // namespace piola
