// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/deferred_global_sum.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/body_halo.hpp"
#include "piola/formulations/common/mirror_images.hpp"
#include "piola/formulations/common/unique_lane_groups.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/jst_sph/boundary_conditions.hpp"
#include "piola/formulations/jst_sph/neighbour_records.hpp"
#include "piola/formulations/jst_sph/options.hpp"
#include "piola/formulations/jst_sph/state.hpp"
#include "piola/math/tensor.hpp"
#include "piola/neighbours/reference_pairs.hpp"
#include <memory>
#include <optional>
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
  MirrorImages& images() { return images_; }
  std::size_t bytes() const;
  bool shared() const { return halo_ != nullptr; }  ///< whether the body is distributed
  /// Slots of the local particles.
  Range own() const;
  /// Lattice lines for observers if the body is distributed; else nullptr.
  LatticeLineHalo* lattice_line_halo() const { return halo_ ? &halo_->lines : nullptr; }
  /// Calls f(name, field, components) for the evolved state, i.e. the fields of a checkpoint.
  template <class F>
  void each_evolved(F const& f) const {
    fields_.each_evolved(f);
  }
  /// Advances from `time` to time + dt, with supports and loads.
  void step(Backend const& backend, double time, double dt);
  /// Multiplies the velocities that are not prescribed, and adds the lost energy to the damping loss.
  void damp(double factor);
  /// Work of loads and of driven supports since the start [J].
  DeferredGlobalSum& external_work() { return external_work_; }
  DeferredGlobalSum const& external_work() const { return external_work_; }
  double kinetic_energy() const;  ///< [J]; collective
  /// The next time after `time` at which a support or a load ends.
  double next_end_time(double time) const { return boundary_.next_end_time(time); }
  Boundary& boundary() { return boundary_; }
  Boundary const& boundary() const { return boundary_; }

  /// State of the particle in a slot, three-dimensional (missing directions do not deform).
  std::array<double, 3> X(Index slot) const { return set_->X[static_cast<std::size_t>(id(slot))]; }
  std::array<double, 3> x(Index slot) const {
    int const D = state_.dimension;
    return D < 3 ? point_at(state_.x, slot, D, X(slot)) : point_at(state_.x, slot, 3);
  }
  std::array<double, 3> v(Index slot) const { return point_at(state_.v, slot, state_.dimension); }
  Mat<3> F(Index slot) const;
  Mat<3> H(Index slot) const;  ///< the evolved H if there is one, else cof F
  double J(Index slot) const;  ///< the evolved J if there is one, else det F
  double replicated_mass(Index slot) const { return volume(slot) * state_.constants.rho0; }  ///< of any particle [kg]
  /// Tributary volume in the body itself.
  double volume(Index slot) const { return set_->volume[static_cast<std::size_t>(id(slot))]; }
  /// Tributary volume in the body continued by mirror planes.
  double mirrored_volume(Index slot) const { return volume(slot) * images_.multiplicity(slot); }

  static double value(FieldRef const& f, Index slot, int c = 0) { return value_at(f, slot, c); }
  static void set(FieldRef const& f, Index slot, int c, double value) { value_at(f, slot, c) = value; }

 private:
  std::optional<Cloud> cloud() const;
  void make_pairs(Backend const& backend);
  void group_lanes(int lanes);
  void distribute(int lanes);
  std::vector<Index> slots_of_neighbours(int lanes, bool far) const;
  void set_constants(MaterialParameters const& material);
  void allocate();
  void fill(Assembly const& assembly, Backend const& backend);

  Body body_;
  Options options_;
  SlotOrder order_;
  ParticleSet const* set_;
  MirrorImages images_;
  std::unique_ptr<ReferencePairs> pairs_;
  FieldList fields_;
  BodyState state_;
  NeighbourRecords records_;
  std::optional<UniqueLaneGroups> groups_;  ///< of reference data, if the pair tables are stencils
  Boundary boundary_;
  std::vector<double> partial_;
  DeferredGlobalSum external_work_;
  FailureSlot failure_;
  std::unique_ptr<BodyHalo> halo_;  ///< nullptr if not distributed
};

}  // namespace piola::jst_sph
