// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"
#include "math/random.hpp"
#include <numbers>

namespace piola {
namespace {

using namespace testing;

/// Round-off of velocities in m/s: a few ulps of the wave speed, 140 m/s, over some ten steps.
constexpr double round_off = 1e-12;

bool at_bottom(Point const& X) { return X[1] < 1e-9; }
bool at_top(Point const& X) { return X[1] > 1 - 1e-9; }

/// n steps of dt from t = 0.
void run_steps(Formulation& f, double dt, int n) {
  double t = 0;
  for (int k = 0; k < n; ++k, t += dt) f.step(t, dt);
}
/// Steps of the formulation's own choice.
double run_until(Formulation& f, double end, double t = 0) {
  while (t < end * (1 - 1e-12)) {
    double const dt = std::min(f.stable_time_step(), end - t);
    f.step(t, dt);
    t += dt;
  }
  return t;
}

class BothIntegrators : public ::testing::TestWithParam<std::string> {
 protected:
  Assembly box(int dimension, int n, double jitter = 0) const {
    Assembly a = assemble(unit_box(dimension, n, jitter));
    choose(a, "scheme", GetParam());
    return a;
  }
};

INSTANTIATE_TEST_SUITE_P(All, BothIntegrators, ::testing::Values("filtered", "paper"));

// ---- loads

TEST_P(BothIntegrators, LetABodyFallFreely) {
  for (int const dimension : {1, 2, 3}) {
    Assembly a = box(dimension, 5);
    load(a, {"3", "-9.81", "1"}, everywhere);
    auto const f = make_formulation(a);
    double const dt = 1e-3;
    run_steps(*f, dt, 20);
    double const t = 20 * dt, g[] = {3, -9.81, 1};
    auto const n = a.particles.X.size();
    Values const v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n);
    for (std::size_t k = 0; k < 3 * n; ++k) {
      double const b = static_cast<int>(k % 3) < dimension ? g[k % 3] : 0;
      EXPECT_NEAR(v[k], b * t, round_off);
      EXPECT_NEAR(u[k], 0.5 * b * t * t, 1e-14);
    }
    auto const d = f->diagnose();
    EXPECT_NEAR(d.external_work / d.kinetic_energy, 1, 1e-11);
  }
}

TEST_P(BothIntegrators, TakeTheMeanOfALoadThatChangesInTime) {
  Assembly a = box(2, 5);
  load(a, {"5 * t", "0", "0"}, everywhere);
  auto const f = make_formulation(a);
  run_steps(*f, 1e-3, 20);
  for (double const t = 0.02; double const v : {sample(*f, "Velocity", 25)[0], sample(*f, "Velocity", 25)[72]})
    EXPECT_NEAR(v, 2.5 * t * t, round_off);  // the trapezoidal rule is exact for a linear load
}

TEST_P(BothIntegrators, AddLoadsUpAndEndEachAtItsTime) {
  Assembly a = box(2, 5);
  load(a, {"7", "0", "0"}, everywhere).until = 8e-3;
  load(a, {"3", "0", "0"}, everywhere);
  load(a, {"100 * t", "0", "0"}, everywhere).until = 4e-3;
  auto const f = make_formulation(a);
  run_steps(*f, 1e-3, 12);
  EXPECT_NEAR(sample(*f, "Velocity", 25)[0], 7 * 8e-3 + 3 * 12e-3 + 50 * 16e-6, round_off);
}

TEST_P(BothIntegrators, GiveParticlesTheirFactorOfTheLoad) {
  Assembly a = box(1, 9);
  auto& l = load(a, {"2 + X", "0", "0"}, [](Point const& X) { return X[0] > 1 - 1e-9; });
  l.factor = {10};
  auto const f = make_formulation(a);
  f->step(0, 1e-9);
  EXPECT_NEAR(sample(*f, "Velocity", 9)[24] / (30 * 1e-9), 1, 1e-6);  // too short for stress to arise
  EXPECT_NEAR(sample(*f, "Velocity", 9)[0] / (30 * 1e-9), 0, 1e-6);
}

// ---- driven supports

TEST_P(BothIntegrators, MoveDrivenParticlesAsPrescribed) {
  Assembly a = box(3, 5);
  support(a, {true, true, true}, at_bottom);
  support(a, {true, true, false}, at_top).velocity = formulas({"0", "-10", "0"});
  auto const f = make_formulation(a);
  double const dt = 5e-5;
  run_steps(*f, dt, 40);
  auto const n = a.particles.X.size();
  Values const v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n);
  for (std::size_t k = 0; k < n; ++k) {
    if (at_bottom(a.particles.X[k])) {
      for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(u[3 * k + c], 0);
    }
    if (!at_top(a.particles.X[k])) continue;
    EXPECT_EQ(v[3 * k], 0);
    EXPECT_EQ(u[3 * k], 0);
    EXPECT_EQ(v[3 * k + 1], -10);
    EXPECT_NEAR(u[3 * k + 1], -10 * 40 * dt, 1e-14);
  }
  EXPECT_FALSE(f->failure().has_value());
}

TEST_P(BothIntegrators, FollowAVelocityThatChangesInTimeAndPlace) {
  Assembly a = box(2, 5);
  support(a, {true, true, false}, at_bottom).velocity = formulas({"4 * t * X", "2 * cos(100 * t)", "0"});
  auto const f = make_formulation(a);
  run_steps(*f, 1e-4, 50);
  Values const v = sample(*f, "Velocity", 25), u = sample(*f, "Displacement", 25);
  for (std::size_t k = 0; k < 25; ++k) {
    if (!at_bottom(a.particles.X[k])) continue;
    double const X = a.particles.X[k][0], t = 5e-3;
    EXPECT_NEAR(v[3 * k], 4 * t * X, 1e-15);
    EXPECT_NEAR(v[3 * k + 1], 2 * std::cos(100 * t), 1e-14);
    EXPECT_NEAR(u[3 * k], 2 * t * t * X, 1e-14);                       // trapezoidal rule
    EXPECT_NEAR(u[3 * k + 1], 0.02 * std::sin(100 * t), 1e-5 * 0.02);  // its error is (100 dt)^2 / 12
  }
}

TEST_P(BothIntegrators, GiveDrivenParticlesTheVelocityOfTheStartWithoutWork) {
  Assembly a = box(2, 5);
  give_velocity(a, [](Point const&) { return Point{1, 2, 0}; });
  support(a, {false, true, false}, at_top).velocity = formulas({"0", "7 + t", "0"});
  auto const f = make_formulation(a);
  Values const v = sample(*f, "Velocity", 25);
  for (std::size_t k = 0; k < 25; ++k) {
    EXPECT_EQ(v[3 * k], 1);
    EXPECT_EQ(v[3 * k + 1], at_top(a.particles.X[k]) ? 7 : 2);
  }
  EXPECT_EQ(f->diagnose().external_work, 0);
}

TEST_P(BothIntegrators, LetTheSupportThatIsNamedLastHaveItsWay) {
  Assembly a = box(2, 5);
  support(a, {true, true, false}, at_top).velocity = formulas({"3", "4", "0"});
  support(a, {false, true, false}, at_top).velocity = formulas({"0", "5", "0"});
  auto const f = make_formulation(a);
  Values const v = sample(*f, "Velocity", 25);
  EXPECT_EQ(v[72], 3);
  EXPECT_EQ(v[73], 5);
}

// ---- release

TEST_P(BothIntegrators, ConserveMomentumOnceAllSupportsAreReleased) {
  Assembly a = box(3, 5);
  give_velocity(a, [](Point const& X) { return Point{3 * X[1], 10 * X[0], 2}; });
  support(a, {true, true, true}, at_bottom).until = 1e-3;
  auto& top = support(a, {true, true, false}, at_top);
  top.velocity = formulas({"20 * sin(2000 * t)", "-5", "0"});
  top.until = 2e-3;
  auto const f = make_formulation(a);
  run_until(*f, 1e-3);
  auto const held = f->diagnose();
  run_until(*f, 2e-3, 1e-3);
  auto const released = f->diagnose();
  run_until(*f, 4e-3, 2e-3);
  auto const free = f->diagnose();
  EXPECT_GT(std::fabs(released.linear_momentum[1] - held.linear_momentum[1]), 10);
  double const size = std::sqrt(2 * free.kinetic_energy * 1100);
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(free.linear_momentum[c], released.linear_momentum[c], 1e-12 * size);
    EXPECT_NEAR(free.angular_momentum[c], released.angular_momentum[c], 1e-11 * size);
  }
  EXPECT_EQ(free.external_work, released.external_work);
  double slid = 0;  // particles of the clamp move
  Values const u = sample(*f, "Displacement", a.particles.X.size());
  for (std::size_t k = 0; k < a.particles.X.size(); ++k)
    if (at_bottom(a.particles.X[k])) slid = std::max(slid, std::fabs(u[3 * k]));
  EXPECT_GT(slid, 1e-3);
}

TEST_P(BothIntegrators, EndAStepWhereASupportIsReleased) {
  Assembly a = box(2, 5);
  a.cfl = 0.3;  // a step that does not grow from a small first one
  auto const free = make_formulation(a);
  support(a, {true, true, false}, at_top).until = 1e-3;
  auto const f = make_formulation(a);
  double const stable = free->stable_time_step();
  double t = 0;
  int steps = 0;
  for (; t < 1e-3 * (1 - 1e-12); ++steps) {
    double const dt = f->stable_time_step();
    EXPECT_GT(dt, 0.4 * stable);
    EXPECT_LT(dt, stable * (1 + 2e-6));
    f->step(t, dt);
    t += dt;
  }
  EXPECT_NEAR(t, 1e-3, 1e-15);
  EXPECT_EQ(steps, static_cast<int>(std::ceil(1e-3 / stable)));
  EXPECT_EQ(f->stable_time_step(), stable);
}

/// A particle at rest on a spring: the first step after its release starts with the force that the spring then has.
TEST(Release, StartsVerletWithTheForceThatTheSupportHeldBack) {
  Assembly a = assemble(unit_box(1, 5), rubber("linear_elastic", 0));
  choose(a, "scheme", "filtered");
  choose(a, "eps4_momentum", 0.0);
  displace(a, [](Point const& X) { return Point{0.01 * X[0], 0, 0}; });
  Assembly released = a;
  support(released, {true, false, false}, everywhere).until = 5e-4;
  auto const f = make_formulation(a), g = make_formulation(released);
  double const dt = 1e-4;
  for (int k = 0; k < 5; ++k) g->step(k * dt, dt);
  EXPECT_EQ(largest(sample(*g, "Velocity", 5)), 0);
  for (int k = 0; k < 7; ++k) {
    f->step(k * dt, dt);
    g->step((k + 5) * dt, dt);
  }
  EXPECT_GT(largest(sample(*f, "Velocity", 5)), 0.1);
  EXPECT_LT(largest_difference(sample(*f, "Velocity", 5), sample(*g, "Velocity", 5)), 1e-13);
}

// ---- oblique supports

/// The same body with everything in it turned by R.
Assembly turned(Assembly const& a, Mat<3> const& R) {
  Assembly b = a;
  auto const turn = [&](Point const& p) {
    Vec<3> const r = R * Vec<3>{{p[0], p[1], p[2]}};
    return Point{r[0], r[1], r[2]};
  };
  for (auto& X : b.particles.X.own()) X = turn(X);
  for (auto& v : b.initial_velocity) v = turn(v);
  for (auto& s : b.supports) {
    Point const normal = s.frame == Support::Frame::axes
                             ? Point{s.fix[0] ? 1.0 : 0.0, s.fix[1] ? 1.0 : 0.0, s.fix[2] ? 1.0 : 0.0}
                             : s.normal;
    if (s.frame == Support::Frame::axes) s.frame = Support::Frame::normal;
    s.normal = turn(normal);
  }
  return b;
}

TEST_P(BothIntegrators, HoldAnObliqueRollerAsOneAlongAnAxis) {
  for (int const dimension : {2, 3})
    for (bool const tangent : {false, true}) {
      Assembly a = box(dimension, 5);
      a.particles.bodies[0].regular = false;  // lists, whose corrections turn with the body
      give_velocity(a, [](Point const& X) { return Point{X[1] * X[1], 3 - 9 * X[1] + X[0], 0.5 * X[0]}; });
      support(a, {false, true, false}, at_bottom);
      support(a, {true, false, false}, [](Point const& X) { return X[0] < 1e-9; });
      if (tangent) {
        a.supports[0].frame = Support::Frame::tangent;
        a.supports[0].normal = {0, 1, 0};
        a.supports[0].fix = {};
      }
      Vec<3> const axis = dimension == 2 ? Vec<3>{{0, 0, 1}} : Vec<3>{{1, 2, 3}};
      Mat<3> const R = rotation_about(axis, 0.7);
      auto const f = make_formulation(a), g = make_formulation(turned(a, R));
      advance(*f, 1e-4, 30);
      advance(*g, 1e-4, 30);
      auto const n = a.particles.X.size();
      Values const v = sample(*f, "Velocity", n), w = sample(*g, "Velocity", n);
      double wrong = 0;
      for (std::size_t k = 0; k < n; ++k) {
        Vec<3> const r = R * Vec<3>{{v[3 * k], v[3 * k + 1], v[3 * k + 2]}};
        for (std::size_t c = 0; c < 3; ++c) wrong = std::max(wrong, std::fabs(w[3 * k + c] - r[static_cast<int>(c)]));
      }
      EXPECT_LT(wrong, 1e-12 * largest(v)) << dimension << tangent;
    }
}

TEST_P(BothIntegrators, HoldAllDirectionsOfSupportsThatAreNotAtRightAngles) {
  Assembly a = box(3, 5);
  give_velocity(a, [](Point const& X) { return Point{X[1] * X[1], 3 - 9 * X[1] + X[0], 0.5 * X[0]}; });
  double const s = std::sqrt(0.5);
  auto& oblique = support(a, {}, at_bottom);
  oblique.frame = Support::Frame::normal;
  oblique.normal = {s, s, 0};
  oblique.velocity = formulas({"2", "1", "0"});
  support(a, {true, false, false}, at_bottom).velocity = formulas({"5 * t", "0", "0"});
  auto const f = make_formulation(a);
  run_steps(*f, 1e-4, 10);
  auto const n = a.particles.X.size();
  Values const v = sample(*f, "Velocity", n), u = sample(*f, "Displacement", n);
  double free = 0;
  for (std::size_t k = 0; k < n; ++k) {
    if (!at_bottom(a.particles.X[k])) continue;
    EXPECT_NEAR(v[3 * k], 5e-3, 1e-14);
    EXPECT_NEAR(v[3 * k] + v[3 * k + 1], 3, 1e-14);
    EXPECT_NEAR(u[3 * k], 2.5e-6, 1e-14);
    EXPECT_NEAR(u[3 * k] + u[3 * k + 1], 3e-3, 1e-14);
    free = std::max(free, std::fabs(v[3 * k + 2]));
  }
  EXPECT_GT(free, 0.1);
}

// ---- work

double imbalance(Assembly const& a, double end, int n) {
  auto const f = make_formulation(a);
  auto const start = f->diagnose();
  run_steps(*f, end / n, n);
  auto const d = f->diagnose();
  EXPECT_FALSE(f->failure().has_value());
  EXPECT_GT(d.external_work, 0.1 * d.total_energy());
  return std::fabs(d.total_energy() + d.stabilisation_loss + d.projection_loss - start.total_energy() -
                   d.external_work) /
         d.external_work;
}

TEST_P(BothIntegrators, BookTheWorkOfDrivenSupportsAndLoads) {
  Assembly a = box(2, 7);
  choose(a, "eps4_momentum", 0.0);  // with Verlet its loss is known to first order only
  support(a, {true, true, false}, at_bottom);
  support(a, {true, true, false}, at_top).velocity = formulas({"3 * sin(900 * t)", "-5 + 2000 * t", "0"});
  load(a, {"3e3", "2e6 * t", "0"}, [](Point const& X) { return X[0] > 0.7; });
  double const end = 4e-3, coarse = imbalance(a, end, 100), fine = imbalance(a, end, 200);
  EXPECT_LT(fine, 1e-3);
  EXPECT_GT(coarse / fine, 3.5) << coarse << " " << fine;
}

TEST_P(BothIntegrators, DoNoWorkAtSupportsAtRest) {
  Assembly a = box(2, 5);
  give_velocity(a, [](Point const& X) { return Point{0, 5 * X[1], 0}; });
  support(a, {true, true, false}, at_bottom).until = 1;
  auto const f = make_formulation(a);
  run_steps(*f, 1e-4, 20);
  EXPECT_EQ(f->diagnose().external_work, 0);
}

// ---- the rest

TEST_P(BothIntegrators, ContinueAcrossAReleaseWithTheSameBits) {
  for (auto const& backend : backends()) {
    Assembly a = box(3, 5);
    a.backend = backend;
    give_velocity(a, [](Point const& X) { return Point{3 * X[1], 10 * X[0], 2}; });
    auto& top = support(a, {true, true, false}, at_top);
    top.velocity = formulas({"20 * sin(2000 * t)", "-5", "0"});
    top.until = 1e-3;
    support(a, {false, false, true}, at_bottom).until = 1.5e-3;
    load(a, {"0", "1e4 * cos(500 * t)", "100"}, everywhere).until = 0.8e-3;
    auto const whole = make_formulation(a);
    auto part = make_formulation(a);
    double t = 0;
    while (t < 2e-3) {
      double const dt = whole->stable_time_step();
      EXPECT_EQ(part->stable_time_step(), dt);
      whole->step(t, dt);
      part->step(t, dt);
      t += dt;
      SavedState s = saved(*part);
      part = make_formulation(a);
      part->load(s);
      EXPECT_EQ(saved(*whole).values, saved(*part).values) << backend << " " << t;
    }
    EXPECT_EQ(part->diagnose().external_work, whole->diagnose().external_work);
  }
}

TEST(StabilityLimit, IsThatOfTheBodyWithoutLoadsAndDrivenSupports) {
  Assembly a = assemble(unit_box(2, 6));
  choose(a, "scheme", "filtered");
  Assembly b = a;
  support(b, {true, true, false}, at_top).velocity = formulas({"0", "3", "0"});
  auto& roller = support(b, {}, at_bottom);
  roller.frame = Support::Frame::normal;
  roller.normal = {0.6, 0.8, 0};
  load(b, {"1e6", "0", "0"}, everywhere);
  EXPECT_EQ(make_formulation(b)->stable_time_step(), make_formulation(a)->stable_time_step());
}

}  // namespace
}  // namespace piola
