// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cross_set_pairs.hpp"
#include "piola/base/errors.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <numeric>
#include <set>
#include <string>

namespace piola {
namespace {

using Points = std::vector<std::array<double, 3>>;

std::size_t at(Index k) { return static_cast<std::size_t>(k); }

/// Two sets of points in the unit cube, what is asked of their pairs, and the answer.
struct Sets {
  Points targets, sources;
  std::vector<double> h;
  std::vector<int> least;
  std::vector<Index> target_in_slot, slot_of_source;
  std::function<bool(Index, Index)> visible;
  double skin = 0;
  static constexpr Index filler = 999;

  Sets(int number_of_targets, int number_of_sources, double h0, std::uint32_t seed = 1) {
    testing::Random random(seed);
    auto const points = [&](int n) {
      Points r(static_cast<std::size_t>(n));
      for (auto& p : r) p = {random.in(0, 1), random.in(0, 1), random.in(0, 1)};
      return r;
    };
    targets = points(number_of_targets);
    sources = points(number_of_sources);
    h.assign(targets.size(), h0);
    least.assign(targets.size(), 0);
    // Slots backwards, with empty ones at the end; records of sources are shuffled by a stride.
    target_in_slot.assign((targets.size() + 15) / 16 * 16, -1);
    for (std::size_t k = 0; k < targets.size(); ++k) target_in_slot[k] = static_cast<Index>(targets.size() - 1 - k);
    for (int k = 0; k < number_of_sources; ++k) slot_of_source.push_back((k * 11) % number_of_sources);
  }
  CrossSetPairs pairs(int lanes = 4) const {
    CrossSetPairs r;
    r.build({targets, sources, h, 2, skin, least, target_in_slot, slot_of_source, visible}, lanes, filler);
    return r;
  }
  double distance(Index target, Index source) const {
    auto const &x = targets[at(target)], &y = sources[at(source)];
    return std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]);
  }
  /// Records of the sources nearer than `reach`.
  std::set<Index> around(Index target, double reach) const {
    std::set<Index> r;
    for (Index s = 0; s < static_cast<Index>(sources.size()); ++s)
      if (distance(target, s) <= reach && (!visible || visible(target, s))) r.insert(slot_of_source[at(s)]);
    return r;
  }
};

/// What the table says of a slot, fillers included.
std::vector<Index> row(CrossSetPairs const& pairs, int lanes, Index slot) {
  CrossSetPairTable const t = pairs.table();
  std::vector<Index> r;
  for (Index k = t.begin[slot / lanes]; k < t.begin[slot / lanes + 1]; ++k)
    r.push_back(t.source[k * lanes + slot % lanes]);
  return r;
}
std::vector<Index> row_of_target(Sets const& sets, CrossSetPairs const& pairs, int lanes, Index target) {
  auto const slot = std::find(sets.target_in_slot.begin(), sets.target_in_slot.end(), target);
  auto r = row(pairs, lanes, static_cast<Index>(slot - sets.target_in_slot.begin()));
  r.erase(std::find(r.begin(), r.end(), Sets::filler), r.end());
  return r;
}

TEST(CrossSetPairs, AreAllSourcesWithinTheSupportForAnyNumberOfLanes) {
  Sets const sets(90, 210, 0.11);
  for (int const lanes : {1, 2, 4, 8, 16}) {
    CrossSetPairs const pairs = sets.pairs(lanes);
    for (Index t = 0; t < 90; ++t) {
      auto const found = row_of_target(sets, pairs, lanes, t);
      std::set<Index> const expected = sets.around(t, 0.22);
      EXPECT_EQ(std::set<Index>(found.begin(), found.end()), expected);
      EXPECT_EQ(found.size(), expected.size()) << "none twice";
      auto const source = [&](Index slot) { return std::ranges::find(sets.slot_of_source, slot); };
      EXPECT_TRUE(std::is_sorted(found.begin(), found.end(), [&](Index a, Index b) { return source(a) < source(b); }))
          << "in the order of the set, wherever records are";
      EXPECT_EQ(pairs.count(t), static_cast<int>(expected.size()));
    }
  }
}

TEST(CrossSetPairs, FillShortListsAndSlotsWithoutTarget) {
  Sets const sets(5, 60, 0.15);
  int const lanes = 4;
  CrossSetPairs const pairs = sets.pairs(lanes);
  std::size_t longest = 0, fillers = 0;
  for (Index slot = 0; slot < 4; ++slot) {
    auto const all = row(pairs, lanes, slot);
    auto const real = static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](Index k) { return k < 60; }));
    longest = std::max(longest, real);
    fillers += all.size() - real;
    EXPECT_EQ(all.size(), row(pairs, lanes, 0).size()) << "lanes of a group have lists of one length";
  }
  EXPECT_EQ(row(pairs, lanes, 0).size(), longest);
  EXPECT_GT(fillers, 0u);
  for (Index slot = 5; slot < 8; ++slot)
    for (Index const k : row(pairs, lanes, slot)) EXPECT_EQ(k, Sets::filler);
  EXPECT_TRUE(row(pairs, lanes, 8).empty()) << "a group without any target";
  CrossSetPairTable const table = pairs.table();
  for (Index slot = 0; slot < 16; ++slot) EXPECT_TRUE(std::isfinite(table.inverse_h[slot])) << slot;
}

TEST(CrossSetPairs, WithASkinListMoreThanTheyCount) {
  Sets sets(40, 200, 0.1);
  sets.skin = 0.25;
  CrossSetPairs const pairs = sets.pairs();
  for (Index t = 0; t < 40; ++t) {
    auto const found = row_of_target(sets, pairs, 4, t);
    EXPECT_EQ(std::set<Index>(found.begin(), found.end()), sets.around(t, 0.25));
    EXPECT_EQ(pairs.count(t), static_cast<int>(sets.around(t, 0.2).size()));
  }
}

TEST(CrossSetPairs, LeaveOutWhatIsNotVisible) {
  Sets sets(40, 200, 0.12);
  sets.visible = [&](Index target, Index source) {
    return (sets.targets[at(target)][0] < 0.5) == (sets.sources[at(source)][0] < 0.5);
  };
  CrossSetPairs const pairs = sets.pairs();
  std::size_t hidden = 0;
  for (Index t = 0; t < 40; ++t) {
    auto const found = row_of_target(sets, pairs, 4, t);
    EXPECT_EQ(std::set<Index>(found.begin(), found.end()), sets.around(t, 0.24));
    hidden += static_cast<std::size_t>(std::count_if(sets.sources.begin(), sets.sources.end(), [&](auto const& y) {
      Index const s = static_cast<Index>(&y - sets.sources.data());
      return sets.distance(t, s) < 0.24 && !sets.visible(t, s);
    }));
  }
  EXPECT_GT(hidden, 10u);
}

TEST(CrossSetPairs, HaveTheWantedSmoothingLengthWhereThereIsEnoughAround) {
  Sets sets(30, 300, 0.3);
  sets.least.assign(30, 3);
  for (std::size_t k = 0; k < 30; ++k) sets.h[k] = 0.3 + 0.001 * static_cast<double>(k);
  CrossSetPairs const pairs = sets.pairs();
  for (Index slot = 0; slot < 30; ++slot)
    EXPECT_EQ(pairs.table().inverse_h[slot], 1 / sets.h[at(sets.target_in_slot[at(slot)])]);
}

/// Sources at 0, 1, 2, ... on a line, the target at 0: with h = 0.4 its support 0.8 holds one.
Sets line(int least) {
  Sets sets(1, 12, 0.4);
  sets.targets[0] = {0, 0, 0};
  for (std::size_t k = 0; k < 12; ++k) sets.sources[k] = {static_cast<double>(k), 0, 0};
  sets.least[0] = least;
  return sets;
}

/// What a support had to grow for shall lie within four fifths of it, where the kernel has some weight.
TEST(CrossSetPairs, GrowUntilTheyHaveEnough) {
  for (int least = 1; least <= 3; ++least) {
    Sets const sets = line(least);
    CrossSetPairs const pairs = sets.pairs();
    double const reach = 2 / pairs.table().inverse_h[0], wanted = (least - 1) / 0.8;
    EXPECT_GE(pairs.count(0), least);
    EXPECT_GT(reach, wanted);
    EXPECT_LE(reach, (1 + 1e-12) * std::max(0.8, 1.1 * wanted)) << "not more than a step further than needed";
    EXPECT_EQ(row_of_target(sets, pairs, 4, 0).size(), static_cast<std::size_t>(pairs.count(0)));
  }
}

/// The kernel vanishes on the edge of its support: a source there is none.
TEST(CrossSetPairs, DoNotCountASourceOnTheEdge) {
  Sets sets = line(2);
  sets.h[0] = 0.5;
  CrossSetPairs const pairs = sets.pairs();
  EXPECT_EQ(pairs.count(0), 2);
  EXPECT_GT(1 / pairs.table().inverse_h[0], 0.5);
  sets.least[0] = 1;
  EXPECT_EQ(sets.pairs().count(0), 1);
}

TEST(CrossSetPairs, RefuseATargetThatHasTooFewAroundIt) {
  Sets sets = line(5);  // the fourth source is 3 away; of a support of 2 * 4 * 0.4 = 3.2 only 80 % count
  sets.targets[0] = {0, 0, 0};
  try {
    (void)sets.pairs();
    FAIL() << "was accepted";
  } catch (InputError const& error) {
    EXPECT_EQ(std::string(error.what()),
              "neighbours: the particle at (0, 0, 0) m has 3 of the other set around it (5 are needed) - make the body "
              "wider or the spacing smaller");
  }
}

/// A particle whose cells are all gone has the length zero: no multiple of it reaches anything.
TEST(CrossSetPairs, RefuseATargetWithoutASmoothingLength) {
  for (double const h : {0.0, std::numeric_limits<double>::quiet_NaN()}) {
    Sets sets(3, 12, 2);
    sets.least.assign(3, 1);
    sets.h[1] = h;
    try {
      (void)sets.pairs();
      FAIL() << "was accepted";
    } catch (TooFewSources const& error) {
      EXPECT_EQ(error.target, 1);
    }
  }
}

TEST(CrossSetPairs, KnowTheirMemory) {
  Sets const few(30, 100, 0.1), many(30, 100, 0.2);
  EXPECT_GT(many.pairs().bytes(), few.pairs().bytes());
}

TEST(CrossSetPairs, CanBeBuiltAgain) {
  Sets const first(40, 200, 0.15), second(20, 80, 0.2, 2);
  CrossSetPairs pairs = first.pairs();
  pairs.build({second.targets, second.sources, second.h, 2, 0, second.least, second.target_in_slot,
               second.slot_of_source, second.visible},
              4, Sets::filler);
  CrossSetPairs const fresh = second.pairs();
  for (Index slot = 0; slot < 32; ++slot) EXPECT_EQ(row(pairs, 4, slot), row(fresh, 4, slot));
}

}  // namespace
}  // namespace piola
