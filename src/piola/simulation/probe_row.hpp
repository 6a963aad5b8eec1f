// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/simulation/probes.hpp"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace piola {

/// The probes of a run, in the order of the case. On ranks all have them, and each looks at its own particles where
/// values add up; for the others rank 0 gets positions of all particles.
class ProbeRow {
 public:
  ProbeRow(CaseSpec const& spec, ParticleSet const& particles);
  /// Values of each probe at a time [s]; on rank 0 of several, whom the others help.
  std::vector<std::vector<double>> evaluate(Formulation const& formulation, double time);
  /// What those others do.
  void take_part(Formulation const& formulation, double time);
  std::vector<Probe>& probes() { return probes_; }
  std::vector<Probe> const& probes() const { return probes_; }

 private:
  std::vector<std::vector<double>> evaluate_owned(Formulation const& formulation, double time);
  void share(std::optional<std::vector<std::int64_t>> const& owned);
  ParticleSet const& particles_;
  std::vector<ProbeSpec> specs_;
  std::vector<Probe> probes_;
  std::optional<std::size_t> shared_for_;  ///< how often ranks had been cut anew when they shared the probes
};

}  // namespace piola
