// SPDX-License-Identifier: Apache-2.0
// On one rank, which has everything; several are for ranks_test.py.
#include "piola/domain/slot_collectives.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

TEST(OwnSlots, OfOneRankStayAsTheyAre) {
  Field field("Velocity", "m/s", 2, Role::evolved);
  field.allocate(100, 0);
  for (Index i = 0; i < 100; ++i)
    for (int c = 0; c < 2; ++c) field.at(i, c) = 2 * i + c;
  allgather_selected_slots(field.ref(), {0, 100}, std::vector<Index>{3, 99}, 2);
  for (Index i = 0; i < 100; ++i)
    for (int c = 0; c < 2; ++c) ASSERT_EQ(field.at(i, c), 2 * i + c);
  EXPECT_EQ(sum_over_slots(false, {10, 20}, [&](Index i) { return field.at(i, 1); }), 2 * 145 + 10);
}

TEST(OwnSlots, KeepTheFirstFailureOfOneRank) {
  std::vector<std::int64_t> const id{7, 5, -1};
  FailureSlot slot{.index = 1, .code = 2, .id = id.data()};
  allreduce_first_failure(slot);
  EXPECT_EQ(slot.index, 1);
  EXPECT_EQ(slot.code, 2);
  FailureSlot none;
  allreduce_first_failure(none);
  EXPECT_EQ(none.index, FailureSlot::none);
}

}  // namespace
}  // namespace piola
