// SPDX-License-Identifier: Apache-2.0
// Cells of the nodal formulation that become Eulerian.
#include "piola/formulations/nodal/eulerian_cell.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include "support/key_words.hpp"

namespace piola::testing {
namespace {

using test::expect_words;

constexpr double density = 2700, size = 0.01;

MaterialParameters metal() {
  MaterialParameters m = material("perfectly_plastic", density, 69e9, 0.33);
  auto const& parameters = law_of(m).parameters;
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    if (parameters[k].name == "yield_stress") m.value[k] = 0.3e9;
    if (parameters[k].name == "specific_heat") m.value[k] = 900;
  }
  return m;
}

/// A block that is pressed, sheared and turned, so that cells of its middle convert at `strain` and others later.
Assembly stirred_block(int dimension, double strain) {
  ShapeSpec shape;
  shape.dimension = dimension;
  shape.max = {size, size, dimension > 2 ? size : 0};
  shape.particles = dimension > 2 ? std::array{9, 9, 9} : std::array{13, 13, 1};
  ParticleSet set;
  fill(shape, "block", set);
  Assembly a = nodal_body(std::move(set), metal());
  a.formulations[0].words["conversion"] = "eulerian";
  choose(a, "convert_strain", strain);
  give_velocity(a, [](Point const& X) {
    double const x = X[0] / size - 0.5, y = X[1] / size - 0.5, squeeze = 300 * std::exp(-8 * (x * x + y * y));
    return Point{-2 * squeeze * x + 100 * y, squeeze * y - 80 * x, 20 * x};
  });
  return a;
}

/// Advances to `end` [s] with steps of `share` of the stable one. Returns the number of steps.
int advance_to(Formulation& f, double end, double share = 1) {
  int steps = 0;
  for (double time = 0; time < end; ++steps) {
    double const dt = std::min(share * f.stable_time_step(), end - time);
    f.step(time, dt);
    time += dt;
  }
  EXPECT_FALSE(f.failure().has_value());
  return steps;
}

/// A cell under uniaxial strain, as the only one of its kind among neighbours that move uniformly: `before` and `after`
/// are the strain times the sum that is 1 inside a body.
TEST(NodalEulerian, CellFollowsTheLawAndTakesUpTheWorkOfItsStress) {
  nodal::MaterialRange const range{metal(), {}, 0, 1, {}};
  double const V0 = 2e-9, dt = 1e-8, strain = -1e-3;
  nodal::EulerianCell cell;
  cell.V0 = V0;
  double work = 0;
  for (int k = 0; k < 20; ++k) {
    nodal::EulerianStep step;
    step.dt = dt;
    step.strain(0, 0) = step.before(0, 0) = step.after(0, 0) = strain;
    step.J = cell.J * std::exp(strain);
    work += 0.5 * cell.volume() * cell.stress()(0, 0) * strain;
    advance(cell, range, step);
    work += 0.5 * cell.volume() * cell.stress()(0, 0) * strain;
  }
  EXPECT_NEAR(cell.energy * density * V0, work, 1e-9 * work);
  double const bulk = 69e9 / (3 * (1 - 2 * 0.33)), J = std::exp(20 * strain);
  EXPECT_NEAR(cell.pressure, bulk * (1 / J - 1), 0.01 * cell.pressure);
  EXPECT_NEAR(von_mises(cell.history.S), 0.3e9, 1);
  EXPECT_NEAR(cell.stress()(0, 0), -cell.pressure - 0.2e9, 1);
  // In tension and softened entirely nothing is left.
  cell.softening = 1;
  for (int k = 0; k < 40; ++k) {
    nodal::EulerianStep step;
    step.dt = dt;
    step.strain(0, 0) = -strain;
    step.J = cell.J * std::exp(-strain);
    advance(cell, range, step);
  }
  for (double const s : cell.stress().c) EXPECT_EQ(s, 0);
}

/// Momentum is kept to round-off, energy as in Verlet steps: its error falls with the square of the step.
TEST(NodalEulerian, KeepsMomentumAndEnergy) {
  for (int const dimension : {2, 3}) {
    Assembly const a = stirred_block(dimension, 0.01);
    double drift[2];
    for (int half = 0; half < 2; ++half) {
      auto const f = make_formulation(a);
      Diagnostics const start = f->diagnose();
      advance_to(*f, 3e-6, half == 0 ? 1 : 0.25);
      Diagnostics const end = f->diagnose();
      double const scale = std::sqrt(2 * start.kinetic_energy * density * size * size);
      for (std::size_t c = 0; c < 3; ++c)
        EXPECT_NEAR(end.linear_momentum[c], start.linear_momentum[c], 1e-13 * scale) << dimension << ' ' << c;
      drift[half] = std::abs(end.total_energy() / start.total_energy() - 1);
      double const converted = column(*f, "failed_particles"), all = static_cast<double>(a.particles.X.size());
      EXPECT_GT(converted, 0.2 * all);
      EXPECT_LT(converted, 0.95 * all);
    }
    EXPECT_LT(drift[0], 1e-3) << dimension;
    EXPECT_LT(drift[1], 0.25 * drift[0] + 2e-5) << dimension;
  }
}

/// Cells that convert at once, of a body in uniform motion, press as those that do not.
TEST(NodalEulerian, PressesAsCellsThatFollowGradients) {
  for (int const dimension : {2, 3}) {
    auto const inner_pressure = [&](double strain) {
      Assembly a = stirred_block(dimension, strain);
      give_velocity(a, [](Point const& X) { return Point{-2000 * X[0], -2000 * X[1], -2000 * X[2]}; });
      auto const f = make_formulation(a);
      advance_to(*f, 3e-8, 0.1);  // before the faces are felt
      std::vector<double> p(a.particles.X.size());
      f->observables().sample("CellPressure", p);
      double sum = 0, count = 0;
      for (std::size_t k = 0; k < p.size(); ++k) {
        Point const& X = a.particles.X[k];
        bool const inside = std::abs(X[0] / size - 0.5) < 0.15 && std::abs(X[1] / size - 0.5) < 0.15 &&
                            (dimension < 3 || std::abs(X[2] / size - 0.5) < 0.15);
        if (inside) sum += p[k], ++count;
      }
      EXPECT_EQ(column(*f, "failed_particles"), strain < 1 ? static_cast<double>(p.size()) : 0);
      return sum / count;
    };
    double const expected = inner_pressure(1e9);
    EXPECT_LT(expected, -5e6);
    EXPECT_NEAR(inner_pressure(0), expected, 0.01 * std::abs(expected)) << dimension;
  }
}

TEST(NodalEulerian, HasTheSameBitsOnThreadsAndFromCheckpoints) {
  Assembly const a = stirred_block(2, 0.01);
  auto const run = [&](std::vector<double> const& stops) { return state_after(a, stops, 10); };
  auto const alone = [&] {
    Threads const one(1);
    return run({3e-6});
  }();
  Threads const three(3);
  for (auto const& [name, values] : run({3e-6})) EXPECT_TRUE(values == alone.at(name)) << name << " on threads";
  for (auto const& [name, values] : run({1e-6, 2e-6, 3e-6}))
    EXPECT_TRUE(values == alone.at(name)) << name << " from checkpoints";
}

TEST(NodalEulerian, RefusesWhatItDoesNotSupport) {
  auto const refused = [](auto const& change) {
    Assembly a = stirred_block(2, 0.1);
    change(a);
    return refusal(a);
  };
  expect_words(refused([](Assembly& a) { a.materials[0] = rubber(); }), {"conversion", "rate form"});
  expect_words(refused([](Assembly& a) { choose(a, "fluctuation_viscosity", 0.05); }),
               {"fluctuation_viscosity", "conversion"});
  expect_words(refused([](Assembly& a) { a.formulations[0].words.erase("conversion"); }),
               {"convert_strain", "conversion"});
  expect_words(refused([](Assembly& a) { a.particles.axisymmetric = true; }), {"axisymmetric", "conversion"});
}

}  // namespace
}  // namespace piola::testing
