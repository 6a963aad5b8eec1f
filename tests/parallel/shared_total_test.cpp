// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/shared_total.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

exec::ExactSum sum_of(double a, double b) {
  exec::ExactSum sum;
  sum += a;
  sum += b;
  return sum;
}

TEST(SharedTotal, HasTheBitsOfOneThatIsKeptUpToDate) {
  SharedTotal late;
  double now = 0;
  for (int step = 1; step < 2500; ++step) {
    double const a = 0.1 * step, b = -1.0 / step, known = 1e-3 / step;
    late.add_part(sum_of(a, b));
    late.add(known);
    now += sum_of(a, b).value();
    now += known;
  }
  EXPECT_FALSE(late.settled());
  late.settle();
  EXPECT_TRUE(late.settled());
  EXPECT_EQ(late.value(), now);
}

TEST(SharedTotal, AddsAtOnceWhatAllKnowIfNothingIsOpen) {
  SharedTotal total;
  total.add(3);
  EXPECT_TRUE(total.settled());
  EXPECT_EQ(total.value(), 3);
}

TEST(SharedTotal, ForgetsWhatIsOpenWhenItIsSet) {
  SharedTotal total;
  total.add_part(sum_of(1, 2));
  total.set(7);
  total.settle();
  EXPECT_EQ(total.value(), 7);
}

}  // namespace
}  // namespace piola
