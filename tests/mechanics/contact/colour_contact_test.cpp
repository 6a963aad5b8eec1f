// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/colour_contact.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <random>

namespace piola::contact {
namespace {

class Colour : public ::testing::TestWithParam<int> {
 protected:
  /// Two blocks of points, one behind the face x = 0, the other pressed into it by `depth` and shaken.
  struct Blocks {
    std::vector<Vec<3>> x;
    std::vector<double> masses;
    ColourContact contact;
  };
  static Blocks blocks(double depth, double shake, bool late = false) {
    int const D = GetParam();
    Blocks r;
    std::vector<ColourContact::Body> bodies(2);
    std::mt19937 random(3);
    std::uniform_real_distribution<double> some(-shake, shake);
    for (std::size_t b = 0; b < 2; ++b) {
      double const dp = b == 0 ? 1 : 0.8;
      bodies[b].spacing = dp;
      bodies[b].modulus = b == 0 ? 2e6 : 5e6;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < (D > 1 ? 7 : 1); ++j)
          for (int k = 0; k < (D > 2 ? 7 : 1); ++k) {
            bodies[b].at.push_back(static_cast<Index>(r.x.size()));
            bodies[b].volume.push_back(std::pow(dp, D));
            Vec<3> x{{b == 0 ? -(i + 0.5) * dp : (i + 0.5) * dp - depth, D > 1 ? (j - 3) * dp : 0,
                      D > 2 ? (k - 3) * dp : 0}};
            for (int c = 0; c < D; ++c) x[c] += some(random);
            r.x.push_back(x);
            r.masses.push_back(1000 * std::pow(dp, D));
          }
    }
    r.contact = ColourContact(D, std::move(bodies), {{0, 1, 0.5, late}});
    return r;
  }
};

TEST_P(Colour, OfAHalfSpaceIsAHalfOnItsFace) {
  ColourKernel const kernel{GetParam(), 2.4};
  EXPECT_NEAR(kernel.of_half_space(0).value, 0.5, 1e-5);
  EXPECT_NEAR(kernel.of_half_space(2.4).value, 0, 1e-12);
  double const h = 1e-4, d = 0.5;
  EXPECT_NEAR((kernel.of_half_space(d - h).value - kernel.of_half_space(d + h).value) / (2 * h),
              kernel.of_half_space(d).slope, 1e-4);
  for (double const r : {0.3, 1.1, 2.0})
    EXPECT_NEAR((kernel.value(r + h) - kernel.value(r - h)) / (2 * h * r), kernel.slope(r), 1e-6);
}

TEST_P(Colour, ForcesAreTheSlopeOfTheEnergyAndBalance) {
  Blocks b = blocks(0.3, 0.1);
  b.contact.evaluate(b.x, b.masses);
  ASSERT_GT(b.contact.totals().energy, 0);
  auto const f = b.contact.forces();
  Vec<3> force, moment;
  double size = 0;
  for (std::size_t k = 0; k < b.x.size(); ++k) {
    force = force + f[k];
    moment = moment + cross(b.x[k], f[k]);
    size += std::sqrt(dot(f[k], f[k]));
  }
  EXPECT_LT(std::sqrt(dot(force, force)), 1e-13 * size);
  EXPECT_LT(std::sqrt(dot(moment, moment)), 1e-12 * size);
  double const h = 1e-6;
  for (std::size_t k = 0; k < b.x.size(); k += 5)
    for (int c = 0; c < GetParam(); ++c) {
      auto x = b.x;
      double energy[2];
      for (int side = 0; side < 2; ++side) {
        x[k][c] = b.x[k][c] + (side == 0 ? -h : h);
        b.contact.evaluate(x, b.masses);
        energy[side] = b.contact.totals().energy;
      }
      EXPECT_NEAR(-(energy[1] - energy[0]) / (2 * h), f[k][c], 1e-6 * size) << k << " " << c;
    }
}

TEST_P(Colour, FacesThatTouchHardlyPush) {
  Blocks touching = blocks(0, 0), pressed = blocks(0.1, 0);
  touching.contact.evaluate(touching.x, touching.masses);
  pressed.contact.evaluate(pressed.x, pressed.masses);
  EXPECT_LT(touching.contact.totals().deepest, 0.06)
      << "the colour of a lattice is that of a half-space but for ripple";
  EXPECT_NEAR(pressed.contact.totals().deepest, 0.1 / 0.9, 0.07);
}

// Energy is at most 1/2 u.K u with the bound of the frequency: no vector grows faster.
TEST_P(Colour, FrequencyIsABound) {
  Blocks b = blocks(0.2, 0.05);
  b.contact.evaluate(b.x, b.masses);
  double const bound = b.contact.totals().frequency2;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  std::vector<Vec<3>> u(b.x.size());
  for (Vec<3>& a : u)
    for (int c = 0; c < GetParam(); ++c) a[c] = some(random);
  double omega2 = 0;
  for (int iteration = 0; iteration < 60; ++iteration) {
    double const h = 1e-6;
    double norm = 0;
    for (std::size_t k = 0; k < u.size(); ++k) norm += b.masses[k] * dot(u[k], u[k]);
    for (Vec<3>& a : u) a = (1 / std::sqrt(norm)) * a;
    std::vector<std::vector<Vec<3>>> f;
    for (double const side : {-h, h}) {
      auto x = b.x;
      for (std::size_t k = 0; k < x.size(); ++k) x[k] = x[k] + side * u[k];
      b.contact.evaluate(x, b.masses);
      f.push_back(b.contact.forces());
    }
    omega2 = 0;
    std::vector<Vec<3>> next(u.size());
    for (std::size_t k = 0; k < u.size(); ++k) {
      next[k] = (-1 / (2 * h * b.masses[k])) * (f[1][k] - f[0][k]);
      omega2 += b.masses[k] * dot(u[k], next[k]);
    }
    u = next;
  }
  EXPECT_GT(omega2, 0);
  EXPECT_LT(omega2, bound);
}

TEST_P(Colour, WhatHasNoMassIsNotThere) {
  Blocks b = blocks(0.3, 0);
  for (std::size_t k = 0; k < b.masses.size() / 2; ++k) b.masses[k] = 0;
  b.contact.evaluate(b.x, b.masses);
  EXPECT_EQ(b.contact.totals().energy, 0);
  EXPECT_TRUE(b.contact.loaded_indices().empty());
}

// Particles that lose their surface push from the depth that they have then on, also from a checkpoint, and from their
// face on once they have been out; other particles of the pair do not.
TEST_P(Colour, LateTargetsPushFromTheDepthAtWhichTheyJoin) {
  Blocks all = blocks(0.3, 0), late = blocks(0.3, 0, true), loaded = blocks(0.3, 0, true);
  std::vector<char> marked(late.x.size());
  for (std::size_t k = 0; k < marked.size() / 2; ++k) marked[k] = 1;  // of the first block
  auto const energy_at = [](Blocks& b, double deeper) {
    auto x = b.x;
    for (std::size_t k = x.size() / 2; k < x.size(); ++k) x[k][0] -= deeper;
    b.contact.evaluate(x, b.masses);
    return b.contact.totals().energy;
  };
  EXPECT_FALSE(late.contact.any());
  EXPECT_EQ(energy_at(late, 0), 0);
  late.contact.add_targets(marked);
  EXPECT_TRUE(late.contact.any());
  EXPECT_EQ(energy_at(late, 0), 0);
  loaded.contact.add_targets(marked);
  loaded.contact.load(late.contact.state());
  double const deeper = energy_at(late, 0.1), whole = energy_at(all, 0.1);
  EXPECT_GT(deeper, 0);
  EXPECT_EQ(energy_at(loaded, 0.1), deeper);
  EXPECT_LT(deeper, 0.3 * whole);
  EXPECT_EQ(energy_at(late, -1), 0);
  EXPECT_TRUE(late.contact.state().empty());
  double const after = energy_at(late, 0.1);
  EXPECT_GT(after, 2 * deeper);
  EXPECT_LT(after, whole);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, Colour, ::testing::Values(1, 2, 3));

}  // namespace
}  // namespace piola::contact
