// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/partition.hpp"
#include "piola/domain/load_balancer.hpp"
#include <algorithm>
#include <functional>
#include <gtest/gtest.h>
#include <numeric>
#include <random>

namespace piola {
namespace {

using Work = std::vector<double>;

/// What each rank has to do then.
Work loads(Work const& work, Work before, std::vector<Index> const& first) {
  for (std::size_t r = 0; r < first.size(); ++r) {
    auto const last = r + 1 < first.size() ? static_cast<std::size_t>(first[r + 1]) : work.size();
    for (auto k = static_cast<std::size_t>(first[r]); k < last; ++k) before[r] += work[k];
  }
  return before;
}

double busiest(Work const& work, Work const& before, std::vector<Index> const& first) {
  Work const all = loads(work, before, first);
  return *std::max_element(all.begin(), all.end());
}

/// Smallest load of the busiest rank over all partitions with at least `least` blocks per rank, found by trying all.
double least_of_all(Work const& work, Work const& before, Index least) {
  auto const blocks = static_cast<Index>(work.size()), ranks = static_cast<Index>(before.size());
  double best = 1e300;
  std::vector<Index> first{0};
  std::function<void()> const go_on = [&] {
    if (static_cast<Index>(first.size()) == ranks) {
      if (blocks - first.back() >= least) best = std::min(best, busiest(work, before, first));
      return;
    }
    for (Index k = first.back() + least; k <= blocks; ++k) {
      first.push_back(k);
      go_on();
      first.pop_back();
    }
  };
  go_on();
  return best;
}

Work nothing(std::size_t ranks) { return Work(ranks, 0); }

TEST(CutByWork, IsTheBestOfAllThatThereAre) {
  std::mt19937 random(7);
  for (int k = 0; k < 400; ++k) {
    std::size_t const ranks = 1 + random() % 4, blocks = 1 + random() % 9;
    Work work(blocks), before(ranks, 0);
    for (double& w : work) w = random() % 3 == 0 ? 0 : static_cast<double>(random() % 20);
    if (std::all_of(work.begin(), work.end(), [](double w) { return w == 0; })) work[0] = 1;
    bool const first_body = random() % 2 == 0;
    for (double& b : before) b = first_body ? 0 : static_cast<double>(random() % 30);
    bool const idle = std::all_of(before.begin(), before.end(), [](double b) { return b == 0; });
    auto const first = partition_by_work(work, before);
    ASSERT_EQ(first.size(), ranks);
    ASSERT_EQ(first.front(), 0);
    ASSERT_TRUE(std::is_sorted(first.begin(), first.end()));
    ASSERT_LE(first.back(), static_cast<Index>(blocks));
    Index const least = idle && blocks >= ranks ? 1 : 0;
    ASSERT_NEAR(busiest(work, before, first), least_of_all(work, before, least), 1e-9) << k;
    for (std::size_t r = 1; r < ranks; ++r) ASSERT_GE(first[r] - first[r - 1], least);
    ASSERT_GE(static_cast<Index>(blocks) - first.back(), least);
  }
}

TEST(CutByWork, SharesTheRestOutAsEquallyAsItCan) {
  EXPECT_EQ(loads(Work(10, 1), nothing(4), partition_by_work(Work(10, 1), nothing(4))), (Work{2, 3, 2, 3}));
  Work const heavy{1, 1, 1, 1, 9, 1, 1, 1, 1, 1, 1};
  Work const load = loads(heavy, nothing(3), partition_by_work(heavy, nothing(3)));
  EXPECT_EQ(*std::max_element(load.begin(), load.end()), 9);
}

TEST(CutByWork, WithoutWorkCountsBlocks) {
  EXPECT_EQ(partition_by_work(Work(6, 0), nothing(3)), (std::vector<Index>{0, 2, 4}));
  EXPECT_EQ(partition_by_work(Work{}, nothing(3)), (std::vector<Index>{0, 0, 0}));
}

TEST(CutByWork, LeavesNobodyOutWhereOneBlockHasAllTheWork) {
  EXPECT_EQ(partition_by_work(Work{0, 0, 0, 0, 7}, nothing(3)).size(), 3U);
  for (std::size_t at = 0; at < 5; ++at) {
    Work work(5, 0);
    work[at] = 7;
    auto const first = partition_by_work(work, nothing(3));
    EXPECT_LT(first[0], first[1]) << at;
    EXPECT_LT(first[1], first[2]) << at;
    EXPECT_LT(first[2], 5) << at;
  }
}

TEST(CutByWork, OfFewBlocksLeavesSomeRanksNothing) {
  auto const first = partition_by_work(Work{5, 5}, nothing(5));
  Work load = loads(Work{5, 5}, nothing(5), first);
  std::sort(load.begin(), load.end());
  EXPECT_EQ(load, (Work{0, 0, 0, 5, 5}));
  EXPECT_EQ(partition_by_work(Work{3}, nothing(1)), (std::vector<Index>{0}));
}

TEST(CutByWork, EvensOutWhatRanksHaveBesides) {
  Work const before{6, 0, 0};
  EXPECT_EQ(loads(Work(12, 1), before, partition_by_work(Work(12, 1), before)), (Work{6, 6, 6}));
}

TEST(Partition, OfEqualSharesIsThatOfBlocks) {
  for (Index const slots : {0, 1, 64, 65, 1000})
    for (int const ranks : {1, 2, 3, 7}) {
      Partition const cut({128, 128 + slots}, ranks);
      Index next = 128;
      for (int r = 0; r < ranks; ++r) {
        Range const share = even_range_of_rank(slots, r, ranks), part = cut.of(r);
        EXPECT_EQ(part.first, next);
        EXPECT_EQ(part.last - part.first, share.last - share.first);
        next = part.last;
      }
      EXPECT_EQ(next, 128 + slots);
    }
}

TEST(Partition, HasRunsOfBlocksThatBeginWhereItIsTold) {
  Partition const cut({10, 210}, {0, 3, 3, 4});
  EXPECT_EQ(cut.of(0).first, 10);
  EXPECT_EQ(cut.of(0).last, 202);
  EXPECT_EQ(cut.of(1).first, cut.of(1).last);
  EXPECT_EQ(cut.of(2).last, 210);
  EXPECT_EQ(cut.of(3).first, 210);
  EXPECT_EQ(cut.of(3).last, 210);
  EXPECT_EQ(cut.from_zero().of(2).first, 192);
  EXPECT_EQ(cut.from_zero(), Partition({0, 200}, {0, 3, 3, 4}));
  EXPECT_FALSE(cut == cut.from_zero());
}

TEST(LoadBalancer, KnowsHowMuchTheBusiestIsAboveTheMean) {
  EXPECT_DOUBLE_EQ(imbalance_of(Work{1, 1, 1}), 0);
  EXPECT_DOUBLE_EQ(imbalance_of(Work{0, 3}), 1);
  EXPECT_DOUBLE_EQ(imbalance_of(Work{0, 0}), 0);
  EXPECT_DOUBLE_EQ(imbalance_of(Work{}), 0);
}

TEST(LoadBalancer, LooksAtTimesAsOftenAsItIsTold) {
  auto const looks = [](Repartition when, int steps) {
    LoadBalancer balance(when);
    std::vector<int> due;
    for (int k = 0; k < steps; ++k) {
      balance.busy() += 1e-3;
      if (balance.due()) due.push_back(k);
    }
    return due;
  };
  EXPECT_EQ(looks({.every = 3}, 10), (std::vector<int>{3, 6, 9}));
  EXPECT_TRUE(looks({.never = true}, 1000).empty());
  EXPECT_TRUE(looks({}, 1000).empty()) << "one rank is as busy as the mean";
}

TEST(LoadBalancer, OfOneRankPlansAllForIt) {
  LoadBalancer balance({.every = 1});
  balance.busy() = 2;
  EXPECT_FALSE(balance.due());
  EXPECT_TRUE(balance.due());
  std::vector<Partition> const now{Partition({0, 130}), Partition({130, 140})};
  auto const [cuts, longest] = balance.plan(now, {{1, 1, 1}, {1}});
  EXPECT_EQ(cuts, now);
  EXPECT_NEAR(longest, 2, 1e-12);
  EXPECT_TRUE(balance.repartition_statistics().imbalance.empty());
}

TEST(WorkTimer, AddsTime) {
  double sum = 1;
  { WorkTimer const watch(sum); }
  EXPECT_GE(sum, 1);
  EXPECT_LT(sum, 1 + 1);
}

}  // namespace
}  // namespace piola
