// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"
#include <numbers>

namespace piola {
namespace {

using namespace testing;

constexpr double speed = 5000;  // m/s: E = 200 GPa, rho0 = 8000 kg/m3, nu = 0

/// When the fundamental mode of a bar of 1 m between fixed ends first comes to rest: exactly L / (2 c).
double time_of_rest(int n, double eps4, std::string const& law) {
  Assembly a = assemble(unit_box(1, n), material(law, 8000, 200e9, 0));
  choose(a, "eps4_momentum", eps4);
  a.cfl = 0.3;
  auto const shape = [](Point const& X) { return std::sin(std::numbers::pi * X[0]); };
  give_velocity(a, [&](Point const& X) { return Point{1e-3 * shape(X), 0, 0}; });
  support(a, {true, false, false}, [](Point const& X) { return X[0] < 1e-9 || X[0] > 1 - 1e-9; });
  auto const f = make_formulation(a);
  double const dt = f->stable_time_step();
  auto const amplitude = [&] {
    Values const v = sample(*f, "Velocity", a.particles.X.size());
    double sum = 0;
    for (std::size_t k = 0; k < a.particles.X.size(); ++k) sum += v[3 * k] * shape(a.particles.X[k]);
    return sum;
  };
  double before = amplitude();
  for (int k = 0; k < 100000; ++k) {
    f->step(k * dt, dt);
    double const now = amplitude();
    if (now <= 0) return dt * (k + before / (before - now));
    before = now;
  }
  return 0;
}

class StandingWave : public ::testing::TestWithParam<std::tuple<std::string, double>> {};

TEST_P(StandingWave, HasTheAnalyticalFrequencyToSecondOrder) {
  auto const& [law, eps4] = GetParam();
  double const exact = 1 / (2 * speed);
  double error[3];
  int const n[] = {11, 21, 41};
  for (int k = 0; k < 3; ++k) error[k] = std::fabs(time_of_rest(n[k], eps4, law) / exact - 1);
  EXPECT_LT(error[2], 1e-3);
  for (int k = 0; k < 2; ++k) {
    double const order = std::log2(error[k] / error[k + 1]);
    EXPECT_GT(order, 1.8) << error[0] << " " << error[1] << " " << error[2];
    EXPECT_LT(order, 3.2) << error[0] << " " << error[1] << " " << error[2];  // the damping is of third order
  }
}

INSTANTIATE_TEST_SUITE_P(All, StandingWave,
                         ::testing::Combine(::testing::Values("linear_elastic", "neo_hookean"),
                                            ::testing::Values(0.0, 0.125)));

}  // namespace
}  // namespace piola
