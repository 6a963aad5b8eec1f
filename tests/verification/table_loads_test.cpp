// SPDX-License-Identifier: Apache-2.0
// Loads, supports and rigid shapes whose values are tables: impulses, displacements, and the same formulas.
#include "piola/base/text.hpp"
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include <cmath>
#include <gtest/gtest.h>

namespace piola {
namespace {

using Point = std::array<double, 3>;

constexpr double end = 1e-3;  // [s]

/// A free block with a material of the formulation, and further sections; step in seconds.
std::string block(std::string const& formulation, double step, std::string const& more) {
  std::string const law = formulation == "adaptle"      ? "elastic"
                          : formulation == "taylor_sph" ? "linear_elastic"
                                                        : "neo_hookean";
  return "title = \"t\"\n[run]\nend = \"1 ms\"\nthreads = 1\nmax_step = " + exact_text(step) +
         "\n[[body]]\nname = \"block\"\nshape = { box = { min = [0, 0], max = [\"20 mm\", \"10 mm\"] }, spacing = \"2 "
         "mm\" "
         "}\nmaterial = { law = \"" +
         law + "\", density = 1000, youngs_modulus = \"10 kPa\", poissons_ratio = 0.3 }\n" +
         "formulation = { name = \"" + formulation + "\" }\n" + more;
}

/// The last state of a case that is run to its end with steps of its max_step.
Diagnostics run(std::string const& text, std::vector<std::vector<double>>* positions = nullptr) {
  Simulation s = build(read_case_text(text, "case.toml"));
  int const steps = static_cast<int>(std::lround(end / s.spec.run.max_step));
  double const dt = end / steps;
  EXPECT_LE(dt, s.formulation->stable_time_step() * 1.0001);
  for (int k = 0; k < steps; ++k) s.formulation->step(k * dt, dt);
  EXPECT_FALSE(s.formulation->failure().has_value());
  if (positions != nullptr) {
    std::vector<double> u(3 * static_cast<std::size_t>(s.particles.size()));
    s.formulation->observables().sample("Displacement", u);
    positions->push_back(u);
  }
  return s.formulation->diagnose();
}

std::string pushed_by(std::string const& value) {
  return "[[load]]\nbody = \"block\"\nbody_force = [" + value + ", 0]\n";
}

/// Triangle with the corners 0.1 ms, 0.4 ms and 0.8 ms, 0.5 MN/m^3 high: 175 N s/m^3.
constexpr char const* triangle = "{ table = [[0, 0], [\"0.1 ms\", 0], [\"0.4 ms\", 5e5], [\"0.8 ms\", 0]] }";
constexpr double impulse = 0.5 * 0.7e-3 * 5e5 * 0.02 * 0.01;  // on the block [N s/m]

class TableLoads : public ::testing::TestWithParam<std::string> {};

TEST_P(TableLoads, GiveAFreeBodyTheirImpulse) {
  Diagnostics const on_rows = run(block(GetParam(), 1e-5, pushed_by(triangle)));
  EXPECT_NEAR(on_rows.linear_momentum[0] / impulse, 1, 1e-12) << "steps that end at the rows";
  // A corner inside a step of length h costs at most h^2/8 of the jump of the slope.
  double const h = 1e-3 / 97, jumps = 5e5 * (1 / 0.3e-3 + (1 / 0.3e-3 + 1 / 0.4e-3) + 1 / 0.4e-3);
  Diagnostics const between = run(block(GetParam(), h, pushed_by(triangle)));
  double const error = std::abs(between.linear_momentum[0] - impulse);
  EXPECT_LE(error, h * h / 8 * jumps * 0.02 * 0.01);
  EXPECT_GT(error, 1e-9 * impulse) << "it is not exact";
  EXPECT_NEAR(run(block(GetParam(), 1e-5, pushed_by("{ table = [[0, 0], [1, 1]], after = \"zero\", scale = 0 }")))
                  .linear_momentum[0],
              0, 1e-15);
}

TEST_P(TableLoads, AreTheFormulaOfTheSameLines) {
  std::string const formula =
      "\"t < 1e-4 ? 0 : t < 4e-4 ? (t - 1e-4)/3e-4*5e5 : t < 8e-4 ? 5e5 - (t - 4e-4)/4e-4*5e5 : 0\"";
  std::vector<std::vector<double>> u;
  Diagnostics const table = run(block(GetParam(), 1e-5, pushed_by(triangle)), &u);
  Diagnostics const formulas = run(block(GetParam(), 1e-5, pushed_by(formula)), &u);
  EXPECT_NEAR(table.linear_momentum[0] / formulas.linear_momentum[0], 1, 1e-13);
  ASSERT_EQ(u.size(), 2U);
  for (std::size_t k = 0; k < u[0].size(); k += 3) ASSERT_NEAR(u[0][k] / u[1][k], 1, 1e-10) << k;
}

TEST_P(TableLoads, MoveSupportsByTheirDisplacement) {
  std::vector<std::vector<double>> u;
  run(block(
          GetParam(), 1e-5,
          "[[support]]\nbody = \"block\"\nwhere = \"X < 0.5e-3\"\nfix = \"x\"\n"
          "velocity = [{ table = [[0, 0], [\"0.5 ms\", \"10 um\"], [\"1 ms\", \"30 um\"]], derivative = true }, 0]\n"),
      &u);
  EXPECT_NEAR(u[0][0], 30e-6, 0.2e-6) << "a step across a kink takes one of both slopes";
}

INSTANTIATE_TEST_SUITE_P(All, TableLoads, ::testing::Values("nodal", "jst_sph", "taylor_sph", "adaptle"),
                         [](auto const& at) { return at.param; });

TEST(TableDrives, MoveARigidShapeAlongTheTable) {
  auto const at = [](std::string const& value) {
    Diagnostics const d =
        run(block("nodal", 1e-5,
                  "[[rigid]]\nname = \"die\"\nsphere = { centre = [\"40 mm\", 0], radius = \"5 mm\" }\n"
                  "velocity = [" +
                      value + ", 0]\nangular_velocity = [1]\n"));
    return d.rigids.at(0).centre[0];
  };
  // Velocities are taken in the middle of steps: exact where a table is straight in each.
  EXPECT_NEAR(at("{ table = [[0, 0], [\"0.5 ms\", \"2 m/s\"], [\"1 ms\", \"1 m/s\"]] }"), 0.04 + 0.5e-3 + 0.75e-3,
              1e-14);
  EXPECT_NEAR(at("{ table = [[0, \"1 mm\"], [\"0.5 ms\", \"2 mm\"], [\"1 ms\", \"-1 mm\"]], derivative = true }"),
              0.04 - 2e-3, 1e-14);
}

TEST(TableProfiles, GiveAnInitialVelocityOverAPlace) {
  std::string text = block("nodal", 1e-5, "");
  text += "initial_velocity = [0, { table = [[0, 0], [\"10 mm\", \"4 m/s\"]], over = \"X - Y\", after = \"zero\" }]\n";
  Simulation const s = build(read_case_text(text, "case.toml"));
  std::vector<double> v(3 * static_cast<std::size_t>(s.particles.size()));
  s.formulation->observables().sample("Velocity", v);
  for (std::size_t k = 0; k < s.particles.X.size(); ++k) {
    double const x = s.particles.X[k][0] - s.particles.X[k][1];
    if (std::abs(x - 0.01) < 1e-9) continue;  // the jump
    EXPECT_NEAR(v[3 * k + 1], x < 0 || x > 0.01 ? 0 : 400 * x, 1e-12);
  }
}

}  // namespace
}  // namespace piola
