// SPDX-License-Identifier: Apache-2.0
// Conduction of heat in bodies of solids in rate form.
#include "formulations/copper.hpp"
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

constexpr double pi = 3.14159265358979323846, specific_heat = 383, start = 293;

/// Copper that stays at rest: its pressure does not depend on heat.
MaterialParameters conducting(double conductivity) {
  MaterialParameters m = metals::copper();
  auto const info = find_law("isotropic_hardening").value();
  for (std::size_t i = 0; i < info.parameters.size(); ++i)
    if (info.parameters[i].name == "conductivity") m.value[i] = conductivity;
  return m;
}
/// So large that heat spreads before waves cross the body [m^2/s], and the conductivity [W/(m K)].
constexpr double diffusivity = 1e5, conductivity = diffusivity * metals::rho0 * specific_heat;

template <class F>
void heat(Assembly& a, F const& temperature) {
  for (auto const& X : a.particles.X.seen()) a.initial_temperature.push_back(temperature(X));
}
Values temperatures(Formulation const& f, Assembly const& a) { return sample(f, "Temperature", a.particles.X.size()); }
/// sum (T - mean) phi / sum phi^2, phi: values of a mode; mean: temperature of the body once it is even.
double amplitude(Values const& T, double mean, Values const& mode) {
  double sum = 0, square = 0;
  for (std::size_t i = 0; i < T.size(); ++i) {
    sum += (T[i] - mean) * mode[i];
    square += mode[i] * mode[i];
  }
  return sum / square;
}
double internal_energy(Formulation const& f) {
  for (auto const& [name, value] : f.diagnose().more)
    if (name == "internal_energy") return value;
  ADD_FAILURE() << "no internal energy";
  return 0;
}

/// Steps until the time t with diffusivity t = `end` [m^2].
void conduct(Formulation& f, double end, int steps) {
  double const dt = end / diffusivity / steps;
  for (int k = 0; k < steps; ++k) f.step(k * dt, dt);
  EXPECT_FALSE(f.failure().has_value());
}

struct Bar {
  int dimension;
  std::array<int, 3> particles;
  double jitter = 0, across = 0.4;
};
Assembly bar(Bar const& of, MaterialParameters const& m = conducting(conductivity)) {
  ShapeSpec shape;
  shape.dimension = of.dimension;
  for (auto c = 0U; c < static_cast<unsigned>(of.dimension); ++c) shape.max[c] = c == 0 ? 1 : of.across;
  shape.particles = of.particles;
  shape.jitter = of.jitter;
  ParticleSet set;
  fill(shape, "bar", set);
  return nodal_body(std::move(set), m);
}

double volume(Assembly const& a) {
  double sum = 0;
  for (double const V : a.particles.volume.seen()) sum += V;
  return sum;
}

/// Rate at which the first mode along X of a bar with insulated faces decays, over that of an undeformed bar of length
/// 1, pi^2 diffusivity.
double decay(Assembly a, double end = 0.1, int steps = 100) {
  Values mode;
  heat(a, [&](Point const& X) { return start + 100 * std::cos(pi * X[0]); });
  for (auto const& X : a.particles.X.seen()) mode.push_back(std::cos(pi * X[0]));
  auto const f = make_formulation(a);
  double const before = internal_energy(*f), mean = start + before / (metals::rho0 * specific_heat * volume(a)),
               first = amplitude(temperatures(*f, a), mean, mode);
  conduct(*f, end, steps);
  EXPECT_NEAR(internal_energy(*f), before, 1e-9 * metals::rho0 * specific_heat * 100);
  return -std::log(amplitude(temperatures(*f, a), mean, mode) / first) / end / (pi * pi);
}

TEST(NodalConduction, LetsAModeDecayAsTheorySays) {
  EXPECT_NEAR(decay(bar({1, {20, 1, 1}})), 1, 0.005);
  EXPECT_NEAR(decay(bar({2, {20, 8, 1}})), 1, 0.005);
  EXPECT_NEAR(decay(bar({3, {12, 5, 5}})), 1, 0.01);
  EXPECT_NEAR(decay(bar({2, {20, 8, 1}, 0.2})), 1, 0.03);
  EXPECT_NEAR(decay(bar({3, {20, 8, 8}, 0.2})), 1, 0.03);  // 12 x 5 x 5: 0.968
}

/// Longer steps than are stable are divided.
TEST(NodalConduction, IsStableInLongSteps) { EXPECT_NEAR(decay(bar({2, {20, 8, 1}}), 0.1, 3), 1, 0.01); }

/// Fourier's law holds in the deformed bar: stretched to twice its length at the same density of heat per mass, heat
/// flows over twice the distance, through a cross-section that has stayed: rate k pi^2 / (rho/2 c (2 L)^2).
TEST(NodalConduction, FollowsTheDeformation) {
  for (int const dimension : {1, 2, 3}) {
    Assembly a = bar({dimension, {20, 5, 5}});
    displace(a, [](Point const& X) { return Point{X[0], 0, 0}; });
    support(a, {true, true, true}, everywhere).velocity = formulas({"0", "0", "0"});
    EXPECT_NEAR(decay(a), 0.5, 0.005) << dimension << "D";
  }
}

/// Two halves of different conductivity between uneven ends: the flux is the same in both once the profile is steady.
TEST(NodalConduction, IsContinuousBetweenMaterials) {
  Assembly a = bar({1, {40, 1, 1}});
  std::vector<int>& part = a.particles.part.own();
  for (auto const& X : a.particles.X.seen()) part.push_back(X[0] > 0.5 ? 1 : 0);
  a.parts = {{conducting(3 * conductivity)}};
  heat(a, [](Point const& X) { return start + (X[0] > 0.5 ? 100 : 0); });
  auto const f = make_formulation(a);
  conduct(*f, 0.005, 100);
  // Half-spaces of effusivities 1 and sqrt 3 meet at the temperature (0 + 100 sqrt 3)/(1 + sqrt 3). In the middle
  // between two particles it is their mean with the conductivities as weights.
  auto const T = temperatures(*f, a);
  EXPECT_NEAR(0.25 * T[19] + 0.75 * T[20] - start, 100 * std::sqrt(3.0) / (1 + std::sqrt(3.0)), 0.2);
}

/// Bits do not depend on threads.
TEST(NodalConduction, HasTheSameBitsOnThreads) {
  auto const run = [] {
    Assembly a = bar({3, {12, 5, 5}, 0.2});
    heat(a, [](Point const& X) { return start + 100 * X[0] * X[0] + 50 * X[1]; });
    auto const f = make_formulation(a);
    conduct(*f, 0.01, 20);
    return temperatures(*f, a);
  };
  Threads const one(1);
  auto const alone = run();
  Threads const three(3);
  EXPECT_EQ(run(), alone);
}

/// Where heat raises the pressure, a body that is warmer than its material at the start is under the pressure gamma
/// rho c (T - T0).
TEST(NodalConduction, HeatIsPressureOfTheEquationOfState) {
  MaterialParameters m = conducting(0);
  auto const info = find_law("isotropic_hardening").value();
  for (std::size_t i = 0; i < info.parameters.size(); ++i)
    if (info.parameters[i].name == "grueneisen_gamma") m.value[i] = 2;
  m.word[SolidLayout<IsotropicHardening>::eos_word] = 2;  // mie_grueneisen
  Assembly a = bar({2, {6, 5, 1}}, m);
  heat(a, [](Point const&) { return start + 10; });
  auto const f = make_formulation(a);
  double const expected = -2 * metals::rho0 * specific_heat * 10;
  for (double const p : sample(*f, "CellPressure", a.particles.X.size())) EXPECT_NEAR(p, expected, 1e-9 * -expected);
}

}  // namespace
}  // namespace piola::testing
