// SPDX-License-Identifier: Apache-2.0
// Runs whose energy jumps: they end within ten steps, at once where the step falls.
#include "piola/guards/energy_jump.hpp"
#include "piola/model/read_case.hpp"
#include "piola/output/checkpoint.hpp"
#include "piola/output/frames.hpp"
#include "piola/simulation/run_case.hpp"
#include "formulations/small_bodies.hpp"
#include "support/fake_formulation.hpp"
#include "support/key_words.hpp"
#include "support/temporary_folder.hpp"
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <nlohmann/json.hpp>

namespace piola {
namespace {

using test::expect_words;
using testing::make_plate;
using testing::TemporaryFolder;
using testing::text_of;
using OfTime = std::function<double(double)>;

/// Energies [J] as functions of time; steps are 1 ms. Particle 6 has the kinetic energy.
struct Energies {
  OfTime kinetic = [](double) { return 100.0; }, strain = [](double) { return 0.0; }, work = strain;
  OfTime step = [](double) { return 1e-3; };
};

class Prescribed : public testing::FakeFormulation {
 public:
  explicit Prescribed(Energies energies) : energies_(std::move(energies)) {}
  double stable_time_step() const override { return energies_.step(time_); }
  void step(double time, double dt) override {
    time_ = time + dt;
    if (++steps_ == stop_at && stop != nullptr) *stop = 15;
  }
  void damp(double) override {}
  double kinetic_energy() const override { return energies_.kinetic(time_); }
  std::optional<Failure> failure() const override { return std::nullopt; }
  Diagnostics diagnose() const override {
    ++evaluations;
    Diagnostics d;
    d.kinetic_energy = energies_.kinetic(time_);
    d.strain_energy = energies_.strain(time_);
    d.external_work = energies_.work(time_);
    d.jacobian_min = d.jacobian_max = 1;
    return d;
  }
  std::vector<FieldInfo> fields() const override { return {{"Displacement", "m", 3}, {"Velocity", "m/s", 3}}; }
  void sample(std::string_view field, std::span<double> values) const override {
    std::fill(values.begin(), values.end(), 0.0);
    if (field == "Velocity") values[18] = energies_.kinetic(time_);
  }
  void save(StateWriter& writer) const override { writer.put("time", std::array{time_, steps_}); }
  void load(StateReader& reader) override {
    std::array<double, 2> v{};
    reader.get("time", v);
    time_ = v[0];
    steps_ = v[1];
  }

  double stop_at = -1;
  std::atomic<int>* stop = nullptr;
  mutable int evaluations = 0;

 private:
  Energies energies_;
  double time_ = 0, steps_ = 0;
};

/// A run of one second with three rows in its history.
Simulation simulation(Energies const& energies) {
  Simulation s;
  s.particles = make_plate(4);
  s.formulation = std::make_unique<Prescribed>(energies);
  s.formulation_name = "told";
  s.mass = 16;
  s.spec.title = "Jump";
  s.spec.source = "title = \"Jump\"\n";
  s.spec.run.end = 1;
  s.spec.output.history_every = 0.5;
  for (Body const& body : s.particles.bodies) s.spec.bodies.emplace_back().name = body.name;
  return s;
}

/// A load without formulas on the plate: the case has one, whatever it does.
void add_load(CaseSpec& spec) { spec.loads.emplace_back().body = "plate"; }

Prescribed& prescribed(Simulation& s) { return static_cast<Prescribed&>(*s.formulation); }

CaseOutcome run(Simulation& s, std::filesystem::path const& folder, bool resume = false,
                std::atomic<int>* stop = nullptr) {
  Listener listener;
  std::atomic<int> none{0};
  return run_case(s, {.folder = folder, .resume = resume, .force = false}, listener, stop ? *stop : none);
}

/// `before` until step 347, `after` from step 348 on.
OfTime jump(double before, double after) {
  return [=](double t) { return t < 0.3475 ? before : after; };
}

TEST(EnergyJump, EndsTheRunWithinTenStepsWithTheFastestParticleAndBothEnergies) {
  Energies e;
  e.kinetic = jump(100, 4.77e10);
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  CaseOutcome const o = run(s, folder / "r");
  EXPECT_EQ(o.ending, RunStatus::failed);
  EXPECT_EQ(o.summary.steps, 350);
  expect_words(o.failure, {"stopped at step 350, t = 0.35 s", "particle 6 (body 'plate'", "energy jumps",
                           "total energy [J] = 4.77e+10", "lowest before [J] = 100", "half of run.cfl"});
  EXPECT_EQ(nlohmann::json::parse(text_of(folder / "r/summary.json"))["status"], "failed");
}

// A tension without limit: kinetic energy out of an internal energy far below zero.
TEST(EnergyJump, IsSeenWhereInternalEnergyPaysForIt) {
  Energies e;
  e.kinetic = jump(100, 1e6);
  e.strain = jump(0, 100 - 1e6);
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  CaseOutcome const o = run(s, folder / "r");
  EXPECT_EQ(o.ending, RunStatus::failed);
  EXPECT_EQ(o.summary.steps, 350);
  expect_words(o.failure, {"total energy [J] = 100", "kinetic energy [J] = 1e+06"});
}

TEST(EnergyJump, IsSeenInAStepThatFallsWhereMotionDoesNotShowIt) {
  Energies e;
  e.strain = jump(0, 1e6);
  e.step = [](double t) { return t < 0.3475 ? 1e-3 : 1e-4; };
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  CaseOutcome const o = run(s, folder / "r");
  EXPECT_EQ(o.ending, RunStatus::failed);
  EXPECT_EQ(o.summary.steps, 349) << "the step after it is the first short one";
}

TEST(EnergyJump, IsSeenAtTheEndOfTheRunByTheFirstLook) {
  Energies e;
  e.strain = [](double t) { return t < 0.9995 ? 0 : 300; };
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  EXPECT_EQ(run(s, folder / "r").ending, RunStatus::failed);
}

TEST(EnergyJump, OfEnergiesThatAreNotNumbersEndsTheRun) {
  for (bool const moves : {true, false}) {
    Energies e;
    (moves ? e.kinetic : e.strain) = jump(moves ? 100 : 0, std::numeric_limits<double>::quiet_NaN());
    TemporaryFolder const folder;
    Simulation s = simulation(e);
    CaseOutcome const o = run(s, folder / "r");
    EXPECT_EQ(o.ending, RunStatus::failed);
    EXPECT_EQ(o.summary.steps, moves ? 350 : 500) << "energies at rest are evaluated in rows of the history alone";
    expect_words(o.failure, {"the energy is not a number"});
  }
}

/// Work and energy of a load are added up within a step of each other, so that its onset is no jump.
TEST(EnergyJump, IsNotTheOnsetOfALoadButWhatLastsForFiveSteps) {
  Energies e;
  auto const pushed = [](double t) { return t > 0.3475 ? std::pow(t - 0.3475, 2) : 0; };
  e.kinetic = [=](double t) { return pushed(t + 1e-3); };
  e.work = pushed;
  TemporaryFolder const folder;
  Simulation loaded = simulation(e), created = simulation(e);
  add_load(loaded.spec);
  EXPECT_EQ(run(loaded, folder / "loaded").ending, RunStatus::completed);
  e.kinetic = jump(100, 1e4);
  e.work = [](double) { return 0.0; };
  created = simulation(e);
  add_load(created.spec);
  CaseOutcome const o = run(created, folder / "created");
  EXPECT_EQ(o.ending, RunStatus::failed);
  EXPECT_EQ(o.summary.steps, 354);
}

// A support that is driven at once gives its particles energy in the first step; its work follows with the waves.
TEST(EnergyJump, IsNotTheStartOfADrivenSupportWithShortSteps) {
  Energies e;
  e.kinetic = [](double t) { return t > 0 ? 500.0 : 0.0; };
  e.strain = [](double t) { return 1e4 * t; };
  e.work = [](double t) { return 1e4 * t + std::min(500.0, 1e4 * t); };  // less than what is missing for 16 steps
  TemporaryFolder const folder;
  for (bool const coarse : {true, false}) {
    Simulation s = simulation(e);
    s.spec.output.history_every = 1e-3;
    SupportSpec& support = s.spec.supports.emplace_back();
    support.body = "plate";
    support.velocity.emplace();
    s.spec.bodies[0].material = testing::rubber();  // 144 m/s across 1 m: 6.9 ms
    if (coarse) s.particles.bodies[0].spacing = {4, 4, 4};
    CaseOutcome const o = run(s, folder / (coarse ? "coarse" : "fine"));
    EXPECT_EQ(o.ending, coarse ? RunStatus::completed : RunStatus::failed);
    if (!coarse) {
      EXPECT_EQ(o.summary.steps, 15) << "the first after twice 6.9 ms";
    }
  }
}

// The energy of a pressure of the start is in no book.
TEST(EnergyJump, IsNotWhatAPressureOfTheStartBrings) {
  Energies e;
  e.kinetic = [](double t) { return 1e5 * std::min(1.0, 100 * t); };
  e.strain = [=](double t) { return -1e5 * std::min(1.0, 100 * t); };
  for (bool const under_pressure : {true, false}) {
    TemporaryFolder const folder;
    Simulation s = simulation(e);
    if (under_pressure) s.spec.bodies[0].formulation.formulas["initial_pressure"];
    EXPECT_EQ(run(s, folder / "r").ending, under_pressure ? RunStatus::completed : RunStatus::failed);
  }
}

TEST(EnergyJump, IsNoEnergyThatLoadsBringAndCostsFewEvaluations) {
  Energies e;
  e.kinetic = e.work = [](double t) { return 1e6 * t * t; };
  TemporaryFolder const folder;
  Simulation s = simulation(e), off = simulation(e);
  add_load(s.spec);
  off.spec.run.guards.on = false;
  EXPECT_EQ(run(s, folder / "r").ending, RunStatus::completed);
  run(off, folder / "off");
  EXPECT_LE(prescribed(s).evaluations - prescribed(off).evaluations, 12) << "of 1000 steps";
}

TEST(EnergyJump, IsLeftToTheUserWhereTheCaseSaysSo) {
  Energies e;
  e.kinetic = jump(100, 250);
  TemporaryFolder const folder;
  Simulation off = simulation(e), high = simulation(e), usual = simulation(e);
  off.spec.run.guards.energy_rise_stop = std::numeric_limits<double>::infinity();
  high.spec.run.guards.energy_rise_stop = 2;
  EXPECT_EQ(run(off, folder / "off").ending, RunStatus::completed);
  EXPECT_EQ(run(high, folder / "high").ending, RunStatus::completed);
  EXPECT_EQ(run(usual, folder / "usual").ending, RunStatus::failed);
}

TEST(EnergyJump, LeavesNoCheckpointOfItsStepToResumeFrom) {
  Energies e;
  e.kinetic = jump(100, 1e9);
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  s.spec.output.checkpoints_every = 0.348;
  s.spec.run.end = 0.9;
  EXPECT_EQ(run(s, folder / "none").ending, RunStatus::failed);
  EXPECT_TRUE(list_checkpoints(folder / "none").empty());
  Simulation kept = simulation(e);
  kept.spec.output.checkpoints_every = 0.1;
  CaseOutcome const o = run(kept, folder / "kept");
  ASSERT_FALSE(list_checkpoints(folder / "kept").empty());
  EXPECT_LT(read_checkpoint(list_checkpoints(folder / "kept").front()).time, 0.3475);
  expect_words(o.failure, {"newest checkpoint before it: " + list_checkpoints(folder / "kept").front().string()});
}

// As after any failure: the state at the jump is in the last frame and in failed.h5, and the message gives their places
// and that of the newest state before it.
TEST(EnergyJump, LeavesItsStateInTheLastFrameAndInAFailedCheckpoint) {
  Energies e;
  e.kinetic = jump(100, 1e9);
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  s.spec.output.checkpoints_every = 0.1;
  s.spec.output.frames_every = 0.1;
  CaseOutcome const o = run(s, folder / "r");
  EXPECT_EQ(read_checkpoint(folder / "r" / failed_checkpoint).step, 350);
  auto const frames = list_frames(folder / "r");
  ASSERT_EQ(frames.size(), 5U) << "at 0, 0.1, 0.2, 0.3 s and at the jump";
  EXPECT_EQ(frames.back().first, o.summary.end_time);
  expect_words(o.failure, {"last state: " + (folder / "r/frames.hdf.series").string() + " and " +
                               (folder / "r" / failed_checkpoint).string(),
                           "newest checkpoint before it: " + list_checkpoints(folder / "r").front().string()});
}

/// A sheared block of rubber with steps above the limit of stability.
std::string unstable_block(std::string const& formulation) {
  return "title = \"Block\"\n[run]\nend = \"0.2 s\"\ncfl = 1.2\n[[body]]\nname = \"block\"\n"
         "shape = { box = { min = [0, 0], max = [1, 1] }, particles = [8, 8], placement = \"cell_centred\" }\n"
         "material = { law = \"neo_hookean\", density = 1000, youngs_modulus = \"10 MPa\", poissons_ratio = 0.3 }\n"
         "formulation = { name = \"" +
         formulation +
         "\" }\ninitial_velocity = [\"30*Y\", \"0\"]\n[output]\nframes = { every = \"1 ms\" }\n"
         "checkpoints = { every = \"1 ms\" }\n";
}

TEST(EnergyJump, OfAnUnstableBlockKeepsTheStatesBeforeAndAtIt) {
  for (char const* formulation : {"nodal", "jst_sph"}) {
    TemporaryFolder const folder;
    Simulation s = build(read_case_text(unstable_block(formulation), "case.toml"));
    CaseOutcome const o = run(s, folder / "r");
    ASSERT_EQ(o.ending, RunStatus::failed) << formulation;
    expect_words(o.failure, {"is the fastest where the energy jumps without a load",
                             "last state: ", "newest checkpoint before it: "});
    Checkpoint const last = read_checkpoint(folder / "r" / failed_checkpoint);
    EXPECT_EQ(last.step, o.summary.steps);
    EXPECT_EQ(list_frames(folder / "r").back().first, last.time);
    auto const kept = list_checkpoints(folder / "r");
    ASSERT_FALSE(kept.empty());
    EXPECT_LT(read_checkpoint(kept.front()).step, last.step) << "a state before the jump";
    // The run can be continued from the kept state: here it fails at the same step again.
    Simulation again = build(read_case_text(unstable_block(formulation), "case.toml"));
    CaseOutcome const resumed = run(again, folder / "r", true);
    EXPECT_EQ(resumed.ending, RunStatus::failed);
    EXPECT_EQ(resumed.summary.steps, o.summary.steps);
  }
}

TEST(EnergyJump, IsSeenInTheSameStepByAResumedRun) {
  Energies e;
  e.kinetic = [](double t) { return t < 0.6475 ? 100 : 1e4; };
  for (double const stop_at : {1.0, 300.0, 646.0}) {
    TemporaryFolder const folder;
    Simulation whole = simulation(e), first = simulation(e), second = simulation(e);
    for (Simulation* s : {&whole, &first, &second}) add_load(s->spec);
    CaseOutcome const expected = run(whole, folder / "whole");
    std::atomic<int> stop{0};
    prescribed(first).stop_at = stop_at;
    prescribed(first).stop = &stop;
    EXPECT_EQ(run(first, folder / "parts", false, &stop).ending, RunStatus::stopped);
    CaseOutcome const found = run(second, folder / "parts", true);
    EXPECT_EQ(found.ending, RunStatus::failed);
    EXPECT_EQ(found.summary.steps, expected.summary.steps);
    EXPECT_EQ(found.summary.steps, 654);
  }
}

TEST(EnergyJump, IsToldByAStepThatCollapsesOtherwise) {
  Energies e;
  e.kinetic = [](double t) { return t < 0.3475 ? 100 : 150; };
  e.step = [](double t) { return t < 0.3475 ? 1e-3 : 1e-12; };
  TemporaryFolder const folder;
  Simulation s = simulation(e);
  CaseOutcome const o = run(s, folder / "r");
  EXPECT_EQ(o.ending, RunStatus::failed);
  expect_words(o.failure, {"time step collapsed", "energy at the start [J] = 100", "total energy [J] = 150",
                           "work of loads [J] = 0"});
}

}  // namespace
}  // namespace piola
