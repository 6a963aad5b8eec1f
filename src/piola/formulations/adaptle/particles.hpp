// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/load_balancer.hpp"
#include "piola/exec/lazy_zero_array.hpp"
#include "piola/exec/reproducible_sum.hpp"
#include "piola/formulations/adaptle/fields.hpp"
#include "piola/formulations/adaptle/law_factors.hpp"
#include "piola/formulations/adaptle/lost_surfaces.hpp"
#include "piola/formulations/adaptle/options.hpp"
#include "piola/formulations/adaptle/particle_partition.hpp"
#include "piola/formulations/adaptle/reference_lists.hpp"
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include "piola/formulations/adaptle/step_halo_exchanges.hpp"
#include "piola/formulations/common/lattice_line_halo.hpp"
#include "piola/mechanics/prescribed.hpp"
#include "piola/mechanics/resultants.hpp"
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

namespace piola::adaptle {

/// Sums since the start of the run [J], and counts.
struct EnergyTotals {
  double contact_energy = 0, viscous_loss = 0, external_work = 0;
  double converted = 0, by_guard = 0, converted_mass = 0, energy_change = 0, momentum_change = 0, deleted = 0;
  double overlap = 0;
  double time = 0, next_dt = 0, damping_loss = 0, hourglass_energy = 0;
  double artificial_work = 0;  ///< energy that artificial stress takes from motion, of either sign

  /// For a checkpoint.
  std::vector<double> state() const;
  void restore(std::span<double const> values);

 private:
  template <class Self>
  static auto listed(Self& b) {
    return std::tie(b.contact_energy, b.viscous_loss, b.external_work, b.converted, b.by_guard, b.converted_mass,
                    b.energy_change, b.momentum_change, b.deleted, b.overlap, b.time, b.next_dt, b.damping_loss,
                    b.hourglass_energy, b.artificial_work);
  }
};

/// Wall time by part of a step [s].
struct StepTimings {
  double lists = 0, sweeps = 0, points = 0, conversion = 0;
};

/// All particles of a run: their memory, the order of a step, supports and loads.
class Particles {
 public:
  Particles(Assembly const& assembly, Options const& options, Backend const& backend);
  Particles(Particles const&) = delete;
  Particles& operator=(Particles const&) = delete;

  void step(double time, double dt);
  void damp(double factor);
  double kinetic_energy() const;
  double stable_time_step() const;
  double next_end_time() const;

  System const& system() const { return system_; }
  EnergyTotals const& energy_totals() const { return energy_totals_; }
  /// Reduces the actions of the last step over ranks. Collective.
  Resultants actions() const;
  void restore_actions(std::span<double const> state) {
    action_sums_.reset();
    actions_.restore(state);
  }
  StepTimings const& seconds() const { return seconds_; }
  Options const& options() const { return options_; }
  FailureSlot const& failure() const { return failure_; }
  SpatialLists const& spatial() const { return spatial_; }
  int reference_neighbours(Index i) const { return material_.built() ? material_.neighbours(i) : 0; }
  std::size_t bytes() const;

  Fields& fields() { return fields_; }
  Fields const& fields() const { return fields_; }
  EnergyTotals& energy_totals() { return energy_totals_; }
  /// Calls f(field) for all fields of a checkpoint. Slots count if is_saved(). Deformation follows from
  /// positions, except for deleted particles. The reference data of converted particles are not needed.
  template <class Set, class F>
  void each_saved(Set& fields, F const& f) const {
    fields.each([&](auto& field) {
      if (field.role() == Role::evolved && fields.holds(field)) f(field);
    });
    if (!fields.holds(fields.F) || !deleted()) return;
    f(fields.F);
    f(fields.F_rate);
    f(fields.gap);
  }
  bool is_saved(Field const& field, Index slot) const {
    return field.role() == Role::evolved || !(fields_.active.at(slot) > 0);
  }
  std::vector<double>& rigid_centres() { return rigid_centre_; }
  std::vector<double> const& rigid_centres() const { return rigid_centre_; }
  /// Rebuilds derived data after a checkpoint has been loaded.
  void resumed();
  /// Whether a particle has more neighbours than can be listed.
  bool neighbour_overflow() const { return neighbour_overflow_; }
  /// Motion of these particles, replicated on all ranks [m], [m/s].
  void read_motion(std::span<std::int64_t const> ids, std::span<std::array<double, 3>> x,
                   std::span<std::array<double, 3>> v) const;
  /// Whether the slot is local.
  bool is_local(Index slot) const {
    Range const own = own_[static_cast<std::size_t>(body_of_[static_cast<std::size_t>(slot)])];
    return slot >= own.first && slot < own.last;
  }
  /// Mass of a particle of any rank for contact [kg]; 0 for deleted particles, which do not take part in contact.
  double contact_mass(std::int64_t id) const;
  ParticlePartition const& local_particles() const { return owned_; }
  /// Lattice lines for observers on several ranks; null on one rank.
  LatticeLineHalo* lines(int body) const {
    return lines_.empty() ? nullptr : lines_[static_cast<std::size_t>(body)].get();
  }
  std::optional<RepartitionStatistics> repartition_statistics() const { return balance_.repartition_statistics(); }
  LostSurfaces const& lost_surfaces() const { return lost_; }

 private:
  bool deleted() const;
  /// Whether f(slot) is true for some particle.
  template <class F>
  bool any_of(F const& f) const {
    for (Index i = 0; i < system_.particles; ++i)
      if (f(i)) return true;
    return false;
  }
  void set_bodies(Assembly const& assembly);
  void set_particles(Assembly const& assembly);
  void set_descriptions();
  void set_reference();
  void set_contact(Assembly const& assembly);
  void set_factors();
  void set_boundaries();
  void allocate(Assembly const& assembly);
  void choose_material();
  std::array<double, 3> const& X(Index slot) const { return set_.X[static_cast<std::size_t>(slot)]; }
  void prepare_supports(double time);
  void prepare_loads(double time);
  void prepare_rigid(double time, double dt);
  void sum_actions(double time, double dt);
  void broadcast_failure();
  void start();
  void make_lists(SpatialLists::RemoteParticles const& others);
  void sweep(double dt);
  void evaluate(double dt);
  void convert(double dt);
  bool requests_by_formula();
  /// Mass, change of energy and of momentum of the particles converted in a step.
  using ConversionSums = exec::ReproducibleSums<3>;
  /// Repartitions the particles by their measured work. All values stay bit-identical.
  void rebalance();
  void take(std::vector<Partition> cuts);
  void migrate(std::vector<Partition> const& from, std::vector<Partition> const& to);
  double work_of(Index slot) const;
  std::vector<ImpulseSum> impulses(double time, double dt) const;
  void lose_surface(Index slot);
  void make_eulerian(Index i, double dt, bool by_guard, ConversionSums& sums);
  double energy_of(Index i) const;
  std::array<double, 3> momentum_of(Index i) const;
  void remove(Index i);

  Options options_;
  Backend const* backend_;
  System system_;
  std::vector<BodyConstants> body_;
  ParticlePartition owned_;
  std::vector<Range> own_;                        ///< of each body: the local slots
  std::unique_ptr<StepHaloExchanges> exchanges_;  ///< null on one rank
  std::vector<std::unique_ptr<LatticeLineHalo>> lines_;
  std::vector<int> body_of_;
  Fields fields_;
  LazyZeroArray<Correction> correction_;
  LazyZeroArray<std::int8_t> conversion_requests_;
  LazyZeroArray<double> position_;
  std::vector<std::uint8_t> eulerian_;
  ReferenceLists material_;
  SpatialLists spatial_;
  Memory material_records_;
  std::vector<KernelContactPair> contact_pairs_;
  LostSurfaces lost_;
  std::vector<double> partial_;
  LazyZeroArray<double> rigid_power_;
  PointFactors factors_;
  FailureSlot failure_;
  EnergyTotals energy_totals_;
  StepTimings seconds_;
  bool lagrangian_ = false;  ///< whether some particle is not fully Eulerian
  bool neighbour_overflow_ = false;
  // Boundaries
  std::vector<Support> supports_;
  std::vector<Load> loads_;
  LazyZeroArray<std::int8_t> held_;
  LazyZeroArray<std::size_t> holder_;  ///< per component: index of the support that holds it
  LazyZeroArray<double> held_velocity_, load_, reaction_;
  std::vector<double> rigid_action_;
  Resultants actions_;
  /// Local impulses of the last step whose reduction is deferred; empty once they are in `actions_`.
  struct ResultantSums {
    double dt;
    std::vector<ImpulseSum> impulses;               ///< of supports, then of loads
    std::vector<exec::ReproducibleSums<6>> rigids;  ///< force and moment of rigid shapes
  };
  std::optional<ResultantSums> action_sums_;
  std::vector<RigidShape> shapes_;
  std::vector<RigidPoseAtHalfTime> rigid_;
  std::vector<double> rigid_centre_;
  LoadBalancer balance_;
  ParticleSet const set_;  ///< copy-on-write, shared with the case
};

}  // namespace piola::adaptle
