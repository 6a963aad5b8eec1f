// SPDX-License-Identifier: Apache-2.0
// Who turns Eulerian or fails, when, with whom; and what it leaves behind.
#include "formulations/adaptle/clouds.hpp"
#include <set>

namespace piola {
namespace {

using namespace testing;

MaterialParameters damaging() { return sample_metal("perfectly_plastic", "elastic", "johnson_cook"); }

std::set<Index> eulerian(Cloud const& cloud) {
  std::set<Index> r;
  for (Index i = 0; i < cloud.size(); ++i)
    if (cloud.state[i].phi > 0) r.insert(i);
  return r;
}

/// Those not farther than the distance from particle i in the reference configuration, with i.
std::set<Index> within(Cloud const& cloud, Index i, double distance) {
  std::set<Index> r;
  Point const a = cloud.X(i);
  for (Index j = 0; j < cloud.size(); ++j) {
    Point const b = cloud.X(j);
    if (std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]) <= distance) r.insert(j);
  }
  return r;
}

TEST(AdaptleConversion, TakesTheReferenceNeighboursWithinTheRadius) {
  for (double const radius : {2.0, 1.0, 0.0}) {
    Assembly a = adaptle_assembly(unit_box(2, 11), damaging());
    choose(a, "smoothing_length", 1.3);
    choose(a, "conversion_radius", radius);
    Cloud cloud(a);
    Index const middle = 60;
    cloud.state[middle].damage = 1;
    cloud.evaluate();
    EXPECT_EQ(eulerian(cloud), within(cloud, middle, radius * 1.3 * 0.1));
    auto const& energy_totals = cloud.particles->energy_totals();
    EXPECT_EQ(energy_totals.converted, static_cast<double>(eulerian(cloud).size()));
    EXPECT_EQ(energy_totals.by_guard, 0);
    double mass = 0;
    for (Index const i : eulerian(cloud)) mass += cloud.mass(i);
    EXPECT_NEAR(energy_totals.converted_mass, mass, 1e-12 * mass);
    cloud.evaluate();
    EXPECT_EQ(energy_totals.converted, static_cast<double>(eulerian(cloud).size())) << "their neighbours go no further";
  }
}

TEST(AdaptleConversion, WaitsForTheDamageThatTheUserWants) {
  Assembly a = adaptle_assembly(unit_box(2, 7), damaging());
  choose(a, "convert_damage", 0.5);
  Cloud cloud(a);
  cloud.state[24].damage = 0.49;
  cloud.evaluate();
  EXPECT_TRUE(eulerian(cloud).empty());
  cloud.state[24].damage = 0.5;
  cloud.evaluate();
  EXPECT_FALSE(eulerian(cloud).empty());
}

TEST(AdaptleConversion, FollowsTheEquivalentStrain) {
  // Simple shear F = I + g e_x e_y: E' has E_xy = g/2, E_yy = g^2/2 - g^2/6, so eps^2 = 2/3 (g^2/2 + g^4/6).
  double const g = 0.4, strain = std::sqrt(2.0 / 3.0 * (g * g / 2 + g * g * g * g / 6));
  for (double const limit : {0.999 * strain, 1.001 * strain}) {
    Assembly a = adaptle_assembly(unit_box(3, 5));
    choose(a, "correction", "mixed");
    choose(a, "convert_strain", limit);
    displace(a, [&](Point const& X) { return Point{g * X[1], 0, 0}; });
    Cloud cloud(a);
    cloud.evaluate();
    EXPECT_EQ(eulerian(cloud).size(), limit < strain ? 125u : 0u);
  }
}

TEST(AdaptleConversion, FollowsAFormula) {
  Assembly a = adaptle_assembly(unit_box(2, 9), damaging());
  choose(a, "conversion_radius", 0.0);
  choose_formula(a, "convert_when", "plastic_strain > 0.2 && X < 0.5 && temperature > 299");
  Cloud cloud(a);
  cloud.state[3].plastic_strain = 0.3;
  cloud.state[8].plastic_strain = 0.3;  // X = 1
  cloud.state[12].plastic_strain = 0.1;
  cloud.evaluate();
  EXPECT_EQ(eulerian(cloud), (std::set<Index>{3}));
}

TEST(AdaptleConversion, GuardsVolumesAndTethers) {
  Assembly a = adaptle_assembly(unit_box(2, 7));
  choose(a, "correction", "mixed");
  displace(a, [](Point const& X) { return Point{-0.8 * X[0], 0, 0}; });  // J = 0.2
  Cloud flat(a);
  flat.evaluate();
  EXPECT_EQ(eulerian(flat).size(), 49u);
  EXPECT_EQ(flat.particles->energy_totals().by_guard, 49);

  // One particle is Eulerian and has left its place by 1.5 h: those that have it for a neighbour follow, alone.
  for (double const tether : {1.0, 2.0}) {
    Assembly b = adaptle_assembly(unit_box(2, 11));
    double const h = 1.3 * 0.1;
    choose(b, "smoothing_length", 1.3);
    choose(b, "conversion_separation", tether);
    Cloud torn(b);
    Index const middle = 60;
    torn.state[middle].phi = 1;
    torn.state[middle].x[0] += 1.5 * h;
    torn.changed();
    torn.evaluate();
    if (tether == 2) {
      EXPECT_EQ(eulerian(torn), (std::set<Index>{middle}));
      continue;
    }
    // Its displacement enters the deformation gradients of its neighbours, which moves their thresholds a little.
    std::set<Index> const found = eulerian(torn), near = within(torn, middle, 2 * h);
    EXPECT_GT(found.size(), 3u);
    EXPECT_TRUE(std::includes(near.begin(), near.end(), found.begin(), found.end()));
    EXPECT_EQ(torn.particles->energy_totals().by_guard, static_cast<double>(found.size() - 1));
  }
}

TEST(AdaptleConversion, KeepsTheStateAndFindsTheDensityOfTheEndOfTheStep) {
  // Uniform expansion with the rate a along x: rho = rho0 / (1 + a t).
  double const rate = 2e4, dt = 1e-7;
  Assembly a = adaptle_assembly(unit_box(2, 9));
  choose(a, "correction", "mixed");
  give_velocity(a, [&](Point const& X) { return Point{rate * X[0], 0, 0}; });
  Cloud stays(a);
  choose_formula(a, "convert_when", "t > 2.5e-7");
  Cloud turns(a);
  int steps = 0;
  for (; steps < 5 && eulerian(turns).empty(); ++steps) {
    stays.particles->step(steps * dt, dt);
    turns.particles->step(steps * dt, dt);
  }
  ASSERT_EQ(eulerian(turns).size(), 81u);
  ASSERT_GT(steps, 1);
  ASSERT_TRUE(eulerian(stays).empty());
  for (Index i = 0; i < stays.size(); ++i) {
    State const s = stays.state[i], t = turns.state[i];
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(s.x[c], t.x[c]);
      EXPECT_EQ(s.v[c], t.v[c]);
    }
    for (int c = 0; c < 6; ++c) EXPECT_EQ(s.S[c], t.S[c]);
    EXPECT_EQ(s.energy, t.energy);
  }
  // In the middle no wave has come from the faces yet (5e-7 s at 6 km/s are 3 mm of 1 m).
  // The rate of the middle of the step serves for its second half: (rate dt)^2 / 8 at most.
  EXPECT_NEAR(turns.state[40].rho, 2870 / (1 + rate * steps * dt), 2870 * rate * dt * rate * dt / 7);
  double kinetic = 0;
  for (Index i = 0; i < turns.size(); ++i) kinetic += 0.5 * turns.mass(i) * std::pow(turns.state[i].v[0], 2);
  EXPECT_LT(turns.particles->energy_totals().energy_change, 1e-14 * kinetic);
  EXPECT_LT(turns.particles->energy_totals().momentum_change, 1e-14 * kinetic / rate);
}

/// A particle that is stretched or compressed along x, sheared, and failed.
TEST(AdaptleRelease, LeavesNeitherShearNorTensionButCompression) {
  for (std::string const description : {"eulerian", "adaptive", "total_lagrangian"})
    for (double const stretch : {1.01, 0.99}) {
      Assembly a = adaptle_assembly(unit_box(2, 7), damaging());
      choose(a, "description", description);
      choose(a, "failed", "release");
      choose(a, "correction", "mixed");
      choose(a, "correction_limit", 1e30);
      Cloud cloud(a);
      for (Index i = 0; i < cloud.size(); ++i) {
        State const s = cloud.state[i];
        s.x[0] *= stretch;
        s.rho /= stretch;
        s.S[0] = 1e6;
        s.S[1] = s.S[2] = -0.5e6;
      }
      cloud.state[24].damage = 1;
      cloud.state[24].released = 1;
      cloud.changed();
      cloud.evaluate();
      cloud.evaluate();
      for (double const S : cloud.state[24].S) EXPECT_EQ(S, 0) << description;
      EXPECT_EQ(cloud.state[23].S[0], 1e6) << "sound material keeps its stress";
      EXPECT_EQ(cloud.state[24].active, 1);
      if (stretch > 1) {
        EXPECT_EQ(cloud.half(24).pressure, 0);
        EXPECT_LT(cloud.half(23).pressure, 0);
      } else {
        EXPECT_GT(cloud.half(24).pressure, 0.99 * cloud.half(23).pressure);
      }
      std::set<Index> const neighbours = within(cloud, 24, 2 * 1.4 / 6 * (1 + 1e-12));
      if (description == "adaptive")
        EXPECT_EQ(eulerian(cloud), neighbours) << "it converts all the same";
      else
        EXPECT_EQ(eulerian(cloud).size(), description == "eulerian" ? 49u : 0u);
    }
}

TEST(AdaptleRelease, TakesAsLongAsAShearWaveThroughTheSupport) {
  Assembly a = adaptle_assembly(unit_box(2, 7), damaging());
  choose(a, "description", "total_lagrangian");
  Cloud cloud(a);
  adaptle::BodyConstants const& body = cloud.system().body[0];
  double const c = std::sqrt(body.shear_modulus / body.rho0), time = 2 * body.h / c, S0 = 1e6;
  State const s = cloud.state[24];
  s.S[0] = S0;
  s.S[1] = s.S[2] = -0.5 * S0;
  s.damage = 1;
  double const energy = s.energy;
  for (Index i = 0; i < cloud.size(); ++i)  // nothing moves, so that nothing but the release changes the stress
    for (double& v : cloud.state[i].v) v = 0;
  cloud.changed();
  double before = S0;
  for (int k = 1; k <= 10; ++k) {
    cloud.particles->step(0, 0.1 * time * 1e-6);
    double const left = 1 - 1e-7 * k;
    EXPECT_NEAR(s.S[0], S0 * left, 1e-9 * S0);
    EXPECT_LT(s.S[0], before);
    before = s.S[0];
  }
  EXPECT_NEAR(s.energy, energy, 1e-4 * S0 * S0 / body.shear_modulus * cloud.volume(24))
      << "what is released becomes heat";
  EXPECT_GT(s.plastic_work, 0);
  cloud.particles->step(0, 2 * time);
  EXPECT_EQ(s.released, 1);
  for (double const S : s.S) EXPECT_EQ(S, 0);
}

TEST(AdaptleDeletion, LeavesParticlesWithoutStressAndWithTheirDeformation) {
  Assembly a = adaptle_assembly(unit_box(2, 9), damaging());
  choose(a, "description", "total_lagrangian");
  choose(a, "failed", "delete");
  choose(a, "correction", "mixed");
  give_velocity(a, [](Point const& X) { return Point{200 * X[0] * X[1], -100 * X[1], 0}; });
  Cloud cloud(a);
  double time = 0;
  auto const advance_cloud = [&](int n) {
    for (int k = 0; k < n; ++k) {
      double const dt = cloud.particles->stable_time_step();
      cloud.particles->step(time, dt);
      time += dt;
    }
  };
  advance_cloud(3);
  Index const gone = 40;
  cloud.state[gone].damage = 1;
  advance_cloud(1);
  ASSERT_EQ(cloud.state[gone].active, 0);
  EXPECT_EQ(cloud.particles->energy_totals().deleted, 1);
  EXPECT_EQ(cloud.state[gone].phi, 0);
  Deformation const kept = cloud.deformation(gone);
  double const v = cloud.state[gone].v[0];
  ASSERT_NE(kept.F[0], 1);
  advance_cloud(5);
  for (int c = 0; c < 9; ++c) EXPECT_EQ(cloud.deformation(gone).F[c], kept.F[c]);
  for (double const S : cloud.state[gone].S) EXPECT_EQ(S, 0);
  EXPECT_EQ(cloud.half(gone).pressure, 0);
  EXPECT_EQ(cloud.state[gone].v[0], v) << "nothing pulls at it";
  EXPECT_EQ(cloud.particles->energy_totals().deleted, 1);
  for (Index i = 0; i < cloud.size(); ++i) EXPECT_EQ(cloud.state[i].active, i == gone ? 0 : 1);
}

/// A checkpoint stores deformation gradients once there are deleted particles, whose deformation does not follow from
/// positions.
TEST(AdaptleDeletion, GoesOnFromACheckpointBitForBit) {
  Assembly a = adaptle_assembly(unit_box(2, 9), damaging());
  choose(a, "description", "total_lagrangian");
  choose(a, "failed", "delete");
  give_velocity(a, [](Point const& X) { return Point{200 * X[0] * X[1], -100 * X[1], 0}; });
  auto const whole = make_formulation(a);
  double const soon = take_steps(*whole, 0, 3);
  SavedState state = saved(*whole);
  EXPECT_FALSE(state.values.contains("DeformationGradient"));
  state.values["Damage"][40] = 1;
  whole->load(state);
  double const later = take_steps(*whole, soon, 2);
  state = saved(*whole);
  EXPECT_TRUE(state.values.contains("DeformationGradient"));
  auto const resumed = make_formulation(a);
  resumed->load(state);
  EXPECT_EQ(take_steps(*resumed, later, 5), take_steps(*whole, later, 5));
  EXPECT_EQ(saved(*resumed).values, saved(*whole).values);
}

/// A converted particle keeps a deformation gradient that is not read again. The gradient does not follow from
/// positions after further steps.
TEST(AdaptleDeletion, GoesOnFromACheckpointBetweenAConversionAndADeletionBitForBit) {
  ParticleSet set;
  for (double const start : {0.0, 3.0}) {
    ShapeSpec shape;
    shape.dimension = 2;
    shape.min[0] = start;
    shape.max = {start + 1, 1, 0};
    shape.particles = {9, 9, 1};
    fill(shape, start > 0 ? "deletes" : "converts", set);
  }
  Assembly a = adaptle_assembly(std::move(set), damaging());
  a.formulations[1].words.insert_or_assign("description", "total_lagrangian");
  a.formulations[1].words.insert_or_assign("failed", "delete");
  give_velocity(a, [](Point const& X) { return Point{200 * X[0] * X[1], -100 * X[1], 0}; });
  auto const whole = make_formulation(a);
  auto const fails = [&](std::size_t particle) {
    SavedState state = saved(*whole);
    state.values["Damage"][particle] = 1;
    whole->load(state);
  };
  double const first = take_steps(*whole, 0, 3);
  fails(40);
  double const second = take_steps(*whole, first, 2);
  ASSERT_GT(largest(saved(*whole).values["KernelType"]), 0);
  fails(81 + 40);
  SavedState state = saved(*whole);
  EXPECT_FALSE(state.values.contains("DeformationGradient"));
  auto const resumed = make_formulation(a);
  resumed->load(state);
  EXPECT_EQ(take_steps(*resumed, second, 5), take_steps(*whole, second, 5));
  EXPECT_TRUE(saved(*whole).values.contains("DeformationGradient"));
  EXPECT_EQ(saved(*resumed).values, saved(*whole).values);
}

TEST(AdaptleDeletion, KeepsMomentumAndEnergyOfTheRest) {
  Assembly a = adaptle_assembly(unit_box(2, 11, 0.1), damaging());
  choose(a, "description", "total_lagrangian");
  choose(a, "failed", "delete");
  Cloud cloud(a);
  shake_up(cloud, 2, 0.004);
  cloud.state[60].damage = cloud.state[61].damage = 1;
  cloud.evaluate();
  cloud.evaluate();
  double force[2]{}, forces = 0, power = 0, powers = 0;
  for (Index i = 0; i < cloud.size(); ++i) {
    power += cloud.state[i].energy_rate;
    for (int c = 0; c < 2; ++c) {
      force[c] += cloud.sums(i).force[c];
      forces += std::fabs(cloud.sums(i).force[c]);
      power += cloud.sums(i).force[c] * cloud.half(i).v[c];
      powers += std::fabs(cloud.sums(i).force[c] * cloud.half(i).v[c]);
    }
  }
  EXPECT_EQ(cloud.sums(60).force[0], 0);
  EXPECT_LT(std::hypot(force[0], force[1]), 1e-14 * forces);
  EXPECT_LT(std::fabs(power), 1e-14 * powers);
}

}  // namespace
}  // namespace piola
