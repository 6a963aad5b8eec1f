// SPDX-License-Identifier: Apache-2.0
// Plane waves, turning and free plates under Taylor-SPH.
#include "formulations/taylor_sph/taylor_bodies.hpp"
#include <fmt/format.h>
#include <numbers>

namespace piola {
namespace {

using namespace testing;
constexpr double pi = std::numbers::pi;

// ---- plane waves across a plate

struct Wave {
  bool shear;
  std::string cells;
  double jitter;
};

void PrintTo(Wave const& w, std::ostream* out) { *out << (w.shear ? "S " : "P ") << w.cells; }

class TaylorPlaneWave : public ::testing::TestWithParam<Wave> {};

/// Standing wave v = sin(pi x) along x (P) or along y (S), with lateral edges that go with it: errors of displacement
/// and stress after a quarter of a period, relative to their amplitudes.
std::pair<double, double> quarter_period_error(Wave const& wave, int n) {
  Moduli const m(2);
  double const modulus = wave.shear ? m.mu : m.along, speed = std::sqrt(modulus / density), amplitude = 1e-6;
  std::size_t const along = wave.shear ? 1 : 0, stress = wave.shear ? 3 : 0;
  Assembly a = assemble_taylor(unit_box(2, n, wave.jitter));
  choose(a, "virtual_particles", wave.cells);
  choose(a, "hourglass_filter", 0);
  choose(a, "smoothing_length", wave.cells == "delaunay" ? 0.9 : 0.6);
  give_velocity(a, [&](Point const& X) {
    Point v{};
    v[along] = amplitude * speed * std::sin(pi * X[0]);
    return v;
  });
  // At the ends the wave is at rest; on the lateral edges nothing moves across it.
  support(a, {!wave.shear, wave.shear, false}, [](Point const& X) { return X[0] < 1e-9 || X[0] > 1 - 1e-9; });
  support(a, {wave.shear, !wave.shear, false}, [](Point const& X) { return X[1] < 1e-9 || X[1] > 1 - 1e-9; });
  auto const f = make_formulation(a);
  int const steps = wave.shear ? 3 * (n - 1) / 2 : n - 1;  // Courant number of P-waves 0.62 at most
  advance(*f, 0.5 / speed / steps, steps);
  Values const u = sample(*f, "Displacement", a.particles.X.size()),
               s = sample(*f, "CauchyStress", a.particles.X.size());
  double worst_u = 0, worst_stress = 0;
  for (std::size_t k = 0; k < a.particles.X.size(); ++k) {
    double const x = a.particles.X[k][0];
    worst_u = std::max(worst_u, std::fabs(u[3 * k + along] / (amplitude / pi) - std::sin(pi * x)));
    worst_stress = std::max(worst_stress, std::fabs(s[6 * k + stress] / (amplitude * modulus) - std::cos(pi * x)));
  }
  return {worst_u, worst_stress};
}

TEST_P(TaylorPlaneWave, IsOfSecondOrderInDisplacementAndStress) {
  Wave const& wave = GetParam();
  std::pair<double, double> error[3];
  int const n[] = {9, 17, 33};
  for (int k = 0; k < 3; ++k) error[k] = quarter_period_error(wave, n[k]);
  EXPECT_LT(error[2].first, 3e-3);
  EXPECT_LT(error[2].second, 1e-2);
  for (int k = 0; k < 2; ++k) {
    EXPECT_GT(std::log2(error[k].first / error[k + 1].first), 1.7) << error[k].first << " " << error[k + 1].first;
    EXPECT_GT(std::log2(error[k].second / error[k + 1].second), 1.7) << error[k].second << " " << error[k + 1].second;
  }
}

INSTANTIATE_TEST_SUITE_P(All, TaylorPlaneWave,
                         ::testing::Values(Wave{false, "delaunay", 0}, Wave{false, "lattice_cells", 0},
                                           Wave{true, "delaunay", 0}, Wave{true, "lattice_cells", 0}),
                         [](auto const& p) { return (p.param.shear ? "S_" : "P_") + p.param.cells; });

/// Along the axes, with one virtual particle in the middle of each box, a plane wave at Courant number 1 is exact where
/// nothing has come from the corners yet.
TEST(TaylorPlaneWave, OnTheMiddlesOfBoxesIsExactAtCourantNumberOne) {
  Moduli const m(2);
  double const dt = 0.1 / m.speed();
  Assembly a = assemble_taylor(testing::box({1, 2, 0}, {11, 21, 1}, 2));
  choose(a, "virtual_particles", "lattice_cells");
  choose(a, "configuration", "fixed");
  drive(a, {true, false, false}, {"0.1*cos(90*t)", "0", "0"}, [](Point const& X) { return X[0] < 1e-9; });
  auto const f = make_formulation(a);
  EXPECT_NEAR(f->stable_time_step(), dt, 1e-12 * dt);
  int const steps = 8, middle = 10;
  advance(*f, dt, steps);
  auto const count = a.particles.X.size();
  Values const v = sample(*f, "Velocity", count), s = sample(*f, "CauchyStress", count);
  for (std::size_t k = 0; k < count; ++k) {
    if (a.particles.lattice_index[k][1] != middle) continue;
    int const since = steps - a.particles.lattice_index[k][0];
    double const known = since > 0 ? 0.1 * std::cos(90 * since * dt) : 0;
    EXPECT_NEAR(v[3 * k], known, 1e-12) << k;
    EXPECT_NEAR(s[6 * k], -density * m.speed() * known, 1e-11 * density * m.speed()) << k;
    EXPECT_NEAR(s[6 * k + 1], -0.3 / 0.7 * density * m.speed() * known, 1e-11 * density * m.speed()) << k;
  }
}

// ---- turning

/// Formulas of R(w t) (X - centre) along x and y, times a factor.
std::array<std::string, 3> turned(double factor, double w, bool ahead) {
  std::string const x = fmt::format("(cos({0}*t)*(X - 0.5) - sin({0}*t)*(Y - 0.5))", w);
  std::string const y = fmt::format("(sin({0}*t)*(X - 0.5) + cos({0}*t)*(Y - 0.5))", w);
  if (ahead) return {fmt::format("-({})*{}", factor, y), fmt::format("({})*{}", factor, x), "0"};
  return {fmt::format("({})*{}", factor, x), fmt::format("({})*{}", factor, y), "0"};
}

struct TurnError {
  double place, stress;
};

/// A plate that accelerations keep on its circles turns by a right angle in n steps; its stress, `stress` in the
/// beginning, turns with it.
TurnError quarter_turn(int n, SymMat<2> const& stress, bool driven, std::string const& projection) {
  double const w = 20, end = 0.5 * pi / w;
  Assembly a = assemble_taylor(unit_box(2, 6));
  give_velocity(a, [&](Point const& X) { return Point{-w * (X[1] - 0.5), w * (X[0] - 0.5), 0}; });
  choose(a, "momentum_projection", projection);
  choose(a, "hourglass_filter", 0);  // its fraction is per step, whatever the step
  load(a, turned(-w * w, w, false), everywhere);
  if (driven) drive(a, {true, true, false}, turned(w, w, true), [](Point const& X) { return is_on_edge(X, 2); });
  auto const f = make_formulation(a);
  give_stress(*f, a, [&](Point const&) { return stress.c; });
  advance(*f, end / n, n);
  EXPECT_FALSE(f->failure().has_value());
  EXPECT_EQ(more(*f, "triangulations"), 0);
  Values const x = sample(*f, "Position", 36), s = sample(*f, "CauchyStress", 36);
  TurnError e{0, 0};
  for (std::size_t k = 0; k < 36; ++k) {
    Point const& X = a.particles.X[k];
    e.place =
        std::max({e.place, std::fabs(x[3 * k] - 0.5 + (X[1] - 0.5)), std::fabs(x[3 * k + 1] - 0.5 - (X[0] - 0.5))});
    // Turned by a right angle: components change places, the shear its sign.
    e.stress = std::max({e.stress, std::fabs(s[6 * k] - stress.c[1]), std::fabs(s[6 * k + 1] - stress.c[0]),
                         std::fabs(s[6 * k + 3] + stress.c[2])});
  }
  return e;
}

TEST(TaylorTurningPlate, HasNoStressAndTurnsWithSecondOrder) {
  for (auto const* projection : {"off", "on"}) {
    TurnError const coarse = quarter_turn(40, {}, false, projection), fine = quarter_turn(80, {}, false, projection);
    EXPECT_GT(coarse.place / fine.place, 3.8) << projection << " " << coarse.place << " " << fine.place;
    EXPECT_GT(coarse.stress / fine.stress, 3.6) << projection << " " << coarse.stress << " " << fine.stress;
    EXPECT_LT(fine.place, 1e-3);
    EXPECT_LT(fine.stress, 1e-3 * youngs_modulus);
  }
}

/// (1, 0.2, 0.1) becomes (0.2, 1, -0.1).
TEST(TaylorTurningPlate, CarriesItsStressAlongWithSecondOrder) {
  SymMat<2> const stress{{1000, 200, 100}};
  TurnError const coarse = quarter_turn(40, stress, true, "on"), fine = quarter_turn(80, stress, true, "on");
  EXPECT_GT(coarse.stress / fine.stress, 3.8) << coarse.stress << " " << fine.stress;
  EXPECT_LT(fine.stress, 5e-4 * youngs_modulus);
}

// ---- free plates

/// A free plate that spins slowly enough to stay what it is: rim speeds of a twentieth of that of sound.
TEST(TaylorSpinningPlate, HasNoMoreStressThanItsCentrifugalForces) {
  Moduli const m(2);
  double const w = 0.1 * m.speed(), end = pi / w;
  Assembly a = assemble_taylor(unit_box(2, 7));
  give_velocity(a, [&](Point const& X) { return Point{-w * (X[1] - 0.5), w * (X[0] - 0.5), 0}; });
  auto const f = make_formulation(a);
  Diagnostics const before = f->diagnose();
  double time = 0;
  int halves = 0;
  while (time < end) {
    time = run(*f, 1, time);
    // rho w^2 r^2 at the corner, r^2 = 1/2, and again as much for the plate's breathing.
    EXPECT_LT(largest(sample(*f, "CauchyStress", 49)), density * w * w) << time;
    Diagnostics const d = f->diagnose();
    EXPECT_NEAR(d.total_energy(), before.total_energy(), 0.02 * before.total_energy()) << time;
    EXPECT_NEAR(d.angular_momentum[2], before.angular_momentum[2], 0.02 * before.angular_momentum[2]) << time;
    ++halves;
  }
  EXPECT_GT(halves, 50);
  EXPECT_FALSE(f->failure().has_value());
  // After half a turn each particle is where its opposite was.
  Values const x = sample(*f, "Position", 49);
  double const angle = w * time;
  for (std::size_t k = 0; k < 49; ++k) {
    double const X = a.particles.X[k][0] - 0.5, Y = a.particles.X[k][1] - 0.5;
    EXPECT_NEAR(x[3 * k] - 0.5, std::cos(angle) * X - std::sin(angle) * Y, 0.03);
    EXPECT_NEAR(x[3 * k + 1] - 0.5, std::sin(angle) * X + std::cos(angle) * Y, 0.03);
  }
}

/// What a free plate that waves loses of its momentum and energy in a quarter of a period, relative to all of it.
struct Loss {
  double momentum, energy;
};
Loss waving_plate(int n, double hourglass, std::string const& projection) {
  Moduli const m(2);
  Assembly a = assemble_taylor(unit_box(2, n));
  choose(a, "hourglass_filter", hourglass);
  choose(a, "momentum_projection", projection);
  double const v = 1e-3 * m.speed();
  give_velocity(a, [&](Point const& X) {
    return Point{v * (0.5 + std::cos(pi * X[0]) * std::cos(0.5 * X[1])), v * std::sin(X[0]) * X[1] * X[1], 0};
  });
  auto const f = make_formulation(a);
  Diagnostics const before = f->diagnose();
  double time = 0;
  while (time < 0.5 / m.speed()) time = run(*f, 1, time);
  Diagnostics const after = f->diagnose();
  Loss loss{0,
            std::fabs(after.total_energy() + after.stabilisation_loss - before.total_energy()) / before.total_energy()};
  for (std::size_t c = 0; c < 2; ++c)
    loss.momentum =
        std::max(loss.momentum, std::fabs(after.linear_momentum[c] - before.linear_momentum[c]) / (density * v));
  return loss;
}

TEST(TaylorFreePlate, KeepsItsMomentumAndEnergyTheBetterTheFinerItIs) {
  for (double const hourglass : {0.0, 0.3}) {
    Loss const coarse = waving_plate(9, hourglass, "off"), fine = waving_plate(17, hourglass, "off");
    EXPECT_LT(fine.momentum, 0.01);
    EXPECT_LT(fine.energy, 0.05);
    EXPECT_GT(coarse.momentum / fine.momentum, 1.5) << coarse.momentum << " " << fine.momentum;
    EXPECT_GT(coarse.energy / fine.energy, 1.5) << coarse.energy << " " << fine.energy;
  }
}

TEST(TaylorFreePlate, KeepsItsMomentumToRoundOffWithTheProjection) {
  Loss const loss = waving_plate(9, 0.3, "on");
  EXPECT_LT(loss.momentum, 1e-13);
}

}  // namespace
}  // namespace piola
