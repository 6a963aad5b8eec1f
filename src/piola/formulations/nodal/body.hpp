// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/halo_plan.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/lattice_line_halo.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/nodal/boundary_conditions.hpp"
#include "piola/formulations/nodal/fields.hpp"
#include "piola/formulations/nodal/neighbour_records.hpp"
#include "piola/formulations/nodal/options.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/smoothing.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/math/tensor.hpp"
#include <memory>
#include <optional>
#include <vector>

namespace piola::nodal {

/// One body of a nodal run: owns its memory, passes its state to the loops, is addressed in Id order.
class NodalBody {
 public:
  /// Keeps a reference to `set`, which must outlive the body. Throws InputError (too few particles across; a body
  /// without an outline). Collective: each rank holds its local particles and their ghosts.
  NodalBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
            Backend const& backend);
  NodalBody(NodalBody const&) = delete;
  NodalBody& operator=(NodalBody const&) = delete;

  BodyState& state() { return state_; }
  BodyState const& state() const { return state_; }
  Body const& body() const { return body_; }
  ParticleSet const& set() const { return *set_; }
  Options const& options() const { return options_; }
  Boundary& boundary() { return *boundary_; }
  Boundary const& boundary() const { return *boundary_; }
  Index particles() const { return order_.particles; }
  Index slots() const { return order_.slots(); }
  std::int64_t id(Index slot) const { return order_.id[static_cast<std::size_t>(slot)]; }
  Reference const& reference() const { return reference_; }
  bool shared() const { return halo_ != nullptr; }
  /// Communication pattern of the body while strains change slowly.
  /// Slots of the local particles: all on one rank.
  Range own() const;
  /// Lattice lines for observers if the body is distributed; else nullptr.
  LatticeLineHalo* lines() const { return lines_.get(); }
  /// Created on first use. Collective.
  Smoothing const& smoothing() const;
  std::size_t bytes() const;

  /// Advances from `time` to time + dt, with supports and loads. If a cell is inverted, repeats the step in two halves,
  /// up to a few times; the failure remains if that does not help. Returns the number of halvings.
  int step(Backend const& backend, double time, double dt);
  /// Multiplies the velocities that no support prescribes; the lost kinetic energy is added to damping_loss().
  void damp(double factor);
  /// Largest change of a strain at the last step since the last measurement of the step limit.
  double largest_change() const { return largest_change_; }
  double kinetic_energy() const;                               ///< over all ranks [J]; collective
  double kinetic_energy_of(Index slot) const;                  ///< [J]
  double strain_energy() const;                                ///< over all ranks, of the state for observers [J];
                                                               ///< collective
  double damping_loss() const { return damping_loss_; }        ///< since the start [J]
  double viscous_loss() const;                                 ///< over all ranks, since the start [J]; collective
  bool stores_history() const { return fields_.with_solids; }  ///< whether it has solids in rate form
  bool viscous() const { return fields_.with_viscosity; }
  /// Mean over the points of a cell of one number of their histories (HistoryLayout); 0 for bodies without solids in
  /// rate form.
  double mean_of_points(Index slot, int number) const;
  void set_damping_loss(double loss) { damping_loss_ = loss; }
  /// Whether the fields for observers belong to the present state, so that no sweep is needed. Callers that change the
  /// state from outside must reset it.
  bool observed() const { return observed_; }
  void set_observed(bool observed) { observed_ = observed; }
  double next_end_time(double time) const { return boundary_->next_end_time(time); }

  std::array<double, 3> X(Index slot) const { return set_->X[static_cast<std::size_t>(id(slot))]; }
  std::array<double, 3> x(Index slot) const {
    return D_ < 3 ? point_at(state_.x, slot, D_, X(slot)) : point_at(state_.x, slot, 3);
  }
  std::array<double, 3> v(Index slot) const { return point_at(state_.v, slot, D_); }
  Mat<3> F(Index slot) const;  ///< at the centroid of the cell; missing directions: mean over its points
  MaterialRange const& material(Index slot) const;
  double mass(Index slot) const { return share(slot) * value(state_.mass, slot); }
  /// Mass of any particle [kg]. On all ranks if surface contact acts on the body.
  double known_mass(Index slot) const { return reference_.mass[static_cast<std::size_t>(slot)]; }
  double volume(Index slot) const { return share(slot) * value(state_.V, slot); }
  static double value(FieldRef const& f, Index slot, int c = 0) { return value_at(f, slot, c); }

 private:
  /// Fraction of a particle's volume that belongs to the body itself, on this side of its mirror planes.
  double share(Index slot) const {
    return reference_.share.empty() ? 1 : reference_.share[static_cast<std::size_t>(slot)];
  }
  void set_up(Assembly const& assembly, Backend const& backend);
  MirrorImages make_images(Assembly const& assembly, std::size_t body) const;
  void attach_images();
  void keep_own_side();
  int step(Backend const& backend, double time, double dt, int halvings);
  void set_materials(std::vector<MaterialParameters> const& materials);
  void set_viscosity(MaterialParameters const& material);
  std::vector<double> densities() const;
  void allocate();
  void fill_reference();
  void fill_initial(Assembly const& assembly);
  void fill_offset(Assembly const& assembly, Backend const& backend);
  void fill_histories();
  void make_boundary(Assembly const& assembly, std::size_t body);
  void agree_on_step(double change);
  void share();
  void mark_halo();
  /// Calls f(slot) for local particles, ghosts and images.
  template <class Visit>
  void each_seen(Visit const& f) const;
  bool failed() const { return failure_.index < order_.particles; }
  std::vector<Index> slots_read() const;

  Body body_;
  Options options_;
  int D_;
  SlotOrder order_;
  MirrorImages images_;
  std::vector<MirroredParticle> mirrored_;  ///< on planes
  ParticleSet const* set_;
  Fields fields_;
  NeighbourRecords gathered_;
  Reference reference_;
  mutable std::optional<Smoothing> smoothing_;
  std::optional<Boundary> boundary_;
  std::vector<MaterialRange> materials_;  ///< of the body and of its parts
  std::vector<double> partial_;
  double damping_loss_ = 0, largest_change_ = 0;
  bool observed_ = false;
  FailureSlot failure_;
  BodyState state_;
  std::unique_ptr<HaloPlan> halo_;  ///< nullptr on one rank
  std::unique_ptr<LatticeLineHalo> lines_;
};

}  // namespace piola::nodal
