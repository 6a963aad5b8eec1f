// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/input/probe_kinds.hpp"
#include "piola/measures/clusters.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/output/history.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace piola {

/// The particles of a probe: all that it selects, or the local ones of this rank.
struct ProbeParticles {
  std::vector<std::int64_t> ids;
  std::vector<double> volume;      ///< tributary
  std::vector<std::size_t> place;  ///< indices of ids in a cache of local particles; empty: the ids
  std::vector<std::size_t> order;  ///< indices of ids among those of all ranks; empty: all

  std::size_t size() const { return ids.size(); }
  /// Index of particle k in a cache.
  std::size_t at(std::size_t k) const { return place.empty() ? static_cast<std::size_t>(ids[k]) : place[k]; }
};

/// One [[probe]] of a case, with its particles chosen once from their reference positions.
class Probe {
 public:
  /// Throws InputError if `where` (or `from` and `to`) selects nothing, or if the body or a quantity is unknown.
  Probe(ProbeSpec const& spec, ParticleSet const& particles);
  /// "NAME.quantity" with units, one for each value of `evaluate`.
  std::vector<HistoryColumn> columns() const;
  /// Present values [SI]. A twist angle continues from the last call, so that full turns are counted if it changes by
  /// less than half a turn between calls. `time` [s] is for formulas.
  std::vector<double> evaluate(FieldCache& cache, double time = 0);
  ProbeSpec const& spec() const { return spec_; }
  std::vector<std::int64_t> const& ids() const { return particles_.ids; }

  bool is_reducible() const { return info_of(spec_.kind).is_reducible; }
  /// Restricts the probe to the local particles of this rank (Observables::local_particles). evaluate() then needs a
  /// cache of these, is collective, and gives the bits of one rank.
  void share(std::optional<std::vector<std::int64_t>> const& owned);

  /// State for later calls: the last twist angle [rad].
  double state() const { return last_angle_; }
  void restore(double state) { last_angle_ = state; }

 private:
  std::vector<double> own_values(FieldCache& cache, double time);
  ProbeSpec spec_;
  ProbeParticles particles_;
  std::vector<FieldQuantity> quantities_;  ///< empty for the kinds with numbers of their own
  std::vector<std::size_t> own_;           ///< indices of these among the quantities of the kind
  std::optional<Measured> measured_;       ///< of the kinds that are not reducible
  std::vector<double> distance_;           ///< stress_intensity: of the particles of all ranks from the tip [m]
  double last_angle_ = 0;
};

}  // namespace piola
