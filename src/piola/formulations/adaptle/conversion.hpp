// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/formulations/adaptle/energy_totals.hpp"
#include "piola/formulations/adaptle/lost_surfaces.hpp"
#include "piola/formulations/adaptle/particle_data.hpp"
#include "piola/formulations/adaptle/reference_lists.hpp"
#include <array>
#include <vector>

namespace piola::adaptle {

/// Conversion of total-Lagrangian particles to Eulerian ones, and their deletion: requests, lost surfaces, and changes
/// of energy and momentum.
class Conversion {
 public:
  /// All arguments must outlive this.
  Conversion(ParticleData& particles, std::vector<BodyOptions> const& options, ReferenceLists const& neighbours,
             EnergyTotals& totals);
  Conversion(Conversion const&) = delete;
  Conversion& operator=(Conversion const&) = delete;

  /// Evaluates convert_when; returns whether any particle is to convert by it. Collective.
  bool request_by_formula();
  /// Converts flagged particles to Eulerian, or deletes them in bodies with failed = "delete". In bodies without
  /// deletion, reference neighbours within conversion_radius of a particle flagged by a criterion convert too (not
  /// recursively). A conversion counts as a guard conversion only if no criterion asked for it. Collective.
  void convert(double dt);
  /// Marks the surfaces that the Eulerian particles of a checkpoint have lost.
  void resumed();
  LostSurfaces const& lost_surfaces() const { return lost_; }

 private:
  /// Mass, change of energy and of momentum of the particles converted in a step.
  using Sums = exec::ReproducibleSums<3>;
  bool request_by(Expression const& formula, std::size_t body);
  void lose_surface(Index slot);
  void make_eulerian(Index i, double dt, bool by_guard, Sums& sums);
  void remove(Index i);
  double energy_of(Index i) const;
  std::array<double, 3> momentum_of(Index i) const;

  ParticleData& particles_;
  std::vector<BodyOptions> const& options_;
  ReferenceLists const& neighbours_;
  EnergyTotals& totals_;
  LazyZeroArray<std::int8_t> requests_;  ///< per slot, as DescriptionTable::request
  LostSurfaces lost_;
};

}  // namespace piola::adaptle
