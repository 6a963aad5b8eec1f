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

/// The probes of a run, in the order of the case, on all ranks. Additive probes are evaluated on local particles by
/// each rank; for the others positions of all particles are gathered on rank 0.
class ProbeRow {
 public:
  ProbeRow(CaseSpec const& spec, ParticleSet const& particles);
  /// Values of each probe at a time [s]. Collective: rank 0 calls this, other ranks take_part().
  std::vector<std::vector<double>> evaluate(Formulation const& formulation, double time);
  /// Counterpart of evaluate() on ranks other than 0.
  void take_part(Formulation const& formulation, double time);
  std::vector<Probe>& probes() { return probes_; }
  std::vector<Probe> const& probes() const { return probes_; }

 private:
  std::vector<std::vector<double>> evaluate_owned(Formulation const& formulation, double time);
  void share(std::optional<std::vector<std::int64_t>> const& owned);
  ParticleSet const& particles_;
  std::vector<ProbeSpec> specs_;
  std::vector<Probe> probes_;
  std::optional<std::size_t> shared_for_;  ///< number of repartitions when the probes were distributed
};

}  // namespace piola
