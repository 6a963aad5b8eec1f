// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

double energy_totals(Diagnostics const& d) { return d.total_energy() + d.stabilisation_loss + d.projection_loss; }

/// Energy that is unaccounted for after 8 ms in n steps, relative to the initial energy.
double defect(Assembly const& a, int n) {
  auto const f = make_formulation(a);
  double const before = energy_totals(f->diagnose());
  advance(*f, 8e-3 / n, n);
  EXPECT_FALSE(f->failure().has_value());
  return std::fabs(energy_totals(f->diagnose()) - before) / before;
}

class EnergyBalance : public ::testing::TestWithParam<std::tuple<std::string, double>> {
 protected:
  Assembly assembly() const {
    auto const& [projection, jitter] = GetParam();
    Assembly a = tumbling_box(3, 5, jitter);
    choose(a, "angular_momentum_projection", projection);
    choose(a, "eps2_momentum", 1.0 / 32);
    return a;
  }
};

TEST_P(EnergyBalance, ClosesAtLeastWithTheSquareOfTheTimeStep) {
  Assembly const a = assembly();
  double const fine = defect(a, 80), finer = defect(a, 160);
  EXPECT_LT(finer, 1e-5);
  // Second order gives 4. Two-stage Runge-Kutta has an energy error of third order on linear oscillations (8), and no
  // more than that is seen here.
  EXPECT_GT(fine / finer, 3.5) << fine << " " << finer;
}

TEST_P(EnergyBalance, LosesEnergyToTheStabilisation) {
  auto const f = make_formulation(assembly());
  advance(*f, 1e-4, 80);
  EXPECT_GT(f->diagnose().stabilisation_loss, 1e-3 * f->diagnose().kinetic_energy);
}

INSTANTIATE_TEST_SUITE_P(All, EnergyBalance,
                         ::testing::Combine(::testing::Values("on", "off"), ::testing::Values(0.0, 0.2)));

TEST(Stabilisation, OfTheAdjointFormNeverFeedsEnergy) {
  for (double const jitter : {0.0, 0.2}) {
    Assembly a = tumbling_box(3, 6, jitter);
    support(a, {true, true, true}, [](Point const& X) { return X[1] < 1e-9; });
    choose(a, "scheme", "filtered");
    auto const f = make_formulation(a);
    double before = 0;
    for (int k = 0; k < 100; ++k) {
      f->step(0, f->stable_time_step());
      double const now = f->diagnose().stabilisation_loss;
      EXPECT_GE(now, before) << "step " << k;
      before = now;
    }
    EXPECT_GT(before, 0);
  }
}

TEST(Stabilisation, IsOffWhereItsCoefficientsAreZero) {
  Assembly a = tumbling_box(3, 5);
  choose(a, "eps4_momentum", 0.0);
  choose(a, "angular_momentum_projection", "off");
  auto const f = make_formulation(a);
  advance(*f, 1e-4, 20);
  EXPECT_EQ(f->diagnose().stabilisation_loss, 0);
  EXPECT_EQ(f->diagnose().projection_loss, 0);
}

TEST(Energy, OfAUniformDeformationIsThatOfTheLawTimesTheVolume) {
  // F = I + 0.6 e1 (x) e2 has the energy mu/2 0.36 per volume, mu = E / (2 (1 + nu)); the box has the volume 1.
  for (int const dimension : {2, 3}) {
    Assembly a = assemble(unit_box(dimension, 5));
    displace(a, [](Point const& X) { return Point{0.6 * X[1], 0, 0}; });
    double const mu = 17e6 / 2.6;
    EXPECT_NEAR(make_formulation(a)->diagnose().strain_energy, 0.18 * mu, 1e-10 * mu);
  }
}

}  // namespace
}  // namespace piola
