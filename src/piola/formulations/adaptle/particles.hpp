// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/adaptle/boundary_conditions.hpp"
#include "piola/formulations/adaptle/conversion.hpp"
#include "piola/formulations/adaptle/distribution.hpp"
#include "piola/formulations/adaptle/energy_totals.hpp"
#include "piola/formulations/adaptle/law_factors.hpp"
#include "piola/formulations/adaptle/particle_data.hpp"
#include "piola/formulations/adaptle/reference_lists.hpp"
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include <array>
#include <span>
#include <vector>

namespace piola::adaptle {

/// Wall time by part of a step [s].
struct StepTimings {
  double lists = 0, sweeps = 0, points = 0, conversion = 0;
};

/// All particles of a run, and the order of a step.
class Particles {
 public:
  Particles(Assembly const& assembly, Options const& options, Backend const& backend);
  Particles(Particles const&) = delete;
  Particles& operator=(Particles const&) = delete;

  void step(double time, double dt);
  void damp(double factor);
  double kinetic_energy() const;
  double stable_time_step() const { return energy_totals_.next_dt; }

  ParticleData const& data() const { return data_; }
  System const& system() const { return data_.system(); }
  Fields& fields() { return data_.fields(); }
  Fields const& fields() const { return data_.fields(); }
  EnergyTotals& energy_totals() { return energy_totals_; }
  EnergyTotals const& energy_totals() const { return energy_totals_; }
  BoundaryConditions& boundary() { return boundary_; }
  BoundaryConditions const& boundary() const { return boundary_; }
  Distribution const& distribution() const { return distribution_; }
  StepTimings const& seconds() const { return seconds_; }
  FailureSlot const& failure() const { return data_.failure(); }
  /// Whether a particle has more neighbours than can be listed.
  bool neighbour_overflow() const { return neighbour_overflow_; }
  SpatialLists const& spatial() const { return spatial_; }
  int reference_neighbours(Index i) const { return material_.built() ? material_.neighbours(i) : 0; }
  std::size_t bytes() const { return data_.bytes() + material_.bytes() + spatial_.bytes(); }

  /// Rebuilds derived data after a checkpoint has been loaded.
  void resumed();

  /// Motion of these particles, replicated [m], [m/s]. Collective.
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const;
  LostSurfaces const& lost_surfaces() const { return conversion_.lost_surfaces(); }

 private:
  void start();
  void take(std::vector<Partition> cuts);
  void set_factors();
  void choose_material();
  void make_lists(SpatialLists::RemoteParticles const& others);
  void sweep(double dt);
  void evaluate(double dt);
  void broadcast_failure();

  Options options_;
  Backend const* backend_;
  ParticleData data_;
  ReferenceLists material_;
  SpatialLists spatial_;
  PointFactors factors_;
  BoundaryConditions boundary_;
  EnergyTotals energy_totals_;
  Conversion conversion_;
  Distribution distribution_;
  StepTimings seconds_;
  bool neighbour_overflow_ = false;
};

}  // namespace piola::adaptle
