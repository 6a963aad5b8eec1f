// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/estimate.hpp"
#include "piola/estimates/reduced_case.hpp"
#include "piola/input/read_case.hpp"
#include "piola/output/atomic_file.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/sample_case.hpp"
#include "support/temporary_folder.hpp"
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tuple>

namespace piola {
namespace {

using testing::TemporaryFolder;

Estimate estimate_of(std::string const& text) {
  Simulation const s = build(read_case_text(text, "case.toml"));
  return estimate(s.spec, s.particles, *s.formulation, s.threads);
}

std::string const output = "[output.frames]\nevery = \"2 ms\"\n[output.checkpoints]\nevery = \"5 ms\"\n";

TEST(Estimate, StepsOfAGentleStartAreCounted) {
  StepEstimate rule{.settled = 1, .first = 1, .growth = 1, .limit = ""};
  RunSpec run;
  run.end = 10.5;
  EXPECT_EQ(steps_of(rule, run), 11);
  run.end = 10 * (1 + 1e-9);
  EXPECT_EQ(steps_of(rule, run), 10);
  run.end = 0.1;
  EXPECT_EQ(steps_of(rule, run), 1);
  // 1/8 + 1/4 + 1/2 and then whole steps: 0.875 in three.
  rule.first = 0.125;
  rule.growth = 2;
  run.end = 10.875;
  EXPECT_EQ(steps_of(rule, run), 13);
  // Slower from 0.3 s on: 1/8 + 1/4 + 1/2 + 3/4 and then whole steps: 1.625 in four.
  rule.late_growth = 1.5;
  rule.late_from = 0.3;
  run.end = 11.625;
  EXPECT_EQ(steps_of(rule, run), 14);
  run.max_step = 0.25;
  run.end = 1.125;
  EXPECT_EQ(steps_of(rule, run), 5);
}

// What is foretold is what the run then does: its steps, and the bytes in its folder.
TEST(Estimate, StepsAndDiskAreThoseOfTheRun) {
  TemporaryFolder const folder;
  std::string const text = test::sample_with("0.5 s", "20 ms") + output;
  Simulation s = build(read_case_text(text, "case.toml"));
  Estimate const e = estimate(s.spec, s.particles, *s.formulation, s.threads);
  Listener nobody;
  std::atomic<int> stop{0};
  CaseOutcome const outcome = run_case(s, {.folder = folder / "r"}, nobody, stop);
  EXPECT_NEAR(static_cast<double>(outcome.summary.steps), static_cast<double>(e.steps),
              0.1 * static_cast<double>(e.steps));
  EXPECT_GT(outcome.summary.steps, std::ceil(0.02 / e.step) + 20);  // the gentle start
  double bytes = 0;
  for (auto const& entry : std::filesystem::recursive_directory_iterator(folder / "r"))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  EXPECT_NEAR(e.disk, bytes, 0.25 * bytes);
}

TEST(Estimate, IsTheSameEachTime) {
  Estimate const a = estimate_of(test::sample_case()), b = estimate_of(test::sample_case());
  EXPECT_EQ(a.run_seconds, b.run_seconds);
  EXPECT_EQ(a.setup_seconds, b.setup_seconds);
  EXPECT_EQ(a.memory, b.memory);
  EXPECT_GT(a.setup_seconds, 0);
}

TEST(Estimate, TellsWhatLimitsTheStep) {
  EXPECT_NE(estimate_of(test::sample_case()).rule.limit.find("measured"), std::string::npos);
  std::string const paper = test::sample_with("variables = \"pF\"", "scheme = \"paper\"");
  EXPECT_NE(estimate_of(paper).rule.limit.find("run.cfl = 0.3"), std::string::npos);
}

/// Steps that a run takes.
double steps_taken(std::string const& text) {
  Simulation s = build(read_case_text(text, "case.toml"));
  Listener nobody;
  std::atomic<int> stop{0};
  return static_cast<double>(run_case(s, {.folder = {}}, nobody, stop).summary.steps);
}

Estimate estimate_with_trial(std::string const& text) {
  Simulation s = build(read_case_text(text, "case.toml"));
  Trial trial;
  Estimate const e = estimate_by_trial(s, trial);
  EXPECT_EQ(e.trial_steps, trial.steps);
  EXPECT_FALSE(trial.failure);
  return e;
}

std::string const rod =
    "title = \"Rod\"\n[run]\nend = \"1 s\"\n[[body]]\nname = \"rod\"\nshape = { box = { min = [0, 0, 0], max = [6, "
    "1, 1] "
    "}, particles = [18, 3, 3] }\nmaterial = { law = \"neo_hookean\", density = 1100, youngs_modulus = \"17 MPa\", "
    "poissons_ratio = 0.4 }\nformulation = { name = \"nodal\" }\n";

// The first 25 steps of nodal are a sixth of those that follow.
TEST(Estimate, OfNodalIsNotThatOfItsFirstSteps) {
  for (char const* start : {"initial_velocity = [\"-10*X\", \"Y\", 0]\n", "initial_velocity = [0, 0, \"5*X\"]\n"}) {
    double const taken = steps_taken(rod + start);
    Estimate const tried = estimate_with_trial(rod + start);
    ASSERT_GT(taken, 2 * static_cast<double>(tried.trial_steps)) << start;
    EXPECT_NEAR(static_cast<double>(tried.steps), taken, 0.2 * taken) << start;
    EXPECT_LT(tried.rule.first, 0.3 * tried.step) << start;
    EXPECT_NEAR(static_cast<double>(estimate_of(rod + start).steps), taken, 0.35 * taken) << "untried, " << start;
  }
}

TEST(Estimate, OfATrialThatEndsTheRunIsExact) {
  std::string const text = test::replaced(rod, "1 s", "2 ms") + "initial_velocity = [0, 0, \"5*X\"]\n";
  Estimate const tried = estimate_with_trial(text);
  EXPECT_EQ(static_cast<double>(tried.steps), steps_taken(text));
  EXPECT_EQ(tried.most_steps, tried.steps);
  EXPECT_TRUE(tried.varies.empty());
}

// A part of a larger body: the same step, since the fastest modes are local, and the same memory per particle.
TEST(Estimate, APartTellsAboutTheWhole) {
  constexpr double program = 35e6;
  for (char const* scheme : {"filtered", "paper"}) {
    std::string const text =
        "title = \"Plate\"\n[run]\nend = 1\n[[body]]\nname = \"plate\"\nshape = { box = { min = [0, 0], max = [1, 1] "
        "}, particles = [140, 140] }\nmaterial = { law = \"neo_hookean\", density = 1000, youngs_modulus = 1e7, "
        "poissons_ratio = 0.3 }\nformulation = { name = \"jst_sph\", scheme = \"" +
        std::string(scheme) + "\" }\ninitial_velocity = [\"Y\", 0]\n" + output;
    Simulation const s = build(read_case_text(text, "case.toml"));
    Estimate const whole = estimate(s.spec, s.particles, *s.formulation, s.threads);
    Estimate const part = estimate_from_parts(s.spec, s.particles, s.threads);
    EXPECT_NEAR(part.step, whole.step, 0.1 * whole.step);
    EXPECT_NEAR(part.memory - program, whole.memory - program, 0.1 * (whole.memory - program));
    EXPECT_NEAR(part.disk, whole.disk, 0.1 * whole.disk);
  }
}

// Of taylor_sph every rank has all, so that nobody sends anything for a row.
TEST(Estimate, RowsTakeBytesOfWhatRanksShare) {
  std::string const text =
      "title = \"Plate\"\n[run]\nend = 1\n[[body]]\nname = \"plate\"\nshape = { box = { min = [0, 0], max = [1, 1] }, "
      "particles = [20, 20] }\nmaterial = { law = \"linear_elastic\", density = 1000, youngs_modulus = 1e7, "
      "poissons_ratio = 0.3 }\nformulation = { name = \"NAME\" }\ninitial_velocity = [\"Y\", 0]\n"
      "[[probe]]\nname = \"shards\"\nkind = \"fragment\"\nbody = \"plate\"\nquantities = [\"large_fragment_count\"]\n";
  auto const of = [&](std::string_view name) {
    std::string own = text;
    own.replace(own.find("NAME"), 4, name);
    return estimate_of(own);
  };
  EXPECT_EQ(of("taylor_sph").row_bytes, 0);
  EXPECT_EQ(of("nodal").row_bytes, 8 * 6 * 400);
  EXPECT_GT(of("taylor_sph").row_work_of_first, 0);
  EXPECT_EQ(of("nodal").row_work_of_first, 0);
}

// What one body takes because another one flows, or is there at all.
TEST(Estimate, PartsTellWhatBodiesTakeBesideOthers) {
  auto const halves = [](std::string_view description) {
    std::string text = "title = \"Halves\"\n[run]\nend = \"1 us\"\n";
    for (auto const& [name, low, word] :
         {std::tuple{"low", 0.0, std::string_view("total_lagrangian")}, std::tuple{"high", 6.1, description}})
      text += fmt::format(
          "[[body]]\nname = \"{}\"\nshape.box = {{ min = [\"0 mm\", \"{} mm\"], max = [\"12 mm\", \"{} mm\"] }}\n"
          "shape.spacing = \"0.1 mm\"\nshape.placement = \"cell_centred\"\n"
          "material = {{ name = \"aluminium_perfectly_plastic\" }}\n"
          "formulation = {{ name = \"adaptle\", description = \"{}\" }}\n",
          name, low, low + 6, word);
    return text;
  };
  constexpr double program = 31e6;
  for (char const* description : {"total_lagrangian", "eulerian"}) {
    Simulation const s = build(read_case_text(halves(description), "case.toml"));
    Estimate const whole = estimate(s.spec, s.particles, *s.formulation, s.threads);
    Estimate const parts = estimate_from_parts(s.spec, s.particles, s.threads);
    EXPECT_NEAR(parts.memory - program, whole.memory - program, 0.07 * (whole.memory - program)) << description;
  }
}

TEST(Estimate, PartsKeepSpacingAndWalls) {
  ShapeSpec box;
  box.max = {10, 1, 3};
  box.particles = {101, 11, 31};
  ShapeSpec const part = part_of(box, 21);
  EXPECT_EQ(part.particles, (std::array<int, 3>{21, 11, 21}));
  for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(spacing_of(part)[d], spacing_of(box)[d], 1e-12);
  ShapeSpec ring;
  ring.kind = ShapeSpec::Kind::sphere;
  ring.dimension = 2;
  ring.radius = 10;
  ring.inner_radius = 9.5;
  ring.spacing = 0.1;
  ShapeSpec const small = part_of(ring, 40);
  EXPECT_DOUBLE_EQ(small.radius, 2);
  EXPECT_DOUBLE_EQ(small.inner_radius, 1.5);
}

}  // namespace
}  // namespace piola
