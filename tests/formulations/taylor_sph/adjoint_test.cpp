// SPDX-License-Identifier: Apache-2.0
// The adjoint exchange: its balances of momentum and energy, on sets where kernel estimates have none.
#include "formulations/taylor_sph/taylor_bodies.hpp"

namespace piola::testing {
namespace {

struct Setting {
  int dimension;
  double jitter;
  std::string configuration, cells;
};

void PrintTo(Setting const& s, std::ostream* out) { *out << s.dimension << s.configuration << s.cells << s.jitter; }

std::string name_of(Setting const& s) {
  return std::to_string(s.dimension) + "D_" + (s.jitter > 0 ? "jittered_" : "regular_") + s.configuration + "_" +
         s.cells;
}

std::vector<Setting> settings(std::vector<std::string> const& configurations) {
  std::vector<Setting> r;
  for (auto const& configuration : configurations) {
    for (int dimension = 1; dimension <= 3; ++dimension)
      for (double const jitter : {0.0, 0.2}) r.push_back({dimension, jitter, configuration, "delaunay"});
    for (int dimension = 2; dimension <= 3; ++dimension) r.push_back({dimension, 0.0, configuration, "lattice_cells"});
  }
  return r;
}

Assembly assembly(Setting const& s, double speed) {
  Assembly a = busy_body(s.dimension, s.dimension == 1 ? 21 : s.dimension == 2 ? 7 : 4, s.jitter, speed);
  choose(a, "exchange", "adjoint");
  choose(a, "configuration", s.configuration);
  choose(a, "virtual_particles", s.cells);
  return a;
}

double mass_of(Formulation const& f) {
  // The momentum of a uniform motion at 1 m/s equals the mass.
  return f.diagnose().linear_momentum[0];
}

class AdjointExchange : public ::testing::TestWithParam<Setting> {};

/// E* falls by (1 - b) dt^2/2 (sum V_J L_J:D:L_J - sum W_i L_i:D:L_i) in each step; `stabilisation_loss` contains it.
TEST_P(AdjointExchange, BalancesEnergyInEveryStepToRoundOff) {
  for (double const memory : {0.0, 0.2, 1.0}) {
    // The balance is that of a fixed configuration without patterns of boxes.
    if (GetParam().cells == "lattice_cells") continue;
    Assembly a = assembly(GetParam(), 0.1);
    choose(a, "stress_retention", memory);
    auto const f = make_formulation(a);
    double const dt = f->stable_time_step();
    f->step(0, dt);
    double before = more(*f, "centred_energy"), lost = f->diagnose().stabilisation_loss;
    double const scale = f->diagnose().total_energy();
    for (int k = 1; k < 30; ++k) {
      f->step(k * dt, dt);
      double const now = more(*f, "centred_energy"), loss = f->diagnose().stabilisation_loss - lost;
      EXPECT_NEAR(now - before, -loss, 1e-13 * scale) << "step " << k << " memory " << memory;
      EXPECT_GE(loss, -1e-15 * scale) << "step " << k << " memory " << memory;
      if (memory == 1) {
        EXPECT_EQ(loss, 0);
      }
      before = now;
      lost += loss;
    }
    EXPECT_EQ(lost > 1e-6 * scale, memory < 1) << "the exchange damps what the corners' mean does not see";
  }
}

INSTANTIATE_TEST_SUITE_P(All, AdjointExchange, ::testing::ValuesIn(settings({"fixed"})),
                         [](auto const& p) { return name_of(p.param); });

class AdjointMotion : public ::testing::TestWithParam<Setting> {};

TEST_P(AdjointMotion, KeepsBothMomentaToRoundOff) {
  auto const f = make_formulation(assembly(GetParam(), 1));
  Diagnostics const first = f->diagnose();
  double scale = 0;
  for (double const p : first.linear_momentum) scale = std::max(scale, std::fabs(p));
  double time = 0;
  for (int k = 0; k < 20; ++k) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
  }
  Diagnostics const last = f->diagnose();
  EXPECT_FALSE(f->failure());
  EXPECT_GT(last.strain_energy, 1e-3 * last.kinetic_energy) << "something happened";
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(last.linear_momentum[c], first.linear_momentum[c], 1e-13 * scale);
    EXPECT_NEAR(last.angular_momentum[c], first.angular_momentum[c], 1e-13 * scale);
  }
}

/// The velocity gradient of a linear velocity is exact on any set, rim included: stress is D:d dt everywhere.
TEST_P(AdjointMotion, PassesThePatchTest) {
  Assembly a = assembly(GetParam(), 1);
  int const D = GetParam().dimension;
  double const rate = 1e-3;
  a.cfl = 1e-6;  // so short that the stress of the step does not change the velocity
  give_velocity(a, [&](Point const& X) {
    return Point{rate * (2 * X[0] + (D > 1 ? X[1] : 0)), D > 1 ? rate * (X[0] - X[1]) : 0, D > 2 ? rate * X[2] : 0};
  });
  auto const f = make_formulation(a);
  double const dt = f->stable_time_step();
  f->step(0, dt);
  auto const n = a.particles.X.size();
  Values const stress = sample(*f, "CauchyStress", n);
  Moduli const m(D);
  double const volume = D == 2 ? 1 : 2;
  double const along = D == 1 ? 2 * youngs_modulus : m.lambda * volume + 4 * m.mu;
  for (std::size_t i = 0; i < n; ++i) {
    EXPECT_NEAR(stress[6 * i] / (along * rate * dt), 1, 1e-8) << i;
    if (D > 1) {
      EXPECT_NEAR(stress[6 * i + 3] / (2 * m.mu * rate * dt), 1, 1e-8) << i;
    }
  }
}

TEST_P(AdjointMotion, IsTheSameOnEveryMachineAndThroughACheckpoint) {
  Assembly a = assembly(GetParam(), 1);
  Values reference;
  for (auto const& backend : backends()) {
    a.backend = backend;
    auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
    run(*whole, 9);
    double const time = run(*first, 4);
    SavedState checkpoint = saved(*first);
    second->load(checkpoint);
    EXPECT_EQ(second->diagnose().stabilisation_loss, first->diagnose().stabilisation_loss);
    EXPECT_EQ(more(*second, "centred_energy"), more(*first, "centred_energy"));
    run(*second, 5, time);
    EXPECT_EQ(whole_state(*whole), whole_state(*second)) << backend;
    if (reference.empty()) reference = whole_state(*whole);
    EXPECT_LT(largest_difference(whole_state(*whole), reference), 1e-9 * largest(reference)) << backend;
  }
}

INSTANTIATE_TEST_SUITE_P(All, AdjointMotion, ::testing::ValuesIn(settings({"updated"})),
                         [](auto const& p) { return name_of(p.param); });

/// A uniform stress puts no force on particles inside, and on those of the surface its traction: together none.
TEST(AdjointForces, OfAUniformStressVanishInsideOnAnySet) {
  for (int D = 2; D <= 3; ++D) {
    Setting const setting{D, 0.2, "fixed", "delaunay"};
    Assembly a = assembly(setting, 0);
    a.initial_velocity.clear();
    choose(a, "stress_retention", 0.0);
    auto const f = make_formulation(a);
    give_stress(*f, a, [&](Point const&) { return std::array<double, 6>{1, 2, 0.5, 0.3, 0.2, 0.1}; });
    double const dt = f->stable_time_step();
    f->step(0, dt);
    auto const n = a.particles.X.size();
    Values const v = sample(*f, "Velocity", n);
    double rim = 0, inside = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        double& most = is_on_edge(a.particles.X[i], D) ? rim : inside;
        most = std::max(most, std::fabs(v[3 * i + c]));
      }
    EXPECT_GT(rim, 0);
    EXPECT_LT(inside, 1e-13 * rim) << D;
    EXPECT_LT(std::fabs(f->diagnose().linear_momentum[0]), 1e-13 * rim * density);
  }
}

/// A traction's impulse and work are those of its force, to round-off, whatever the set.
TEST(AdjointLoads, HaveTheImpulseAndWorkOfTheirForce) {
  Assembly a = assembly({2, 0.2, "updated", "delaunay"}, 0);
  a.initial_velocity.clear();
  Load& l = load(a, {"300", "40*t", "0"}, [](Point const& X) { return X[0] > 1 - 1e-9; });
  l.normal = Point{1, 0, 0};
  auto const f = make_formulation(a);
  double time = 0, push = 0;
  for (int k = 0; k < 10; ++k) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    // 1 m of a side that hardly deforms; its length is that of half time.
    push += dt * 300;
    time += dt;
  }
  Diagnostics const d = f->diagnose();
  EXPECT_NEAR(d.linear_momentum[0], push, 2e-3 * push);
  EXPECT_GT(d.external_work, 0);
  double const booked = more(*f, "centred_energy") + d.stabilisation_loss - d.external_work;
  EXPECT_NEAR(booked, 0, 3e-3 * d.external_work) << "the side moves by a fraction of a per cent of its length";
}

/// In a fixed configuration the energy balance closes to round-off: energy, loss, work of tractions, of accelerations
/// and of driven and oblique supports.
TEST(AdjointLoads, CloseTheBooksOfEnergy) {
  for (int D = 1; D <= 3; ++D) {
    Assembly a = assembly({D, 0.2, "fixed", "delaunay"}, 0.1);
    drive(a, {true, false, false}, {"0.2*cos(3*t)", "0", "0"}, [](Point const& X) { return X[0] < 1e-9; });
    load(a, {"1", "0", "0"}, everywhere);
    Load& l = load(a, {"30", "0", "0"}, [](Point const& X) { return X[0] > 1 - 1e-9; });
    l.normal = Point{1, 0, 0};
    auto const f = make_formulation(a);
    double const dt = f->stable_time_step();
    f->step(0, dt);
    auto const energy_totals = [&] {
      Diagnostics const d = f->diagnose();
      return more(*f, "centred_energy") + d.stabilisation_loss - d.external_work;
    };
    double const before = energy_totals();
    for (int k = 1; k < 25; ++k) f->step(k * dt, dt);
    EXPECT_GT(std::fabs(f->diagnose().external_work), 1e-3 * f->diagnose().total_energy());
    // Speeds that change within a step are those of its ends in the forces, too: nothing is lost.
    EXPECT_NEAR(energy_totals(), before, 1e-12 * f->diagnose().total_energy()) << D;
  }
}

/// Uniform motion by 1 m/s has the momentum of the mass: the shares of the cells are the whole body.
TEST(AdjointMasses, AreThoseOfTheBody) {
  for (int D = 1; D <= 3; ++D)
    for (double const jitter : {0.0, 0.2}) {
      Assembly a = assembly({D, jitter, "updated", "delaunay"}, 0);
      give_velocity(a, [](Point const&) { return Point{1, 0, 0}; });
      EXPECT_NEAR(mass_of(*make_formulation(a)), density, 1e-12 * density);
    }
}

/// A disc that turns freely: the kernel estimates part positions from stress at the corners of its steps and gain 53
/// times the energy in nine turns.
TEST(AdjointDisc, TurnsTwiceWithoutGainingEnergy) {
  ParticleSet set;
  ShapeSpec disc;
  disc.dimension = 2;
  disc.kind = ShapeSpec::Kind::sphere;
  disc.radius = 0.5;
  disc.spacing = 0.1;
  fill(disc, "disc", set);
  Assembly a = assemble_taylor(set);
  choose(a, "exchange", "adjoint");
  // 3 rad/s in a body with 10 times the stiffness of this one.
  double const rate = 3 / std::sqrt(10.0);
  give_velocity(a, [&](Point const& X) { return Point{-rate * X[1], rate * X[0], 0}; });
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  double lowest = start, rise = 0;
  for (double time = 0; time < 2 * 2 * 3.14159265 / rate;) {
    time = run(*f, 100, time);
    double const now = f->diagnose().total_energy();
    rise = std::max(rise, now - lowest);
    lowest = std::min(lowest, now);
  }
  EXPECT_LT(rise, 1e-3 * start);
  EXPECT_GT(lowest, (1 - 5e-3) * start);
  EXPECT_GT(f->diagnose().jacobian_min, 0.98);
  EXPECT_LT(f->diagnose().jacobian_max, 1.02);
}

/// A wave's step on a lattice: boxes carry it one spacing per step, right-angled triangles two thirds.
TEST(AdjointStep, IsThatOfTheCellsStiffness) {
  for (auto const* cells : {"delaunay", "lattice_cells"}) {
    Assembly a = assembly({2, 0, "updated", cells}, 0);
    a.cfl = 1;
    double const share = cells == std::string("delaunay") ? 2.0 / 3 : 1;
    EXPECT_NEAR(make_formulation(a)->stable_time_step(), share / 6 / Moduli(2).speed(), 1e-9);
  }
}

/// The largest step of cells at random is stable: energy does not grow over many steps at 0.98 of it.
TEST(AdjointStep, HoldsOnAJitteredSet) {
  for (int D = 1; D <= 3; ++D) {
    Assembly a = assembly({D, 0.3, "fixed", "delaunay"}, 0.1);
    a.cfl = 0.98;
    auto const f = make_formulation(a);
    double const start = f->diagnose().total_energy();
    run(*f, 400);
    EXPECT_LT(f->diagnose().total_energy(), 1.01 * start) << D;
  }
}

}  // namespace
}  // namespace piola::testing
