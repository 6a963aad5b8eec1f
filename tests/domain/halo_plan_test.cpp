// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/halo_plan.hpp"
#include "piola/domain/error_agreement.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace piola {
namespace {

TEST(ShareOf, CoversAllSlotsOnceAndStartsWithBlocks) {
  for (Index const slots : {0, 16, 64, 80, 1000, 106'144})
    for (int const count : {1, 2, 3, 5, 7, 64}) {
      Index next = 0;
      for (int r = 0; r < count; ++r) {
        Range const own = even_range_of_rank(slots, r, count);
        ASSERT_EQ(own.first, next) << slots << " slots, rank " << r << " of " << count;
        ASSERT_TRUE(own.first % exec::block_size == 0 || own.first == slots);
        ASSERT_LE(own.last - own.first, (slots / exec::block_size / count + 2) * exec::block_size);
        next = own.last;
      }
      ASSERT_EQ(next, slots);
    }
}

TEST(ShareOf, HasNothingForRanksBeyondTheBlocks) {
  int with_particles = 0;
  for (int r = 0; r < 7; ++r)
    with_particles += even_range_of_rank(130, r, 7).first < even_range_of_rank(130, r, 7).last ? 1 : 0;
  EXPECT_EQ(with_particles, 3);
}

TEST(HaloPlan, OfOneRankReceivesNothing) {
  HaloPlan plan(640, {1, 5, 5, 639});
  EXPECT_EQ(plan.add_cutoff({7}), 1);
  EXPECT_TRUE(plan.received().empty());
}

TEST(HaloPlan, TellsFieldsOfWhichNothingChangesFromForgottenOnes) {
  std::vector<double> still(640, 1), forgotten(640, 1);
  FieldRef field;
  field.data = still.data();
  HaloPlan plan(640, {1, 639});
  plan.add(field, 0, 0);
  EXPECT_NO_THROW(plan.exchange(field));
  field.data = forgotten.data();
#if defined(PIOLA_CONTRACTS) && PIOLA_CONTRACTS
  EXPECT_ANY_THROW(plan.exchange(field));
#endif
}

TEST(Ranks, AreOneWithoutALauncher) {
  EXPECT_EQ(comm::size(), 1);
  EXPECT_EQ(comm::rank(), 0);
  double value = std::numeric_limits<double>::quiet_NaN();
  comm::allreduce_max(value);
  EXPECT_TRUE(std::isnan(value));
  std::vector<double> const values{1, -0.0, 3};
  EXPECT_EQ(comm::gather(values), values);
  EXPECT_EQ(comm::agree({2, "no such file"}).message, "no such file");
  EXPECT_EQ(comm::agree_within(1, {2, "no such file"})->code, 2);
  EXPECT_TRUE(comm::all_equal(17));
  EXPECT_EQ(comm::comm_statistics().collectives, 0);
}

}  // namespace
}  // namespace piola
