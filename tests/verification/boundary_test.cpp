// SPDX-License-Identifier: Apache-2.0
// A rod fixed at X = 0 and pulled at X = L by a constant traction, or by its weight: exact solutions of d'Alembert.
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

constexpr double length = 1, density = 1000, modulus = 1e7, wave_speed = 100, traction = 1e4;  // strain 1e-3

bool at_end(Point const& X) { return X[0] > length - 1e-9; }

/// Not "paper": its literal biharmonic feeds energy at the end of a rod that is pulled.
Assembly rod(int n) {
  Assembly a = assemble(testing::box({length, 0, 0}, {n, 1, 1}, 1), material("linear_elastic", density, modulus, 0));
  choose(a, "scheme", "filtered");
  support(a, {true, false, false}, [](Point const& X) { return X[0] < 1e-9; });
  return a;
}

/// The traction as the acceleration of the last particle: area / mass.
Assembly pulled_rod(int n) {
  Assembly a = rod(n);
  auto& l = load(a, {std::to_string(traction), "0", "0"}, at_end);
  l.factor = {1 / (density * a.particles.volume[static_cast<std::size_t>(l.particles[0])])};
  return a;
}

void run_until(Formulation& f, double end, double t = 0) {
  while (t < end * (1 - 1e-12)) {
    double const dt = std::min(f.stable_time_step(), end - t);
    f.step(t, dt);
    t += dt;
  }
}

TEST(RodUnderLoad, CarriesAWaveOfTheTractionAndItsVelocity) {
  int const n = 401;
  Assembly const a = pulled_rod(n);
  auto const f = make_formulation(a);
  run_until(*f, 0.5 * length / wave_speed);  // the front is in the middle
  Values const v = sample(*f, "Velocity", n), P = sample(*f, "FirstPiolaStress", n);
  double impulse = 0;
  for (std::size_t k = 0; k < n; ++k) {
    double const X = a.particles.X[k][0];
    impulse += a.particles.volume[k] * density * v[3 * k];
    if (X > 0.4 && X < 0.6) continue;  // dispersion, eq. C.4, spreads the front over some (h^2 L / 2)^(1/3) = 0.015
    bool const behind = X > 0.5;
    EXPECT_NEAR(P[9 * k] / traction, behind ? 1 : 0, 0.02) << X;
    EXPECT_NEAR(v[3 * k] / (traction / (density * wave_speed)), behind ? 1 : 0, 0.02) << X;
  }
  EXPECT_NEAR(impulse / (traction * 0.5 * length / wave_speed), 1, 1e-10);  // nothing has reached the fixed end
}

TEST(RodUnderLoad, SwingsAboutItsStaticElongation) {
  Assembly const a = pulled_rod(101);
  auto const f = make_formulation(a);
  double const most = 2 * traction * length / modulus;  // at t = 2 L / c, and half of it at L / c
  run_until(*f, length / wave_speed);
  EXPECT_NEAR(sample(*f, "Displacement", 101)[300] / most, 0.5, 5e-3);
  run_until(*f, 2 * length / wave_speed, length / wave_speed);
  EXPECT_NEAR(sample(*f, "Displacement", 101)[300] / most, 1, 2e-2);
  auto const d = f->diagnose();
  EXPECT_NEAR(d.external_work / (traction * sample(*f, "Displacement", 101)[300]), 1, 1e-3);
}

/// u(L) swings between 0 and g L^2 / c^2 about g L^2 / (2 c^2), its static value, with the period 4 L / c.
TEST(RodUnderLoad, HangsUnderItsWeight) {
  Assembly a = rod(101);
  load(a, {"9.81", "0", "0"}, everywhere);
  auto const f = make_formulation(a);
  run_until(*f, 2 * length / wave_speed);
  double const most = 9.81 * length * length / (wave_speed * wave_speed);
  EXPECT_NEAR(sample(*f, "Displacement", 101)[300] / most, 1, 1e-2);
  EXPECT_NEAR(f->diagnose().kinetic_energy / f->diagnose().external_work, 0, 1e-2);
}

}  // namespace
}  // namespace piola
