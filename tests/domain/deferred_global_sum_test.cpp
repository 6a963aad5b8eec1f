// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/deferred_global_sum.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

exec::ReproducibleSum parallel_sum(double a, double b) {
  exec::ReproducibleSum sum;
  sum += a;
  sum += b;
  return sum;
}

TEST(DeferredGlobalSum, HasTheBitsOfOneThatIsKeptUpToDate) {
  DeferredGlobalSum late;
  double now = 0;
  for (int step = 1; step < 2500; ++step) {
    double const a = 0.1 * step, b = -1.0 / step, known = 1e-3 / step;
    late.add_part(parallel_sum(a, b));
    late.add(known);
    now += parallel_sum(a, b).value();
    now += known;
  }
  EXPECT_FALSE(late.settled());
  late.settle();
  EXPECT_TRUE(late.settled());
  EXPECT_EQ(late.value(), now);
}

TEST(DeferredGlobalSum, AddsAtOnceWhatAllKnowIfNothingIsOpen) {
  DeferredGlobalSum total;
  total.add(3);
  EXPECT_TRUE(total.settled());
  EXPECT_EQ(total.value(), 3);
}

TEST(DeferredGlobalSum, ForgetsWhatIsOpenWhenItIsSet) {
  DeferredGlobalSum total;
  total.add_part(parallel_sum(1, 2));
  total.set(7);
  total.settle();
  EXPECT_EQ(total.value(), 7);
}

}  // namespace
}  // namespace piola
