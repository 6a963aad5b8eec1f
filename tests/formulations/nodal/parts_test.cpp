// SPDX-License-Identifier: Apache-2.0
// Bodies of several materials.
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

/// Particles beyond a plane, and beyond a second one, are of other materials. Their numbers are no multiples of any
/// lane count, so that groups of lanes hold two materials.
Assembly layered(int dimension, double jitter = 0.1) {
  Assembly a = nodal_body(brick(dimension, jitter, {5, 5, 6}));
  std::vector<int>& part = a.particles.part.own();
  for (auto const& X : a.particles.X.seen()) part.push_back(X[0] > 0.5 ? 2 : X[0] > 0.1 ? 1 : 0);
  a.parts = {{material("linear_elastic", 2000, 4e7, 0.3), material("neo_hookean", 500, 3e6, 0.1)}};
  give_velocity(a, [&](Point const& X) {
    return Point{2 * X[0] * X[0], dimension > 1 ? std::sin(3 * X[0]) : 0, dimension > 2 ? X[0] * X[1] : 0};
  });
  return a;
}

Values moved(Assembly const& a) {
  auto const f = make_formulation(a);
  advance(*f, 1e-4, 12);
  EXPECT_FALSE(f->failure().has_value());
  return sample(*f, "Position", a.particles.X.size());
}

class NodalParts : public ::testing::TestWithParam<int> {};

TEST_P(NodalParts, OfOneMaterialAreNoParts) {
  Assembly parts = layered(GetParam());
  parts.parts[0].assign(2, parts.materials[0]);
  Assembly whole = parts;
  whole.particles.part.clear();
  whole.parts.clear();
  EXPECT_LT(largest_difference(moved(parts), moved(whole)), 1e-12);
}

TEST_P(NodalParts, AreTheSameOnEveryMachine) {
  Assembly a = layered(GetParam());
  auto const best = moved(a);
  for (auto const& name : backends()) {
    a.backend = name;
    EXPECT_LT(largest_difference(moved(a), best), 1e-12) << name;
  }
}

TEST_P(NodalParts, HaveTheSameBitsOnThreads) {
  Assembly const a = layered(GetParam());
  Threads const one(1);
  auto const alone = moved(a);
  Threads const three(3);
  EXPECT_EQ(moved(a), alone);
}

TEST_P(NodalParts, FeelMinusTheDerivativeOfTheEnergy) {
  Assembly a = layered(GetParam());
  a.initial_velocity.clear();
  displace(a, [&](Point const& X) {
    return Point{0.05 * X[0] * X[0], GetParam() > 1 ? 0.1 * X[0] * X[1] : 0, GetParam() > 2 ? 0.05 * X[0] : 0};
  });
  a.cfl = 0.1;
  auto const force = forces(a);
  constexpr double step = 1e-5;
  for (std::size_t const id : {std::size_t{1}, a.particles.X.size() / 2, a.particles.X.size() - 2}) {
    double& u = a.initial_displacement[id][0];
    double const before = u;
    u = before + step;
    double const above = make_formulation(a)->diagnose().strain_energy;
    u = before - step;
    double const below = make_formulation(a)->diagnose().strain_energy;
    u = before;
    EXPECT_NEAR(force[id][0], (below - above) / (2 * step), 1e-6 * largest(force)) << id;
  }
}

TEST_P(NodalParts, HaveTheirOwnDensities) {
  Assembly a = layered(GetParam(), 0);
  give_velocity(a, [](Point const&) { return Point{1, 0, 0}; });
  double mass = 0;
  for (std::size_t i = 0; i < a.particles.X.size(); ++i)
    mass += a.particles.volume[i] * materials_of(a, 0)[part_of(a.particles, i)].value[0];
  EXPECT_NEAR(make_formulation(a)->diagnose().linear_momentum[0], mass, 1e-12 * mass);
}

TEST_P(NodalParts, KeepMomentumAndEnergy) {
  Assembly const a = layered(GetParam());
  auto const f = make_formulation(a);
  auto const before = f->diagnose();
  advance(*f, 0.25 * f->step_estimate().stable, 400);
  auto const after = f->diagnose();
  EXPECT_GT(after.strain_energy, 1e-3 * before.total_energy());
  EXPECT_NEAR(after.total_energy(), before.total_energy(), 1e-3 * before.total_energy());
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(after.linear_momentum[c], before.linear_momentum[c], 1e-11 * std::fabs(before.linear_momentum[0]));
}

INSTANTIATE_TEST_SUITE_P(Dimensions, NodalParts, ::testing::Values(1, 2, 3));

TEST(NodalPartsRefused, WithViscosity) {
  Assembly a = layered(3);
  choose(a, "shock_viscosity", 1);
  EXPECT_NE(refusal(a).find("are those of one material"), std::string::npos) << refusal(a);
}

TEST(PartsRefused, ByFormulationsWithoutThem) {
  Assembly a = layered(3);
  for (auto& f : a.formulations) f.name = "jst_sph";
  EXPECT_NE(refusal(a).find("knows no parts (allowed: parts in nodal)"), std::string::npos) << refusal(a);
}

}  // namespace
}  // namespace piola::testing
