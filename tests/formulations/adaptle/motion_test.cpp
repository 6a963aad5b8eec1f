// SPDX-License-Identifier: Apache-2.0
// Motions with known stresses: translation, rotation, stretch in plane strain and plane stress.
#include "formulations/adaptle/clouds.hpp"

namespace piola {
namespace {

using namespace testing;

constexpr double rho0 = 2870, young = 70e9, poisson = 0.33;
constexpr double shear = young / (2 * (1 + poisson)), bulk = young / (3 * (1 - 2 * poisson));

class AdaptleMotion : public ::testing::TestWithParam<std::tuple<int, std::string, std::string>> {
 protected:
  int const dimension = std::get<0>(GetParam());
  Assembly assembly() const {
    Assembly a = adaptle_assembly(unit_box(dimension, dimension == 2 ? 9 : 6, 0.15));
    choose(a, "description", std::get<1>(GetParam()));
    choose(a, "correction", std::get<2>(GetParam()));
    choose(a, "correction_limit", 1e30);
    if (std::get<1>(GetParam()) == "patch") choose_formula(a, "eulerian_where", "X + Y < 0.9");
    return a;
  }
};

TEST_P(AdaptleMotion, TranslationCausesNoStress) {
  Assembly a = assembly();
  give_velocity(a, [&](Point const&) { return Point{30, -20, dimension == 3 ? 10.0 : 0.0}; });
  auto const f = make_formulation(a);
  advance(*f, f->stable_time_step(), 20);
  std::size_t const n = a.particles.X.size();
  EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-11 * young);
  Values const v = sample(*f, "Velocity", n);
  for (std::size_t k = 0; k < n; ++k) EXPECT_NEAR(v[3 * k], 30, 1e-6);
}

/// Straight paths over half a step stretch by (omega dt)^2 / 4: the stress of a step is of second order.
TEST_P(AdaptleMotion, RotationCausesNoStressWithTheCorrection) {
  Assembly a = assembly();
  double const omega = 50;
  choose(a, "alpha", 0.0);
  choose(a, "beta", 0.0);
  choose(a, "artificial_stress", 0.0);
  give_velocity(a, [&](Point const& X) { return Point{-omega * X[1], omega * X[0], 0}; });
  std::size_t const n = a.particles.X.size();
  double before = 0;
  for (double const dt : {2e-6, 1e-6}) {
    auto const f = make_formulation(a);
    f->step(0, dt);
    double const stress = largest(sample(*f, "CauchyStress", n));
    if (std::get<2>(GetParam()) == "none") {
      // Plain gradients at the surface see a part of the rotation as strain.
      EXPECT_GT(stress, 0.01 * shear * omega * dt);
      continue;
    }
    EXPECT_LT(stress, 3 * young * (omega * dt) * (omega * dt));
    if (before > 0) {
      EXPECT_NEAR(before / stress, 4, 0.1);
    }
    before = stress;
  }
}

/// A turning body carries its stress along: S of its own frame stays.
TEST_P(AdaptleMotion, RotationTurnsTheStress) {
  if (std::get<2>(GetParam()) == "none") GTEST_SKIP() << "plain gradients see strain at the surface";
  Assembly a = assembly();
  double const omega = 1e4, S = 1e6;
  // Held on their way, so that stress and inertia do not move anything.
  support(a, {true, true, true}, everywhere).velocity =
      formulas({"-1e4*(X*sin(1e4*t) + Y*cos(1e4*t))", "1e4*(X*cos(1e4*t) - Y*sin(1e4*t))", "0"});
  give_velocity(a, [&](Point const& X) { return Point{-omega * X[1], omega * X[0], 0}; });
  Cloud cloud(a);
  for (Index i = 0; i < cloud.size(); ++i) {
    cloud.state[i].S[0] = S;
    cloud.state[i].S[1] = -S;
  }
  double const dt = 1e-8;
  for (int k = 0; k < 1000; ++k) cloud.particles->step(k * dt, dt);
  // By 0.1 rad. The path of the midpoint rule adds strains of (omega dt)^2 per step at most.
  double const angle = omega * 1000 * dt, slack = 2 * shear * 1000 * (omega * dt) * (omega * dt);
  for (Index i = 0; i < cloud.size(); ++i) {
    EXPECT_NEAR(cloud.state[i].S[0], S * std::cos(2 * angle), 0.01 * S + slack);
    EXPECT_NEAR(cloud.state[i].S[3], S * std::sin(2 * angle), 0.01 * S + slack);
  }
}

/// A stretch along x with the rate of every particle given: stresses of plane strain (2D) or uniaxial strain (3D).
TEST_P(AdaptleMotion, UniaxialStretchHasTheStressOfHookesLaw) {
  if (std::get<2>(GetParam()) == "none") GTEST_SKIP() << "plain gradients are not exact";
  Assembly a = assembly();
  choose(a, "artificial_stress", 0.0);  // it does work against a stretch
  double const rate = 10, strain = 1e-4;
  support(a, {true, true, true}, everywhere).velocity = formulas({"10*X", "0", "0"});
  give_velocity(a, [&](Point const& X) { return Point{rate * X[0], 0, 0}; });
  auto const f = make_formulation(a);
  advance(*f, strain / rate / 50, 50);
  Values const stress = sample(*f, "CauchyStress", a.particles.X.size());
  double const along = (bulk + 4 * shear / 3) * strain, across = (bulk - 2 * shear / 3) * strain;
  // Pressure of total-Lagrangian particles is half a step old, 1 % here; products of strains are 1e-4 of it.
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    EXPECT_NEAR(stress[6 * k], along, 0.015 * along);
    EXPECT_NEAR(stress[6 * k + 1], across, 0.015 * along);
    EXPECT_NEAR(stress[6 * k + 2], across, 0.015 * along);
    EXPECT_NEAR(stress[6 * k + 3], 0, 1e-3 * along);
  }
  // The internal energy is the work of deformation, strain^2 (K + 4/3 G) / 2 per volume.
  EXPECT_NEAR(f->diagnose().strain_energy, 0.5 * along * strain, 0.001 * along * strain);
}

INSTANTIATE_TEST_SUITE_P(All, AdaptleMotion,
                         ::testing::Combine(::testing::Values(2, 3),
                                            ::testing::Values("eulerian", "total_lagrangian", "patch"),
                                            ::testing::Values("none", "mixed")));

/// A thin plate that is stretched along x and free across: every particle goes the way of the exact solution.
TEST(AdaptlePlaneStress, UniaxialTensionHasTheResponseOfYoungsModulus) {
  for (std::string const description : {"eulerian", "total_lagrangian"}) {
    Assembly a = adaptle_assembly(unit_box(2, 7, 0.1));
    choose(a, "description", description);
    choose(a, "correction", "mixed");
    choose(a, "correction_limit", 1e30);
    choose(a, "assumption", "plane_stress");
    double const rate = 10, strain = 1e-4;
    support(a, {true, true, false}, everywhere).velocity = formulas({"10*X", "-3.3*Y", "0"});
    give_velocity(a, [&](Point const& X) { return Point{rate * X[0], -poisson * rate * X[1], 0}; });
    Cloud cloud(a);
    for (int k = 0; k < 50; ++k) cloud.particles->step(k * strain / rate / 50, strain / rate / 50);
    double const sigma = young * strain;
    for (Index i = 0; i < cloud.size(); ++i) {
      State const s = cloud.state[i];
      double const p = bulk * (cloud.state[i].rho / rho0 - 1);
      EXPECT_NEAR(s.S[0] - p, sigma, 0.006 * sigma);
      EXPECT_NEAR(s.S[1] - p, 0, 0.006 * sigma);
      EXPECT_NEAR(s.S[2] - p, 0, 0.006 * sigma);
      EXPECT_NEAR(s.S[3], 0, 1e-3 * sigma);
      EXPECT_NEAR(value_at(cloud.system().field.thickness, i) - 1, -poisson * strain, 1e-3 * strain);
    }
  }
}

TEST(AdaptlePlaneStress, PlaneStrainIsStiffer) {
  Assembly a = adaptle_assembly(unit_box(2, 7));
  choose(a, "description", "eulerian");
  choose(a, "correction", "mixed");
  support(a, {true, true, false}, everywhere).velocity = formulas({"10*X", "0", "0"});
  give_velocity(a, [](Point const& X) { return Point{10 * X[0], 0, 0}; });
  std::map<std::string, double> stress;
  for (std::string const assumption : {"plane_strain", "plane_stress"}) {
    choose(a, "assumption", assumption);
    auto const f = make_formulation(a);
    advance(*f, 2e-7, 50);
    stress[assumption] = sample(*f, "CauchyStress", 49)[0];
  }
  EXPECT_NEAR(stress["plane_strain"], (bulk + 4 * shear / 3) * 1e-4, 0.001 * young * 1e-4);
  EXPECT_NEAR(stress["plane_stress"], young / (1 - poisson * poisson) * 1e-4, 0.001 * young * 1e-4);
}

}  // namespace
}  // namespace piola
