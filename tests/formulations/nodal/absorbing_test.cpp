// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include <fmt/format.h>
#include <numeric>

namespace piola::testing {
namespace {

std::string const packed_bar =
    "shape = { spacing = 0.2, arrangement = \"packed\", box = { min = [0, 0, 0], max = [1.06, 0.68, 0.72] } }\n";

/// A case of one body of linear elastic material: c_p = 100 m/s, c_s = 50 m/s, density 1000 kg/m3.
Simulation body_with(std::string const& more, std::string const& shape = packed_bar) {
  return build(
      read_case_text("title = \"Absorbed\"\n[run]\nend = \"1 s\"\ncfl = 0.2\n[[body]]\nname = \"body\"\n" + shape +
                         "material = { law = \"linear_elastic\", density = 1000, youngs_modulus = 6666666.6666666667, "
                         "poissons_ratio = 0.33333333333333333 }\nformulation = { name = \"nodal\" }\n" +
                         more,
                     "absorbed.toml"));
}

std::string absorbing(std::string const& where, std::string const& more = "") {
  return "[[load]]\nname = \"end\"\nbody = \"body\"\n" + where + "\nnon_reflecting = true\n" + more;
}

std::string const stretching = "initial_velocity = [\"3*X+2*Y\", \"4*X*Y\", \"3*X*X\"]\n";

double radiated(Diagnostics const& d) {
  for (auto const& [name, value] : d.more)
    if (name == "radiated_energy") return value;
  return 0;
}

/// Amplitude of what is left of a pulse that has left a bar along x, whose sides do not move across it.
double left_of_pulse(std::string const& shape, std::string const& sides) {
  auto const simulation =
      body_with("initial_velocity = [\"exp(-((X-0.5)/0.1)^2)\"" +
                    std::string(shape.find("min = [0]") == std::string::npos ? ", \"0\"" : "") + "]\n" + sides +
                    absorbing("face = \"-x\"") + "[[load]]\nbody = \"body\"\nface = \"+x\"\nnon_reflecting = true\n",
                shape);
  auto& f = *simulation.formulation;
  auto const start = f.diagnose();
  double time = 0;
  while (time < 0.012) time = advance_by_itself(f, time, 1);
  auto const end = f.diagnose();
  EXPECT_NEAR(radiated(end) + end.total_energy(), start.total_energy(), 2e-4 * start.total_energy());
  return std::sqrt(end.total_energy() / start.total_energy());
}

TEST(AbsorbingPatch, LeavesNothingOfAPulseThatMeetsItHeadOn) {
  std::string const sides = "[[support]]\nbody = \"body\"\nwhere = \"Y > -1\"\nfix = \"y\"\n";
  for (std::string const more : {"", ", placement = \"cell_centred\"", ", jitter = 0.2"}) {
    EXPECT_LT(left_of_pulse("shape = { box = { min = [0], max = [1] }, particles = [61]" + more + " }\n", ""), 0.02)
        << more;
    EXPECT_LT(
        left_of_pulse("shape = { box = { min = [0, 0], max = [1, 0.1] }, particles = [61, 7]" + more + " }\n", sides),
        0.02)
        << more;
  }
}

TEST(AbsorbingPatch, BearsTheTractionOfItsMaterialWhereABodyMoves) {
  for (auto const& [more, normal, shear] : {std::tuple{"", 1.0, 1.0}, {"impedance = [0.5, 3]\n", 0.5, 3.0}}) {
    auto const simulation = body_with("initial_velocity = [\"2\", \"0\", \"3\"]\n" + absorbing("patch = \"+x\"", more));
    auto& f = *simulation.formulation;
    double const dt = 1e-9;
    f.step(0, dt);
    auto const force = f.diagnose().actions.at(0).force;
    double const area = 0.68 * 0.72;
    EXPECT_NEAR(force[0], -normal * 1000 * 100 * 2 * area, 1e-4 * 2e5 * area);
    EXPECT_NEAR(force[1], 0, 1e-4 * 2e5 * area);
    EXPECT_NEAR(force[2], -shear * 1000 * 50 * 3 * area, 1e-4 * 2e5 * area);
  }
}

/// The dashpots meet the moving body at once: a jump, after which energy is kept to the error of Verlet steps. The
/// bounds of 3 % and 0.2 % were set after a first run.
TEST(AbsorbingPatch, TakesTheEnergyThatItReportsToSecondOrder) {
  for (std::string const more : {"", "background_velocity = [\"5*t\", \"1\", \"Y\"]\n", "angle = \"40 degrees\"\n"}) {
    double error[2];
    for (int const half : {0, 1}) {
      auto const simulation = body_with(stretching + absorbing("patch = \"+x\"", more));
      auto& f = *simulation.formulation;
      auto const start = f.diagnose();
      double const dt = f.stable_time_step() / (1 + half);
      for (int k = 0; k < 60 * (1 + half); ++k) f.step(k * dt, dt);
      auto const end = f.diagnose();
      EXPECT_GT(radiated(end), 0.1 * start.total_energy());
      error[half] = std::fabs(end.total_energy() + radiated(end) - end.external_work - start.total_energy());
      EXPECT_LT(error[half], (half ? 2e-3 : 0.03) * start.total_energy());
    }
    EXPECT_LT(error[1], 0.4 * error[0]) << more;
  }
}

TEST(AbsorbingPatch, HasForcesThatWithThoseOfSupportsSumToTheChangeOfMomentum) {
  auto const simulation =
      body_with(stretching +
                "[[support]]\nbody = \"body\"\npatch = \"-y\"\nfix = \"y\"\nhold = \"particles\"\n"
                "[[support]]\nbody = \"body\"\npatch = \"-z\"\nfix = \"xz\"\nhold = \"particles\"\n" +
                absorbing("patch = \"+x\""));
  auto& f = *simulation.formulation;
  double const dt = f.stable_time_step();
  auto before = f.diagnose();
  for (int k = 0; k < 20; ++k) {
    f.step(k * dt, dt);
    auto const now = f.diagnose();
    for (std::size_t c = 0; c < 3; ++c) {
      double force = 0;
      for (Action const& action : now.actions) force += action.force[c];
      EXPECT_NEAR(now.linear_momentum[c] - before.linear_momentum[c], dt * force, 1e-9) << k;
    }
    before = now;
  }
  EXPECT_NE(before.actions.back().force[0], 0);
}

TEST(AbsorbingPatch, IsTheSameForAnyNumberOfThreadsAndGoesOnBitForBit) {
  std::string const text = stretching + absorbing("patch = \"+x\"", "until = \"5 ms\"\n") +
                           "[[support]]\nbody = \"body\"\npatch = \"-y\"\nfix = \"y\"\nhold = \"particles\"\n";
  expect_same_bits([&] { return body_with(text); }, 27, 60);
}

TEST(AbsorbingPatch, DoesNotShortenTheStep) {
  std::string const free = "title = \"Step\"\n[run]\nend = \"1 s\"\n[[body]]\nname = \"body\"\n" + packed_bar +
                           "material = { law = \"neo_hookean\", density = 1000, youngs_modulus = 1e7, poissons_ratio = "
                           "0.3 }\nformulation = { name = \"nodal\" }\n" +
                           stretching;
  auto const without = build(read_case_text(free, "free.toml"));
  auto const with = build(read_case_text(free + absorbing("patch = \"+x\""), "absorbed.toml"));
  EXPECT_EQ(with.formulation->stable_time_step(), without.formulation->stable_time_step());
  auto& f = *with.formulation;
  auto const start = f.diagnose();
  advance_by_itself(f, 0, 500);
  auto const end = f.diagnose();
  EXPECT_NEAR(end.total_energy() + radiated(end), start.total_energy(), 2e-3 * start.total_energy());
}

TEST(AbsorbingPatch, BesideAMirrorPlaneIsHalfOfTheWholeBody) {
  auto const shape = [](char const* low) {
    return fmt::format("shape = {{ box = {{ min = [0, {}], max = [1, 0.5] }}, spacing = 0.1 }}\n", low);
  };
  std::string const moving = "initial_velocity = [\"X*(1-Y*Y)\", \"X*Y\"]\n", end = absorbing("face = \"+x\"");
  auto const whole = body_with(moving + end, shape("-0.5"));
  auto const part = body_with(moving + end + "[[mirror]]\nbody = \"body\"\nface = \"-y\"\n", shape("0"));
  for (auto* f : {whole.formulation.get(), part.formulation.get()})
    for (int k = 0; k < 80; ++k) f->step(k * 1e-4, 1e-4);
  double const of_whole = radiated(whole.formulation->diagnose());
  EXPECT_GT(of_whole, 0);
  EXPECT_NEAR(2 * radiated(part.formulation->diagnose()), of_whole, 1e-2 * of_whole);
}

TEST(AbsorbingPatch, RefusesWhatDoesNotGoTogether) {
  std::string const at_end = absorbing("patch = \"+x\"");
  EXPECT_THROW(body_with(at_end + "[[support]]\nbody = \"body\"\npatch = \"+x\"\nfix = \"xyz\"\n"), InputError);
  EXPECT_THROW(body_with(at_end + "[[support]]\nbody = \"body\"\npatch = \"+y\"\nfix = \"y\"\n"), InputError);
  EXPECT_THROW(body_with(absorbing("patch = \"+x\"", "impedance = [-1, 1]\n")), InputError);
  EXPECT_THROW(body_with(absorbing("patch = \"+x\"", "impedance = [1]\n")), InputError);
  EXPECT_THROW(body_with(absorbing("patch = \"+x\"", "angle = \"90 degrees\"\n")), InputError);
  EXPECT_THROW(body_with(absorbing("patch = \"+x\"", "angle = \"9 degrees\"\nimpedance = [1, 1]\n")), InputError);
  EXPECT_THROW(body_with(absorbing("patch = \"+x\"", "follower = true\n")), InputError);
  EXPECT_THROW(body_with(absorbing("where = \"X > 1\"")), InputError);
  EXPECT_NO_THROW(body_with(at_end));
}

}  // namespace
}  // namespace piola::testing
