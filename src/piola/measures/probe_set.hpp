// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/measures/probe.hpp"
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace piola {

/// The probes of a run, in the order of the case, on all ranks. Additive probes are evaluated on local particles by
/// each rank; for the others positions of all particles are gathered on rank 0.
class ProbeSet {
 public:
  /// Makes all ranks evaluate their part of the probes at a time [s], then calls `evaluate` on this one.
  using OnAllRanks = void (*)(double time, std::function<void()> const& evaluate);
  ProbeSet(CaseSpec const& spec, ParticleSet const& particles);
  /// Values of each probe at a time [s]. Collective: rank 0 calls this, other ranks evaluate_local(). `on_all_ranks`
  /// sends the command to these; evaluate_probes_collectively() in a run.
  std::vector<std::vector<double>> evaluate(Formulation const& formulation, double time, OnAllRanks on_all_ranks);
  /// Counterpart of evaluate() on ranks other than 0.
  void evaluate_local(Formulation const& formulation, double time);
  std::vector<Probe>& probes() { return probes_; }
  std::vector<Probe> const& probes() const { return probes_; }

 private:
  std::vector<std::vector<double>> evaluate_additive(Formulation const& formulation, double time);
  void distribute(std::optional<std::vector<std::int64_t>> const& local);
  ParticleSet const& particles_;
  std::vector<Probe> probes_;
  std::optional<std::vector<std::int64_t>> distributed_to_;  ///< local particles to which the probes are restricted
};

}  // namespace piola
