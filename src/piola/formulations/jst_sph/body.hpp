// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/deferred_global_sum.hpp"
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/lattice_line_halo.hpp"
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/jst_sph/boundary_conditions.hpp"
#include "piola/formulations/jst_sph/fields.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/math/tensor.hpp"
#include "piola/neighbours/reference_pairs.hpp"
#include <memory>
#include <vector>

namespace piola::jst_sph {

/// One body of a JST-SPH run: owns its memory, passes its state to the loops, is addressed in Id order.
class JstBody {
 public:
  /// Keeps a reference to `set`, which must outlive the body. Throws InputError (too few neighbours). Collective.
  JstBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
          Backend const& backend);
  JstBody(JstBody const&) = delete;
  JstBody& operator=(JstBody const&) = delete;

  BodyState& state() { return state_; }
  BodyState const& state() const { return state_; }
  Body const& body() const { return body_; }
  Options const& options() const { return options_; }
  Index particles() const { return order_.particles; }
  Index slots() const { return order_.slots(); }
  std::int64_t id(Index slot) const { return order_.id[static_cast<std::size_t>(slot)]; }
  ReferencePairs const& pairs() const { return *pairs_; }
  ParticleSet const& set() const { return *set_; }
  std::size_t bytes() const;
  bool shared() const { return halo_ != nullptr; }
  /// Slots of the local particles: all on one rank.
  Range own() const;
  /// Communication pattern of the body; a step has one or two right-hand sides.
  /// Lattice lines for observers if the body is distributed; else nullptr.
  LatticeLineHalo* lines() const { return lines_.get(); }
  /// Advances from `time` to time + dt, with supports and loads.
  void step(Backend const& backend, double time, double dt);
  /// Multiplies the velocities that are not prescribed, and adds the lost energy to the damping loss.
  void damp(double factor);
  DeferredGlobalSum& external_work() {
    return external_work_;
  }  ///< of loads and of driven supports since the start [J]
  DeferredGlobalSum const& external_work() const { return external_work_; }
  double kinetic_energy() const;  ///< over all ranks [J]; collective
  /// The next time after `time` at which a support or a load ends.
  double next_end_time(double time) const { return boundary_.next_end_time(time); }
  Boundary& boundary() { return boundary_; }
  Boundary const& boundary() const { return boundary_; }

  /// State of the particle in a slot, three-dimensional (missing directions do not deform).
  std::array<double, 3> X(Index slot) const { return set_->X[static_cast<std::size_t>(id(slot))]; }
  std::array<double, 3> x(Index slot) const {
    return D_ < 3 ? point_at(state_.x, slot, D_, X(slot)) : point_at(state_.x, slot, 3);
  }
  std::array<double, 3> v(Index slot) const { return point_at(state_.v, slot, D_); }
  Mat<3> F(Index slot) const;
  Mat<3> H(Index slot) const;  ///< the evolved H if there is one, else cof F
  double J(Index slot) const;  ///< the evolved J if there is one, else det F
  /// Tributary volume in the body itself, and in the body continued by mirror planes.
  double volume(Index slot) const { return set_->volume[static_cast<std::size_t>(id(slot))]; }

  double mirrored_volume(Index slot) const { return volume(slot) * images_.multiplicity(slot); }

  static double value(FieldRef const& f, Index slot, int c = 0) { return value_at(f, slot, c); }
  static void set(FieldRef const& f, Index slot, int c, double value) { value_at(f, slot, c) = value; }

 private:
  std::optional<Cloud> cloud(ParticleSet const& set) const;
  double spacing() const;
  /// Largest support radius [m].
  double reach() const;
  /// Slots of the body and of its mirror images.
  Index all_slots() const { return order_.slots() + images_.count(); }
  void mark_images();
  /// Assigns this rank its range of slots. Later set-up covers these slots only. Collective.
  void share(int lanes);
  void mark_halo();
  void tell_once(FieldRef const& field, int first, int count) const;
  /// Calls f(slot) for local particles and ghosts.
  template <class Visit>
  void each_seen(Visit const& f) const;
  /// Field of a ghost exchange: values [first, first + count), for near ghosts or also for far ones.
  struct Told {
    FieldRef field;
    int first, count;
    bool far;
  };
  std::vector<std::vector<Told>> told() const;
  std::vector<Index> slots_read(int lanes, bool far) const;
  void make_pairs(ParticleSet const& set, Backend const& backend);
  void take_tables();
  void allocate();
  /// Memory of fields that sweeps read together at neighbours.
  struct NeighbourRecords {
    Memory memory;
    std::ptrdiff_t component = 0, particle = 1, start = 0;
    FieldVersion version;
  };
  NeighbourRecords gather(int values) const;
  void place_gathered();
  void fill_adjoint(int first);
  bool wanted(Field const& f) const;
  void fill_filter();
  void fill_evolved_geometry();
  /// Calls f(place, slot) for every stored place of a reference field that holds a particle.
  template <class Visit>
  void each_stored(int lanes, Visit const& visit) const;
  void share_reference(int lanes);
  void fill_reference(int lanes);
  void fill_initial(Assembly const& assembly, Backend const& backend);
  void deform_to_positions(Backend const& backend);
  void set_constants(ParticleSet const& set, MaterialParameters const& material);
  /// The first sweep also reads positions, for the Laplacian of the motion without its rigid part.
  bool gathers_position() const { return verlet(); }
  bool stabilised() const { return options_.biharmonic != Biharmonic::none; }
  bool verlet() const { return options_.integrator == Integrator::verlet; }

  Body body_;
  Options options_;
  int D_;
  SlotOrder order_;
  ParticleSet const* set_;
  MirrorImages images_;
  std::unique_ptr<ReferencePairs> pairs_;
  Fields fields_;
  Field weight_{"QuadratureWeight", "m3", 1, Role::reference};  ///< with mirror planes
  NeighbourRecords first_, second_;
  std::vector<std::int32_t> group_;  // regular bodies: index of the stored reference data of a group of lanes
  Index stored_slots_ = 0;
  std::vector<Index> group_first_;  // per stored group: first slot
  Boundary boundary_;
  std::vector<double> partial_;
  DeferredGlobalSum external_work_;
  FailureSlot failure_;
  BodyState state_;
  std::unique_ptr<HaloPlan> halo_;  ///< nullptr on one rank
  std::unique_ptr<LatticeLineHalo> lines_;
};

}  // namespace piola::jst_sph
