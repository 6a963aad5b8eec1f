// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_advection/solver.hpp"
#include "piola/base/errors.hpp"
#include "formulations/small_bodies.hpp"
#include <complex>
#include <limits>
#include <numbers>

namespace piola::jst_advection {
namespace {

using namespace piola::testing;

/// n equal particles on a line of 2 m with two waves on it, c = 4 m/s.
Assembly row(std::int64_t n, double eps4 = 0.125, double cfl = 0.5) {
  ParticleSet set;
  set.dimension = 1;
  double const h = 2.0 / static_cast<double>(n);
  set.bodies = {{"row", 0, n, {h, 1, 1}, {static_cast<int>(n), 1, 1}, true}};
  for (int a = 0; a < n; ++a) {
    set.X.push_back({(a + 0.5) * h, 0, 0});
    set.lattice_index.push_back({a, 0, 0});
  }
  set.volume.assign(set.X.size(), h);
  set.kernel_volume = set.volume;
  set.body.assign(set.X.size(), 0);
  Assembly a = piola::testing::assemble(std::move(set), material("linear_elastic", 1000, 1e9, 0));
  a.formulations = {{"jst_advection", {{"wave_speed", 4.0}, {"eps4_momentum", eps4}}, {}}};
  a.cfl = cfl;
  give_velocity(a, [](Point const& X) { return Point{std::sin(2 * std::numbers::pi * X[0]), 0, 0}; });
  return a;
}

double column(Formulation const& f, std::string const& name) {
  for (auto const& [key, value] : f.diagnose().more)
    if (key == name) return value;
  ADD_FAILURE() << "no column " << name;
  return std::numeric_limits<double>::quiet_NaN();
}

void run(Formulation& f, int first, int last) {
  for (int k = first; k < last; ++k) f.step(k * f.stable_time_step(), f.stable_time_step());
}

TEST(Advection, TakesTheStepOfTheCfl) { EXPECT_NEAR(make(row(40))->stable_time_step(), 0.5 * 0.05 / 4, 1e-16); }

/// (C.4), and its next order: log g of the scheme's own symbol.
TEST(Advection, MeasuresTheCoefficientsOfTheAppendix) {
  double const alpha = 0.5, eps4 = 0.125, kh = 2 * std::numbers::pi * 2 / 80;
  auto const f = make(row(80, eps4, alpha));
  run(*f, 0, 100);
  double const second = 2 - 2 * std::cos(kh);
  std::complex<double> const z(-alpha * eps4 * second * second, -alpha * std::sin(kh));
  std::complex<double> const rate = std::log(1.0 + z + 0.5 * z * z) / alpha;
  EXPECT_NEAR(column(*f, "dispersion"), -6 * (rate.imag() + kh) / std::pow(kh, 3), 1e-10);
  EXPECT_NEAR(column(*f, "diffusion"), -rate.real() / std::pow(kh, 4), 1e-10);
  EXPECT_NEAR(column(*f, "dispersion"), alpha * alpha - 1, 0.01);
  EXPECT_NEAR(column(*f, "diffusion"), eps4 - alpha * alpha * alpha / 8, 0.001);
  EXPECT_NEAR(column(*f, "amplitude"), std::exp(rate.real() * alpha * 100), 1e-12);
}

TEST(Advection, ConservesMomentumAndLosesEnergy) {
  Assembly a = row(40);
  for (auto& v : a.initial_velocity) v[0] += 3;
  auto const f = make(a);
  Diagnostics const before = f->diagnose();
  EXPECT_NEAR(before.linear_momentum[0], 1000 * 2 * 3, 1e-9);
  EXPECT_NEAR(before.kinetic_energy, 0.5 * 1000 * 2 * (9 + 0.5), 1e-9);
  run(*f, 0, 50);
  EXPECT_NEAR(f->diagnose().linear_momentum[0], before.linear_momentum[0], 1e-9);
  EXPECT_LT(f->diagnose().kinetic_energy, before.kinetic_energy);
}

TEST(Advection, ContinuesFromACheckpointWithTheSameBits) {
  auto const whole = make(row(40)), first = make(row(40));
  Assembly other = row(40);
  give_velocity(other, [](Point const& X) { return Point{X[0], 0, 0}; });
  auto const second = make(other);
  run(*whole, 0, 30);
  run(*first, 0, 12);
  SavedState checkpoint = saved(*first);
  second->load(checkpoint);
  run(*second, 12, 30);
  EXPECT_EQ(saved(*whole).values, saved(*second).values);
  EXPECT_EQ(whole->diagnose().more, second->diagnose().more);
}

TEST(Advection, ShowsItsVelocity) {
  Assembly const a = row(40);
  auto const f = make(a);
  Values const v = sample(*f, "Velocity", 40), u = sample(*f, "Displacement", 40);
  for (std::size_t k = 0; k < 40; ++k) EXPECT_EQ(v[3 * k], a.initial_velocity[k][0]);
  EXPECT_EQ(largest(u), 0);
}

TEST(Advection, SaysWhereItIsNoNumberAnyMore) {
  Assembly a = row(40);
  a.initial_velocity[7][0] = std::numeric_limits<double>::infinity();
  auto const failure = make(a)->failure();
  ASSERT_TRUE(failure.has_value());
  EXPECT_EQ(failure->particle, 7);
}

TEST(Advection, RefusesWhatAPeriodicRowIsNot) {
  auto const message = [](Assembly const& a) -> std::string {
    try {
      (void)make(a);
    } catch (InputError const& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(message(row(40)), "accepted");
  Assembly halves = row(40);
  halves.particles.volume[0] /= 2;
  EXPECT_NE(message(halves).find("cell_centred"), std::string::npos);
  Assembly held = row(40);
  support(held, {true, false, false}, [](Point const& X) { return X[0] < 0.1; });
  EXPECT_NE(message(held).find("no boundary"), std::string::npos);
  Assembly plate = piola::testing::assemble(unit_box(2, 5));
  plate.formulations = {{"jst_advection", {}, {}}};
  EXPECT_NE(message(plate).find("one direction"), std::string::npos);
  EXPECT_NE(message(row(4)).find("5 or more"), std::string::npos);
}

}  // namespace
}  // namespace piola::jst_advection
