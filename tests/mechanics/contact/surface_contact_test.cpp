// SPDX-License-Identifier: Apache-2.0
#include "piola/base/errors.hpp"
#include "exec/thread_count.hpp"
#include "mechanics/contact/blocks.hpp"

namespace piola::contact {
namespace {

using namespace testing;

TEST(ContactSurface, HasTheAreaOfTheShape) {
  Blocks const blocks(3, 0);
  double area = 0;
  Vec<3> sum;
  for (SurfacePoint const& point : blocks.surfaces[0].points) {
    area += point.area;
    sum = sum + point.area * point.normal;
    auto const& X = blocks.set.X[static_cast<std::size_t>(point.particle)];
    Vec<3> const y = Vec<3>{{X[0], X[1], X[2]}} + point.offset;
    double const to_face = std::min({y[0], y[1], y[2], 5 - y[0], 5 - y[1], 3 - y[2]});
    EXPECT_NEAR(to_face, 0, 1e-12);
  }
  EXPECT_NEAR(area, 2 * 25 + 4 * 15, 1e-12);
  EXPECT_NEAR(dot(sum, sum), 0, 1e-20);
}

TEST(ContactSurface, OfABallLiesOnIt) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.radius = 2;
  shape.inner_radius = 1;
  shape.spacing = 0.4;
  shape.centre = {1, 2, 3};
  ParticleSet set;
  fill(shape, "ball", set);
  double area = 0;
  for (SurfacePoint const& p : contact_surface(shape, set, set.bodies[0]).points) {
    auto const& X = set.X[static_cast<std::size_t>(p.particle)];
    Vec<3> const y = Vec<3>{{X[0] - 1, X[1] - 2, X[2] - 3}} + p.offset;
    double const r = std::sqrt(dot(y, y)), out = dot(y, p.normal);
    EXPECT_NEAR(r, out > 0 ? 2 : 1, 1e-12);
    area += p.area;
  }
  EXPECT_NEAR(area, 4 * M_PI * 5, 1e-9);
}

TEST(HostParticles, DeformationGradientIsExactForLinearFields) {
  Blocks const blocks(3, 0);
  HostParticles const hosts(blocks.set, blocks.surfaces);
  Mat<3> const F{{1.1, 0.2, 0.1, -0.3, 0.9, 0.05, 0.2, 0.1, 1.3}};
  std::vector<Vec<3>> x;
  for (auto const id : hosts.ids()) {
    auto const& X = blocks.set.X[static_cast<std::size_t>(id)];
    x.push_back(F * Vec<3>{{X[0], X[1], X[2]}});
  }
  for (Index k = 0; k < hosts.count(); ++k)
    for (int c = 0; c < 9; ++c) EXPECT_NEAR(hosts.F(k, x).c[c], F.c[c], 1e-12);
}

TEST(HostParticles, RefuseABodyOfOneLayer) {
  Blocks blocks(3, 0);
  blocks.add(box(3, {0, 0, 9}, {4, 4, 1}, 1));
  EXPECT_THROW((void)HostParticles(blocks.set, blocks.surfaces), InputError);
}

class InDimensions : public ::testing::TestWithParam<int> {};

TEST_P(InDimensions, BlocksThatTouchAreNotPushed) {
  Blocks const blocks(GetParam(), 0);
  SurfaceContactSystem system = blocks.system();
  system.evaluate(places(system, blocks.set), 1e-3);
  EXPECT_NEAR(system.totals().energy, 0, 1e-20);
  EXPECT_LT(system.totals().deepest, 1e-12);
}

/// Where a point is lost, another blend of planes remains. Points in contact push on from their depth: the energy does
/// not rise, and forces are still its derivative, also from a checkpoint.
TEST_P(InDimensions, LostPointsAddNoEnergy) {
  int const D = GetParam();
  Blocks const blocks(D, 0.15);
  std::size_t const up = D == 3 ? 2 : 1;
  std::vector<Vec<3>> x = places(blocks.system(), blocks.set), deeper;
  distort(x, D, 0.4);
  double risen = 0, fresh = 0;
  for (std::size_t k = 0; k < x.size(); ++k) {
    std::vector<char> lost(x.size());
    lost[k] = 1;
    SurfaceContactSystem system = blocks.system(), late = blocks.system(), resumed = blocks.system();
    system.evaluate(x, 1e-3);
    double const before = system.totals().energy;
    system.drop(lost);
    system.evaluate(x, 1e-3);
    late.drop(lost);
    late.evaluate(x, 1e-3);
    risen = std::max(risen, system.totals().energy / before - 1);
    fresh = std::max(fresh, late.totals().energy / before - 1);
    deeper = x;
    double work = 0;
    for (std::size_t n = 0; n < x.size(); ++n)
      if (system.ids()[n] >= blocks.set.bodies[1].first) {
        deeper[n][static_cast<int>(up)] -= 1e-6;
        work += 1e-6 * system.forces()[n][static_cast<int>(up)];
      }
    double const there = system.totals().energy;
    std::vector<double> const state = system.state(), depths = system.depths();
    system.evaluate(deeper, 1e-3);
    EXPECT_NEAR(system.totals().energy - there, work, 1e-3 * work + 1e-12 * there) << k;
    resumed.drop(lost);
    resumed.restore(x, state);
    resumed.load_depths(depths);
    resumed.evaluate(deeper, 1e-3);
    EXPECT_EQ(resumed.totals().energy, system.totals().energy) << k;
  }
  EXPECT_LT(risen, 1e-12);
  EXPECT_GT(fresh, 1e-3);  // what it is without the depths
}

TEST_P(InDimensions, FlatFacesHaveThePressureOfTheLayer) {
  int const D = GetParam();
  double const depth = 0.05;
  Blocks const blocks(D, depth, 0.7, 1);  // the upper one lies wholly on the lower one
  SurfaceContactSystem system = blocks.system();
  system.evaluate(places(system, blocks.set), 1e-3);
  // Each point of the upper face is pushed by half of the layer; those of the lower one, too, where they are under it.
  PairRule const rule = pair_rule(0.5, 2e6, 1, 5e6, 0.7);
  double const pressure = -layer(-depth, rule.stiffness, rule.length).slope;
  double const area = D == 3 ? 2.8 * 2.8 : 2.8;
  Vec<3> const up = system.between(1, 0).force;
  EXPECT_NEAR(up[D - 1] / (2 * pressure * area), 1, 0.15) << "edges fade";
  for (int c = 0; c < D - 1; ++c) EXPECT_NEAR(up[c], 0, 0.02 * up[D - 1]);
}

TEST_P(InDimensions, ForcesAreTheSlopesOfTheEnergy) {
  int const D = GetParam();
  Blocks const blocks(D, 0.2);
  SurfaceContactSystem system = blocks.system();
  auto x = places(system, blocks.set);
  distort(x, D, 0.3);
  expect_slopes(system, x, D);
}

TEST_P(InDimensions, MomentaAreKept) {
  int const D = GetParam();
  Blocks const blocks(D, 0.2);
  SurfaceContactSystem system = blocks.system();
  auto x = places(system, blocks.set);
  distort(x, D, 0.3);
  system.evaluate(x, 1e-3);
  expect_balance(system, x);
}

// Pressed in against all force, points lose sight of the face that they went through.
TEST_P(InDimensions, PointsThatGoThroughABodyAreCounted) {
  int const D = GetParam();
  Blocks const blocks(D, 0, 0.7, 1);
  SurfaceContactSystem system = blocks.system();
  auto x = places(system, blocks.set);
  system.start(x);
  for (double depth = 0; depth < 3; depth += 0.1) {
    EXPECT_TRUE(depth > 1 || system.passed().empty()) << depth;
    for (std::size_t k = 0; k < x.size(); ++k)
      if (system.ids()[k] >= blocks.set.bodies[1].first) x[k][D - 1] -= 0.1;
    system.evaluate(x, 1e-3);
  }
  ASSERT_EQ(system.passed().size(), 2U);
  for (Passed const& passed : system.passed()) {
    EXPECT_EQ(passed.of + passed.through, 1U);
    EXPECT_GE(passed.points, 2);
  }
  SurfaceContactSystem resumed = blocks.system();
  resumed.restore(x, system.state());
  EXPECT_EQ(resumed.passed().size(), 2U);
}

TEST_P(InDimensions, RigidShapesTakeTheReaction) {
  int const D = GetParam();
  Blocks const blocks(D, -50);
  for (double const depth : {0.1, 0.6}) {  // at 0.6 points of the side faces are behind the plane as well
    RigidSurface plane;
    plane.dimension = D;
    plane.axis = {{0, 0, 0}};
    plane.axis[D - 1] = 1;
    plane.centre[D - 1] = depth;  // above the lower face of block 0
    SurfaceContactSystem system = blocks.system({plane});
    auto const x = places(system, blocks.set);
    system.evaluate(x, 1e-3);
    Vec<3> force;
    for (Vec<3> const& f : system.forces()) force = force + f;
    double const area = D == 3 ? 25 : 5, k = 0.5 * 2e6;
    EXPECT_NEAR(force[D - 1] / (-layer(-depth, k, 0.5).slope * area), 1, 1e-12) << depth;
    EXPECT_NEAR(system.totals().energy / (layer(-depth, k, 0.5).energy * area), 1, 1e-12) << depth;
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(system.resultant_on_rigid(0).force[c], -force[c], 1e-12 * force[D - 1]);
  }
}

TEST_P(InDimensions, ForcesDoNotDependOnWhenListsWereMadeOrOnThreads) {
  int const D = GetParam();
  Blocks const blocks(D, 0.1);
  std::vector<Vec<3>> first;
  for (int const threads : piola::testing::thread_counts) {
    piola::testing::Threads const shared(threads);
    SurfaceContactSystem fresh = blocks.system(), old = blocks.system();
    auto x = places(fresh, blocks.set);
    old.evaluate(x, 1e-3);
    for (Vec<3>& y : x) y[0] += 0.11;  // less than the lists are good for
    for (std::size_t k = 0; k < x.size() / 3; ++k) x[k][1] += 0.05;
    old.evaluate(x, 1e-3);
    fresh.evaluate(x, 1e-3);
    for (std::size_t k = 0; k < x.size(); ++k)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(old.forces()[k][c], fresh.forces()[k][c]);
    if (first.empty()) first = fresh.forces();
    for (std::size_t k = 0; k < x.size(); ++k)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(first[k][c], fresh.forces()[k][c]) << threads;
  }
}

/// All results of contact that a run reads.
std::vector<double> told_by(SurfaceContactSystem const& system, std::size_t rigids) {
  Totals const& t = system.totals();
  std::vector<double> all{t.energy,        t.deepest,       t.frequency2,
                          t.spring_energy, t.friction_work, static_cast<double>(t.touched)};
  auto const put = [&](Vec<3> const& a) { all.insert(all.end(), a.c, a.c + 3); };
  for (Vec<3> const& f : system.forces()) put(f);
  put(system.between(0, 1).force);
  put(system.between(0, 1).moment);
  for (std::size_t r = 0; r < rigids; ++r) {
    put(system.resultant_on_rigid(r).force);
    put(system.resultant_on_rigid(r).moment);
    all.push_back(system.frequencies(r).of_shape);
    all.push_back(system.frequencies(r).of_points);
  }
  return all;
}

/// Two plates whose ends slide with friction on each other and on a free rigid shape. Their middles do not touch.
std::vector<double> rub_at_both_ends(int D, std::uint32_t seed) {
  Blocks plates(D, -50);
  plates.set = {};
  plates.surfaces.clear();
  std::size_t const up = D == 3 ? 2 : 1;
  std::array<double, 3> above{0.3, 0, 0};
  above[up] = 2.8;
  plates.add(box(D, {0, 0, 0}, {20, D == 3 ? 4 : 3, 3}, 1));
  plates.add(box(D, above, {26, D == 3 ? 4 : 3, 3}, 0.7));
  double const middle = 10;
  if (seed > 0)
    for (Surface& surface : plates.surfaces) deal_out(surface, plates.set, middle, seed++);
  RigidSurface floor;
  floor.dimension = D;
  floor.axis = {{0, 0, 0}};
  floor.axis[D - 1] = 1;
  floor.centre = {{1, 2, 0}};
  floor.centre[D - 1] = 0.04;
  floor.inverse_mass = 0.3;
  floor.inverse_inertia = identity<3>();
  SurfaceContactSystem system = plates.system({floor}, {.kinetic = 0.3});
  auto x = places(system, plates.set);
  for (std::size_t k = 0; k < x.size(); ++k) {
    double const to_middle = x[k][0] / middle - 1, lift = system.ids()[k] < plates.set.bodies[1].first ? 1.5 : 5;
    x[k][D - 1] += lift * std::pow(1 - to_middle * to_middle, 3);
  }
  system.set_masses(std::vector<double>(x.size(), 1.7));
  system.start(x);
  for (std::size_t k = 0; k < x.size(); ++k)
    for (int c = 0; c < D; ++c) x[k][c] += 0.01 * std::sin(1.3 * static_cast<double>(k) + c);
  system.evaluate(x, 1e-3);
  return told_by(system, 1);
}

TEST_P(InDimensions, NoSumDependsOnTheOrderOfPoints) {
  auto const reference = rub_at_both_ends(GetParam(), 0);
  for (std::size_t k : {0, 3, 4, 5}) ASSERT_NE(reference[k], 0) << k;
  for (std::uint32_t seed = 1; seed < 40; seed += 3) EXPECT_EQ(rub_at_both_ends(GetParam(), seed), reference) << seed;
}

TEST_P(InDimensions, NearBodiesThatCloseShortenTheStep) {
  int const D = GetParam();
  Blocks const blocks(D, -0.5);
  SurfaceContactSystem system = blocks.system();
  auto const x = places(system, blocks.set);
  system.evaluate(x, 1e-3);
  std::vector<Vec<3>> v(x.size());
  EXPECT_TRUE(std::isinf(system.contact_time_step(v)));
  for (std::size_t k = 0; k < v.size(); ++k)
    if (system.ids()[k] >= blocks.set.bodies[1].first) v[k][D - 1] = -10;
  EXPECT_NEAR(system.contact_time_step(v), 0.1 * 0.85 / 10, 1e-12);
  for (Vec<3>& u : v) u = -1.0 * u;
  EXPECT_GT(system.contact_time_step(v), 1e6) << "they part, but for rounding";
}

TEST_P(InDimensions, FrictionSticksThenSlides) {
  int const D = GetParam();
  Blocks const blocks(D, 0.05, 0.7, 1);
  constexpr double mu = 0.3;
  SurfaceContactSystem system = blocks.system({}, {.kinetic = mu});
  auto x = places(system, blocks.set);
  system.start(x);
  double const normal = system.between(1, 0).force[D - 1];
  EXPECT_LT(std::fabs(system.between(1, 0).force[0]), 5e-3 * normal) << "nothing has moved; edges are not quite even";
  double work = 0, stretch = 0;
  for (int step = 0; step < 60; ++step) {
    for (std::size_t k = 0; k < x.size(); ++k)
      if (system.ids()[k] >= blocks.set.bodies[1].first) x[k][0] += 0.002;
    system.evaluate(x, 1e-3);
    work += system.totals().friction_work;
    stretch += 0.002;
    double const pull = -system.between(1, 0).force[0];
    EXPECT_LE(pull, mu * normal * 1.02);
    if (step == 0) {
      EXPECT_GT(pull, 0);
    }
    if (step == 59) {
      EXPECT_NEAR(pull / (mu * normal), 1, 0.03) << "it slides";
    }
  }
  // Work of the last force over the way, less what the springs took to stretch.
  EXPECT_NEAR(work / (mu * normal * stretch), 1, 0.3);
  EXPECT_GT(work, system.totals().spring_energy);
}

TEST_P(InDimensions, FrictionKeepsMomentaAndIsBlindToRigidMotion) {
  int const D = GetParam();
  Blocks const blocks(D, 0.2);
  SurfaceContactSystem system = blocks.system({}, {.kinetic = 0.5});
  auto x = places(system, blocks.set);
  system.start(x);
  distort(x, D, 0.1);
  system.evaluate(x, 1e-3);
  expect_balance(system, x);
  double const energy = system.totals().spring_energy;
  ASSERT_GT(energy, 0);
  double const c = std::cos(0.3), s = std::sin(0.3);
  for (int turn = 0; turn < 10; ++turn) {
    for (Vec<3>& y : x) y = {{c * y[0] - s * y[1] + 0.1, s * y[0] + c * y[1] - 0.2, y[2]}};
    system.evaluate(x, 1e-3);
    EXPECT_NEAR(system.totals().spring_energy / energy, 1, 1e-10);
    EXPECT_NEAR(system.totals().friction_work, 0, 1e-10 * energy);
  }
}

TEST_P(InDimensions, RestoredStateGoesOnBitForBit) {
  int const D = GetParam();
  Blocks const blocks(D, 0.1);
  RigidSurface plane;
  plane.dimension = D;
  plane.axis = {};
  plane.axis[D - 1] = 1;
  plane.centre[D - 1] = 0.05;
  SurfaceContactSystem whole = blocks.system({plane}, {.kinetic = 0.3}),
                       resumed = blocks.system({plane}, {.kinetic = 0.3});
  auto x = places(whole, blocks.set);
  auto const move = [&] {
    for (std::size_t k = 0; k < x.size(); ++k) x[k][0] += 0.003 * static_cast<double>(k % 5);
  };
  whole.start(x);
  for (int k = 0; k < 4; ++k) {
    move();
    whole.evaluate(x, 1e-3);
  }
  // A resumed run has evaluated contact at its start before restore().
  auto pressed = places(resumed, blocks.set);
  for (Vec<3>& y : pressed) y[D - 1] -= 0.02;
  resumed.start(pressed);
  ASSERT_FALSE(resumed.loaded_indices().empty());
  resumed.restore(x, whole.state());
  EXPECT_EQ(resumed.loaded_indices(), whole.loaded_indices());
  EXPECT_EQ(resumed.state(), whole.state());
  for (int k = 0; k < 20; ++k) {
    move();
    whole.evaluate(x, 1e-3);
    resumed.evaluate(x, 1e-3);
    EXPECT_EQ(resumed.state(), whole.state());
  }
}

INSTANTIATE_TEST_SUITE_P(Contact, InDimensions, ::testing::Values(2, 3));

}  // namespace
}  // namespace piola::contact
