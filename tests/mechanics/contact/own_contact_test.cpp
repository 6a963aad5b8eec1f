// SPDX-License-Identifier: Apache-2.0
// Bodies that touch themselves, and what their surfaces remember.
#include "mechanics/contact/blocks.hpp"

namespace piola::contact {
namespace {

using namespace testing;

/// A ring, in 3D a tube, whose inner faces can meet.
struct Ring {
  ParticleSet set;
  std::vector<Surface> surfaces;

  explicit Ring(int dimension) {
    ShapeSpec shape;
    shape.dimension = dimension;
    shape.kind = dimension == 3 ? ShapeSpec::Kind::cylinder : ShapeSpec::Kind::sphere;
    shape.axis = 2;
    shape.length = 4;
    shape.radius = 12;
    shape.inner_radius = 8;
    shape.spacing = 1;
    fill(shape, "ring", set);
    surfaces.push_back(contact_surface(shape, set, set.bodies[0]));
    surfaces[0].modulus = 2e6;
  }
  SurfaceContactSystem system(FrictionLaw const& friction = {}) const {
    return {set, surfaces, {}, {{{true, 0.5, friction}}}};
  }
  /// The walls bulged in until the inner faces overlap by `depth` in the middle.
  std::vector<Vec<3>> closed(SurfaceContactSystem const& system, double depth) const {
    auto x = places(system, set);
    for (Vec<3>& y : x) y[1] -= std::copysign(8 + 0.5 * depth, y[1]) * std::exp(-y[0] * y[0] / (3.5 * 3.5));
    return x;
  }
};

class OwnContact : public ::testing::TestWithParam<int> {};

TEST_P(OwnContact, ABodyAtRestDoesNotPushItself) {
  Ring const ring(GetParam());
  SurfaceContactSystem system = ring.system();
  system.evaluate(places(system, ring.set), 1e-3);
  EXPECT_EQ(system.totals().touched, 0);
  EXPECT_EQ(system.totals().energy, 0);
  Blocks const blocks(GetParam(), -1);
  PairSettings setting = blocks.setting(0);
  for (std::size_t b = 0; b < setting.size(); ++b) setting[b][b].is_active = true;
  SurfaceContactSystem corners(blocks.set, blocks.surfaces, {}, setting);
  auto x = places(corners, blocks.set);
  // Neither its edges nor its faces do when it is squeezed to half its height.
  for (Vec<3>& y : x) y[GetParam() - 1] *= 0.5;
  corners.evaluate(x, 1e-3);
  EXPECT_EQ(corners.totals().energy, 0);
}

TEST_P(OwnContact, InnerFacesThatMeetPush) {
  Ring const ring(GetParam());
  SurfaceContactSystem system = ring.system();
  auto x = ring.closed(system, 0.2);
  system.evaluate(x, 1e-3);
  EXPECT_GT(system.totals().touched, 3);
  EXPECT_GT(system.totals().deepest, 0.1);
  EXPECT_LT(system.totals().deepest, 0.4) << "the walls are steep beside the middle";
  double up = 0, down = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    double const f = system.forces()[k][1];
    auto const& X = ring.set.X[static_cast<std::size_t>(system.ids()[k])];
    (X[1] > 0 ? up : down) += f;
  }
  EXPECT_GT(up, 0);
  EXPECT_NEAR(down, -up, 1e-12 * up);
  expect_balance(system, x);
  distort(x, GetParam(), 0.01);
  expect_slopes(system, x, GetParam());
}

TEST_P(OwnContact, RubsToo) {
  Ring const ring(GetParam());
  SurfaceContactSystem system = ring.system({.kinetic = 0.3});
  auto x = ring.closed(system, 0.2);
  system.start(x);
  for (std::size_t k = 0; k < x.size(); ++k)
    if (ring.set.X[static_cast<std::size_t>(system.ids()[k])][1] > 0) x[k][0] += 0.1;
  system.evaluate(x, 1e-3);
  EXPECT_GT(system.totals().friction_work, 0);
  expect_balance(system, x);
}

INSTANTIATE_TEST_SUITE_P(Contact, OwnContact, ::testing::Values(2, 3));

/// Two legs of a U with a slit between them that is narrower than a bond is long.
TEST(SelfContactExclusions, DistanceGoesAlongTheBodyNotAcrossASlit) {
  ParticleSet set;
  set.dimension = 2;
  std::vector<std::array<double, 3>> X;
  Surface surface;
  surface.spacing = 1;
  for (int j = 0; j < 10; ++j)
    for (int i = 0; i < 6; ++i) {
      double const slit = i > 2 ? 0.6 : 0;  // 1.6 from leg to leg
      bool const joined = j < 2;
      surface.points.push_back({static_cast<std::int64_t>(X.size()), {}, {{1, 0, 0}}, 1});
      X.push_back({i + (joined ? 0.0 : slit), static_cast<double>(j), 0});
    }
  set.X = X;
  set.bodies = {{.name = "U", .first = 0, .last = static_cast<std::int64_t>(X.size()), .spacing = {1, 1, 1}}};
  std::vector<Surface> const surfaces{surface};
  HostParticles const hosts(set, surfaces);
  SelfContactExclusions const near(set, 0, hosts, 1);
  auto const host = [&](int i, int j) { return hosts.of(0, static_cast<std::size_t>(6 * j + i)); };
  EXPECT_TRUE(near.hold(host(2, 9), host(2, 9)));
  EXPECT_TRUE(near.hold(host(2, 9), host(2, 6)));
  EXPECT_FALSE(near.hold(host(2, 9), host(2, 5))) << "four bonds away";
  EXPECT_FALSE(near.hold(host(2, 9), host(3, 9))) << "across the slit";
  EXPECT_TRUE(near.hold(host(2, 2), host(3, 2))) << "around its end";
  EXPECT_TRUE(near.hold(host(2, 0), host(3, 0)));
}

TEST(FrictionLaw, FallsFromRestToSlidingAndHasALimit) {
  EXPECT_EQ(friction_coefficient({.kinetic = 0.3}, 5), 0.3);
  FrictionLaw const law{.kinetic = 0.2, .still = 0.5, .decay_speed = 0.1};
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 0), 0.5);
  EXPECT_DOUBLE_EQ(friction_coefficient(law, 0.1), 0.2 + 0.3 * std::exp(-1.0));
  EXPECT_NEAR(friction_coefficient(law, 10), 0.2, 1e-15);
  EXPECT_DOUBLE_EQ(friction_bound({.kinetic = 0.3}, 10, 2, 0), 3);
  EXPECT_DOUBLE_EQ(friction_bound({.kinetic = 0.3, .shear_limit = 1}, 10, 2, 0), 2);
}

/// Pulls the upper block sideways by `way` [m] per step. Returns the ratio of friction force to normal force: the
/// largest one, and the last one.
std::array<double, 2> pull(Blocks const& blocks, FrictionLaw const& law, double way, double dt) {
  SurfaceContactSystem system = blocks.system({}, law);
  auto x = places(system, blocks.set);
  system.start(x);
  double most = 0, last = 0;
  for (int step = 0; step < 120; ++step) {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (system.ids()[k] >= blocks.set.bodies[1].first) x[k][0] += way;
    system.evaluate(x, dt);
    Vec<3> const f = system.between(1, 0).force;
    last = -f[0] / f[1];
    most = std::max(most, last);
  }
  return {most, last};
}

TEST(FrictionLaw, SlowSlidingTakesTheCoefficientAtRestFastOneThatOfSliding) {
  Blocks const blocks(2, 0.05, 0.7, 1);
  FrictionLaw const law{.kinetic = 0.2, .still = 0.4, .decay_speed = 1};
  EXPECT_NEAR(pull(blocks, law, 0.001, 1)[1], 0.4, 0.02);
  EXPECT_NEAR(pull(blocks, law, 0.001, 1e-4)[1], 0.2, 0.01);
}

TEST(FrictionLaw, ShearStressHasALimit) {
  Blocks const blocks(2, 0.05, 0.7, 1);
  double const normal = pull(blocks, {.kinetic = 0.3}, 0.001, 1)[1];
  ASSERT_NEAR(normal, 0.3, 0.01);
  SurfaceContactSystem system = blocks.system();
  system.evaluate(places(system, blocks.set), 1);
  double const pressure = system.between(1, 0).force[1] / 2.8;
  EXPECT_NEAR(pull(blocks, {.kinetic = 0.3, .shear_limit = 0.1 * pressure}, 0.001, 1)[1], 0.1, 0.02);
}

TEST(AtParticles, TellPressureGapWayAndHeat) {
  Blocks const blocks(2, 0.05, 0.7, 1);
  SurfaceContactSystem system = blocks.system({}, {.kinetic = 0.3});
  auto x = places(system, blocks.set);
  system.start(x);
  double work = 0;
  for (int step = 0; step < 100; ++step) {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (system.ids()[k] >= blocks.set.bodies[1].first) x[k][0] += 0.002;
    system.evaluate(x, 1);
    work += system.totals().friction_work;
  }
  double heat = 0, deepest = 0, most = 0, pushed = 0;
  PairRule const rule = pair_rule(0.5, 2e6, 1, 5e6, 0.7);
  double const layer_pressure = -2 * layer(-0.05, rule.stiffness, rule.length).slope;
  for (SurfaceContactSystem::ParticleContactState const& p : system.at_particles()) {
    auto const& X = blocks.set.X[static_cast<std::size_t>(p.id)];
    bool const upper = p.id >= blocks.set.bodies[1].first, face = upper ? X[1] < 3.4 : X[1] > 2.4;
    if (!face) {
      EXPECT_NEAR(p.pressure, 0, 1e-20);
    }
    deepest = std::min(deepest, p.gap);
    pushed = std::max(pushed, p.pressure);
    if (upper) most = std::max(most, p.slid);
    heat += p.heat * (upper ? 0.7 : 1.0) * (p.heat > 0 ? 1 : 0);
  }
  EXPECT_NEAR(deepest, -0.05, 1e-12);
  EXPECT_NEAR(pushed / layer_pressure, 1, 0.2);
  EXPECT_GT(most, 0.1) << "of 0.2, less what the springs took";
  EXPECT_LT(most, 0.2);
  // Edge particles have another area than the face's share of it.
  EXPECT_NEAR(heat / (work - system.totals().spring_energy), 1, 0.5);
}

}  // namespace
}  // namespace piola::contact
