// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/solver.hpp"
#include "piola/base/errors.hpp"
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include <limits>

namespace piola {
namespace {

using namespace testing;

// ---- rest

class TaylorBodyAtRest : public ::testing::TestWithParam<std::tuple<int, double, std::string>> {};

TEST_P(TaylorBodyAtRest, StaysAtRest) {
  auto const& [D, jitter, configuration] = GetParam();
  Assembly a = assemble_taylor(unit_box(D, 6, jitter));
  choose(a, "configuration", configuration);
  auto const f = make_formulation(a);
  run(*f, 10);
  auto const n = a.particles.X.size();
  for (auto const* field : {"Velocity", "Displacement", "CauchyStress"}) EXPECT_EQ(largest(sample(*f, field, n)), 0);
  Values const x = sample(*f, "Position", n), J = sample(*f, "Jacobian", n), rho = sample(*f, "Density", n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(x[3 * k + c], a.particles.X[k][c]);
    EXPECT_EQ(J[k], 1);
    EXPECT_EQ(rho[k], density);
  }
  EXPECT_EQ(f->diagnose().total_energy(), 0);
  EXPECT_FALSE(f->failure().has_value());
}

INSTANTIATE_TEST_SUITE_P(All, TaylorBodyAtRest,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Values(0.0, 0.2),
                                            ::testing::Values("updated", "fixed")));

TEST(TaylorBodyInUniformMotion, KeepsItsVelocityAndHasNoStress) {
  for (int D = 1; D <= 3; ++D) {
    Assembly a = assemble_taylor(unit_box(D, 6, 0.2));
    give_velocity(a, [&](Point const&) { return Point{3, D > 1 ? -2.0 : 0, D > 2 ? 1.0 : 0}; });
    auto const f = make_formulation(a);
    double const time = run(*f, 10);
    auto const n = a.particles.X.size();
    Values const v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(v[3 * k + c], a.initial_velocity[k][c], 1e-13);
        EXPECT_NEAR(u[3 * k + c], time * a.initial_velocity[k][c], 1e-13);
      }
    EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-12 * youngs_modulus);
  }
}

// ---- checkpoints

/// A plate whose edges are driven in simple shear, with a superposed wave. The motion rebuilds neighbour lists, and
/// later the triangulation.
Assembly sheared_plate(int n, double rate) {
  Assembly a = assemble_taylor(unit_box(2, n));
  choose(a, "virtual_particles", "delaunay");
  std::string const along = std::to_string(rate) + "*Y";
  drive(a, {true, true, false}, {along, "0", "0"}, [](Point const& X) { return is_on_edge(X, 2); });
  give_velocity(a, [&](Point const& X) {
    // The superposed wave makes stress and velocity non-uniform.
    return Point{rate * X[1], is_on_edge(X, 2) ? 0 : 0.1 * std::sin(3 * X[0]) * std::sin(3 * X[1]), 0};
  });
  return a;
}

void expect_the_same_continuation(Assembly const& a, int before, int after) {
  auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
  run(*whole, before + after);
  double const time = run(*first, before);
  SavedState checkpoint = saved(*first);
  second->load(checkpoint);
  EXPECT_EQ(second->stable_time_step(), first->stable_time_step());
  EXPECT_EQ(second->diagnose().stabilisation_loss, first->diagnose().stabilisation_loss);
  EXPECT_EQ(second->diagnose().external_work, first->diagnose().external_work);
  run(*second, after, time);
  SavedState const expected = saved(*whole), found = saved(*second);
  for (auto const& [name, values] : expected.values) EXPECT_EQ(values, found.values.at(name)) << name;
  EXPECT_FALSE(whole->failure().has_value());
}

class TaylorCheckpoint : public ::testing::TestWithParam<std::tuple<int, double, std::string>> {};

TEST_P(TaylorCheckpoint, ContinuesWithTheSameBits) {
  auto const& [D, jitter, backend] = GetParam();
  Assembly a = busy_body(D, D == 1 ? 21 : D == 2 ? 8 : 5, jitter);
  support(a, {true, false, true}, [](Point const& X) { return X[0] < 1e-9; });
  load(a, {"1 + t", "0", "0"}, everywhere);
  a.backend = backend;
  expect_the_same_continuation(a, 4, 5);
}

INSTANTIATE_TEST_SUITE_P(All, TaylorCheckpoint,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Values(0.0, 0.2),
                                            ::testing::ValuesIn(backends())));

/// Lists are rebuilt before and after each checkpoint, so their state must be restored.
TEST(TaylorCheckpoint, ContinuesWithTheSameBitsThroughNewLists) {
  Assembly const a = sheared_plate(8, 5);
  auto const f = make_formulation(a);
  double const time = run(*f, 12);
  double const updates = more(*f, "list_updates");
  EXPECT_GE(updates, 1);
  run(*f, 12, time);
  EXPECT_GT(more(*f, "list_updates"), updates);
  for (int before : {9, 11, 12, 13}) expect_the_same_continuation(a, before, 24 - before);
}

TEST(TaylorCheckpoint, ContinuesWithTheSameBitsThroughANewTriangulation) {
  Assembly const a = sheared_plate(8, 5);
  auto const f = make_formulation(a);
  double time = 0;
  int steps = 0;
  for (; more(*f, "triangulations") == 0 && steps < 120; ++steps) time = run(*f, 1, time);
  ASSERT_EQ(more(*f, "triangulations"), 1);
  ASSERT_FALSE(f->failure().has_value());
  for (int const before : {steps - 3, steps, steps + 2}) expect_the_same_continuation(a, before, steps + 5 - before);
}

TEST(TaylorCheckpoint, IsInTheOrderOfIds) {
  Assembly const a = busy_body(3, 5);
  SavedState const s = saved(*make_formulation(a));
  Values const& x = s.values.at("body0_position");
  for (std::size_t k = 0; k < a.particles.X.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(x[3 * k + c], a.particles.X[k][c]);
}

TEST(TaylorCheckpoint, OfOneMachineContinuesOnAnother) {
  Assembly a = busy_body(3, 5);
  a.backend = backends().front();
  auto const first = make_formulation(a);
  run(*first, 5);
  SavedState s = saved(*first);
  a.backend = backends().back();
  auto const second = make_formulation(a);
  second->load(s);
  EXPECT_EQ(whole_state(*first), whole_state(*second));
}

// ---- large shear

TEST(TaylorSolver, RefusesACheckpointWithCellsOfParticlesThatAreNotThere) {
  Assembly const a = assemble_taylor(unit_box(2, 5));
  auto const f = make_formulation(a);
  SavedState const good = saved(*f);
  for (double const bad : {25.0, -1.0, 0.5, std::numeric_limits<double>::quiet_NaN()}) {
    SavedState cells = good, count = good;
    cells.values.at("body0_cells").at(3) = bad;
    EXPECT_THROW(f->load(cells), FileError) << bad;
    count.values.at("body0_cell_corners").at(0) = bad > 1 ? 1e300 : bad;
    EXPECT_THROW(f->load(count), FileError) << bad;
  }
  SavedState again = good;
  EXPECT_NO_THROW(f->load(again));
}

/// Uniform simple shear is a solution: the stress is that of Jaumann's rate, through all triangulations,
///   s12 = G sin(g), s11 = -s22 = G (1 - cos(g)) for a shear g.
TEST(SimpleShear, HasTheStressOfJaumannsRateThroughNewTriangulations) {
  Assembly a = assemble_taylor(unit_box(2, 7));
  choose(a, "virtual_particles", "delaunay");
  double const rate = 5;
  drive(a, {true, true, false}, {"5*Y", "0", "0"}, [](Point const& X) { return is_on_edge(X, 2); });
  give_velocity(a, [&](Point const& X) { return Point{rate * X[1], 0, 0}; });
  a.cfl = 0.5;
  auto const f = make_formulation(a);
  double time = 0;
  while (time * rate < 1.6) time = run(*f, 1, time);
  EXPECT_GE(more(*f, "triangulations"), 1);
  EXPECT_FALSE(f->failure().has_value());
  auto const n = a.particles.X.size();
  Values const s = sample(*f, "CauchyStress", n), u = sample(*f, "Displacement", n), J = sample(*f, "Jacobian", n);
  double const G = Moduli(2).mu, g = rate * time;
  for (std::size_t k = 0; k < n; ++k) {
    EXPECT_NEAR(s[6 * k], G * (1 - std::cos(g)), 1e-3 * G);
    EXPECT_NEAR(s[6 * k + 1], -G * (1 - std::cos(g)), 1e-3 * G);
    EXPECT_NEAR(s[6 * k + 3], G * std::sin(g), 1e-3 * G);
    EXPECT_NEAR(u[3 * k], g * a.particles.X[k][1], 1e-11);
    EXPECT_NEAR(u[3 * k + 1], 0, 1e-11);
    EXPECT_NEAR(J[k], 1, 1e-11);
  }
}

// ---- time step

TEST(TaylorTimeStep, IsTheCourantNumberTimesSpacingOverWaveSpeed) {
  double const nu = 0.3, E = youngs_modulus;
  struct Row {
    int dimension;
    std::string assumption;
    double modulus;
  };
  double const strain = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu)), thin = E / (1 - nu * nu);
  for (auto const& [D, assumption, modulus] :
       {Row{1, "uniaxial_stress", E}, Row{1, "uniaxial_strain", strain}, Row{2, "plane_strain", strain},
        Row{2, "plane_stress", thin}, Row{3, "as_dimension", strain}}) {
    Assembly a = assemble_taylor(unit_box(D, 6));
    choose(a, "assumption", assumption);
    choose(a, "virtual_particles", "lattice_cells");
    double const dt = 0.2 / std::sqrt(modulus / density);
    EXPECT_NEAR(make_formulation(a)->stable_time_step(), 0.9 * dt, 1e-12 * dt) << assumption;
    a.cfl = 0.4;
    EXPECT_NEAR(make_formulation(a)->stable_time_step(), 0.4 * dt, 1e-12 * dt) << assumption;
  }
}

TEST(TaylorTimeStep, EndsWhereASupportOrALoadDoes) {
  Assembly a = assemble_taylor(unit_box(1, 11));
  drive(a, {true, false, false}, {"1", "0", "0"}, [](Point const& X) { return X[0] < 1e-9; }).until = 0.0213;
  auto const f = make_formulation(a);
  double time = 0;
  for (int k = 0; k < 3; ++k) time = run(*f, 1, time);
  EXPECT_NEAR(time, 0.0213, 1e-12);  // steps of at most 9 ms
  run(*f, 1, time);
  EXPECT_NEAR(f->stable_time_step(), f->step_estimate().stable, 0);
}

// ---- failure

TEST(TaylorFailure, OfNumbersThatAreNotNumbersIsReported) {
  for (int D = 1; D <= 3; ++D) {
    Assembly a = assemble_taylor(unit_box(D, 5));
    a.initial_velocity.assign(a.particles.X.size(), {0, 0, 0});
    auto const bad = a.particles.X.size() / 2;
    a.initial_velocity[bad][0] = std::nan("");
    auto const f = make_formulation(a);
    f->step(0, 1e-6);
    auto const failure = f->failure();
    ASSERT_TRUE(failure.has_value());
    EXPECT_EQ(failure->what, "has a velocity or stress that is not a number");
    EXPECT_EQ(failure->body, "box");
    EXPECT_EQ(failure->X, a.particles.X[static_cast<std::size_t>(failure->particle)]);
  }
}

TEST(TaylorFailure, OfACellTurnedInsideOutIsReported) {
  Assembly a = assemble_taylor(unit_box(2, 5));
  give_velocity(a, [](Point const& X) { return Point{-1500 * X[0], 0, 0}; });
  auto const f = make_formulation(a);
  EXPECT_FALSE(f->failure().has_value());
  f->step(0, 1e-3);
  auto const failure = f->failure();
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->what, "is at a cell that is turned inside out, crushed or torn");
}

/// A particle with an extreme velocity ends the run within 30 steps, with a reported failure.
TEST(TaylorFailure, OfAParticleThatFliesOffIsReported) {
  for (double const speed : {1e6, 1e20, 1e30, 1e300, std::numeric_limits<double>::infinity(), std::nan("")})
    for (auto const* cells : {"lattice_cells", "delaunay"}) {
      Assembly a = assemble_taylor(unit_box(2, 5));
      choose(a, "virtual_particles", cells);
      a.initial_velocity.assign(a.particles.X.size(), {0, 0, 0});
      a.initial_velocity[7] = {speed, 0.5 * speed, 0};
      auto const f = make_formulation(a);
      for (int k = 0; k < 30 && !f->failure(); ++k) f->step(1e-3 * k, 1e-3);
      EXPECT_TRUE(f->failure()) << speed << " " << cells;
    }
}

/// The rim of a disc that turns fast creeps away until a new triangulation leaves a particle without a cell.
TEST(TaylorFailure, OfABodyThatComesApartIsReported) {
  ShapeSpec shape;
  shape.kind = ShapeSpec::Kind::sphere;
  shape.dimension = 2;
  shape.radius = 0.5;
  shape.spacing = 0.1;
  ParticleSet set;
  set.dimension = 2;
  fill(shape, "disc", set);
  Assembly a = assemble_taylor(std::move(set), material("linear_elastic", 1000, 1e6, 0.3));
  choose(a, "configuration", "updated");
  choose(a, "exchange", "kernel_sums");
  give_velocity(a, [](Point const& X) { return Point{-30 * X[1], 30 * X[0], 0}; });
  auto const f = make_formulation(a);
  double parted = 0, time = 0;
  int steps = 0;
  for (; steps < 400 && !f->failure(); ++steps) {
    if (steps == 5) parted = more(*f, "strain_drift");
    time = run(*f, 1, time);
  }
  ASSERT_TRUE(f->failure());
  EXPECT_EQ(f->failure()->what, "has no cell left around it");
  EXPECT_GT(more(*f, "strain_drift"), 0.2) << "long before, positions and stress have parted";
  EXPECT_LT(parted, 0.2);
}

// ---- several bodies

TEST(TaylorTwoBodies, MoveAsEachWouldAlone) {
  ParticleSet set = unit_box(2, 6), alone = unit_box(2, 6);
  ShapeSpec shape;
  shape.dimension = 2;
  shape.min = {3, 0, 0};
  shape.max = {4, 1, 0};
  shape.particles = {9, 9, 1};
  fill(shape, "second", set);
  auto const motion = [](Point const& X) { return Point{0.5 * X[1], 0.3 * X[0] * X[1], 0}; };
  Assembly both = assemble_taylor(set), one = assemble_taylor(alone);
  both.materials[1] = soft(0.45);
  choose(one, "kernel", "wendland_c2");
  both.formulations[0].words["kernel"] = "wendland_c2";
  give_velocity(both, motion);
  give_velocity(one, motion);
  for (Assembly* a : {&both, &one}) {
    drive(*a, {true, true, false}, {"0.1*t", "0", "0"}, [](Point const& X) { return X[0] < 1e-9; });
    Load& pull = load(*a, {"100", "0", "0"}, [](Point const& X) { return std::fabs(X[0] - 1) < 1e-9; });
    pull.normal = std::array<double, 3>{1, 0, 0};
  }
  auto const f = make_formulation(both), g = make_formulation(one);
  advance(*f, 1e-3, 10);
  advance(*g, 1e-3, 10);
  for (auto const* name : {"body0_velocity", "body0_stress", "body0_position"})
    EXPECT_EQ(saved(*f).values.at(name), saved(*g).values.at(name));
  EXPECT_LT(f->stable_time_step(), g->stable_time_step());
  Values const body = sample(*f, "Body", set.X.size()), id = sample(*f, "Id", set.X.size());
  for (std::size_t k = 0; k < set.X.size(); ++k) {
    EXPECT_EQ(body[k], k < 36 ? 0 : 1);
    EXPECT_EQ(id[k], static_cast<double>(k));
  }
}

TEST(TaylorSolver, KnowsItsStagesMemoryAndCosts) {
  auto const f = make_formulation(assemble_taylor(unit_box(3, 7)));
  EXPECT_EQ(f->statistics().stages_per_step, 2);
  EXPECT_GT(f->statistics().memory_bytes, 343 * (3 + 3 + 6) * 8U);
  ASSERT_EQ(f->statistics().seconds.size(), 2u);
  EXPECT_EQ(f->statistics().seconds[1].first, "neighbour_lists");
  EXPECT_GT(f->statistics().seconds[1].second, 0);
}

}  // namespace
}  // namespace piola
