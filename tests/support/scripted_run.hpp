// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/output/checkpoint.hpp"
#include "piola/simulation/run_case.hpp"
#include "support/fake_formulation.hpp"
#include "support/temporary_folder.hpp"
#include <functional>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace piola::testing {

using Point = std::array<double, 3>;

/// A run with prescribed results: each quantity is a function of time. The default step is 1 ms.
struct Script {
  std::function<double(double)> kinetic = [](double) { return 0.0; }, work = kinetic, loss = kinetic;
  std::function<Point(std::size_t, double)> displacement = [](std::size_t, double) { return Point{}; };
  std::function<double(std::size_t, double)> speed = [](std::size_t, double) { return 0.0; },
                                             jacobian = [](std::size_t, double) { return 1.0; };
  std::vector<char> eulerian = {};
  std::function<double(double)> step = [](double) { return 1e-3; };
  std::int64_t limiting_particle = -1;  ///< of StepBound
  std::function<std::array<double, 9>(std::size_t, double)> gradient = {};
  std::function<std::vector<std::pair<std::string, double>>(double)> more = [](double) {
    return std::vector<std::pair<std::string, double>>{};
  };
  std::vector<UncoveredParticles> uncovered = {};
};

class Scripted : public FakeFormulation {
 public:
  Scripted(Script script, std::size_t particles) : script_(std::move(script)), n_(particles) {}
  double stable_time_step() const override { return script_.step(time_); }
  StepBound step_bound() const override { return {stable_time_step(), "the script", script_.limiting_particle}; }
  void step(double time, double dt) override {
    time_ = time + dt;
    if (++steps_ == stop_at) *stop = 15;
  }
  void damp(double) override {}
  std::optional<Failure> failure() const override { return std::nullopt; }
  Diagnostics diagnose() const override {
    Diagnostics d;
    d.kinetic_energy = script_.kinetic(time_);
    d.external_work = script_.work(time_);
    d.stabilisation_loss = script_.loss(time_);
    d.jacobian_min = d.jacobian_max = script_.jacobian(0, time_);
    for (std::size_t i = 0; i < n_; ++i) {
      d.jacobian_min = std::min(d.jacobian_min, script_.jacobian(i, time_));
      d.jacobian_max = std::max(d.jacobian_max, script_.jacobian(i, time_));
    }
    d.more = script_.more(time_);
    d.uncovered = script_.uncovered;
    return d;
  }
  std::vector<FieldInfo> fields() const override {
    std::vector<FieldInfo> r{{"Displacement", "m", 3}, {"Velocity", "m/s", 3}, {"Jacobian", "1", 1}};
    if (!script_.eulerian.empty()) r.push_back({"KernelType", "1", 1});
    if (script_.gradient) r.push_back({"DeformationGradient", "1", 9});
    return r;
  }
  void sample(std::string_view field, std::span<double> values) const override {
    for (std::size_t i = 0; i < n_; ++i) {
      if (field == "Jacobian") values[i] = script_.jacobian(i, time_);
      if (field == "KernelType") values[i] = script_.eulerian[i];
      if (field == "Velocity") values[3 * i] = script_.speed(i, time_);
      if (field == "DeformationGradient") {
        auto const F = script_.gradient(i, time_);
        std::copy(F.begin(), F.end(), values.begin() + static_cast<std::ptrdiff_t>(9 * i));
      }
      if (field != "Displacement") continue;
      Point const u = script_.displacement(i, time_);
      std::copy(u.begin(), u.end(), values.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
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

 private:
  Script script_;
  std::size_t n_;
  double time_ = 0, steps_ = 0;
};

inline Simulation simulation(Script const& script, ParticleSet particles = make_plate(4)) {
  Simulation s;
  s.particles = std::move(particles);
  s.formulation = std::make_unique<Scripted>(script, s.particles.X.size());
  s.formulation_name = "script";
  s.mass = 16;
  s.spec.title = "Script";
  s.spec.source = "title = \"Script\"\n";
  s.spec.run.end = 1;
  s.spec.output.history_every = 0.01;
  for (Body const& body : s.particles.bodies) s.spec.bodies.emplace_back().name = body.name;
  return s;
}

struct WarningList : Listener {
  std::vector<std::string> warnings_;
  void warning(std::string const& text) override { warnings_.push_back(text); }
};

struct Outcome {
  CaseOutcome of;
  nlohmann::json guards;
  std::vector<std::string> shown;
  std::string all() const {
    std::string text;
    for (auto const& w : of.summary.warnings) text += w + "\n";
    return text;
  }
};

inline Outcome run(Simulation& s, std::filesystem::path const& folder, bool resume = false,
                   std::atomic<int>* stop = nullptr) {
  WarningList listener;
  std::atomic<int> none{0};
  Outcome o{run_case(s, {.folder = folder, .resume = resume, .force = false}, listener, stop ? *stop : none), {}, {}};
  o.guards = nlohmann::json::parse(text_of(folder / "summary.json"))["guards"];
  o.shown = listener.warnings_;
  return o;
}

inline Outcome run(Script const& script, ParticleSet particles = make_plate(4)) {
  TemporaryFolder const folder;
  Simulation s = simulation(script, std::move(particles));
  return run(s, folder / "r");
}

/// Deformation gradient of a rotation by `angle` [rad] in the plane.
inline std::array<double, 9> turned(double angle) {
  return {std::cos(angle), -std::sin(angle), 0, std::sin(angle), std::cos(angle), 0, 0, 0, 1};
}

}  // namespace piola::testing
