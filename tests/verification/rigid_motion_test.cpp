// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"
#include "math/random.hpp"

namespace piola {
namespace {

using namespace testing;

class RigidMotion : public ::testing::TestWithParam<std::tuple<int, double, std::string, std::string>> {
 protected:
  int const dimension = std::get<0>(GetParam());
  Assembly assembly() const {
    Assembly a = assemble(unit_box(dimension, dimension == 3 ? 5 : 7, std::get<1>(GetParam())));
    choose(a, "scheme", std::get<2>(GetParam()));
    choose(a, "variables", std::get<3>(GetParam()));
    return a;
  }
};

/// Stiffness of the rubber [Pa]; stresses are compared with it.
constexpr double stiffness = 23e6;

TEST_P(RigidMotion, ByTranslationChangesNeitherVelocityNorShape) {
  Assembly a = assembly();
  Point const v{3, dimension > 1 ? -2 : 0.0, dimension > 2 ? 1.5 : 0.0};
  give_velocity(a, [&](Point const&) { return v; });
  auto const f = make_formulation(a);
  double const dt = f->stable_time_step();
  advance(*f, dt, 20);
  auto const n = a.particles.X.size();
  Values const F = sample(*f, "DeformationGradient", n), velocity = sample(*f, "Velocity", n),
               u = sample(*f, "Displacement", n), P = sample(*f, "FirstPiolaStress", n);
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(F[9 * k + c], c % 4 == 0 ? 1 : 0, 1e-13);
    // Velocity differences vanish exactly. With displacement variables, differences of positions round: stresses of
    // 1e-15 E over 20 steps move a particle by 1e-15 E / (rho dx) 20 dt, a few 1e-12 m/s.
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(velocity[3 * k + c], v[c], 1e-10);
      EXPECT_NEAR(u[3 * k + c], 20 * dt * v[c], 1e-12);
    }
  }
  EXPECT_LT(largest(P), 1e-12 * stiffness);
}

TEST_P(RigidMotion, ByARotationCausesNoStress) {
  if (dimension == 1) GTEST_SKIP() << "a bar cannot turn";
  Mat<3> const R = rotation_about({{0, 0, 1}}, 1.1), turn = dimension == 3 ? R * rotation_about({{1, 2, 0}}, -0.7) : R;
  Assembly a = assembly();
  displace(a, [&](Point const& X) {
    Vec<3> const x = turn * Vec<3>{{X[0], X[1], X[2]}};
    return Point{x[0] - X[0], x[1] - X[1], x[2] - X[2]};
  });
  auto const f = make_formulation(a);
  auto const n = a.particles.X.size();
  EXPECT_LT(largest(sample(*f, "FirstPiolaStress", n)), 1e-12 * stiffness);
  advance(*f, f->stable_time_step(), 10);
  Values const F = sample(*f, "DeformationGradient", n);
  for (std::size_t k = 0; k < n; ++k)
    for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(F[9 * k + c], turn.c[c], 1e-12);
  EXPECT_LT(largest(sample(*f, "Velocity", n)), 1e-9);  // m/s, of a body with waves of 144 m/s
  EXPECT_LT(f->diagnose().strain_energy, 1e-12 * stiffness);
}

INSTANTIATE_TEST_SUITE_P(All, RigidMotion,
                         ::testing::Combine(::testing::Values(1, 2, 3), ::testing::Values(0.0, 0.2),
                                            ::testing::Values("filtered", "paper"),
                                            ::testing::Values("pF", "displacement")));

TEST(RigidMotion, OfASpinningCubeKeepsItsDeformationCloseToARotation) {
  // After a step, F = I + dt W + O(dt^2): F^T F - I is of second order in the angle, which is 105 dt.
  Assembly a = assemble(unit_box(3, 5));
  give_velocity(a, [](Point const& X) { return Point{-105 * (X[1] - 0.5), 105 * (X[0] - 0.5), 0}; });
  double before = 0;
  for (double const dt : {4e-5, 2e-5}) {
    auto const f = make_formulation(a);
    f->step(0, dt);
    Values const F = sample(*f, "DeformationGradient", a.particles.X.size());
    double strain = 0;
    for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
      Mat<3> A;
      std::copy_n(F.begin() + static_cast<std::ptrdiff_t>(9 * k), 9, A.c);
      strain = std::max(strain, size(transpose(A) * A - identity<3>()));
    }
    EXPECT_NEAR(strain, 105 * 105 * dt * dt, 1e-3 * strain);
    if (before > 0) {
      EXPECT_NEAR(before / strain, 4, 0.01);
    }
    before = strain;
  }
}

}  // namespace
}  // namespace piola
