// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/particles/particle_set.hpp"
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piola {

class FieldCache;

/// Calls f(fields) on rank 0, where `fields` has the values of all particles. The other ranks send their values of each
/// field that f() requests. Collective. If f() throws, all ranks throw comm::CollectiveError; on one rank the error
/// itself.
void evaluate_on_root(Formulation const& formulation, ParticleSet const& particles,
                      std::function<void(FieldCache&)> const& f);

/// Fields at one time, each sampled at most once. Contains the formulation's fields and "Position" (X + Displacement
/// [m]), "Body" and "Id". Valid until the next step; formulation and particles must outlive it.
class FieldCache {
 public:
  /// all: values of all particles; on several ranks only in evaluate_on_root(). local: values of local particles only
  /// (Observables::local_particles); `id` below is then the index among these, and values() is collective: all ranks
  /// request the same fields in the same order.
  enum class Of { all, local };
  FieldCache(Formulation const& formulation, ParticleSet const& particles, Of of = Of::all);
  bool knows(std::string_view field) const;
  /// Throws std::invalid_argument for a field that is not known.
  FieldInfo const& info(std::string_view field) const;
  /// values[id * components + c]
  std::span<double const> values(std::string_view field);
  std::vector<FieldInfo> const& fields() const { return fields_; }
  Observables const& observables() const { return observables_; }
  ParticleSet const& particles() const { return particles_; }
  /// For Of::local, the ids of the local particles; nothing if these are all particles.
  std::optional<std::vector<std::int64_t>> const& local_particles() const { return local_; }

 private:
  std::vector<double> make(std::string_view field, std::size_t components);
  Observables const& observables_;
  ParticleSet const& particles_;
  std::vector<FieldInfo> fields_;
  Of of_;
  std::optional<std::vector<std::int64_t>> local_;  ///< nothing: all
  std::map<std::string, std::vector<double>, std::less<>> cache_;
};

/// One number per particle: component c of a field, or the length of a vector for c = FieldQuantity::magnitude.
std::vector<double> component_values(FieldCache& cache, std::string_view field, int component);

}  // namespace piola
