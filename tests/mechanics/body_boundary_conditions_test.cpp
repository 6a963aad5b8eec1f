// SPDX-License-Identifier: Apache-2.0
// Supports and loads of one body without a body: two particles in two fields.
#include "piola/mechanics/body_boundary_conditions.hpp"
#include <gtest/gtest.h>

namespace piola {
namespace {

std::array<Expression, 3> formulas(std::string const& x, std::string const& y = "0", std::string const& z = "0") {
  return {Expression(x), Expression(y), Expression(z)};
}

Support moving(std::string const& x, std::string const& y = "0") {
  Support s;
  s.velocity = formulas(x, y);
  s.fix = {true, true, true};
  return s;
}

struct Motion {
  Field x{"Position", "m", 3, Role::evolved}, v{"Velocity", "m/s", 3, Role::evolved};
  Motion() {
    x.allocate(2, 0);
    v.allocate(2, 0);
    x.at(1, 0) = 1;
  }
};

TEST(BodyBoundary, DrivesAsItsSupportsSayAtBothEndsOfAStep) {
  Motion m;
  BodyBoundary boundary(3, {moving("2*t", "3")}, {}, false);
  auto const particle = boundary.add_particle({1, {1, 0, 0}, 5, {1, 0, 0}});
  boundary.add_row(particle, 0, {1, 0, 0});
  boundary.add_row(particle, 0, {0, 1, 0});
  EXPECT_TRUE(boundary.begin_step(m.x.ref(), 0, 0)) << "directions that were not held before";
  boundary.start(m.v.ref());
  EXPECT_EQ(m.v.at(1, 0), 0);
  EXPECT_EQ(m.v.at(1, 1), 3);
  EXPECT_FALSE(boundary.begin_step(m.x.ref(), 0, 0.5));
  ASSERT_EQ(boundary.held().size(), 2U);
  for (auto const& h : boundary.held()) {
    EXPECT_EQ(h.slot, 1);
    EXPECT_EQ(h.mass, 5);
    EXPECT_FALSE(h.at_rest);
    EXPECT_EQ(h.start_speed, h.axis == 0 ? 0 : 3);
    EXPECT_EQ(h.speed, h.axis == 0 ? 1 : 3);
  }
  EXPECT_FALSE(boundary.begin_step(m.x.ref(), 0.5, 0.25));
  for (auto const& h : boundary.held()) EXPECT_EQ(h.start_speed, h.axis == 0 ? 1 : 3);
}

TEST(BodyBoundary, ReleasesWhatEnds) {
  Motion m;
  Support ends = moving("1");
  ends.until = 1;
  BodyBoundary boundary(3, {moving("4"), ends}, {}, false);
  auto const particle = boundary.add_particle({0, {}, 1, {}});
  boundary.add_row(particle, 0, {1, 0, 0});
  boundary.add_row(particle, 1, {1, 0, 0});
  EXPECT_EQ(boundary.next_end_time(0), 1);
  boundary.begin_step(m.x.ref(), 0, 1);
  ASSERT_EQ(boundary.held().size(), 1U);
  EXPECT_EQ(boundary.held()[0].speed, 1) << "that named last has its way";
  EXPECT_EQ(boundary.held()[0].support, 1);
  EXPECT_TRUE(boundary.begin_step(m.x.ref(), 1, 1));
  EXPECT_EQ(boundary.held()[0].speed, 4);
  EXPECT_EQ(boundary.next_end_time(1), std::numeric_limits<double>::infinity());
}

TEST(BodyBoundary, AddsUpLoadsAtBothEndsAndTheirImpulses) {
  Motion m;
  Load dead, named;
  dead.value = formulas("1", "t");
  named.value = formulas("0", "2*t");
  named.name = "push";
  BodyBoundary boundary(3, {}, {dead, named}, false);
  for (std::size_t load : {0, 1}) boundary.add_load(load, {1, 10, 3, {1, 0, 0}, {}});
  boundary.begin_step(m.x.ref(), 1, 2);
  ASSERT_EQ(boundary.loaded().size(), 1U);
  LoadedParticle const& p = boundary.loaded()[0];
  EXPECT_EQ(p.acting[0][0], 3);
  EXPECT_EQ(p.acting[0][1], 3 + 6);
  EXPECT_EQ(p.acting[1][1], 9 + 18);
  m.x.at(1, 0) = 2;
  DeferredGlobalSum work;
  work.set(7);
  boundary.end_step(m.x.ref(), work);
  EXPECT_EQ(work.value(), 7) << "passes find the work";
  Resultants actions({}, {dead, named}, {});
  boundary.add_resultants_to(actions);
  EXPECT_EQ(actions.loads[0].linear[0], 0) << "loads without a name are not reported";
  EXPECT_EQ(actions.loads[1].linear[1], 10 * (6 + 18));  // m dt/2 (a + a')
  EXPECT_EQ(actions.loads[1].angular[2], 10 * (1 * 6 + 2 * 18));
  boundary.reset_impulses();
  boundary.add_resultants_to(actions);
  EXPECT_EQ(actions.loads[1].linear[1], 10 * (6 + 18)) << "handed over once";
}

TEST(BodyBoundary, TakesLoadsThatEndOutOfTheNextAcceleration) {
  Motion m;
  Load lasts, ends;
  lasts.value = ends.value = formulas("1");
  ends.until = 2;
  BodyBoundary boundary(3, {}, {lasts, ends}, false);
  for (std::size_t load : {0, 1}) boundary.add_load(load, {0, 1, 5, {}, {}});
  boundary.begin_step(m.x.ref(), 0, 1);
  boundary.remove_ended(m.v.ref());
  EXPECT_EQ(m.v.at(0, 0), 0);
  boundary.begin_step(m.x.ref(), 1, 1);
  boundary.remove_ended(m.v.ref());
  EXPECT_EQ(m.v.at(0, 0), -5);
  boundary.begin_step(m.x.ref(), 2, 1);
  EXPECT_EQ(boundary.loaded()[0].acting[1][0], 5);
}

TEST(BodyBoundary, DampsNotAlongWhatItHolds) {
  Motion m;
  BodyBoundary boundary(2, {moving("1")}, {}, false);
  boundary.add_row(boundary.add_particle({0, {}, 1, {}}), 0, {0.6, 0.8, 0});
  boundary.begin_step(m.x.ref(), 0, 1);
  for (Index i : {0, 1})
    for (int c : {0, 1}) m.v.at(i, c) = 1;
  boundary.damp(m.v.ref(), 2, 0.5);
  EXPECT_EQ(m.v.at(1, 0), 0.5);
  EXPECT_NEAR(0.6 * m.v.at(0, 0) + 0.8 * m.v.at(0, 1), 1.4, 1e-15);
  EXPECT_NEAR(0.8 * m.v.at(0, 0) - 0.6 * m.v.at(0, 1), 0.1, 1e-15) << "across it is damped";
}

}  // namespace
}  // namespace piola
