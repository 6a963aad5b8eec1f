// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/rigid_state.hpp"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// A particle field as it appears in frames, probes and the manual.
struct FieldInfo {
  std::string name;  ///< VTK style, e.g. "CauchyStress"
  std::string unit;  ///< SI, UDUNITS notation
  int components;    ///< 1 scalar, 3 vector, 6 symmetric tensor (XX YY ZZ XY YZ XZ), 9 tensor (row by row)
};

/// Returns the field of this name. Throws std::invalid_argument if there is none.
FieldInfo const& info_of(std::span<FieldInfo const> fields, std::string_view name);

/// The bound that limits the step from the current state.
struct StepBound {
  double step = 0;             ///< s, not shortened to the end of a load or support
  std::string text;            ///< what limits the step, in words
  std::int64_t particle = -1;  ///< id of the particle whose bound this is; -1: a bound of no single particle
};

/// The current state of a formulation for frames, probes, pictures and logs: fields of its particles, in Id order, its
/// rigid shapes, and what limits its step. Read-only.
class Observables {
 public:
  virtual ~Observables() = default;
  virtual std::vector<FieldInfo> fields() const = 0;
  /// The fields of one body of coupled formulations; bodies without a field show zero.
  virtual std::vector<FieldInfo> fields_of(std::size_t body) const = 0;
  /// Samples one field: values[id * components + c]. Ranks other than 0 pass an empty span. Collective.
  virtual void sample(std::string_view field, std::span<double> values) const = 0;
  /// Ids of the particles that this rank evaluates for observers: each particle is on exactly one rank. Valid until the
  /// next repartition. Empty: all particles, in Id order.
  virtual std::optional<std::vector<std::int64_t>> local_particles() const = 0;
  /// Samples one field of local_particles(): values[k * components + c] for the k-th. Collective.
  virtual void sample_local(std::string_view field, std::span<double> values) const = 0;
  /// Current state of free and rotating rigid shapes; driven ones without rotation follow from the case.
  virtual std::vector<RigidState> rigids() const = 0;
  /// The bound that limits the next step; valid after a step. Equal on all ranks. Collective.
  virtual StepBound step_bound() const = 0;
};

/// Observables of bodies without rigid shapes, of one formulation that runs on one rank.
class SingleRankObservables : public Observables {
 public:
  std::vector<FieldInfo> fields_of(std::size_t /*body*/) const override { return fields(); }
  std::optional<std::vector<std::int64_t>> local_particles() const override { return std::nullopt; }
  void sample_local(std::string_view field, std::span<double> values) const override { sample(field, values); }
  std::vector<RigidState> rigids() const override { return {}; }
};

}  // namespace piola
