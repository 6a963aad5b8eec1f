// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/options.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola::jst_advection {
namespace {

TEST(AdvectionOptions, AreThoseOfThePaperByDefault) {
  Options const o = read_options({"jst_advection", {}, {}}, std::nan(""));
  EXPECT_EQ(o.eps4, 0.125);
  EXPECT_EQ(o.cfl, 0.3);
  EXPECT_EQ(o.wave_speed, 1);
}

TEST(AdvectionOptions, AreTakenFromTheCase) {
  Options const o = read_options({"jst_advection", {{"wave_speed", 7.0}, {"eps4_momentum", 0.25}}, {}}, 0.9);
  EXPECT_EQ(o.eps4, 0.25);
  EXPECT_EQ(o.cfl, 0.9);
  EXPECT_EQ(o.wave_speed, 7);
}

}  // namespace
}  // namespace piola::jst_advection
