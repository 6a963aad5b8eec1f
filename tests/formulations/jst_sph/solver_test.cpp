// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/solver.hpp"
#include "piola/base/errors.hpp"
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

/// Everything that a checkpoint holds, in a row.
Values state(Formulation const& f) {
  Values all;
  for (auto const& [name, values] : saved(f).values) all.insert(all.end(), values.begin(), values.end());
  return all;
}

// ---- state

class Checkpoint : public ::testing::TestWithParam<std::tuple<std::string, std::string, double>> {};

TEST_P(Checkpoint, ContinuesWithTheSameBits) {
  auto const& [backend, variables, jitter] = GetParam();
  Assembly a = tumbling_box(3, 5, jitter);
  a.backend = backend;
  choose(a, "variables", variables);
  support(a, {true, false, true}, [](Point const& X) { return X[1] < 1e-9; });
  auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
  auto const run = [](Formulation& f, int steps) {
    for (int k = 0; k < steps; ++k) f.step(0, f.stable_time_step());
  };
  run(*whole, 9);
  run(*first, 4);
  SavedState checkpoint = saved(*first);
  second->load(checkpoint);
  EXPECT_EQ(second->stable_time_step(), first->stable_time_step());
  EXPECT_EQ(second->diagnose().stabilisation_loss, first->diagnose().stabilisation_loss);
  run(*second, 5);
  EXPECT_EQ(state(*whole), state(*second));
}

INSTANTIATE_TEST_SUITE_P(All, Checkpoint,
                         ::testing::Combine(::testing::ValuesIn(backends()), ::testing::Values("pF", "displacement"),
                                            ::testing::Values(0.0, 0.2)));

TEST(Checkpoint, IsInTheOrderOfIds) {
  Assembly const a = tumbling_box(3, 5);
  auto const f = make_formulation(a);
  SavedState const s = saved(*f);
  Values const& x = s.values.at("body0_position");
  for (std::size_t k = 0; k < a.particles.X.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(x[3 * k + c], a.particles.X[k][c]);
}

TEST(Checkpoint, OfOneMachineContinuesOnAnother) {
  Assembly a = tumbling_box(3, 5);
  a.backend = backends().front();
  auto const first = make_formulation(a);
  advance(*first, 1e-4, 3);
  SavedState s = saved(*first);
  a.backend = backends().back();
  auto const second = make_formulation(a);
  second->load(s);
  EXPECT_EQ(state(*first), state(*second));
}

// ---- supports

class HeldParticles : public ::testing::TestWithParam<std::tuple<std::string, std::string>> {};

TEST_P(HeldParticles, NeverMoveInTheDirectionsThatAreHeld) {
  auto const& [scheme, variables] = GetParam();
  Assembly a = tumbling_box(3, 5);
  choose(a, "scheme", scheme);
  choose(a, "variables", variables);
  auto const bottom = [](Point const& X) { return X[1] < 1e-9; };
  auto const left = [](Point const& X) { return X[0] < 1e-9; };
  support(a, {true, true, true}, bottom);
  support(a, {true, false, false}, left);
  auto const f = make_formulation(a);
  advance(*f, f->stable_time_step(), 30);
  auto const n = a.particles.X.size();
  Values const x = sample(*f, "Position", n), v = sample(*f, "Velocity", n);
  double slid = 0;
  for (std::size_t k = 0; k < n; ++k) {
    Point const& X = a.particles.X[k];
    for (std::size_t c = 0; c < 3; ++c)
      if (bottom(X) || (left(X) && c == 0)) {
        EXPECT_EQ(x[3 * k + c], X[c]);
        EXPECT_EQ(v[3 * k + c], 0);
      }
    if (left(X) && !bottom(X)) slid = std::max(slid, std::fabs(x[3 * k + 1] - X[1]));
  }
  EXPECT_GT(slid, 1e-3);  // rollers let them go along the face
  EXPECT_FALSE(f->failure().has_value());
}

INSTANTIATE_TEST_SUITE_P(All, HeldParticles,
                         ::testing::Combine(::testing::Values("filtered", "paper"),
                                            ::testing::Values("pF", "displacement")));

TEST(HeldParticles, StayWhereTheInitialDisplacementPutThem) {
  Assembly a = assemble(unit_box(2, 5));
  displace(a, [](Point const& X) { return Point{0.1 * X[1], 0, 0}; });
  support(a, {true, true, false}, [](Point const& X) { return X[1] > 1 - 1e-9; });
  auto const f = make_formulation(a);
  advance(*f, f->stable_time_step(), 10);
  Values const u = sample(*f, "Displacement", a.particles.X.size());
  for (std::size_t k = 0; k < a.particles.X.size(); ++k)
    if (a.particles.X[k][1] > 1 - 1e-9) {
      EXPECT_NEAR(u[3 * k], 0.1, 1e-15);
    }
}

TEST(HeldParticles, LoseTheVelocityTheyWereGiven) {
  Assembly a = assemble(unit_box(2, 5));
  give_velocity(a, [](Point const&) { return Point{1, 2, 0}; });
  support(a, {false, true, false}, [](Point const&) { return true; });
  Values const v = sample(*make_formulation(a), "Velocity", a.particles.X.size());
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    EXPECT_EQ(v[3 * k], 1);
    EXPECT_EQ(v[3 * k + 1], 0);
  }
}

// ---- time step

TEST(StableTimeStep, IsTheCourantNumberTimesSpacingOverWaveSpeed) {
  Assembly a = assemble(testing::box({1, 0.4, 0.6}, {11, 5, 4}));  // spacings 0.1, 0.1, 0.2
  double const lambda_2mu = 17e6 * 0.7 / (1.3 * 0.4);              // E (1 - nu) / ((1 + nu)(1 - 2 nu))
  double const c = std::sqrt(lambda_2mu / 1100);
  EXPECT_NEAR(make_formulation(a)->stable_time_step(), 0.3 * 0.1 / c, 1e-12 / c);  // eq. (44); 0.3 is the default
  a.cfl = 0.15;
  EXPECT_NEAR(make_formulation(a)->stable_time_step(), 0.15 * 0.1 / c, 1e-12 / c);
  displace(a, [](Point const& X) { return Point{0, 0, -0.5 * X[2]}; });  // smallest stretch 1/2
  EXPECT_NEAR(make_formulation(a)->stable_time_step(), 0.5 * 0.15 * 0.1 / c, 1e-12 / c);
}

TEST(StableTimeStep, FollowsTheDeformationOfTheLastStep) {
  Assembly a = assemble(unit_box(3, 5));
  give_velocity(a, [](Point const& X) { return Point{0, -100 * X[1], 0}; });
  auto const f = make_formulation(a);
  double const before = f->stable_time_step();
  f->step(0, 1e-3);  // stretch 0.9 along y
  EXPECT_NEAR(f->stable_time_step() / before, 0.9, 1e-9);
}

// ---- failure

class InvertedParticle : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(InvertedParticle, IsReportedWithItsNumberPlaceAndDeterminant) {
  auto const& [backend, jitter] = GetParam();
  Assembly a = assemble(unit_box(3, 5, jitter));
  a.backend = backend;
  std::int64_t const bad = 57;
  a.initial_deformation_gradient.assign(a.particles.X.size(), {1, 0, 0, 0, 1, 0, 0, 0, 1});
  auto const f = make_formulation(a);
  f->step(0, 1e-9);
  EXPECT_FALSE(f->failure().has_value());

  a.initial_deformation_gradient[static_cast<std::size_t>(bad)][0] = -0.1;
  auto const g = make_formulation(a);
  g->step(0, 1e-9);
  auto const failure = g->failure();
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->what, "is inverted");
  EXPECT_EQ(failure->particle, bad);
  EXPECT_EQ(failure->body, "box");
  EXPECT_EQ(failure->X, a.particles.X[static_cast<std::size_t>(bad)]);
  auto const value = [&](std::string const& name) {
    for (auto const& [key, number] : failure->values)
      if (key == name) return number;
    ADD_FAILURE() << "no value is named " << name;
    return 0.0;
  };
  EXPECT_NEAR(value("det F"), -0.1, 1e-6);
  EXPECT_GT(value("neighbours"), 6);
  EXPECT_TRUE(std::isfinite(value("wave speed [m/s]")));
}

TEST_P(InvertedParticle, IsReportedForAnyNumberOfThreadsAsTheSameOne) {
  auto const& [backend, jitter] = GetParam();
  Assembly a = assemble(unit_box(3, 7, jitter));
  a.backend = backend;
  a.initial_deformation_gradient.assign(a.particles.X.size(), {-0.1, 0, 0, 0, 1, 0, 0, 0, 1});
  std::int64_t first = -1;
  for (int const threads : {1, 2, 3, 7}) {
    Threads const keep(threads);
    auto const f = make_formulation(a);
    f->step(0, 1e-9);
    ASSERT_TRUE(f->failure().has_value());
    if (first < 0) first = f->failure()->particle;
    EXPECT_EQ(f->failure()->particle, first);
  }
}

INSTANTIATE_TEST_SUITE_P(All, InvertedParticle,
                         ::testing::Combine(::testing::ValuesIn(backends()), ::testing::Values(0.0, 0.2)));

TEST(Failure, OfNumbersThatAreNotNumbersIsReported) {
  Assembly a = assemble(unit_box(3, 5));
  a.initial_velocity.assign(a.particles.X.size(), {0, 0, 0});
  a.initial_velocity[60][1] = std::nan("");
  auto const f = make_formulation(a);
  f->step(0, 1e-6);
  ASSERT_TRUE(f->failure().has_value());
  EXPECT_EQ(f->failure()->what, "has a deformation that is not a number");
}

// ---- several bodies

TEST(TwoBodies, MoveAsEachWouldAlone) {
  ParticleSet set = unit_box(2, 6);
  ShapeSpec shape;
  shape.dimension = 2;
  shape.min = {3, 0, 0};
  shape.max = {4, 1, 0};
  shape.particles = {9, 9, 1};
  ParticleSet alone = unit_box(2, 6);
  fill(shape, "second", set);
  auto const motion = [](Point const& X) { return Point{5 * X[1], 3 * X[0] * X[1], 0}; };
  Assembly both = assemble(set), one = assemble(alone);
  both.materials[1] = rubber("linear_elastic", 0.45);
  give_velocity(both, motion);
  give_velocity(one, motion);
  auto const f = make_formulation(both), g = make_formulation(one);
  advance(*f, 1e-4, 10);
  advance(*g, 1e-4, 10);
  EXPECT_EQ(saved(*f).values.at("body0_velocity"), saved(*g).values.at("body0_velocity"));
  EXPECT_LT(f->stable_time_step(), g->stable_time_step());
  Values const body = sample(*f, "Body", set.X.size()), id = sample(*f, "Id", set.X.size());
  for (std::size_t k = 0; k < set.X.size(); ++k) {
    EXPECT_EQ(body[k], k < 36 ? 0 : 1);
    EXPECT_EQ(id[k], static_cast<double>(k));
  }
}

// ---- what cannot be built

TEST(Solver, RefusesAMachineThatItDoesNotHaveAndNamesThoseItHas) {
  Assembly a = assemble(unit_box(2, 5));
  a.backend = "abacus";
  std::string const text = refusal(a);
  EXPECT_NE(text.find("'abacus'"), std::string::npos) << text;
  for (auto const& name : backends()) EXPECT_NE(text.find(name), std::string::npos) << text;
}

TEST(Solver, RefusesAFormulationThatDoesNotExist) {
  Assembly a = assemble(unit_box(2, 5));
  a.formulations[0].name = "alchemy";
  EXPECT_NE(refusal(a).find("'alchemy'"), std::string::npos);
}

TEST(Solver, RefusesABodyWithTooFewParticles) {
  EXPECT_NE(refusal(assemble(testing::box({1, 0.1, 0.1}, {11, 1, 1}))).find("too few"), std::string::npos);
}

TEST(Solver, KnowsItsStagesAndItsMemory) {
  auto const small = make_formulation(assemble(unit_box(3, 4))), large = make_formulation(assemble(unit_box(3, 9)));
  EXPECT_EQ(small->statistics().stages_per_step, 2);
  Assembly verlet = assemble(unit_box(3, 4));
  choose(verlet, "scheme", "filtered");
  EXPECT_EQ(make_formulation(verlet)->statistics().stages_per_step, 1);
  EXPECT_GT(large->statistics().memory_bytes, small->statistics().memory_bytes);
  // Where arrays start in their pages changes from one to the next; what they take does not.
  EXPECT_EQ(make_formulation(assemble(unit_box(3, 4)))->statistics().memory_bytes, small->statistics().memory_bytes);
  EXPECT_GT(small->statistics().memory_bytes, 64 * 3 * 8 * 3U);
}

}  // namespace
}  // namespace piola
