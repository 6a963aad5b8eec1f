// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/case_spec.hpp"
#include "piola/measures/clusters.hpp"
#include "piola/output/field_cache.hpp"
#include "piola/output/history.hpp"
#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace piola {

/// Whether values of this kind are sums and extrema over particles, so that each rank can evaluate its local ones; else
/// one rank needs all.
inline bool is_reducible(ProbeSpec::Kind kind) { return kind < ProbeSpec::Kind::spacing; }

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
  std::vector<std::int64_t> const& ids() const { return ids_; }

  bool is_reducible() const { return piola::is_reducible(kind_); }
  /// Restricts the probe to the local particles of this rank (Observables::local_particles). evaluate() then needs a
  /// cache of these, is collective, and gives the bits of one rank.
  void share(std::optional<std::vector<std::int64_t>> const& owned);

  /// State for later calls: the last twist angle [rad].
  double state() const { return last_angle_; }
  void restore(double state) { last_angle_ = state; }

 private:
  double reduce(std::vector<double> const& values) const;
  std::array<double, 2> extrema(auto const& value) const;
  std::size_t place(std::size_t k) const { return place_.empty() ? static_cast<std::size_t>(ids_[k]) : place_[k]; }
  double twist(FieldCache& cache);
  double extent(FieldCache& cache) const;
  double relative_error(FieldCache& cache, double time) const;
  double intensity(FieldCache& cache) const;
  std::vector<double> own_values(FieldCache& cache, double time);
  ProbeSpec::Kind kind_;
  std::string name_;
  std::size_t axis_;
  std::vector<std::int64_t> ids_;
  std::vector<double> weight_;             ///< tributary volumes of ids_
  std::vector<std::size_t> place_;         ///< indices of ids_ in a cache of local particles; empty: the ids
  std::vector<std::size_t> order_;         ///< stress_intensity: indices of ids_ among those of all ranks; empty: all
  std::vector<FieldQuantity> quantities_;  ///< empty for the kinds with numbers of their own
  std::vector<std::size_t> own_;           ///< indices of these among the quantities of the kind
  std::optional<Measured> measured_;       ///< spacing, fragment, rim, hole
  std::string field_;                      ///< error
  std::vector<Expression> reference_;      ///< error: one per component of the field
  std::array<double, 3> direction_;        ///< stress_intensity: ahead of the tip
  std::vector<double> distance_;           ///< stress_intensity: of ids_ from the tip [m]
  double last_angle_ = 0;
};

}  // namespace piola
