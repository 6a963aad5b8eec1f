// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piola {

/// The fields of one moment, each sampled at most once. Besides the formulation's own fields it knows "Position"
/// (X + Displacement [m]), "Body" and "Id". Valid until the next step.
class FieldCache {
 public:
  /// Values of all particles, or of those that this rank owns (Formulation::owned): then all ranks ask for the same
  /// fields, in the same order, and `id` below is the place among those.
  enum class Of { all, owned };
  FieldCache(Formulation const& formulation, ParticleSet const& particles, Of of = Of::all);
  bool knows(std::string_view field) const;
  /// Throws std::invalid_argument for a field that is not known.
  FieldInfo const& info(std::string_view field) const;
  /// values[id * components + c]
  std::span<double const> values(std::string_view field);
  std::vector<FieldInfo> const& fields() const { return fields_; }
  ParticleSet const& particles() const { return particles_; }
  /// Of Of::owned: whose values those are; nothing if this rank owns all.
  std::optional<std::vector<std::int64_t>> const& owned() const { return owned_; }

 private:
  std::vector<double> make(std::string_view field, std::size_t components);
  Formulation const& formulation_;
  ParticleSet const& particles_;
  std::vector<FieldInfo> fields_;
  Of of_;
  std::optional<std::vector<std::int64_t>> owned_;  ///< nothing: all
  std::map<std::string, std::vector<double>, std::less<>> cache_;
};

/// One number per particle: component c of a field, or the length of a vector for c = FieldQuantity::magnitude.
std::vector<double> component_values(FieldCache& cache, std::string_view field, int component);

}  // namespace piola
