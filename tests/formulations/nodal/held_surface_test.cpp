// SPDX-License-Identifier: Apache-2.0
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "formulations/nodal/nodal_bodies.hpp"
#include <fmt/format.h>

namespace piola::testing {
namespace {

/// A packed bar of 5.3 x 3.4 x 3.6 spacings: its particles fill no lattice.
std::string const bar =
    "shape = { spacing = 0.2, arrangement = \"packed\", box = { min = [0, 0, 0], max = [1.06, 0.68, 0.72] } }\n";
std::string const ring =
    "shape = { spacing = 0.2, arrangement = \"packed\", sphere = { centre = [0, 0], radius = 1, inner_radius = 0.4 } "
    "}\n";

/// A case of one body of rubber, with what is given of it.
Simulation body_with(std::string const& more, std::string const& shape = bar, double poissons_ratio = 0.3) {
  std::string const text =
      "title = \"Held surface\"\n[run]\nend = \"1 s\"\ncfl = 0.2\n[[body]]\nname = \"body\"\n" + shape +
      fmt::format(
          "material = {{ law = \"neo_hookean\", density = 1100, youngs_modulus = 17e6, poissons_ratio = {} }}\n",
          poissons_ratio) +
      "formulation = { name = \"nodal\" }\n" + more;
  return build(read_case_text(text, "held.toml"));
}

std::string support_on(std::string const& patch, std::string const& fix, std::string const& more = "") {
  return "[[support]]\nbody = \"body\"\npatch = \"" + patch + "\"\nfix = \"" + fix + "\"\n" + more;
}

std::string const stretching = "initial_velocity = [\"3*X+2*Y\", \"4*X*Y\", \"3*X*X\"]\n";

TEST(HeldSurface, BearsTheTractionOfAUniformPullAndNothingMoves) {
  Mat<3> F = identity<3>();
  F(0, 0) = 1.02;
  Mat<3> const P = NeoHookean(rubber().value).first_piola(F);
  std::string text =
      "initial_displacement = [\"0.02*X\", \"0\", \"0\"]\n" +
      fmt::format("[[load]]\nbody = \"body\"\npatch = \"+x\"\ntraction = [\"{:.17g}\", \"0\", \"0\"]\n", P(0, 0));
  // Rollers on the lateral faces carry the stress that keeps the bar from contracting.
  for (std::string const patch : {"-x", "-y", "+y", "-z", "+z"}) text += support_on(patch, std::string(1, patch[1]));
  auto const simulation = body_with(text);
  auto& f = *simulation.formulation;
  double const start = f.diagnose().strain_energy;
  advance_by_itself(f, 0, 50);
  auto const d = f.diagnose();
  EXPECT_LT(d.kinetic_energy, 1e-6 * start);
  EXPECT_NEAR(d.actions.at(0).force[0], -P(0, 0) * 0.68 * 0.72, 1e-4 * P(0, 0) * 0.68 * 0.72);
  EXPECT_NEAR(d.actions.at(1).force[1], -P(1, 1) * 1.06 * 0.72, 1e-4 * P(1, 1) * 1.06 * 0.72);
}

TEST(HeldSurface, AtRestDoesNoWorkAndKeepsTheEnergyToTheSquareOfTheStep) {
  for (std::string const hold :
       {"fix = \"xyz\"\n", "normal = [1, 0.3, 0.2]\nfix = \"normal\"\n", "normal = [1, 1, 0]\nfix = \"tangent\"\n"}) {
    double error[2];
    for (int const half : {0, 1}) {
      auto const simulation = body_with(stretching + "[[support]]\nbody = \"body\"\npatch = \"-x\"\n" + hold);
      auto& f = *simulation.formulation;
      auto const start = f.diagnose();
      double const dt = f.stable_time_step() / (half + 1);
      advance(f, dt, 150 * (half + 1));
      auto const end = f.diagnose();
      EXPECT_GT(end.strain_energy, 0.01 * start.kinetic_energy) << hold;
      EXPECT_LT(std::fabs(end.external_work), 1e-12 * start.kinetic_energy) << hold;
      error[half] = std::fabs(end.total_energy() / start.total_energy() - 1);
    }
    EXPECT_LT(error[0], 2e-3) << hold;
    EXPECT_LT(error[1], 0.3 * error[0]) << hold;
  }
}

TEST(HeldSurface, GivesTheMomentaThatItsForceAndMomentSay) {
  auto const simulation =
      body_with(stretching + support_on("-x", "xyz") + support_on("+x", "z", "velocity = [\"0\", \"0\", \"40*t\"]\n"));
  auto& f = *simulation.formulation;
  auto const start = f.diagnose();
  std::array<double, 3> linear{}, angular{};
  double time = 0;
  for (int k = 0; k < 40; ++k) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
    for (auto const& action : f.diagnose().actions)
      for (std::size_t c = 0; c < 3; ++c) {
        linear[c] += dt * action.force[c];
        angular[c] += dt * action.moment[c];
      }
    // Moments are about the middles of the patches.
    auto const& actions = f.diagnose().actions;
    for (std::size_t n = 0; n < 2; ++n) {
      std::array<double, 3> const about{n == 0 ? 0 : 1.06, 0.34, 0.36};
      auto const& force = actions[n].force;
      angular[0] += dt * (about[1] * force[2] - about[2] * force[1]);
      angular[1] += dt * (about[2] * force[0] - about[0] * force[2]);
      angular[2] += dt * (about[0] * force[1] - about[1] * force[0]);
    }
  }
  auto const end = f.diagnose();
  for (std::size_t c = 0; c < 3; ++c) {
    EXPECT_NEAR(end.linear_momentum[c] - start.linear_momentum[c], linear[c],
                1e-9 * std::fabs(start.linear_momentum[0]));
    EXPECT_NEAR(end.angular_momentum[c] - start.angular_momentum[c], angular[c],
                1e-9 * std::fabs(start.linear_momentum[0]));
  }
}

TEST(HeldSurface, WhenDrivenDoesTheWorkThatItBooks) {
  auto const simulation =
      body_with(support_on("-x", "xyz") +
                support_on("+x", "xyz", "velocity = [\"60*t\", \"-30*t*(Z-0.36)\", \"30*t*(Y-0.34)\"]\n"));
  auto& f = *simulation.formulation;
  advance_by_itself(f, 0, 400);
  auto const d = f.diagnose();
  EXPECT_GT(d.external_work, 1);
  EXPECT_NEAR(d.total_energy(), d.external_work, 1e-3 * d.external_work);
}

TEST(HeldSurface, CarriesABodyAlongWithoutStrain) {
  auto const simulation = body_with("initial_velocity = [\"2\", \"-1\", \"3\"]\n" +
                                    support_on("-x", "xyz", "velocity = [\"2\", \"-1\", \"3\"]\n"));
  auto& f = *simulation.formulation;
  double const start = f.diagnose().kinetic_energy;
  advance_by_itself(f, 0, 50);
  auto const d = f.diagnose();
  EXPECT_LT(d.strain_energy, 1e-12 * start);
  EXPECT_LT(std::fabs(d.external_work), 1e-10 * start);
}

TEST(HeldSurface, LetsGoWhenItIsReleased) {
  auto const simulation = body_with(stretching + support_on("-x", "xyz", "until = \"1 ms\"\n"));
  auto& f = *simulation.formulation;
  double time = 0;
  while (time < 1e-3 * (1 - 1e-9)) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
  }
  EXPECT_NEAR(time, 1e-3, 1e-9);
  EXPECT_NE(f.diagnose().actions[0].force[0], 0);
  auto const before = f.diagnose();
  advance_by_itself(f, time, 50);
  auto const after = f.diagnose();
  EXPECT_EQ(after.actions[0].force[0], 0);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(after.linear_momentum[c], before.linear_momentum[c], 1e-11 * std::fabs(before.linear_momentum[0]));
}

TEST(HeldSurface, OfTwoSupportsThatShareItIsAsOfOne) {
  auto const one = body_with(stretching + support_on("-x", "xyz"));
  auto const two = body_with(stretching + support_on("-x", "x") + support_on("-x", "yz"));
  for (auto const* s : {&one, &two}) advance_by_itself(*s->formulation, 0, 40);
  auto const n = one.particles.X.size();
  EXPECT_LT(largest_difference(sample(*one.formulation, "Position", n), sample(*two.formulation, "Position", n)),
            1e-13);
}

TEST(HeldSurface, StandsBesideParticlesThatAreHeld) {
  // The patch reaches the particles that the other support drives; both have their way.
  auto const simulation = body_with(stretching + support_on("-x", "xyz") +
                                    "[[support]]\nbody = \"body\"\nwhere = \"Y < 0.2 && X > 0.2\"\nfix = \"y\"\n");
  auto& f = *simulation.formulation;
  auto const n = simulation.particles.X.size();
  double const start = f.diagnose().kinetic_energy;
  advance(f, 0.25 * f.stable_time_step(), 400);
  auto const u = sample(f, "Displacement", n);
  for (std::size_t k = 0; k < n; ++k) {
    auto const& X = simulation.particles.X[k];
    if (X[1] < 0.2 && X[0] > 0.2) {
      EXPECT_LT(std::fabs(u[3 * k + 1]), 1e-14);
    }
  }
  EXPECT_LT(std::fabs(f.diagnose().external_work), 1e-12 * start);
  EXPECT_NEAR(f.diagnose().total_energy(), start, 1e-3 * start);
}

TEST(HeldSurface, OfARingInThePlaneHoldsItsHole) {
  auto const simulation = body_with("initial_velocity = [\"-8*Y\", \"8*X\"]\n" + support_on("inner", "xy"), ring);
  auto& f = *simulation.formulation;
  double const start = f.diagnose().total_energy();
  advance_by_itself(f, 0, 200);
  auto const d = f.diagnose();
  EXPECT_GT(d.strain_energy, 0.01 * start);
  EXPECT_LT(std::fabs(d.external_work), 1e-12 * start);
  EXPECT_NEAR(d.total_energy(), start, 1e-3 * start);
}

TEST(HeldSurface, IsTheSameForAnyNumberOfThreadsAndGoesOnBitForBit) {
  std::string const text = stretching + support_on("-x", "xyz") +
                           support_on("+x", "yz", "velocity = [\"0\", \"5*t\", \"X\"]\nuntil = \"2 ms\"\n");
  expect_same_bits([&] { return body_with(text); }, 37, 90);
}

/// A ball that strikes a plate of three spacings, of which every particle moves the held face.
Simulation ball_on_plate(std::string const& supports) {
  return body_with(
      supports +
          "[[body]]\nname = \"ball\"\nshape = { spacing = 0.2, arrangement = \"packed\", sphere = { centre = [0.5, "
          "0.5, 1.01], "
          "radius = 0.4 } }\nmaterial = { law = \"neo_hookean\", density = 1100, youngs_modulus = 17e6, poissons_ratio "
          "= "
          "0.3 }\nformulation = { name = \"nodal\" }\ninitial_velocity = [\"0\", \"0\", \"-5\"]\n",
      "shape = { spacing = 0.2, arrangement = \"packed\", box = { min = [0, 0, 0], max = [1, 1, 0.6] } }\n");
}

TEST(HeldSurface, GivesBackWhatContactPushes) {
  auto const simulation = ball_on_plate(support_on("-z", "xyz"));
  auto& f = *simulation.formulation;
  auto const start = f.diagnose();
  double time = 0, impulse = 0;
  while (f.diagnose().linear_momentum[2] < 0.5 * std::fabs(start.linear_momentum[2]) && time < 0.2) {
    double const dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
    impulse += dt * f.diagnose().actions.at(0).force[2];
  }
  auto const end = f.diagnose();
  EXPECT_GT(end.linear_momentum[2], 0.4 * std::fabs(start.linear_momentum[2])) << "the ball bounces";
  EXPECT_NEAR(end.linear_momentum[2] - start.linear_momentum[2], impulse, 1e-9 * impulse);
  EXPECT_LT(std::fabs(end.external_work), 1e-12 * start.kinetic_energy);
  EXPECT_NEAR(end.total_energy(), start.total_energy(), 2e-3 * start.total_energy());
}

TEST(HeldSurface, ThatContactPushesGoesOnBitForBitFromACheckpoint) {
  auto const struck = [] { return ball_on_plate(support_on("-z", "xyz", "velocity = [\"3*t\", \"0\", \"0.2\"]\n")); };
  auto const whole = struck(), first = struck(), second = struck();
  advance_by_itself(*whole.formulation, 0, 60);
  double const middle = advance_by_itself(*first.formulation, 0, 31);
  EXPECT_GT(std::fabs(first.formulation->diagnose().actions.back().force[2]), 0) << "nothing is pushed";
  auto state = saved(*first.formulation);
  second.formulation->load(state);
  advance_by_itself(*second.formulation, middle, 29);
  EXPECT_EQ(saved(*second.formulation).values, saved(*whole.formulation).values);
  EXPECT_EQ(second.formulation->diagnose().actions[0].force, whole.formulation->diagnose().actions[0].force);
}

/// Relative error of a quarter of the period L / c of the lowest longitudinal mode of a clamped bar that does not
/// contract: its momentum is zero then.
double error_of_mode(std::string const& hold, int along) {
  double const h = 1.0 / along;
  auto const simulation = body_with(
      "initial_velocity = [\"0.01*sin(pi*X/2)\", \"0\", \"0\"]\n" +
          support_on("-x", "xyz", "hold = \"" + hold + "\"\n"),
      fmt::format(
          "shape = {{ spacing = {}, arrangement = \"packed\", box = {{ min = [0, 0, 0], max = [1, {}, {}] }} }}\n", h,
          3 * h, 3 * h),
      0);
  auto& f = *simulation.formulation;
  double time = 0, before = f.diagnose().linear_momentum[0], after = before, dt = 0;
  while (after > 0) {
    before = after;
    dt = f.stable_time_step();
    f.step(time, dt);
    time += dt;
    after = f.diagnose().linear_momentum[0];
  }
  time -= dt * after / (after - before);
  return std::fabs(time * std::sqrt(17e6 / 1100) - 1);
}

TEST(HeldSurface, ClampsABarWhereItsFaceIs) {
  EXPECT_LT(error_of_mode("surface", 8), 1e-3);
  EXPECT_GT(error_of_mode("particles", 8), 0.03) << "half a spacing of an eighth of the length";
}

}  // namespace
}  // namespace piola::testing
