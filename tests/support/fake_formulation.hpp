// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/particles/particle_set.hpp"
#include "piola/simulation/build.hpp"
#include <atomic>
#include <cmath>
#include <limits>

namespace piola::testing {

/// One body "plate" of n x n particles with unit spacing.
inline ParticleSet make_plate(int n) {
  ParticleSet set;
  set.dimension = 2;
  set.bodies.push_back({"plate", 0, n * n, {1, 1, 1}, {n, n, 1}, true});
  for (int j = 0; j < n; ++j) {
    for (int i = 0; i < n; ++i) {
      set.X.push_back({static_cast<double>(i), static_cast<double>(j), 0});
      set.lattice_index.push_back({i, j, 0});
      set.volume.push_back(1);
      set.kernel_volume.push_back(1);
      set.body.push_back(0);
    }
  }
  return set;
}

/// The interface of a formulation around the motion that a test prescribes.
class FakeFormulation : public Formulation, public SingleRankObservables {
 public:
  StepEstimate step_estimate() const override {
    StepEstimate rule;
    rule.stable = rule.settled = rule.first = stable_time_step();
    rule.limit = "the formulation";
    return rule;
  }
  StepBound step_bound() const override { return {stable_time_step(), "the formulation", -1}; }
  double kinetic_energy() const override { return diagnose().kinetic_energy; }
  Observables const& observables() const override { return *this; }
  RunStatistics statistics() const override { return {}; }
  CoupledParticles* coupled_particles() override { return nullptr; }
};

/// A formulation of independent oscillators: u'' = -k u with unit mass, by symplectic Euler. The step depends on a
/// velocity, so a resumed run agrees only if every number was restored.
class Springs : public FakeFormulation {
 public:
  explicit Springs(ParticleSet const& set) : set_(set), u_(3 * set.X.size()), v_(3 * set.X.size()) {
    for (std::size_t i = 0; i < set.X.size(); ++i) {
      v_[3 * i] = 0.1 * set.X[i][1];
      v_[3 * i + 1] = -0.1 * set.X[i][0];
    }
  }
  double stable_time_step() const override {
    return steps_ >= collapse_at ? 1e-30 : 0.01 * (1 + 0.3 * std::sin(v_[3 * 3]));
  }
  void step(double, double dt) override {
    for (std::size_t i = 0; i < u_.size(); ++i) {
      v_[i] -= dt * stiffness * u_[i];
      u_[i] += dt * v_[i];
    }
    ++steps_;
    if (steps_ == stop_at && stop != nullptr) *stop = 15;
  }
  void damp(double factor) override {
    for (double& v : v_) v *= factor;
  }
  std::optional<Failure> failure() const override {
    if (steps_ < fail_at) return std::nullopt;
    return Failure{"is inverted", 3, "plate", set_.X[3], {0.5, 0.25, 0}, {{"det F", -0.02}, {"neighbours", 27}}};
  }
  Diagnostics diagnose() const override {
    Diagnostics d;
    for (std::size_t i = 0; i < u_.size(); ++i) {
      d.kinetic_energy += 0.5 * v_[i] * v_[i];
      d.strain_energy += 0.5 * stiffness * u_[i] * u_[i];
      d.linear_momentum[i % 3] += v_[i];
    }
    d.jacobian_min = d.jacobian_max = 1;
    d.pressure_max = steps_ >= nan_at ? std::numeric_limits<double>::quiet_NaN() : u_[3];
    d.more = {{"plastic_work", 0.25}};
    return d;
  }
  std::vector<FieldInfo> fields() const override {
    return {{"Displacement", "m", 3}, {"Velocity", "m/s", 3}, {"Pressure", "Pa", 1}, {"CauchyStress", "Pa", 6}};
  }
  void sample(std::string_view field, std::span<double> values) const override {
    if (field == "Displacement")
      std::copy(u_.begin(), u_.end(), values.begin());
    else if (field == "Velocity")
      std::copy(v_.begin(), v_.end(), values.begin());
    else
      for (std::size_t k = 0; k < values.size(); ++k) values[k] = 1e6 * std::sin(0.3 * static_cast<double>(k));
  }
  void save(StateWriter& writer) const override {
    writer.put("u", u_);
    writer.put("v", v_);
    double const steps = steps_;
    writer.put("steps", {&steps, 1});
  }
  void load(StateReader& reader) override {
    reader.get("u", u_);
    reader.get("v", v_);
    double steps = 0;
    reader.get("steps", {&steps, 1});
    steps_ = static_cast<int>(steps);
  }
  RunStatistics statistics() const override {
    RunStatistics all;
    all.seconds = {{"springs", 0.5 * steps_}};
    all.memory_bytes = 16 * u_.size();
    return all;
  }

  double stiffness = 4;
  static constexpr int never = 1 << 30;
  int fail_at = never, collapse_at = never, stop_at = never, nan_at = never;  ///< step at which this happens
  std::atomic<int>* stop = nullptr;

 private:
  ParticleSet set_;
  std::vector<double> u_, v_;
  int steps_ = 0;
};

/// A simulation of Springs over 1 s with histories, frames and checkpoints.
inline Simulation make_springs(int n = 4) {
  Simulation s;
  s.particles = make_plate(n);
  s.formulation = std::make_unique<Springs>(s.particles);
  s.formulation_name = "springs";
  s.mass = n * n;
  s.spec.title = "Springs";
  s.spec.source = "title = \"Springs\"\n";
  s.spec.run.end = 1;
  s.spec.output.history_every = 0.05;
  s.spec.output.frames_every = 0.25;
  s.spec.output.checkpoints_every = 0.3;
  s.spec.bodies.resize(1);
  s.spec.bodies[0].name = "plate";
  return s;
}

inline Springs& springs(Simulation& s) { return static_cast<Springs&>(*s.formulation); }

}  // namespace piola::testing
