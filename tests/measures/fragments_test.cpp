// SPDX-License-Identifier: Apache-2.0
#include "piola/measures/fragments.hpp"
#include "piola/measures/probe.hpp"
#include "support/placed.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using testing::Places3;

ProbeSpec spec_of(ProbeSpec::Kind kind) {
  ProbeSpec spec;
  spec.name = "p";
  spec.body = "plate";
  spec.kind = kind;
  spec.axis = 0;
  return spec;
}

std::vector<double> evaluate(ProbeSpec const& spec, ParticleSet const& set, Places3 const& x) {
  testing::Placed const placed(set, x);
  FieldCache cache(placed, set);
  return Probe(spec, set).evaluate(cache);
}

void expect_near(std::vector<double> const& values, std::vector<double> const& expected) {
  ASSERT_EQ(values.size(), expected.size());
  for (std::size_t k = 0; k < values.size(); ++k) EXPECT_NEAR(values[k], expected[k], 1e-14) << k;
}

// Nearest neighbours at 0.4, 0.4, 0.6, 0.7, 1.3, whose mean is 0.68.
Places3 const uneven{{0, 0, 0}, {0.4, 0, 0}, {1, 0, 0}, {1.7, 0, 0}, {3, 0, 0}};

TEST(Spacing, DescribesTheDistancesToNearestNeighbours) {
  auto set = testing::make_row(5);
  auto const spec = spec_of(ProbeSpec::Kind::spacing);
  double const deviation = std::sqrt(0.548 / 5);
  expect_near(evaluate(spec, set, uneven), {0.4, 0.4, 0.4, 0.6, deviation, 0.8, 0.4});
  set.bodies[0].spacing = {2, 0.5, 0.1};  // in 2D the third is no spacing
  expect_near(evaluate(spec, set, uneven), {0.8, 0.8, 0.8, 1.2, 2 * deviation, 0, 0});
}

// 0.7 to a particle that does not count itself, and 1.3.
TEST(Spacing, SeesNeighboursThatDoNotCountThemselves) {
  auto const set = testing::make_row(5);
  auto spec = spec_of(ProbeSpec::Kind::spacing);
  spec.where = Expression("X > 2.5");
  expect_near(evaluate(spec, set, uneven), {0.7, 0.706, 0.73, 1.0, 0.3, 0.5, 0});
  auto two = set;
  two.bodies = {{"other", 0, 3, {9, 9, 9}, {3, 1, 1}, true}, {"plate", 3, 5, {1, 1, 1}, {2, 1, 1}, true}};
  two.body = {0, 0, 0, 1, 1};
  spec.where = {};
  expect_near(evaluate(spec, two, uneven), {0.7, 0.706, 0.73, 1.0, 0.3, 0.5, 0});
}

TEST(Spacing, RecordsOnlyWhatIsAskedFor) {
  auto const set = testing::make_row(5);
  auto spec = spec_of(ProbeSpec::Kind::spacing);
  spec.quantities = {"spacing_median", "spacing_min"};
  Probe const probe(spec, set);
  ASSERT_EQ(probe.columns().size(), 2u);
  std::vector<double> const values = evaluate(spec, set, uneven);
  ASSERT_EQ(values.size(), 2u);
  for (std::size_t k = 0; k < 2; ++k) {
    bool const median = probe.columns()[k].name == "p.spacing_median";
    EXPECT_TRUE(median || probe.columns()[k].name == "p.spacing_min");
    EXPECT_NEAR(values[k], median ? 0.6 : 0.4, 1e-14);
    EXPECT_EQ(probe.columns()[k].unit, "1");
  }
}

TEST(Spacing, GivesNoNumberWithoutNeighbours) {
  auto const set = testing::make_row(1);
  for (double const v : evaluate(spec_of(ProbeSpec::Kind::spacing), set, {{0, 0, 0}})) EXPECT_TRUE(std::isnan(v));
}

// Clusters of 4, 3, 2 and 1 particles; the first holds the particle that stays in place.
Places3 const debris{{0, 0, 0}, {1, 0, 0}, {2, 0, 0},  {3, 1, 0},  {6, 0, 0},
                     {7, 0, 0}, {8, 1, 1}, {11, 0, 0}, {12, 0, 0}, {20, 0, 0}};

ParticleSet weighted() {
  auto set = testing::make_row(debris.size());
  for (std::size_t i = 0; i < set.volume.size(); ++i) set.volume[i] = 1 + static_cast<double>(i);
  return set;
}

TEST(Fragment, IsTheLargestCluster) {
  auto spec = spec_of(ProbeSpec::Kind::fragment);
  spec.link = 1.8;
  double const vx = (0 * 1 + 1 * 2 + 2 * 3 + 3 * 4) / 10.0;
  expect_near(evaluate(spec, weighted(), debris), {4, 4, 10, vx, 2, -1, 3, 1, 0, 4, 13.75, std::sqrt(14.1875) / 13.75});
  spec.min_particles = 3;  // volumes 10 and 18
  expect_near(evaluate(spec, weighted(), debris), {4, 4, 10, vx, 2, -1, 3, 1, 0, 2, 14, 4.0 / 14});
  EXPECT_EQ(Probe(spec, weighted()).columns()[2].name, "p.fragment_volume");
  EXPECT_EQ(Probe(spec, weighted()).columns()[3].unit, "m/s");
}

TEST(Fragment, MayBeTheLargestThatIsNotAttached) {
  auto spec = spec_of(ProbeSpec::Kind::fragment);
  spec.link = 1.8;
  spec.fragment = ProbeSpec::Fragment::largest_free;
  spec.anchored_where = Expression("X < 0.5");
  double const vx = (4 * 5 + 5 * 6 + 6 * 7) / 18.0;
  spec.min_particles = 2;  // volumes 10, 18 and 17
  double const spread = std::sqrt(38.0 / 3) / 15;
  expect_near(evaluate(spec, weighted(), debris), {4, 3, 18, vx, 2, -1, 2, 1, 1, 3, 15, spread});
  spec.near_axis = 1.2;
  expect_near(evaluate(spec, weighted(), debris), {4, 3, 18, vx, 2, -1, 1, 0, 0, 3, 15, spread});
  spec.at = {0, 1, 1};
  spec.near_axis = 0.5;
  expect_near(evaluate(spec, weighted(), debris), {4, 3, 18, vx, 2, -1, 0, 0, 0, 3, 15, spread});
}

TEST(Fragment, IsLinkedInInitialSpacingsOfItsBody) {
  auto set = weighted();
  auto spec = spec_of(ProbeSpec::Kind::fragment);
  spec.link = 1.8;
  set.bodies[0].spacing = {2, 2, 2};  // 3.6: all but the last
  EXPECT_EQ(evaluate(spec, set, debris)[0], 2);
  EXPECT_EQ(evaluate(spec, set, debris)[1], 9);
}

TEST(Fragment, IsNothingWhereAllIsAttached) {
  auto spec = spec_of(ProbeSpec::Kind::fragment);
  spec.link = 20;
  spec.fragment = ProbeSpec::Fragment::largest_free;
  spec.anchored_where = Expression("X < 0.5");
  expect_near(evaluate(spec, weighted(), debris), {1, 0, 0, 0, 0, 0, 0, 0, 0, 1, 55, 0});
}

}  // namespace
}  // namespace piola
