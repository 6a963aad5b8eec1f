// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/contact.hpp"
#include "piola/formulations/adaptle/contact_sweep.hpp"
#include "formulations/adaptle/clouds.hpp"
#include <limits>

namespace piola {
namespace {

using namespace testing;
using adaptle::BodyConstants;
using adaptle::ContactForce;
using adaptle::KernelContactPair;
using adaptle::RigidPoseAtHalfTime;

template <int D>
void force_is_minus_the_slope_of_the_energy() {
  KernelContactPair p{3e2, 1.4e-3, 1.1e-3};
  adaptle::Kernel<D> const kernel(p.h);
  for (double const exponent : {1.0, 4.0, 6.0}) {
    p.exponent = exponent;
    auto const energy = [&](double r) { return p.eps * std::pow(kernel(r) / kernel(p.dp), exponent); };
    for (double const r : {0.3e-3, 0.9e-3, 1.1e-3, 1.7e-3, 2.5e-3}) {
      ContactForce const f = adaptle::kernel_contact<D>(p, r);
      double const step = 1e-8, slope = (energy(r + step) - energy(r - step)) / (2 * step);
      EXPECT_NEAR(f.force, -slope, 1e-7 * (f.force + energy(r) / p.dp)) << D << "D " << exponent << " " << r;
      double const before = adaptle::kernel_contact<D>(p, r - step).force,
                   after = adaptle::kernel_contact<D>(p, r + step).force;
      EXPECT_GE(f.stiffness, (before - after) / (2 * step) * (1 - 1e-6));  // it bounds the step
      EXPECT_NEAR(f.overlap, 1 - r / p.dp, 1e-15);
    }
    EXPECT_EQ(adaptle::kernel_contact<D>(p, 2 * p.h).force, 0);
    EXPECT_EQ(adaptle::kernel_contact<D>(p, 3 * p.h).stiffness, 0);
  }
}

TEST(AdaptleContact, ForcesOfTheKernelLawAreMinusTheSlopeOfTheirEnergy) {
  force_is_minus_the_slope_of_the_energy<2>();
  force_is_minus_the_slope_of_the_energy<3>();
}

TEST(AdaptleContact, TheLinearLawIsASpringBelowTheSpacing) {
  KernelContactPair const p{50, 1, 0.2};
  EXPECT_EQ(adaptle::linear_contact(p, 0.2).force, 0);
  EXPECT_EQ(adaptle::linear_contact(p, 0.3).stiffness, 0);
  EXPECT_NEAR(adaptle::linear_contact(p, 0.15).force, 50 * 0.05 / 0.04, 1e-12);
  EXPECT_NEAR(adaptle::linear_contact(p, 0.15).stiffness, 50 / 0.04, 1e-12);
  EXPECT_NEAR(adaptle::linear_contact(p, 0.15).overlap, 0.25, 1e-14);
}

TEST(AdaptleContact, NumbersOfLatticesAreThoseOfThePaperwork) {
  EXPECT_NEAR(adaptle::contact_number(2, 1.4e-4, 1e-4, 4), 6.233, 5e-4);
  EXPECT_NEAR(adaptle::contact_number(3, 1.2, 1, 4), 8.507, 5e-4);
}

TEST(AdaptleContact, StiffnessFollowsFromTheImpedances) {
  BodyConstants a, b;
  a.rho0 = 1000;
  a.bulk_modulus = 4e9;  // c = 2000 m/s, Z = 2e6
  b.rho0 = 4000;
  b.bulk_modulus = 36e9;  // c = 3000 m/s, Z = 12e6
  a.spacing = 1e-3;
  b.spacing = 2e-3;
  a.h = 1.2e-3;
  b.h = 2.4e-3;
  double const shock = 2e6 * 12e6 / 14e6 * 400 * (1 + 400.0 / 4000);
  EXPECT_NEAR(adaptle::reference_pressure(a, b, 400), shock, 1e-6 * shock);
  EXPECT_NEAR(adaptle::reference_pressure(a, b, 1), 0.01 * 4e9, 1);
  BodyConstants soft = a;
  soft.yield_stress = 1e8;  // flows away at 3 sy + rho v^2 / 2
  EXPECT_NEAR(adaptle::reference_pressure(soft, b, 400), 3e8 + 500 * 400.0 * 400, 1e-6);
  soft.yield_stress = 1e6;
  EXPECT_NEAR(adaptle::reference_pressure(soft, b, 400), 0.25 * shock, 1e-6 * shock) << "not softer than that";
  ContactRule rule;
  rule.scale = 0.5;
  auto pairs = adaptle::contact_pairs(3, rule, {a, b}, {{100, 0, 0}, {-300, 0, 0}});
  EXPECT_EQ(pairs[0].eps, 0);
  EXPECT_EQ(pairs[3].eps, 0);
  for (std::size_t const k : {std::size_t{1}, std::size_t{2}}) {
    EXPECT_NEAR(pairs[k].h, 1.8e-3, 1e-18);
    EXPECT_NEAR(pairs[k].dp, 1.5e-3, 1e-18);
    // (dp_a dp_b)^2 / dp over C_n, which depends on h/dp alone
    double const wanted = 0.5 * shock * 4e-12 / 1.5e-3 / 8.507;
    EXPECT_NEAR(pairs[k].eps, wanted, 1e-4 * wanted);
  }
  rule.law = ContactRule::Law::linear;
  pairs = adaptle::contact_pairs(2, rule, {a, b}, {{0, 0, 0}, {0, 0, 0}});
  EXPECT_NEAR(pairs[1].eps, 0.5 * 4e9 * 2e-6, 1e-9);
}

BodyConstants metal(double rho0, double bulk_sound_speed, double yield_stress) {
  BodyConstants b;
  b.rho0 = rho0;
  b.bulk_modulus = rho0 * bulk_sound_speed * bulk_sound_speed;
  b.yield_stress = yield_stress;
  return b;
}

TEST(AdaptleContact, ExponentRisesWhereStrengthPresses) {
  BodyConstants const aluminium = metal(2800, 5000, 0.4e9), steel = metal(7800, 4500, 1e9);
  auto const n = [](BodyConstants const& a, BodyConstants const& b, double v) {
    double const here = adaptle::contact_exponent(a, b, v);
    EXPECT_EQ(here, adaptle::contact_exponent(b, a, v)) << "a potential has one";
    return here;
  };
  // p_s = 14e6 35.1e6 / 49.1e6 * 500 (1 + 500 / 9000) = 5.282 GPa, p_f = 1.2 + 0.35 = 1.55 GPa, x = 0.748
  double const shock = 14e6 * 35.1e6 / 49.1e6 * 500 * (1 + 500.0 / 9000), x = (1.2 / 1.55 - 0.4) / 0.5,
               aside = 1 - 1.55e9 / shock;
  EXPECT_NEAR(n(aluminium, steel, 500), 4 + 4 * x * x * (3 - 2 * x) * aside * aside, 1e-12);
  EXPECT_GT(n(aluminium, steel, 500), 5.5);
  EXPECT_EQ(n(aluminium, aluminium, 1200), 4) << "inertia presses: strength has 0.37 of it";
  EXPECT_EQ(n(aluminium, steel, 50), 4) << "the shock is below what flows";
  EXPECT_EQ(n(aluminium, steel, 0), 4);
  EXPECT_EQ(n(metal(1000, 1500, 0), aluminium, 100), 4) << "a liquid has no strength";
  double const never = std::numeric_limits<double>::infinity();
  EXPECT_EQ(n(metal(1000, 1500, never), metal(1000, 1500, never), 100), 4) << "rubber does not flow sideways";
  double last = 4;
  for (double v = 60; v < 3000; v *= 1.01) {
    double const here = n(aluminium, steel, v);
    EXPECT_NEAR(here, last, 0.1) << v;
    EXPECT_LT(here, 8);
    last = here;
  }
}

TEST(AdaptleContact, WhatTheCaseSaysOfTheExponentHolds) {
  std::vector<BodyConstants> const bodies{metal(2800, 5000, 0.4e9), metal(7800, 4500, 1e9)};
  ContactRule rule;
  for (auto const law : {ContactRule::Law::kernel, ContactRule::Law::as_published}) {
    rule.law = law;
    rule.exponent = 6;
    EXPECT_EQ(adaptle::contact_pairs(3, rule, bodies, {{500, 0, 0}, {0, 0, 0}})[1].exponent, 6);
    rule.exponent = std::numeric_limits<double>::quiet_NaN();
    double const found = adaptle::contact_pairs(3, rule, bodies, {{500, 0, 0}, {0, 0, 0}})[1].exponent;
    EXPECT_EQ(found, law == ContactRule::Law::kernel ? adaptle::contact_exponent(bodies[0], bodies[1], 500) : 4);
  }
  rule.law = ContactRule::Law::kernel;
  rule.closing_speed = 0;
  EXPECT_EQ(adaptle::contact_pairs(3, rule, bodies, {{500, 0, 0}, {0, 0, 0}})[1].exponent, 4);
}

struct Seen {
  double distance;
  std::array<double, 3> normal;
};
template <int D>
Seen look(RigidPoseAtHalfTime const& shape, std::array<double, 3> x) {
  Seen r{};
  r.distance = adaptle::distance_to<D>(shape, x.data(), r.normal.data());
  return r;
}
void expect(Seen const& seen, double distance, std::array<double, 3> normal) {
  EXPECT_NEAR(seen.distance, distance, 1e-14);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(seen.normal[c], normal[c], 1e-14) << c;
}

RigidPoseAtHalfTime place(RigidShape::Kind kind) {
  RigidPoseAtHalfTime p{};
  p.kind = static_cast<int>(kind);
  p.centre[0] = 1;
  p.axis[1] = 1;
  return p;
}

TEST(AdaptleRigid, PlanesAreHalfSpaces) {
  RigidPoseAtHalfTime p = place(RigidShape::Kind::plane);
  p.axis[0] = 0.6;
  p.axis[1] = 0.8;
  expect(look<2>(p, {2, 1, 0}), 1.4, {0.6, 0.8, 0});
  expect(look<3>(p, {1, -1, 7}), -0.8, {0.6, 0.8, 0});
}

TEST(AdaptleRigid, Spheres) {
  RigidPoseAtHalfTime p = place(RigidShape::Kind::sphere);
  p.radius = 2;
  expect(look<3>(p, {1, 0, -3}), 1, {0, 0, -1});
  expect(look<3>(p, {1.6, 0.8, 0}), -1, {0.6, 0.8, 0});
  expect(look<2>(p, {4, 4, 0}), 3, {0.6, 0.8, 0});
  EXPECT_NEAR(look<3>(p, {1, 0, 0}).distance, -2, 1e-15);  // the centre: some normal
}

TEST(AdaptleRigid, Cylinders) {
  RigidPoseAtHalfTime p = place(RigidShape::Kind::cylinder);  // along y
  p.radius = 1;
  p.half[0] = 2;
  expect(look<3>(p, {1, 3, 0}), 1, {0, 1, 0});
  expect(look<3>(p, {1.5, -4, 0}), 2, {0, -1, 0});
  expect(look<3>(p, {1, 1, -3}), 2, {0, 0, -1});
  expect(look<3>(p, {1.8, 0.5, 0}), -0.2, {1, 0, 0});  // nearer to the side
  expect(look<3>(p, {1.1, 1.9, 0}), -0.1, {0, 1, 0});  // nearer to the end
  expect(look<3>(p, {5, 6, 0}), 5, {0.6, 0.8, 0});     // beyond the edge
  expect(look<3>(p, {1, -6, -4}), 5, {0, -0.8, -0.6});
}

TEST(AdaptleRigid, Boxes) {
  RigidPoseAtHalfTime p = place(RigidShape::Kind::box);
  p.half[0] = 2;
  p.half[1] = 1;
  p.half[2] = 3;
  expect(look<3>(p, {4, 0.5, -1}), 1, {1, 0, 0});
  expect(look<3>(p, {0, 0.9, 2}), -0.1, {0, 1, 0});
  expect(look<3>(p, {1, 0, -2.8}), -0.2, {0, 0, -1});
  expect(look<3>(p, {-4, -5, 3}), 5, {-0.6, -0.8, 0});  // 3 and 4 beyond an edge
  expect(look<3>(p, {5, 3, 4}), 3, {2.0 / 3, 2.0 / 3, 1.0 / 3});
  expect(look<2>(p, {6, 5, 0}), 5, {0.6, 0.8, 0});
}

/// Two bodies of one particle each, 3 spacings apart, that collide head on at 50 m/s each.
Assembly two_particles(int dimension) {
  ParticleSet set;
  set.dimension = dimension;
  double const dp = 1e-4;
  for (int k = 0; k < 2; ++k) {
    set.bodies.push_back({k == 0 ? "left" : "right", k, k + 1, {dp, dp, dimension == 3 ? dp : 1}, {1, 1, 1}, false});
    set.X.push_back({3 * dp * k, 0, 0});
    set.lattice_index.push_back({0, 0, 0});
    set.volume.push_back(std::pow(dp, dimension));
    set.kernel_volume.push_back(set.volume.back());
    set.body.push_back(k);
  }
  Assembly a = adaptle_assembly(set);
  choose(a, "smoothing_length", 1.4);
  a.initial_velocity = {{50, 0, 0}, {-50, 0, 0}};
  return a;
}

TEST(AdaptleContact, TwoParticlesReboundWithTheirSpeed) {
  for (int const dimension : {2, 3})
    for (std::string const description : {"eulerian", "total_lagrangian"})
      for (auto const law : {ContactRule::Law::kernel, ContactRule::Law::linear, ContactRule::Law::as_published}) {
        Assembly a = two_particles(dimension);
        choose(a, "description", description);
        a.contact.law = law;
        a.contact.stiffness = dimension == 2 ? 2e18 : 2e22;
        auto const f = make_formulation(a);
        double const before = f->diagnose().kinetic_energy, dt = 2e-10;
        // The spring sets in with a kink, which costs some digits.
        double const slack = law == ContactRule::Law::linear ? 5e-6 : 1e-6;
        double least = before;
        for (int k = 0; k < 20000; ++k) {
          f->step(k * dt, dt);
          if (k % 10 == 0) least = std::min(least, f->diagnose().kinetic_energy);
        }
        Values const v = sample(*f, "Velocity", 2), x = sample(*f, "Position", 2);
        EXPECT_LT(least, 0.01 * before);
        EXPECT_LT(x[0], x[3] - 2e-4) << "they passed through each other, or have not parted yet";
        EXPECT_NEAR(v[0], -50, 50 * slack);
        EXPECT_NEAR(v[3], 50, 50 * slack);
        EXPECT_NEAR(v[0] + v[3], 0, 1e-11);
        EXPECT_NEAR(f->diagnose().total_energy(), before, slack * before);
      }
}

// No step brings bodies nearer to each other by more than 0.05 of a spacing, from the first one on, once they see each
// other; while they part, or are far apart, it does not matter how fast they are.
TEST(AdaptleContact, StepsKnowHowFastBodiesClose) {
  auto const step = [](double distance, double speed, double exponent,
                       ContactRule::Law law = ContactRule::Law::kernel) {
    Assembly a = two_particles(2);
    double const spacing = a.particles.bodies[0].spacing[0];
    a.particles.X[1] = a.particles.X[0];
    a.particles.X[1][0] += distance * spacing;
    a.contact.closing_speed = 1e-3;
    a.contact.exponent = exponent;
    a.contact.law = law;
    a.initial_velocity = {{0.5 * speed, 0, 0}, {-0.5 * speed, 0, 0}};
    return make_formulation(a)->stable_time_step() * std::fabs(speed) / spacing;
  };
  EXPECT_NEAR(step(2, 1e5, 4), 0.05, 1e-12);
  EXPECT_GT(step(2, -1e5, 4), 0.2);
  EXPECT_GT(step(4, 1e5, 4), 0.2);
  // A steeper law rises as much in a shorter way; the linear one has no exponent, and 4 is the least that counts.
  EXPECT_NEAR(step(2, 1e5, 8), 0.025, 1e-12);
  EXPECT_NEAR(step(2, 1e5, 5.5), 0.05 * 4 / 5.5, 1e-12);
  EXPECT_NEAR(step(2, 1e5, 2), 0.05, 1e-12);
  EXPECT_NEAR(step(0.9, 1e5, 8, ContactRule::Law::linear), 0.05, 1e-12);
}

TEST(AdaptleRigid, StepsKnowHowFastAParticleComes) {
  auto const step = [](double distance, double speed) {
    Assembly a = two_particles(2);
    double const spacing = a.particles.bodies[0].spacing[0];
    RigidShape wall;
    wall.kind = RigidShape::Kind::plane;
    wall.centre = {-distance * spacing, 0, 0};
    wall.axis = {1, 0, 0};
    a.rigid_shapes.push_back(wall);
    a.initial_velocity = {{-speed, 0, 0}, {-speed, 0, 0}};
    return make_formulation(a)->stable_time_step() * std::fabs(speed) / spacing;
  };
  EXPECT_NEAR(step(1.5, 1e5), 0.05, 1e-12);
  EXPECT_GT(step(1.5, -1e5), 0.2);
  EXPECT_GT(step(2.5, 1e5), 0.2);
}

// Particles that start within reach of each other: the energy of the contact counts from the start.
TEST(AdaptleContact, PotentialAtTheStartBecomesMotion) {
  for (auto const law : {ContactRule::Law::kernel, ContactRule::Law::linear, ContactRule::Law::as_published}) {
    Assembly a = two_particles(2);
    a.initial_velocity.assign(2, {0, 0, 0});
    a.contact.law = law;
    a.contact.stiffness = 2e18;
    double const spacing = a.particles.bodies[0].spacing[0];
    a.particles.X[1] = a.particles.X[0];
    a.particles.X[1][0] += 0.8 * spacing;
    auto const f = make_formulation(a);
    double const stored = f->diagnose().total_energy(), dt = 5e-11;
    EXPECT_GT(stored, 0);
    EXPECT_EQ(f->diagnose().kinetic_energy, 0);
    for (int k = 0; k < 80000; ++k) f->step(k * dt, dt);
    Diagnostics const d = f->diagnose();
    EXPECT_NEAR(d.kinetic_energy, stored, 1e-4 * stored) << static_cast<int>(law);
    EXPECT_NEAR(d.total_energy(), stored, 1e-4 * stored);
  }
}

TEST(AdaptleContact, WithoutALawBodiesOfTotalLagrangianParticlesPass) {
  Assembly a = two_particles(2);
  choose(a, "description", "total_lagrangian");
  a.contact.law = ContactRule::Law::none;
  auto const f = make_formulation(a);
  advance(*f, 1e-8, 800);
  EXPECT_EQ(sample(*f, "Velocity", 2)[0], 50);
}

/// A block of 8 x 6 particles falls on a rigid shape below.
class AdaptleRigidRebound : public ::testing::TestWithParam<std::tuple<std::string, RigidShape::Kind>> {};

TEST_P(AdaptleRigidRebound, KeepsTheEnergyOfABlock) {
  auto const [description, kind] = GetParam();
  Assembly a = adaptle_assembly(box({0.7, 0.5, 0}, {8, 6, 1}, 2));
  choose(a, "description", description);
  choose(a, "artificial_stress", 0.0);
  give_velocity(a, [](Point const&) { return Point{0, -20, 0}; });
  RigidShape shape;
  shape.name = "below";
  shape.kind = kind;
  shape.axis = {0, 1, 0};
  shape.centre = {0.35, -0.06, 0};
  if (kind == RigidShape::Kind::sphere) {
    shape.centre[1] -= 0.4;
    shape.radius = 0.4;
  }
  if (kind == RigidShape::Kind::box) {
    shape.centre[1] -= 0.2;
    shape.half_lengths = {0.2, 0.2, 0};
  }
  a.rigid_shapes.push_back(shape);
  auto const f = make_formulation(a);
  Diagnostics const before = f->diagnose();
  double time = 0;
  double const end = 1.5e-3;
  double worst = 0;
  while (time < end) {
    double const dt = 0.5 * f->stable_time_step();
    f->step(time, dt);
    time += dt;
    worst = std::fmax(worst, std::fabs(f->diagnose().total_energy() - before.kinetic_energy));
  }
  ASSERT_FALSE(f->failure());
  Diagnostics const after = f->diagnose();
  EXPECT_LT(worst, 0.01 * before.kinetic_energy);
  EXPECT_GT(after.linear_momentum[1], -0.2 * before.linear_momentum[1]) << "it has not turned round";
  EXPECT_NEAR(after.linear_momentum[0], 0, 1e-9 * std::fabs(before.linear_momentum[1]));
  EXPECT_EQ(after.external_work, 0);
}

INSTANTIATE_TEST_SUITE_P(All, AdaptleRigidRebound,
                         ::testing::Combine(::testing::Values("eulerian", "total_lagrangian"),
                                            ::testing::Values(RigidShape::Kind::plane, RigidShape::Kind::sphere,
                                                              RigidShape::Kind::box)));

TEST(AdaptleRigid, AMovingPlaneDoesWorkOnABlock) {
  Assembly a = adaptle_assembly(box({0.7, 0.5, 0}, {8, 6, 1}, 2));
  choose(a, "description", "total_lagrangian");
  RigidShape plane;
  plane.axis = {0, 1, 0};
  plane.centre = {0, -0.06, 0};
  plane.velocity[1] = Expression("20");
  a.rigid_shapes.push_back(plane);
  auto const f = make_formulation(a);
  double time = 0;
  while (time < 1e-3) {
    double const dt = 0.5 * f->stable_time_step();
    f->step(time, dt);
    time += dt;
  }
  Diagnostics const d = f->diagnose();
  EXPECT_GT(d.linear_momentum[1], 0);
  EXPECT_GT(d.external_work, 0);
  EXPECT_NEAR(d.total_energy(), d.external_work, 0.01 * d.external_work);
}

}  // namespace
}  // namespace piola
