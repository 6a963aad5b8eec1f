// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/rim_and_hole.hpp"
#include "piola/measures/probe.hpp"
#include "support/placed.hpp"
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

namespace piola {
namespace {

using testing::Places3;

std::vector<double> evaluate(ProbeSpec const& spec, ParticleSet const& set, Places3 const& x) {
  testing::Placed const placed(set, x);
  FieldCache cache(placed, set);
  return Probe(spec, set).evaluate(cache);
}

/// Four lips about the line (7, 8, z) of radius 2, 3, 4, 5 and height 1, 2, 3, 4, each with a lower particle and one
/// further out that is higher; and a fragment high above, about the axis too.
Places3 lips() {
  Places3 x;
  for (int k = 0; k < 4; ++k) {
    double const angle = (0.25 + 0.5 * k) * std::numbers::pi, c = std::cos(angle), s = std::sin(angle);
    auto const put = [&](double r, double z) { x.push_back({7 + r * c, 8 + r * s, z}); };
    put(1, 0.5 + k);
    put(2.0 + k, 1.0 + k);
    put(11, 6);
  }
  x.push_back({8, 9, 60});
  return x;
}

ProbeSpec rim_spec() {
  ProbeSpec spec;
  spec.name = "p";
  spec.body = "plate";
  spec.kind = ProbeSpec::Kind::rim;
  spec.axis = 2;
  spec.at = {7, 8, -3};
  spec.link = 20;
  spec.within = 10;
  spec.base = 0.5;
  spec.sectors = 4;
  spec.anchored_where = Expression("X < 0.5");
  return spec;
}

void expect_rim(std::vector<double> const& values, double diameter, double height, double sectors) {
  ASSERT_EQ(values.size(), 3u);
  EXPECT_NEAR(values[0], diameter, 1e-13);
  EXPECT_NEAR(values[1], height, 1e-13);
  EXPECT_EQ(values[2], sectors);
}

TEST(Rim, IsMadeOfTheHighestAttachedParticleOfEachSector) {
  auto const set = testing::make_row(lips().size(), 3);
  expect_rim(evaluate(rim_spec(), set, lips()), 7, 2, 4);
}

TEST(Rim, MayBeAboutAnyAxis) {
  auto const set = testing::make_row(lips().size(), 3);
  auto spec = rim_spec();
  auto x = lips();
  for (int axis = 0; axis < 2; ++axis) {  // x y z -> z x y, then y z x
    for (auto& p : x) p = {p[2], p[0], p[1]};
    spec.at = {spec.at[2], spec.at[0], spec.at[1]};
    spec.axis = axis;
    expect_rim(evaluate(spec, set, x), 7, 2, 4);
  }
}

// The highest within 11.5 are the outer ones; the first sector's tip alone has a radius up to 2.5.
TEST(Rim, CountsParticlesUpToALargestRadius) {
  auto const set = testing::make_row(lips().size(), 3);
  auto spec = rim_spec();
  spec.within = 11.5;
  expect_rim(evaluate(spec, set, lips()), 22, 5.5, 4);
  spec.within = 2.5;  // tips of radius 2, 1, 1, 1 and height 1, 1.5, 2.5, 3.5
  expect_rim(evaluate(spec, set, lips()), 2.5, 2.125 - 0.5, 4);
  spec.within = 0.5;
  expect_rim(evaluate(spec, set, lips()), 0, 0, 0);
}

TEST(Rim, SkipsEmptySectorsAndTakesTheInnerOfTwoEqualTips) {
  auto const set = testing::make_row(3, 3);
  auto spec = rim_spec();
  spec.sectors = 24;
  expect_rim(evaluate(spec, set, {{12, 8, 2}, {10, 8, 2}, {11, 8, 1}}), 6, 1.5, 1);
}

TEST(Rim, IsNothingWhereNothingIsAttached) {
  auto const set = testing::make_row(3, 3);
  auto spec = rim_spec();
  spec.link = 1;
  expect_rim(evaluate(spec, set, {{90, 8, 2}, {10, 8, 2}, {11, 8, 1}}), 0, 0, 0);
}

/// About the line y = 1: halves of a plate at y >= 3 and y <= -2, then debris: a splinter at (0.5, 1.5) opposite one at
/// (1.2, 0.5), a particle of which only the upper side has one, and a shell 14 wide.
Places3 const holed{{0, 3, 0},     {0, 4, 0},     {0, 5, 0},  {0, -2, 0}, {0, -3, 0},
                    {0.5, 1.5, 0}, {1.2, 0.5, 0}, {2, 10, 0}, {3, 8, 0},  {2.6, -6, 0}};

ProbeSpec hole_spec() {
  ProbeSpec spec;
  spec.name = "p";
  spec.body = "plate";
  spec.kind = ProbeSpec::Kind::hole;
  spec.axis = 0;
  spec.at = {-9, 1, 0};
  spec.slab_from = spec.cavity_from = -0.5;
  spec.slab_to = 1.3;
  return spec;
}

void expect_hole(ProbeSpec const& spec, Places3 const& x, double slab, double cavity) {
  auto const values = evaluate(spec, testing::make_row(x.size()), x);
  ASSERT_EQ(values.size(), 2u);
  EXPECT_NEAR(values[0], slab, 1e-14);
  EXPECT_NEAR(values[1], cavity, 1e-14);
}

TEST(Hole, IsBetweenTheHalvesOfTheSlabAndWithinTheShellOfDebris) { expect_hole(hole_spec(), holed, 5, 14); }

TEST(Hole, MayGoAlongY) {
  auto spec = hole_spec();
  spec.axis = 1;
  spec.at = {1, -9, 0};
  auto x = holed;
  for (auto& p : x) std::swap(p[0], p[1]);
  expect_hole(spec, x, 5, 14);
}

TEST(Hole, CavityIsSoughtInBinsOfARange) {
  auto spec = hole_spec();
  spec.cavity_to = 2.5;
  expect_hole(spec, holed, 5, 5);
  spec.cavity_from = 0.4;
  expect_hole(spec, holed, 5, 1);
  spec.cavity_from = -0.5;
  spec.cavity_to = 100;
  spec.bin = 10;
  expect_hole(spec, holed, 5, 1);
}

TEST(Hole, IsBetweenTheFragmentsWithParticlesThatStayInPlace) {
  auto const set = testing::make_row(holed.size());
  auto spec = hole_spec();
  spec.anchored_where = Expression("X > 1.5 && X < 3.5");  // one of each half
  EXPECT_NEAR(evaluate(spec, set, holed)[0], 5, 1e-14);
  spec.anchored_where = Expression("X > 4.5 && X < 6.5");  // both splinters
  EXPECT_NEAR(evaluate(spec, set, holed)[0], 1, 1e-14);
  spec.anchored_where = Expression("X < 1.5");  // the upper half alone
  EXPECT_TRUE(std::isnan(evaluate(spec, set, holed)[0]));
}

TEST(Hole, IsClosedByAParticleOnTheAxis) {
  auto spec = hole_spec();
  expect_hole(spec, {{0, 1, 0}, {0, 2, 0}, {0, 0, 0}}, 0, 0);
}

TEST(Hole, GivesNoNumberWhereOneSideIsEmpty) {
  auto const values = evaluate(hole_spec(), testing::make_row(2), {{0, 3, 0}, {0, 4, 0}});
  EXPECT_TRUE(std::isnan(values.at(0)));
  EXPECT_TRUE(std::isnan(values.at(1)));
}

TEST(Hole, OfAHalfSectionIsTwiceAsWideAsItsUpperSide) {
  auto set = testing::make_row(holed.size());
  set.axisymmetric = true;
  auto spec = hole_spec();
  spec.axis = 1;
  spec.at = {0, 0, 0};
  auto x = holed;
  for (auto& p : x) p = {std::fabs(p[1] - 1), p[0], 0};
  auto const values = evaluate(spec, set, x);
  EXPECT_NEAR(values.at(0), 4, 1e-14);
  EXPECT_NEAR(values.at(1), 18, 1e-14);
}

}  // namespace
}  // namespace piola
