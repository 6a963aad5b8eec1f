// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/estimate.hpp"
#include "piola/estimates/reduced_case.hpp"
#include "piola/exec/threads.hpp"
#include "piola/model/read_case.hpp"
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
  CostMeter const meter;
  Simulation s = build(read_case_text(text, "case.toml"));
  auto const [e, trial] = estimate(s, meter);
  EXPECT_EQ(e.trial_steps, trial.steps);
  EXPECT_FALSE(trial.failure);
  return e;
}

/// The estimate from parts of bodies that are not too large to be built.
Estimate from_parts(std::string const& text) {
  CaseSpec const spec = read_case_text(text, "case.toml");
  return estimate_from_parts(spec, assemble(spec).particles, exec_host::set_threads(spec.run.threads));
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
  run.max_step = 0.25;
  run.end = 1.125;
  EXPECT_EQ(steps_of(rule, run), 5);
}

// What is foretold is what the run then does: its steps, and the bytes in its folder.
TEST(Estimate, StepsAndDiskAreThoseOfTheRun) {
  TemporaryFolder const folder;
  std::string const text = test::sample_with("0.5 s", "20 ms") + output;
  Estimate const e = estimate_of(text);
  Simulation s = build(read_case_text(text, "case.toml"));
  Listener no_one;
  std::atomic<int> stop{0};
  CaseOutcome const outcome = run_case(s, {.folder = folder / "r"}, no_one, stop);
  EXPECT_NEAR(static_cast<double>(outcome.summary.steps), static_cast<double>(e.steps),
              0.1 * static_cast<double>(e.steps));
  EXPECT_GT(outcome.summary.steps, std::ceil(0.02 / e.step) + 20);  // the gentle start
  double bytes = 0;
  for (auto const& entry : std::filesystem::recursive_directory_iterator(folder / "r"))
    if (entry.is_regular_file()) bytes += static_cast<double>(entry.file_size());
  EXPECT_NEAR(e.disk, bytes, 0.25 * bytes);
}

TEST(Estimate, TellsWhatLimitsTheStep) {
  EXPECT_NE(estimate_of(test::sample_case()).rule.limit.find("measured"), std::string::npos);
  std::string const paper = test::sample_with("variables = \"pF\"", "scheme = \"paper\"");
  EXPECT_NE(estimate_of(paper).rule.limit.find("run.cfl = 0.3"), std::string::npos);
}

/// Steps that a run takes.
double steps_taken(std::string const& text) {
  Simulation s = build(read_case_text(text, "case.toml"));
  Listener no_one;
  std::atomic<int> stop{0};
  return static_cast<double>(run_case(s, {.folder = {}}, no_one, stop).summary.steps);
}

std::string const rod =
    "title = \"Rod\"\n[run]\nend = \"1500 ms\"\n[[body]]\nname = \"rod\"\nshape = { box = { min = [0, 0, 0], max = [6, "
    "1, 1] "
    "}, particles = [18, 3, 3] }\nmaterial = { law = \"neo_hookean\", density = 1100, youngs_modulus = \"17 MPa\", "
    "poissons_ratio = 0.4 }\nformulation = { name = \"nodal\" }\n";

// The first 25 steps of nodal are a sixth of those that follow.
TEST(Estimate, OfNodalIsNotThatOfItsFirstSteps) {
  for (char const* start : {"initial_velocity = [\"-10*X\", \"Y\", 0]\n", "initial_velocity = [0, 0, \"5*X\"]\n"}) {
    double const taken = steps_taken(rod + start);
    Estimate const tried = estimate_of(rod + start);
    ASSERT_GT(taken, 2 * static_cast<double>(tried.trial_steps)) << start;
    EXPECT_NEAR(static_cast<double>(tried.steps), taken, 0.2 * taken) << start;
    EXPECT_LT(tried.rule.first, 0.3 * tried.step) << start;
    EXPECT_NEAR(static_cast<double>(from_parts(rod + start).steps), taken, 0.35 * taken) << "untried, " << start;
  }
}

TEST(Estimate, OfATrialThatEndsTheRunIsExact) {
  std::string const text = test::replaced(rod, "1500 ms", "2 ms") + "initial_velocity = [0, 0, \"5*X\"]\n";
  Estimate const tried = estimate_of(text);
  EXPECT_EQ(static_cast<double>(tried.steps), steps_taken(text));
  EXPECT_EQ(tried.most_steps, tried.steps);
  EXPECT_TRUE(tried.varies.empty());
}

/// Parts of bodies take as much memory per particle as the whole, within 25 %. Parts come first, since they count the
/// code that they load once.
void expect_memory_of_parts(Estimate const& parts, Estimate const& whole) {
  constexpr double program = 31e6;
  EXPECT_NEAR(parts.memory - program, whole.memory - program, 0.25 * (whole.memory - program));
}

// A part of a larger body: the same step, since the fastest modes are local, and the same memory per particle.
TEST(Estimate, APartTellsAboutTheWhole) {
  for (char const* scheme : {"filtered", "paper"}) {
    std::string const text =
        "title = \"Plate\"\n[run]\nend = 1\n[[body]]\nname = \"plate\"\nshape = { box = { min = [0, 0], max = [1, 1] "
        "}, particles = [140, 140] }\nmaterial = { law = \"neo_hookean\", density = 1000, youngs_modulus = 1e7, "
        "poissons_ratio = 0.3 }\nformulation = { name = \"jst_sph\", scheme = \"" +
        std::string(scheme) + "\" }\ninitial_velocity = [\"Y\", 0]\n" + output;
    Estimate const part = from_parts(text), whole = estimate_of(text);
    EXPECT_NEAR(part.step, whole.step, 0.1 * whole.step);
    EXPECT_NEAR(part.disk, whole.disk, 0.1 * whole.disk);
    expect_memory_of_parts(part, whole);
  }
}

// Arrays of one body that exist only because another body is Eulerian, or exists.
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
  for (char const* description : {"total_lagrangian", "eulerian"}) {
    SCOPED_TRACE(description);
    Estimate const parts = from_parts(halves(description)), whole = estimate_of(halves(description));
    expect_memory_of_parts(parts, whole);
  }
}

// A cube of 100^3 on 8 ranks: each has a cube of 50^3, and two layers on three faces of it.
TEST(Estimate, RanksDivideWhatIsDistributed) {
  ParticleSet cube;
  cube.bodies.push_back({.name = "cube", .first = 0, .last = 1'000'000});
  Estimate cost;
  cost.memory = 1e9;
  cost.distributed = {8e8};
  EXPECT_EQ(memory_of_rank(cost, cube, 1), 1e9);
  double const replicated = 1e9 - 8e8, ghosts = 3 * 2 * 50 * 50, own = 125e3;
  EXPECT_NEAR(memory_of_rank(cost, cube, 8), replicated + 8e8 * (own + ghosts) / 1e6, 40e6);
  EXPECT_LT(memory_of_rank(cost, cube, 64), memory_of_rank(cost, cube, 8));
  cost.distributed = {0};
  EXPECT_GE(memory_of_rank(cost, cube, 8), 1e9);
  std::string const short_rod = test::replaced(test::replaced(rod, "1500 ms", "1 ms"), "neo_hookean", "linear_elastic");
  EXPECT_GT(estimate_of(short_rod).distributed.at(0), 0);
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
