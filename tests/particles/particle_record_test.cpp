// SPDX-License-Identifier: Apache-2.0
#include "piola/particles/particle_record.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

ParticleSet two_bodies() {
  ParticleSet set;
  set.dimension = 2;
  set.X = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  set.volume = {1, 1, 1, 1, 1};
  set.kernel_volume = {1, 1, 1, 1, 1};
  set.bodies = {{.name = "rod", .first = 0, .last = 2}, {.name = "plate", .first = 2, .last = 5}};
  return set;
}

std::string difference_to(ParticleSet const& now) {
  return particle_difference(particle_record(two_bodies()), particle_record(now));
}

TEST(ParticleRecord, IsTheSameForTheSameParticles) { EXPECT_EQ(difference_to(two_bodies()), ""); }

TEST(ParticleRecord, SaysInWhichBodyWhatDiffers) {
  ParticleSet moved = two_bodies();
  moved.X[3][1] = 1e-300;
  EXPECT_EQ(difference_to(moved), "body \"plate\": positions of its 3 particles");
  ParticleSet heavier = two_bodies();
  heavier.volume[1] = 1.0000000000000002;
  heavier.X[4][2] = -1;
  EXPECT_EQ(difference_to(heavier),
            "body \"rod\": volumes of its 2 particles; body \"plate\": positions of its 3 particles");
  ParticleSet parts = two_bodies();
  parts.part = {0, 0, 0, 1, 0};
  EXPECT_NE(difference_to(parts).find("body \"plate\": parts"), std::string::npos);
}

TEST(ParticleRecord, SaysHowManyParticlesAndBodiesThereAre) {
  ParticleSet fewer = two_bodies();
  fewer.bodies[1].last = 4;
  EXPECT_EQ(difference_to(fewer), "body \"plate\": 2 particles, not 3");
  ParticleSet swapped = two_bodies();
  std::swap(swapped.bodies[0].name, swapped.bodies[1].name);
  EXPECT_NE(difference_to(swapped).find("body \"plate\", not \"rod\""), std::string::npos);
  ParticleSet alone = two_bodies();
  alone.bodies.pop_back();
  EXPECT_EQ(difference_to(alone), "1 bodies, not 2");
  EXPECT_NE(particle_difference("", particle_record(two_bodies())), "");
}

}  // namespace
}  // namespace piola
