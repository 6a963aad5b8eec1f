// SPDX-License-Identifier: Apache-2.0
#include "formulations/nodal/nodal_bodies.hpp"
#include <algorithm>

namespace piola::testing {
namespace {

/// A box bent and stretched unevenly, so that points of one cell differ.
Assembly bent_box(int dimension, MaterialParameters const& m, double jitter = 0.2) {
  Assembly a = nodal_body(unit_box(dimension, dimension == 3 ? 4 : 5, jitter), m);
  displace(a, [&](Point const& X) {
    Point u{0.05 * X[0] + 0.08 * X[0] * X[0], 0, 0};
    if (dimension > 1) u = {0.1 * X[1] + 0.1 * X[0] * X[1], -0.06 * X[0] + 0.1 * X[0] * X[0] * X[1], 0};
    if (dimension > 2) u[2] = 0.05 * X[0] * X[2] - 0.04 * X[1];
    return u;
  });
  return a;
}

double potential(Assembly const& a) { return make_formulation(a)->diagnose().strain_energy; }

/// -dPi/dx by central differences of fourth order.
double energy_slope(Assembly& a, std::size_t id, std::size_t c) {
  constexpr double step = 5e-4;
  double const before = a.initial_displacement[id][c];
  double sum = 0;
  for (auto const& [place, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
    a.initial_displacement[id][c] = before + place * step;
    sum -= weight * potential(a) / (12 * step);
  }
  a.initial_displacement[id][c] = before;
  return sum;
}

void expect_forces_of_energy(Assembly a, std::string const& what) {
  a.cfl = 0.1;
  auto const force = forces(a);
  for (std::size_t const id : {std::size_t{0}, a.particles.X.size() / 2, a.particles.X.size() - 2})
    for (std::size_t c = 0; c < static_cast<std::size_t>(a.particles.dimension); ++c)
      EXPECT_NEAR(force[id][c], energy_slope(a, id, c), 1e-8 * largest(force)) << what << " " << id << " " << c;
}

TEST(NodalForces, AreMinusTheDerivativeOfTheEnergy) {
  for (auto const& law : laws()) {
    if (law.hypoelastic || law.block != nullptr) continue;
    auto m = rubber(law.name, 0.4);
    for (std::size_t k = 3; k < law.parameters.size(); ++k) m.value[k] = law.parameters[k].default_value;
    for (int D = 1; D <= 3; ++D)
      for (double const jitter : {0.0, 0.2})
        expect_forces_of_energy(bent_box(D, m, jitter), std::string(law.name) + std::to_string(D));
    for (auto const& assumption : {"uniaxial_stress", "plane_stress"}) {
      Assembly a = bent_box(assumption == std::string("plane_stress") ? 2 : 1, m);
      choose(a, "assumption", assumption);
      expect_forces_of_energy(a, std::string(law.name) + assumption);
    }
  }
}

TEST(NodalObservers, SeeThePresentStateHoweverOftenTheyLook) {
  Assembly a = bent_box(3, rubber());
  std::size_t const n = a.particles.X.size();
  auto const seen = make_formulation(a), blind = make_formulation(a);
  double const dt = seen->stable_time_step();
  for (int k = 0; k < 4; ++k) {
    seen->diagnose();
    auto const before = sample(*seen, "Pressure", n);
    EXPECT_EQ(before, sample(*seen, "Pressure", n)) << "the second look";
    seen->step(k * dt, dt);
    blind->step(k * dt, dt);
    EXPECT_NE(before, sample(*seen, "Pressure", n)) << "of the new state";
  }
  EXPECT_EQ(sample(*seen, "CauchyStress", n), sample(*blind, "CauchyStress", n));
  EXPECT_EQ(seen->diagnose().strain_energy, blind->diagnose().strain_energy);
}

TEST(NodalForces, VanishUnderRigidRotation) {
  for (Cloud const& cloud : clouds()) {
    Assembly a = nodal_body(brick(3, cloud.jitter, {4, 5, 6}, cloud.seed));
    double const c = std::cos(1.1), s = std::sin(1.1);
    displace(a, [&](Point const& X) { return Point{(c - 1) * X[0] - s * X[1], s * X[0] + (c - 1) * X[1], 0.3}; });
    EXPECT_LT(largest(forces(a)), 1e-12 * 17e6);  // E times the area of a section
  }
}

/// Runs until `end` with the steps that the formulation asks for.
void run(Formulation& f, double end) {
  double time = 0;
  while (time < end) {
    double const dt = std::min(f.stable_time_step(), end - time);
    f.step(time, dt);
    time += dt;
  }
}

Assembly tumbling(int dimension, double jitter) {
  Assembly a = tumbling_box(dimension, 5, jitter);
  for (auto& f : a.formulations) f = {"nodal", {}, {}};
  return a;
}

TEST(NodalMotion, KeepsMomentaToRoundOffAndEnergyToTheSquareOfTheStep) {
  for (int D = 1; D <= 3; ++D)
    for (double const jitter : {0.0, 0.3}) {
      double error[2];
      for (int half = 0; half < 2; ++half) {
        Assembly a = tumbling(D, jitter);
        a.cfl = half == 0 ? 0.1 : 0.05;
        auto const f = make_formulation(a);
        auto const start = f->diagnose();
        run(*f, 0.02);
        auto const end = f->diagnose();
        EXPECT_GT(end.strain_energy, 0.002 * end.kinetic_energy);
        error[half] = std::fabs(end.total_energy() / start.total_energy() - 1);
        double const scale = std::sqrt(2 * start.kinetic_energy * 1100);
        for (std::size_t c = 0; c < 3; ++c) {
          EXPECT_NEAR(end.linear_momentum[c], start.linear_momentum[c], 1e-11 * scale);
          EXPECT_NEAR(end.angular_momentum[c], start.angular_momentum[c], 1e-11 * scale);
        }
      }
      EXPECT_LT(error[0], 1e-3) << D << " " << jitter;
      EXPECT_LT(error[1], 0.35 * error[0]) << D << " " << jitter;
    }
}

/// How far total energy goes up and down, over that of the start, while a body that is clamped at one end is wrung.
double wobble_of_energy(Cloud const& cloud, double tolerance) {
  Assembly a = nodal_body(brick(3, cloud.jitter, {4, 5, 6}, cloud.seed));
  a.formulations[0].numbers = {{"energy_tolerance", tolerance}};
  support(a, {true, true, true}, [](Point const& X) { return X[2] == 0; });
  give_velocity(a, [](Point const& X) { return Point{-90 * X[1] * X[2], 90 * X[0] * X[2], -40 * X[2]}; });
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  double low = start, high = start;
  for (double time = 0; time < 0.03;) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
    double const now = f->diagnose().total_energy();
    low = std::min(low, now);
    high = std::max(high, now);
  }
  EXPECT_FALSE(f->failure());
  return (high - low) / start;
}

TEST(NodalMotion, KeepsEnergyWithinTheToleranceThatIsAskedFor) {
  for (Cloud const& cloud : clouds({0.3}, 2)) {
    double const any = wobble_of_energy(cloud, 0);
    EXPECT_GT(any, 4e-4) << "steps at the limit of stability would do: " << cloud.jitter << " " << cloud.seed;
    for (double const tolerance : {3e-4, 1e-4}) {  // 6e-5 would need less than a fifth of the stable step
      double const wobble = wobble_of_energy(cloud, tolerance);
      EXPECT_LT(wobble, tolerance) << cloud.jitter << " " << cloud.seed;
      EXPECT_GT(wobble, 0.05 * tolerance) << "steps are shorter than they need be: " << cloud.jitter;
    }
  }
}

TEST(NodalMotion, IsTheSameForAnyNumberOfThreads) {
  Assembly const a = [] {
    Assembly big = nodal_body(unit_box(2, 66, 0.2));  // enough particles for three threads
    give_velocity(big, [](Point const& X) { return Point{5 * X[1], -4 * X[0] * X[0], 0}; });
    big.cfl = 0.3;
    return big;
  }();
  auto const f = make_formulation(a);
  SavedState start = saved(*f), reference;
  for (int const threads : {1, 2, 3, 7}) {
    Threads const used(threads);
    f->load(start);
    advance(*f, 1e-5, 3);
    if (threads == 1) reference = saved(*f);
    EXPECT_EQ(saved(*f).values, reference.values) << threads;
  }
  EXPECT_NE(start.values, reference.values);
}

TEST(NodalMotion, GoesOnBitForBitFromACheckpoint) {
  Assembly a = tumbling(3, 0.2);
  support(a, {true, true, true}, [](Point const& X) { return X[1] == 0; });
  load(a, {"3", "t*20", "X"}, everywhere).until = 2e-3;
  auto const whole = make_formulation(a), first = make_formulation(a), second = make_formulation(a);
  advance_by_itself(*whole, 0, 90);
  double const middle = advance_by_itself(*first, 0, 37);
  (void)first->diagnose();  // looking changes nothing
  auto state = saved(*first);
  second->load(state);
  advance_by_itself(*second, middle, 53);
  EXPECT_EQ(saved(*second).values, saved(*whole).values);
  EXPECT_EQ(second->diagnose().external_work, whole->diagnose().external_work);
}

TEST(NodalMotion, IsTheSameOnEveryMachineUpToRoundOff) {
  Assembly a = tumbling(3, 0.2);
  Values reference;
  for (auto const& backend : backends()) {
    a.backend = backend;
    auto const f = make_formulation(a);
    advance(*f, 1e-4, 20);
    auto const x = sample(*f, "Position", a.particles.X.size());
    if (reference.empty()) reference = x;
    EXPECT_LT(largest_difference(x, reference), 1e-12) << backend;
  }
}

TEST(NodalMotion, MeasuresItsStepWhenStrainsHaveChangedAndElseRarely) {
  auto const fewest_steps_between = [](double speed, std::string const& backend) {
    Assembly a = nodal_body(unit_box(3, 5));  // 125 particles: some slots have none
    a.backend = backend;
    give_velocity(a, [&](Point const& X) { return Point{speed * X[0] * X[0], 0, 0}; });
    auto const f = make_formulation(a);
    double time = 0, fewest = 1e9;
    for (int k = 0; k < 60; ++k) {
      double const dt = f->stable_time_step();
      f->step(time, dt);
      time += dt;
      double const steps = saved(*f).values.at("body0_step_limit")[3];
      if (steps > 0) fewest = std::min(fewest, steps);
    }
    return fewest;
  };
  for (auto const& backend : backends()) {
    EXPECT_EQ(fewest_steps_between(0.01, backend), 25) << backend;
    EXPECT_LT(fewest_steps_between(60, backend), 20) << backend;
  }
}

TEST(NodalMotion, TakesStepsThatTurnCellsInsideOutAgainInHalves) {
  Assembly a = nodal_body(unit_box(3, 5));
  give_velocity(a, [](Point const& X) { return Point{X[0] > 0.9 ? -250.0 : 0.0, 0, 0}; });
  a.cfl = 0.226;  // for itself it would take a fifth of that
  auto const f = make_formulation(a);
  double const start = f->diagnose().total_energy();
  f->step(0, f->stable_time_step());
  EXPECT_FALSE(f->failure());
  auto const d = f->diagnose();
  EXPECT_GT(d.more[1].second, 0) << "no cell was turned inside out";
  EXPECT_GT(d.more[0].second, 0);
  EXPECT_NEAR(d.total_energy(), start, 0.2 * start);
}

TEST(NodalSupports, HoldDriveAndReleaseAndCountTheirWork) {
  Assembly a = nodal_body(brick(3, 0.2));
  support(a, {true, true, true}, [](Point const& X) { return X[2] == 0; });
  Support& pull = support(a, {false, false, false}, [](Point const& X) { return X[2] > 1.09; });
  pull.frame = Support::Frame::normal;
  pull.normal = {0.6, 0, 0.8};
  pull.velocity = formulas({"300*t*0.6", "0", "300*t*0.8"});
  pull.until = 0.01;
  a.cfl = 0.2;
  auto const f = make_formulation(a);
  double time = 0;
  while (time < 0.01 * (1 - 1e-9)) {
    double const dt = f->stable_time_step();
    f->step(time, dt);
    time += dt;
  }
  auto const u = sample(*f, "Displacement", a.particles.X.size());
  for (std::size_t id = 0; id < a.particles.X.size(); ++id) {
    double const* const of = &u[3 * id];
    if (a.particles.X[id][2] == 0) {
      EXPECT_EQ(std::fabs(of[0]) + std::fabs(of[1]) + std::fabs(of[2]), 0);
    }
    if (a.particles.X[id][2] > 1.09) {
      EXPECT_NEAR(0.6 * of[0] + 0.8 * of[2], 0.015, 1e-12);
    }
  }
  auto const pulled = f->diagnose();
  EXPECT_GT(pulled.strain_energy, 0);
  EXPECT_NEAR(pulled.total_energy(), pulled.external_work, 1e-3 * pulled.external_work);
  for (int k = 0; k < 50; ++k, time += f->stable_time_step()) f->step(time, f->stable_time_step());
  EXPECT_EQ(f->diagnose().external_work, pulled.external_work) << "released";
}

// The step limit is objective: only its random start and the accuracy of the measured frequency, 5 % of the square,
// tell directions apart.
TEST(NodalStep, TakesAsManyStepsIfTheCaseIsRotated) {
  for (double const jitter : {0.0, 0.3}) {
    std::vector<int> steps;
    for (double const angle : {0.0, 0.7}) {
      double const c = std::cos(angle), s = std::sin(angle);
      Assembly a = tumbling_box(3, 5, jitter);
      for (auto& f : a.formulations) f = {"nodal", {}, {}};
      for (Point& v : a.initial_velocity) v = {c * v[0] - s * v[1], s * v[0] + c * v[1], v[2]};
      displace(a, [&](Point const& X) { return Point{(c - 1) * X[0] - s * X[1], s * X[0] + (c - 1) * X[1], 0}; });
      auto const f = make_formulation(a);
      int count = 0;
      for (double time = 0; time < 0.05; ++count) {
        double const dt = f->stable_time_step();
        f->step(time, dt);
        time += dt;
      }
      steps.push_back(count);
    }
    EXPECT_GT(steps[0], 100);
    EXPECT_NEAR(steps[1], steps[0], 0.03 * steps[0]) << jitter;
  }
}

TEST(NodalLoads, OfConstantAccelerationMoveAFreeBodyAsAWhole) {
  Assembly a = nodal_body(brick(3, 0.3));
  load(a, {"0", "-9.81", "2"}, everywhere);
  auto const f = make_formulation(a);
  advance(*f, 2e-4, 50);
  auto const u = sample(*f, "Displacement", a.particles.X.size());
  for (std::size_t id = 0; id < a.particles.X.size(); ++id) {
    EXPECT_NEAR(u[3 * id + 1], -0.5 * 9.81 * 1e-4, 1e-13);
    EXPECT_NEAR(u[3 * id + 2], 1e-4, 1e-13);
  }
  auto const d = f->diagnose();
  EXPECT_NEAR(d.external_work, d.kinetic_energy, 1e-10 * d.kinetic_energy);
}

}  // namespace
}  // namespace piola::testing
