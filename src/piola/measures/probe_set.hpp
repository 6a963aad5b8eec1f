// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/measures/probe.hpp"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace piola {

/// The probes of a run, in the order of the case, on all ranks. Additive probes are evaluated on local particles by
/// each rank; for the others positions of all particles are gathered on rank 0.
class ProbeSet {
 public:
  ProbeSet(CaseSpec const& spec, ParticleSet const& particles);
  /// Values of each probe at a time [s]. Those that are not additive are NaN on other ranks than 0. Collective.
  std::vector<std::vector<double>> evaluate(Formulation const& formulation, double time);
  std::vector<Probe>& probes() { return probes_; }
  std::vector<Probe> const& probes() const { return probes_; }

 private:
  void evaluate_additive(Formulation const& formulation, double time, std::vector<std::vector<double>>& values);
  void distribute(std::optional<std::vector<std::int64_t>> const& local);
  ParticleSet const& particles_;
  std::vector<Probe> probes_;
  std::optional<std::vector<std::int64_t>> distributed_to_;  ///< local particles to which the probes are restricted
};

}  // namespace piola
