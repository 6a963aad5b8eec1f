// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/step_bound.hpp"
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

// The search names a particle only if its step is the one that the loops have found.
void expect_a_particle(Assembly a, std::string const& backend) {
  a.backend = backend;
  Cloud cloud(a);
  shake_up(cloud, a.particles.dimension, 0.02);
  cloud.particles->step(0, 1e-9);
  StepBound const bound = adaptle::find_step_bound(*cloud.particles);
  EXPECT_EQ(bound.step, cloud.particles->stable_time_step());
  EXPECT_GE(bound.particle, 0) << backend << ": " << bound.text;
  EXPECT_LT(bound.particle, cloud.size());
}

TEST(AdaptleStepBound, IsTheStepThatTheLoopsFind) {
  for (std::string const& backend : adaptle_machines())
    for (int const dimension : {2, 3})
      for (std::string const description : {"eulerian", "adaptive", "total_lagrangian"})
        for (std::string const correction : {"none", "mixed"}) {
          Assembly a = adaptle_assembly(unit_box(dimension, 5));
          choose(a, "description", description);
          choose(a, "correction", correction);
          expect_a_particle(a, backend);
          if (dimension == 3) continue;
          choose(a, "assumption", "plane_stress");
          expect_a_particle(a, backend);
        }
}

StepBound after_a_step(Assembly const& a) {
  auto const f = make_formulation(a);
  f->step(0, 1e-9);
  return f->observables().step_bound();
}

TEST(AdaptleStepBound, NamesWaves) {
  StepBound const bound = after_a_step(adaptle_assembly(unit_box(3, 4)));
  EXPECT_EQ(bound.text.find("waves: run.cfl h / c"), 0U) << bound.text;
  EXPECT_EQ(bound.particle, 0) << "the first of equal ones";
}

/// A body of which shear has made a fifth of the height. The step of a body with the default damping, and the text.
StepBound bound_of_a_flattened_body(std::string const& key = "beta", double number = 2, double poisson = 0.3) {
  Assembly a = adaptle_assembly(unit_box(2, 6), material("elastic", 1000, 1e9, poisson));
  choose(a, "description", "total_lagrangian");
  if (key == "cfl")
    a.cfl = number;
  else
    choose(a, key, number);
  displace(a, [](Point const& X) { return Point{4 * X[0], -0.8 * X[1], 0}; });
  return after_a_step(a);
}

/// Viscosity acts with 0.05 of its strength on bodies at rest: 0.6 - 0.05 (0.6 - 0.3).
TEST(AdaptleStepBound, IsLongerWhereShearHasCompressedBodiesThatStayTotalLagrangian) {
  StepBound const longer = bound_of_a_flattened_body();
  EXPECT_NE(longer.text.find("run.cfl = 0.3, raised to 0.585 in shear, lengths compressed to 0.2 of"),
            std::string::npos)
      << longer.text;
  for (std::string const key : {"alpha", "hourglass", "hourglass_stiffness"}) {
    StepBound const usual = bound_of_a_flattened_body(key, 1.5);
    EXPECT_NEAR(longer.step, 1.95 * usual.step, 1e-3 * usual.step) << key;
    EXPECT_EQ(usual.text.find("raised"), std::string::npos) << usual.text;
  }
  EXPECT_EQ(bound_of_a_flattened_body("beta", 2, -0.1).text.find("raised"), std::string::npos);
  EXPECT_NEAR(bound_of_a_flattened_body("cfl", 0.15).step, longer.step / 2, 1e-3 * longer.step);
  EXPECT_NEAR(bound_of_a_flattened_body("cfl", 0.6).step, longer.step * 0.6 / 0.585, 1e-3 * longer.step);
}

TEST(AdaptleStepBound, NamesTheCompressedLengthOfWaves) {
  Assembly a = adaptle_assembly(unit_box(3, 4));
  choose(a, "description", "adaptive");
  double const at_rest = after_a_step(a).step;
  for (Point const& X : a.particles.X) a.initial_displacement.push_back({-0.5 * X[0], 0, 0});
  StepBound const bound = after_a_step(a);
  EXPECT_NE(bound.text.find("compressed to 0.5 of"), std::string::npos) << bound.text;
  EXPECT_LT(bound.step, 0.55 * at_rest);
}

TEST(AdaptleStepBound, NamesAcceleration) {
  Assembly a = adaptle_assembly(unit_box(3, 4));
  load(a, {"1e9", "0", "0"}, [](Point const& X) { return X[0] > 0.7; });
  StepBound const bound = after_a_step(a);
  EXPECT_EQ(bound.text.find("acceleration"), 0U) << bound.text;
  ASSERT_GE(bound.particle, 0);
  EXPECT_GT(a.particles.X[static_cast<std::size_t>(bound.particle)][0], 0.7);
}

TEST(AdaptleStepBound, NamesTheChangeOfVolume) {
  Assembly a = adaptle_assembly(unit_box(2, 4));
  give_velocity(a, [](Point const& X) { return Point{1e5 * X[0], 0, 0}; });
  StepBound const bound = after_a_step(a);
  EXPECT_EQ(bound.text.find("the change of volume"), 0U) << bound.text;
  EXPECT_NEAR(bound.step, 0.05 / 1e5, 0.02 * bound.step);
}

TEST(AdaptleStepBound, NamesTheApproachOfAnotherBody) {
  ParticleSet set = unit_box(2, 4);
  ParticleSet const other = set;
  Body body = other.bodies[0];
  body.name = "other";
  body.first = set.size();
  body.last = 2 * set.size();
  set.bodies.push_back(body);
  for (std::size_t k = 0; k < other.X.size(); ++k) {
    set.X.push_back({other.X[k][0] + 1.1, other.X[k][1], 0});
    set.lattice_index.push_back(other.lattice_index[k]);
    set.volume.push_back(other.volume[k]);
    set.kernel_volume.push_back(other.kernel_volume[k]);
    set.body.push_back(1);
  }
  Assembly a = adaptle_assembly(set);
  give_velocity(a, [](Point const& X) { return Point{X[0] > 1.05 ? -1e5 : 0, 0, 0}; });
  StepBound const bound = after_a_step(a);
  EXPECT_EQ(bound.text.find("the approach of another body"), 0U) << bound.text;
}

}  // namespace
}  // namespace piola
