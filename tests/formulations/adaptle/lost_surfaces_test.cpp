// SPDX-License-Identifier: Apache-2.0
// Bodies that start in contact: surfaces keep them apart, the kernel where particles have converted.
#include "piola/model/read_case.hpp"
#include "piola/simulation/build.hpp"
#include "support/key_words.hpp"
#include "support/places.hpp"
#include "support/temporary_folder.hpp"
#include "verification/surface_bodies.hpp"
#include <fmt/format.h>
#include <gmock/gmock.h>

namespace piola {
namespace {

using namespace testing;
using test::expect_words;
using ::testing::HasSubstr;
using ::testing::Not;

/// A block of polymer between two of steel that it touches, hit from the left by the first one; mm and us.
std::string sandwich(std::string const& middle, std::string const& end = "") {
  std::string const steel =
      "material = { law = \"perfectly_plastic\", density = \"7900 kg/m^3\", youngs_modulus = \"200 GPa\", "
      "poissons_ratio = 0.29, yield_stress = \"1 GPa\" }\n"
      "formulation = { name = \"adaptle\", description = \"total_lagrangian\" }\n";
  return "title = \"Sandwich\"\n[run]\nend = \"5 us\"\n" + end +
         "[[body]]\nname = \"left\"\nshape = { box = { min = [\"-6 mm\", 0], max = [0, \"5 mm\"] }, placement = "
         "\"cell_centred\", spacing = \"0.5 mm\" }\n" +
         steel + "initial_velocity = [\"300 m/s\", 0]\n" +
         "[[body]]\nname = \"middle\"\nshape = { box = { min = [0, \"0.1 mm\"], max = [\"4 mm\", \"4.9 mm\"] }, "
         "placement "
         "= \"cell_centred\", spacing = \"0.4 mm\" }\n"
         "material = { law = \"perfectly_plastic\", density = \"1200 kg/m^3\", youngs_modulus = \"2.5 GPa\", "
         "poissons_ratio = 0.4, yield_stress = \"80 MPa\" }\n"
         "formulation = { name = \"adaptle\"" +
         middle + " }\n" +
         "[[body]]\nname = \"right\"\nshape = { box = { min = [\"4 mm\", 0], max = [\"10 mm\", \"5 mm\"] }, placement "
         "= "
         "\"cell_centred\", spacing = \"0.5 mm\" }\n" +
         steel;
}

Simulation simulation(std::string const& text) { return build(read_case_text(text, "case.toml")); }

void go(Formulation& f, double& time, double until) {
  while (time < until && !f.failure()) {
    double const dt = std::min(f.stable_time_step(), until - time);
    f.step(time, dt);
    time += dt;
  }
  EXPECT_FALSE(f.failure().has_value());
}

std::string const converting = ", convert_strain = 0.1", lagrangian = ", description = \"total_lagrangian\"";
std::string const tables =
    "[[contact]]\nbetween = [\"left\", \"middle\"]\n[[contact]]\nbetween = [\"middle\", \"right\"]\n";

TEST(LostSurfaces, BodiesThatTouchStartWithoutEnergyAndKeepIt) {
  Simulation const s = simulation(sandwich(lagrangian));
  EXPECT_TRUE(s.warnings.empty()) << s.warnings.front();
  Diagnostics const before = s.formulation->diagnose();
  EXPECT_LT(column(before, "contact_energy"), 1e-12 * before.total_energy());
  double time = 0;
  go(*s.formulation, time, 4e-6);
  Diagnostics const d = s.formulation->diagnose();
  EXPECT_EQ(column(d, "converted_particles"), 0);
  EXPECT_NEAR(d.total_energy(), before.total_energy(), 5e-3 * before.total_energy());
  EXPECT_NEAR(d.linear_momentum[0], before.linear_momentum[0], 1e-11 * before.linear_momentum[0]);
  EXPECT_LT(d.bodies[0].linear_momentum[0], 0.97 * before.linear_momentum[0]) << "the first one pushes";
}

// The kernel takes over point by point: what it stores at once is part of the total energy.
TEST(LostSurfaces, AreHandedOverToTheKernelWithinASmallShareOfTheEnergy) {
  Simulation const s = simulation(sandwich(converting) + tables);
  Diagnostics const before = s.formulation->diagnose();
  double time = 0;
  go(*s.formulation, time, 4e-6);
  Diagnostics const d = s.formulation->diagnose();
  EXPECT_GT(column(d, "converted_particles"), 5);
  EXPECT_LT(column(d, "contact_overlap"), 0.9);
  EXPECT_NEAR(d.total_energy(), before.total_energy(), 0.03 * before.total_energy());
  EXPECT_NEAR(d.linear_momentum[0], before.linear_momentum[0], 1e-11 * before.linear_momentum[0]);
}

TEST(LostSurfaces, HaveTheSameBitsOnThreadsAndInAResumedRun) {
  std::vector<double> first;
  for (int const threads : thread_counts) {
    Threads const shared(threads);
    Simulation const s = simulation(sandwich(converting, fmt::format("threads = {}\n", threads)) + tables);
    double time = 0;
    go(*s.formulation, time, 2e-6);
    auto const v = sample(*s.formulation, "Velocity", static_cast<std::size_t>(s.particles.size()));
    if (first.empty()) first = v;
    EXPECT_EQ(v, first) << threads;
  }
  Simulation const whole = simulation(sandwich(converting) + tables), parts = simulation(sandwich(converting) + tables);
  double time = 0;
  go(*whole.formulation, time, 1.5e-6);
  EXPECT_GT(column(whole.formulation->diagnose(), "converted_particles"), 0);
  SavedState state = saved(*whole.formulation);
  parts.formulation->load(state);
  double again = time;
  go(*whole.formulation, time, 2e-6);
  go(*parts.formulation, again, 2e-6);
  EXPECT_EQ(saved(*whole.formulation).values, saved(*parts.formulation).values);
}

std::string message(std::string const& text) {
  try {
    simulation(text);
  } catch (InputError const& error) {
    return error.what();
  }
  return "";
}

// Kernel contact would hold 7 % of its energy at the start, and an anvil within half a spacing of particles 30 % more.
TEST(LostSurfaces, LetARodInATubeStartWithoutEnergy) {
  std::string tube = text_of(source_folder() + "/tests/regression/expanding_tube.toml");
  std::string const refusal = message(tube);
  EXPECT_THAT(refusal, HasSubstr("the bodies \"tube\" and \"plug\" start close to each other"));
  expect_words(refusal, {"the rigid shape \"anvil\"", "50 um from a particle of body \"tube\""});
  std::string const anvil = "plane = { point = [0, 0, 0]";
  tube.replace(tube.find(anvil), anvil.size(), "plane = { point = [0, 0, \"-0.34 mm\"]");
  for (char const* pair : {"\"tube\", \"plug\"", "\"tube\", \"shot\"", "\"plug\", \"shot\""})
    tube += fmt::format("[[contact]]\nbetween = [{}]\n", pair);
  Simulation const s = simulation(tube);
  Diagnostics const d = s.formulation->diagnose();
  EXPECT_LT(column(d, "contact_energy"), 1e-3 * d.total_energy());
  EXPECT_LT(column(d, "contact_overlap"), 0.05);
}

TEST(LostSurfaces, AreTheDefaultOfLagrangianBodiesThatTouchUnlessTheCaseNamesALaw) {
  std::string const text = sandwich(lagrangian);
  auto const pairs = [](std::string const& of) { return read_case_text(of, "case.toml").contact_pairs.size(); };
  EXPECT_EQ(pairs(text), 2U);
  EXPECT_EQ(pairs(sandwich("")), 0U);
  EXPECT_EQ(pairs(text + "[contact]\nlaw = \"kernel\"\n"), 0U);
  EXPECT_EQ(pairs(text + "[contact]\nscale = 2\n"), 2U);
  std::string apart = text;
  apart.replace(apart.find("max = [\"4 mm\", \"4.9 mm\"]"), 25, "max = [\"2.8 mm\", \"4.9 mm\"]");
  EXPECT_EQ(pairs(apart), 1U);
}

TEST(LostSurfaces, CannotBeHadByEulerianBodiesWhoseEnergyAtTheStartIsRefused) {
  std::string text = sandwich(", description = \"eulerian\"");
  text.replace(text.find("300 m/s"), 7, "50 m/s");
  std::string const refusal = message(text);
  EXPECT_THAT(refusal, HasSubstr("\"left\" and \"middle\""));
  EXPECT_THAT(refusal, HasSubstr("% of all energy, which nothing has paid for"));
  EXPECT_THAT(refusal, HasSubstr("allowed: at most 1 %"));
  EXPECT_THAT(refusal, HasSubstr("contact.law"));
  Simulation const wanted = simulation(text + "[contact]\nlaw = \"kernel\"\n");
  ASSERT_FALSE(wanted.warnings.empty());
  EXPECT_THAT(wanted.warnings.front(), HasSubstr("which nothing has paid for"));
}

}  // namespace
}  // namespace piola
