// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/fused_allreduce.hpp"
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>
#include <vector>

namespace piola {
namespace {

ReductionPayload<2> said(std::array<double, 2> const& sums, double largest, FailureSlot const& slot) {
  ReductionPayload<2> r;
  r.sums.add(sums.data());
  r.largest = largest;
  r.first = FirstFailure(slot);
  return r;
}

TEST(ReductionPayload, IsSumsTheLargestAndTheFirstFailureInAnyOrder) {
  std::vector<std::int64_t> const id{30, 10, 20};
  FailureSlot none{.id = id.data()}, later{0, 1, id.data()}, first{1, 2, id.data()};
  std::array const all{said({1, 1e20}, 3, none), said({2, 1}, 5, later), said({4, -1e20}, 4, first)};
  for (std::array<std::size_t, 3> const& order : {std::array<std::size_t, 3>{0, 1, 2}, {2, 1, 0}, {1, 2, 0}}) {
    ReductionPayload<2> together = all[order[0]];
    together.add(all[order[1]]);
    together.add(all[order[2]]);
    EXPECT_EQ(together.sums.value(0), 7);
    EXPECT_EQ(together.sums.value(1), 1);
    EXPECT_EQ(together.largest, 5);
    FailureSlot slot{.id = id.data()};
    together.first.put(slot);
    EXPECT_EQ(slot.index, 1) << "id 10 is before id 30";
    EXPECT_EQ(slot.code, 2);
  }
}

TEST(ReductionPayload, IsNotANumberWhereOneIsNot) {
  double const nan = std::numeric_limits<double>::quiet_NaN();
  for (auto const& [a, b] : {std::pair{1.0, nan}, std::pair{nan, 1.0}}) {
    ReductionPayload<2> together = said({0, 0}, a, {});
    together.add(said({0, 0}, b, {}));
    EXPECT_TRUE(std::isnan(together.largest));
    EXPECT_EQ(together.first.index, FailureSlot::none);
  }
}

TEST(FirstFailure, OfSlotsWithoutIdsIsThatOfTheLowestSlot) {
  FirstFailure first(FailureSlot{.index = 7, .code = 1});
  first.add(FirstFailure(FailureSlot{.index = 3, .code = 4}));
  first.add(FirstFailure(FailureSlot{}));
  EXPECT_EQ(first.index, 3);
  EXPECT_EQ(first.code, 4);
}

}  // namespace
}  // namespace piola
