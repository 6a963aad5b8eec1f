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
#include <optional>
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
  double next_end_time() const { return boundary_.next_end_time(energy_totals_.time); }

  System const& system() const { return data_.system(); }
  Fields& fields() { return data_.fields(); }
  Fields const& fields() const { return data_.fields(); }
  EnergyTotals& energy_totals() { return energy_totals_; }
  EnergyTotals const& energy_totals() const { return energy_totals_; }
  /// As BoundaryConditions::resultants(). Collective.
  Resultants actions() const { return boundary_.resultants(); }
  void restore_actions(std::span<double const> state) { boundary_.restore_resultants(state); }
  StepTimings const& seconds() const { return seconds_; }
  FailureSlot const& failure() const { return data_.failure(); }
  /// Whether a particle has more neighbours than can be listed.
  bool neighbour_overflow() const { return neighbour_overflow_; }
  SpatialLists const& spatial() const { return spatial_; }
  int reference_neighbours(Index i) const { return material_.built() ? material_.neighbours(i) : 0; }
  std::size_t bytes() const { return data_.bytes() + material_.bytes() + spatial_.bytes(); }

  ParticleData const& data() const { return data_; }
  std::vector<double>& rigid_centres() { return boundary_.rigid_shapes().centres(); }
  std::vector<double> const& rigid_centres() const { return boundary_.rigid_shapes().centres(); }
  /// Rebuilds derived data after a checkpoint has been loaded.
  void resumed();

  /// Motion of these particles, replicated [m], [m/s]. Collective.
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const;
  bool is_local(Index slot) const { return data_.system().is_local(slot); }
  double contact_mass(std::int64_t id) const { return data_.contact_mass(id); }
  ParticlePartition const& local_particles() const { return distribution_.partition(); }
  LatticeLineHalo* lines(int body) const { return distribution_.lines(body); }
  std::optional<RepartitionStatistics> repartition_statistics() const { return distribution_.statistics(); }
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
