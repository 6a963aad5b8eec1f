// SPDX-License-Identifier: Apache-2.0
// On one rank, which has everything; several are for ranks_test.py.
#include "piola/parallel/own_slots.hpp"
#include "piola/parallel/sum_over_slots.hpp"
#include <gtest/gtest.h>
#include <vector>

namespace piola {
namespace {

TEST(OwnSlots, OfOneRankAreAll) {
  Range const part = own_part({16, 1000});
  EXPECT_EQ(part.first, 16);
  EXPECT_EQ(part.last, 1000);
}

TEST(OwnSlots, OfOneRankStayAsTheyAre) {
  Field field("Velocity", "m/s", 2, Role::evolved);
  field.allocate(100, 0);
  for (Index i = 0; i < 100; ++i)
    for (int c = 0; c < 2; ++c) field.at(i, c) = 2 * i + c;
  complete_slots(field.ref(), 2, {16, 80});
  merge_slots(field.ref(), {0, 100}, std::vector<Index>{3, 99}, 2);
  for (Index i = 0; i < 100; ++i)
    for (int c = 0; c < 2; ++c) ASSERT_EQ(field.at(i, c), 2 * i + c);
  EXPECT_EQ(sum_over_slots(false, {10, 20}, [&](Index i) { return field.at(i, 1); }), 2 * 145 + 10);
}

TEST(OwnSlots, OfSeveralBodiesAreNamedRankByRank) {
  std::vector<Shares> const bodies{Shares({0, 100}), Shares({100, 130})};
  SlotsOfRanks const odd(bodies, [](Index slot) { return slot % 2 == 1; });
  EXPECT_EQ(odd.starts, (std::vector<std::size_t>{0, 65}));
  EXPECT_EQ(odd.slots.front(), 1);
  EXPECT_EQ(odd.slots.back(), 129);
  std::vector<double> values(130, 7);
  complete_slots(std::vector<FieldPart>{{{.data = values.data()}, 0, 1}}, odd);
  EXPECT_EQ(values, std::vector<double>(130, 7));
}

TEST(OwnSlots, TellSeveralThingsAtOnce) {
  std::vector<double> first(10, 1), second(10, 2);
  FailureSlot slot{.index = 3, .code = 2};
  FailuresOfRanks failures(slot);
  SlotsOfRanks const all(std::vector<Shares>{Shares({0, 10})}, [](Index) { return true; });
  complete_slots(
      std::array{ToldToAll{{{{.data = first.data()}, 0, 1}, {{.data = second.data()}, 0, 1}}, &all}, failures.told()});
  failures.put(slot);
  EXPECT_EQ(first, std::vector<double>(10, 1));
  EXPECT_EQ(slot.index, 3);
  EXPECT_EQ(slot.code, 2);
  FailureSlot none;
  FailuresOfRanks(none).put(none);
  EXPECT_EQ(none.index, FailureSlot::none);
}

TEST(OwnSlots, KeepTheFirstFailureOfOneRank) {
  std::vector<std::int64_t> const id{7, 5, -1};
  FailureSlot slot{.index = 1, .code = 2, .id = id.data()};
  share_failure(slot);
  EXPECT_EQ(slot.index, 1);
  EXPECT_EQ(slot.code, 2);
  FailureSlot none;
  share_failure(none);
  EXPECT_EQ(none.index, FailureSlot::none);
}

}  // namespace
}  // namespace piola
