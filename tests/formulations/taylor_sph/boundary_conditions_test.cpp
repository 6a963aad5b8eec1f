// SPDX-License-Identifier: Apache-2.0
// Loads, tractions, driven and released supports.
#include "formulations/taylor_sph/taylor_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

bool is_left(Point const& X) { return X[0] < 1e-9; }
bool is_right(Point const& X) { return X[0] > 1 - 1e-9; }

// ---- accelerations

TEST(TaylorLoads, LetAFreeBodyFallExactly) {
  for (int D = 1; D <= 3; ++D) {
    Assembly a = assemble_taylor(unit_box(D, 5, 0.2));
    load(a, {"2", "-9.81", "0.5"}, everywhere);
    auto const f = make_formulation(a);
    double const t = run(*f, 12);
    auto const n = a.particles.X.size();
    Values const v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n);
    double const g[] = {2, D > 1 ? -9.81 : 0, D > 2 ? 0.5 : 0};
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(v[3 * k + c], g[c] * t, 1e-12);
        EXPECT_NEAR(u[3 * k + c], 0.5 * g[c] * t * t, 1e-12);
      }
    EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-11 * youngs_modulus);
  }
}

/// The impulse is taken at half time: exact for what is linear in time. The factor is that of each particle.
TEST(TaylorLoads, HaveTheImpulseOfHalfTimeAndTheirFactor) {
  Assembly a = assemble_taylor(unit_box(2, 5));
  choose(a, "configuration", "fixed");
  Load& push = load(a, {"3*t", "0", "0"}, everywhere);
  push.factor.assign(push.particles.size(), 2);
  auto const f = make_formulation(a);
  double const t = run(*f, 5);
  for (std::size_t k = 0; k < 25; ++k) EXPECT_NEAR(sample(*f, "Velocity", 25)[3 * k], 3 * t * t, 1e-13);
}

TEST(TaylorLoads, AreGoneAtTheirEnd) {
  Assembly a = assemble_taylor(unit_box(1, 5));
  load(a, {"4", "0", "0"}, everywhere).until = 0.05;
  auto const f = make_formulation(a);
  double time = 0;
  while (time < 0.2) time = run(*f, 1, time);
  for (std::size_t k = 0; k < 5; ++k) EXPECT_NEAR(sample(*f, "Velocity", 5)[3 * k], 0.2, 1e-13);
}

// ---- a bar with one end loaded, at Courant number 1, where all is exact

constexpr int bar_particles = 41;
constexpr double dx = 1.0 / (bar_particles - 1), wave_speed = 10, dt = dx / wave_speed;

Assembly bar() {
  Assembly a = assemble_taylor(unit_box(1, bar_particles));
  choose(a, "configuration", "fixed");
  return a;
}

/// The particle number m from the loaded end after n steps is at the value that the end had n - m steps after the
/// start: pulse(n - m), as long as nothing has been reflected.
template <class Pulse>
void expect_wave(Formulation const& f, int n, bool from_left, Pulse const& speed) {
  Values const v = sample(f, "Velocity", bar_particles), s = sample(f, "CauchyStress", bar_particles);
  for (std::size_t m = 0; m < bar_particles; ++m) {
    std::size_t const k = from_left ? m : bar_particles - 1 - m;
    double const expected = speed(n - static_cast<int>(m)), sign = from_left ? -1 : 1;
    EXPECT_NEAR(v[3 * k], expected, 1e-12) << "after " << n << " steps, at " << m;
    EXPECT_NEAR(s[6 * k], sign * density * wave_speed * expected, 1e-12 * density * wave_speed);
  }
}

TEST(TaylorTraction, OnTheEndOfABarSendsAStepAlongIt) {
  Assembly a = bar();
  double const p = 300;
  Load& pull = load(a, {"300", "0", "0"}, is_right);
  pull.normal = std::array<double, 3>{1, 0, 0};
  auto const f = make_formulation(a);
  for (int n = 1; n <= 30; ++n) {
    f->step((n - 1) * dt, dt);
    expect_wave(*f, n, false, [&](int since) { return since > 0 ? p / (density * wave_speed) : 0; });
    // Half a mass at the end: half a step's work is not yet done, see the trapezoidal rule.
    double const work = p * p / (density * wave_speed) * (n - 0.5) * dt;
    EXPECT_NEAR(f->diagnose().external_work, work, 1e-12 * work);
    EXPECT_NEAR(f->diagnose().total_energy(), work, 1e-11 * work);
  }
}

TEST(TaylorTraction, ThatEndsSendsAPulse) {
  Assembly a = bar();
  Load& pull = load(a, {"300", "0", "0"}, is_right);
  pull.normal = std::array<double, 3>{1, 0, 0};
  pull.until = 10 * dt;
  auto const f = make_formulation(a);
  for (int n = 1; n <= 30; ++n) {
    f->step((n - 1) * dt, dt);
    expect_wave(*f, n, false, [&](int since) { return since > 0 && since < 10 ? 300 / (density * wave_speed) : 0; });
  }
}

TEST(TaylorTraction, FollowsItsFormulaInTime) {
  Assembly a = bar();
  Load& pull = load(a, {"300*sin(500*t)", "0", "0"}, is_right);
  pull.normal = std::array<double, 3>{1, 0, 0};
  auto const f = make_formulation(a);
  for (int n = 1; n <= 30; ++n) {
    f->step((n - 1) * dt, dt);
    expect_wave(*f, n, false,
                [&](int since) { return since > 0 ? 300 * std::sin(500 * since * dt) / (density * wave_speed) : 0; });
  }
}

TEST(TaylorSupport, DrivesTheEndOfABar) {
  Assembly a = bar();
  drive(a, {true, false, false}, {"0.1*cos(400*t)", "0", "0"}, is_left);
  auto const f = make_formulation(a);
  for (int n = 1; n <= 30; ++n) {
    f->step((n - 1) * dt, dt);
    expect_wave(*f, n, true, [&](int since) { return since > 0 ? 0.1 * std::cos(400 * since * dt) : 0; });
  }
}

/// Behind a support that lets go there is a free end: neither stress nor velocity.
TEST(TaylorSupport, ThatLetsGoSendsAPulse) {
  Assembly a = bar();
  drive(a, {true, false, false}, {"0.1", "0", "0"}, is_left).until = 10 * dt;
  auto const f = make_formulation(a);
  for (int n = 1; n <= 30; ++n) {
    f->step((n - 1) * dt, dt);
    expect_wave(*f, n, true, [&](int since) { return since > 0 && since <= 10 ? 0.1 : 0; });
  }
}

TEST(TaylorSupport, AtRestReflectsAWaveAndDoublesItsStress) {
  Assembly a = bar();
  drive(a, {true, false, false}, {"0.1", "0", "0"}, is_left);
  support(a, {true, false, false}, is_right);
  auto const f = make_formulation(a);
  int const n = bar_particles + 10;  // the front has come back from the right end by 10 spacings
  advance(*f, dt, n);
  Values const v = sample(*f, "Velocity", bar_particles), s = sample(*f, "CauchyStress", bar_particles);
  for (std::size_t k = 0; k < bar_particles; ++k) {
    bool const reflected = k + 11 > bar_particles - 1;
    EXPECT_NEAR(v[3 * k], reflected ? 0 : 0.1, 1e-12) << k;
    EXPECT_NEAR(s[6 * k], (reflected ? -2 : -1) * density * wave_speed * 0.1, 1e-12 * density * wave_speed) << k;
  }
}

// ---- plates and blocks

/// On the faces there is what is prescribed: the traction on the right, none elsewhere.
TEST(TaylorTraction, IsWhatTheStressOnAFaceIs) {
  for (int D = 2; D <= 3; ++D) {
    Assembly a = assemble_taylor(unit_box(D, 6));
    choose(a, "configuration", "fixed");
    give_velocity(a, [&](Point const& X) { return Point{X[1] * X[0], X[0] * X[0] - X[1], D > 2 ? X[0] * X[1] : 0}; });
    Load& pull = load(a, {"800*(1 + t)", "0", "0"}, is_right);
    pull.normal = std::array<double, 3>{1, 0, 0};
    auto const f = make_formulation(a);
    double const t = run(*f, 12);
    auto const n = a.particles.X.size();
    Values const s = sample(*f, "CauchyStress", n);
    ASSERT_GT(largest(s), 1000);
    for (std::size_t k = 0; k < n; ++k) {
      Point const& X = a.particles.X[k];
      for (int d = 0; d < D; ++d) {
        bool const upper = X[static_cast<std::size_t>(d)] > 1 - 1e-9, lower = X[static_cast<std::size_t>(d)] < 1e-9;
        if (!upper && !lower) continue;
        for (int c = 0; c < D; ++c)
          EXPECT_NEAR(s[6 * k + static_cast<std::size_t>(SymMat<3>::at(c, d))],
                      d == 0 && c == 0 && upper ? 800 * (1 + t) : 0, 1e-9)
              << X[0] << " " << X[1] << " " << X[2];
      }
    }
  }
}

TEST(TaylorTraction, InsideABodyIsRefused) {
  Assembly a = assemble_taylor(unit_box(2, 5));
  Load& pull =
      load(a, {"1", "0", "0"}, [](Point const& X) { return std::fabs(X[0] - 0.5) < 0.1 && X[1] > 0.6 && X[1] < 0.9; });
  pull.normal = std::array<double, 3>{1, 0, 0};
  EXPECT_EQ(refusal(a),
            "load: the particle at (0.5, 0.75, 0) m carries a traction but is not on the surface - load particles of a "
            "face, and give the box placement = \"on_boundary\"");
}

TEST(TaylorSupport, HoldsItsParticlesInTheirDirections) {
  Assembly a = busy_body(3, 5);
  auto const bottom = [](Point const& X) { return X[1] < 1e-9; };
  support(a, {true, true, true}, bottom);
  support(a, {true, false, false}, is_left);
  for (std::size_t k = 0; k < a.particles.X.size(); ++k)
    for (std::size_t c = 0; c < 3; ++c)
      if (bottom(a.particles.X[k]) || (is_left(a.particles.X[k]) && c == 0)) a.initial_velocity[k][c] = 0;
  auto const f = make_formulation(a);
  run(*f, 15);
  EXPECT_FALSE(f->failure().has_value());
  auto const n = a.particles.X.size();
  Values const x = sample(*f, "Position", n), v = sample(*f, "Velocity", n);
  double slid = 0;
  for (std::size_t k = 0; k < n; ++k) {
    Point const& X = a.particles.X[k];
    for (std::size_t c = 0; c < 3; ++c)
      if (bottom(X) || (is_left(X) && c == 0)) {
        EXPECT_EQ(x[3 * k + c], X[c]);
        EXPECT_EQ(v[3 * k + c], 0);
      }
    if (is_left(X) && !bottom(X)) slid = std::max(slid, std::fabs(x[3 * k + 1] - X[1]));
  }
  EXPECT_GT(slid, 1e-3);
}

TEST(TaylorSupport, MovesItsParticlesAsItsFormulaSays) {
  Assembly a = assemble_taylor(unit_box(2, 7));
  drive(a, {true, true, false}, {"0.3*Y", "0.2*t", "0"}, is_left);
  auto const f = make_formulation(a);
  double time = 0;
  for (int k = 0; k < 8; ++k) {
    time = run(*f, 1, time);
    Values const v = sample(*f, "Velocity", 49), u = sample(*f, "Displacement", 49);
    for (std::size_t p = 0; p < 49; ++p)
      if (is_left(a.particles.X[p])) {
        EXPECT_NEAR(v[3 * p], 0.3 * a.particles.X[p][1], 1e-15);
        EXPECT_NEAR(v[3 * p + 1], 0.2 * time, 1e-15);
        EXPECT_NEAR(u[3 * p + 1], 0.1 * time * time, 1e-14) << "the trapezoidal rule is exact";
      }
  }
}

/// A body that glides along the plane of its rollers has no stress, wherever the rollers are.
TEST(TaylorSupport, OfObliqueRollersLetsABodyGlide) {
  for (int D = 2; D <= 3; ++D) {
    Assembly a = assemble_taylor(unit_box(D, 6));
    double const r = std::sqrt(0.5);
    give_velocity(a, [&](Point const&) { return Point{0.3, -0.3, D > 2 ? 0.2 : 0}; });
    Support& rollers = support(a, {}, [](Point const& X) { return X[1] < 1e-9; });
    rollers.frame = Support::Frame::normal;
    rollers.normal = {r, r, 0};
    auto const f = make_formulation(a);
    double const t = run(*f, 15);
    auto const n = a.particles.X.size();
    Values const v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n);
    for (std::size_t k = 0; k < n; ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(v[3 * k + c], a.initial_velocity[k][c], 1e-13);
        EXPECT_NEAR(u[3 * k + c], t * a.initial_velocity[k][c], 1e-13);
      }
    EXPECT_LT(largest(sample(*f, "CauchyStress", n)), 1e-11 * youngs_modulus);
  }
}

TEST(TaylorSupport, OfObliqueRollersTakesTheVelocityAcrossThem) {
  for (auto const frame : {Support::Frame::normal, Support::Frame::tangent}) {
    Assembly a = assemble_taylor(unit_box(2, 6));
    give_velocity(a, [](Point const& X) { return Point{0.3 + X[1], -0.1 * X[0], 0}; });
    Support& rollers = support(a, {}, [](Point const& X) { return X[1] < 1e-9; });
    rollers.frame = frame;
    rollers.normal = {0.6, 0.8, 0};
    auto const f = make_formulation(a);
    run(*f, 15);
    Values const v = sample(*f, "Velocity", 36);
    double along = 0;
    for (std::size_t k = 0; k < 36; ++k) {
      if (a.particles.X[k][1] > 1e-9) continue;
      double const normal = 0.6 * v[3 * k] + 0.8 * v[3 * k + 1], tangent = 0.8 * v[3 * k] - 0.6 * v[3 * k + 1];
      EXPECT_NEAR(frame == Support::Frame::normal ? normal : tangent, 0, 1e-15);
      along = std::max(along, std::fabs(frame == Support::Frame::normal ? tangent : normal));
    }
    EXPECT_GT(along, 1e-2);
  }
}

}  // namespace
}  // namespace piola
