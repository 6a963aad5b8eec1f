// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/temporary_folder.hpp"
#include "verification/surface_bodies.hpp"
#include <atomic>
#include <fmt/format.h>
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

/// Blocks of rubber with a spacing of 1 mm that hit rigid shapes narrower than that, or so thin that points of the
/// block could get past their middle.
namespace piola {
namespace {

using testing::column;
using testing::TemporaryFolder;

constexpr double block_mass = 1100 * 0.02 * 0.008;  // [kg/m]

std::string case_of(double milliseconds, double speed, std::string const& rest) {
  return fmt::format(R"toml(title = "A block hits a thin shape"
[run]
end = "{} ms"
[[body]]
name = "a"
material = {{ law = "neo_hookean", density = 1100, youngs_modulus = "5 MPa", poissons_ratio = 0.4 }}
formulation = {{ name = "nodal" }}
initial_velocity = ["0 m/s", "-{} m/s"]
[body.shape]
box = {{ min = ["0 mm", "0.5 mm"], max = ["20 mm", "8.5 mm"] }}
spacing = "1 mm"
placement = "cell_centred"
)toml",
                     milliseconds, speed) +
         rest;
}

std::string thin_box(double x_min, double y_min, double x_max, double y_max, std::string const& more = "") {
  return fmt::format(
             "[[rigid]]\nname = \"thin\"\nbox = {{ min = [\"{} mm\", \"{} mm\"], max = [\"{} mm\", \"{} mm\"] }}\n",
             x_min, y_min, x_max, y_max) +
         more;
}

std::string const needle = thin_box(10, -5, 10.4, 0);

Simulation built(std::string const& text) { return build(read_case_text(text, "case.toml")); }

/// Steps to the end of the run; the last state.
Diagnostics go(Simulation& s, std::function<void(Diagnostics const&)> const& look = {}) {
  double time = 0;
  while (time < s.spec.run.end && !s.formulation->failure()) {
    double const dt = s.formulation->stable_time_step();
    s.formulation->step(time, dt);
    time += dt;
    if (look) look(s.formulation->diagnose());
  }
  EXPECT_FALSE(s.formulation->failure().has_value());
  return s.formulation->diagnose();
}

/// The lowest particle [m].
double lowest(Simulation const& s) {
  std::vector<double> x(3 * s.particles.X.size());
  s.formulation->observables().sample("Position", x);
  double least = x[1];
  for (std::size_t k = 1; k < x.size(); k += 3) least = std::min(least, x[k]);
  return least;
}

// Spacings of 0.5 and 0.25 mm, which resolve the box, give the largest force 1420 N/m and throw the block back with
// 0.92 to 0.93 of its momentum.
TEST(ThinShapes, ANarrowBoxPushesAsOneThatIsResolved) {
  Simulation s = built(case_of(1.6, 3, needle));
  Diagnostics const start = s.formulation->diagnose();
  double force = 0;
  Diagnostics const end = go(s, [&](Diagnostics const& d) {
    ASSERT_EQ(d.actions.size(), 1U);
    force = std::max(force, d.actions[0].force[1]);
  });
  EXPECT_NEAR(force, 1420, 100);
  EXPECT_NEAR(end.linear_momentum[1] / (block_mass * 3), 0.92, 0.03);
  EXPECT_TRUE(end.passages.empty());
  EXPECT_NEAR((end.total_energy() - end.external_work) / start.total_energy(), 1, 2e-3);
}

// A block that is too fast for the spacing is pierced: it is slowed down, and the run says so.
TEST(ThinShapes, ANarrowBoxThatPiercesABlockIsTold) {
  TemporaryFolder const folder;
  Simulation s = built(case_of(1, 11, needle));
  Listener listener;
  std::atomic<int> stop{0};
  run_case(s, {.folder = folder / "r", .resume = false, .force = false}, listener, stop);
  Diagnostics const end = s.formulation->diagnose();
  EXPECT_GT(end.linear_momentum[1], -0.6 * block_mass * 11) << "it has lost much of its momentum";
  ASSERT_EQ(end.passages.size(), 1U);
  auto const summary = nlohmann::json::parse(testing::text_of(folder / "r/summary.json"));
  std::string const warnings = summary["warnings"].dump();
  std::string const expected = fmt::format("{} surface points of the rigid shape", end.passages[0].points);
  EXPECT_NE(warnings.find(expected), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("went through the surface of body"), std::string::npos) << warnings;
  EXPECT_EQ(summary["guards"]["overlap"]["points_through"], static_cast<double>(end.passages[0].points));
}

TEST(ThinShapes, APlateOfTwoSpacingsHoldsAFastBlock) {
  Simulation s = built(case_of(0.3, 80, thin_box(-50, -2, 50, 0)));
  double least = 1;
  Diagnostics const end = go(s, [&](Diagnostics const&) { least = std::min(least, lowest(s)); });
  EXPECT_GT(least, -0.001) << "no particle is past the middle of the plate";
  EXPECT_GT(end.linear_momentum[1], 0.5 * block_mass * 80) << "it bounces";
  EXPECT_TRUE(end.passages.empty());
}

TEST(ThinShapes, AFreePlateOfHalfASpacingTakesTheMomentum) {
  Simulation s = built(case_of(0.4, 30, thin_box(-50, -0.5, 50, 0, "motion = \"free\"\nmass = \"100 kg/m\"\n")));
  Diagnostics const start = s.formulation->diagnose();
  double least = 1;
  Diagnostics const end =
      go(s, [&](Diagnostics const& d) { least = std::min(least, lowest(s) - d.rigids.at(0).centre[1]); });
  EXPECT_GT(least, 0) << "no particle is past the middle of the plate";
  EXPECT_LT(100 * end.rigids[0].velocity[1], -1.5 * block_mass * 30) << "the block bounces";
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(end.linear_momentum[c], start.linear_momentum[c], 1e-12 * block_mass * 30);
    EXPECT_NEAR(end.angular_momentum[c], start.angular_momentum[c], 1e-11 * block_mass * 30);
  }
  EXPECT_NEAR((end.total_energy() - end.external_work) / start.total_energy(), 1, 2e-3);
}

// A driven plate of a fifth of a spacing with friction, whose end is under the block.
TEST(ThinShapes, ADrivenPlateLiftsABlock) {
  std::string const plate = thin_box(-30, -0.2, 12, 0, "velocity = [\"5 m/s\", \"20 m/s\"]\n");
  Simulation s = built(case_of(0.6, 0, plate + "[contact]\nfriction = 0.3\n"));
  Diagnostics const end = go(s);
  EXPECT_TRUE(end.passages.empty());
  EXPECT_GT(end.linear_momentum[1], 0.9 * block_mass * 20) << "it flies off";
  EXPECT_GT(column(end, "friction_heat"), 0);
  EXPECT_NEAR((end.total_energy() + column(end, "friction_heat")) / end.external_work, 1, 5e-3);
}

// A needle in the mirror plane of half a block moves it as a whole needle moves the whole block.
TEST(ThinShapes, HalfOfABlockMovesAsTheWhole) {
  std::string const middle = thin_box(9.8, -5, 10.2, 0), whole = case_of(0.8, 3, middle);
  std::string half = whole + "[[mirror]]\nbody = \"a\"\nface = \"+x\"\n";
  half.replace(half.find("max = [\"20 mm\""), 14, "max = [\"10 mm\"");
  Simulation one = built(whole), other = built(half);
  Diagnostics const a = go(one), b = go(other);
  EXPECT_GT(a.linear_momentum[1], -0.5 * block_mass * 3);
  EXPECT_NEAR(2 * b.linear_momentum[1], a.linear_momentum[1], 1e-3 * block_mass * 3);
}

TEST(ThinShapes, ResumeBitForBit) {
  CaseSpec const spec = read_case_text(
      case_of(1, 30,
              thin_box(-50, -0.5, 8.3, 0, "motion = \"free\"\nmass = \"1 kg/m\"\n") + "[contact]\nfriction = 0.2\n"),
      "case.toml");
  Assembly const a = assemble(spec);
  auto const run = [](Formulation& f, double& time, int steps) {
    for (int k = 0; k < steps; ++k) {
      double const dt = f.stable_time_step();
      f.step(time, dt);
      time += dt;
    }
  };
  auto const whole = make_formulation(a);
  double time = 0;
  while (!(column(whole->diagnose(), "contact_overlap") > 0.27)) run(*whole, time, 1);  // past the middle of the plate
  testing::expect_resumes(a, *whole, time, [&](Formulation& f, double& t) { run(f, t, 20); });
  testing::expect_same_on_threads(a, [&](Formulation& f, double& t) { run(f, t, 60); });
}

}  // namespace
}  // namespace piola
