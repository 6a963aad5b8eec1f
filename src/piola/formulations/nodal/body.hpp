// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/common/body_halo.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/nodal/body_materials.hpp"
#include "piola/formulations/nodal/boundary_conditions.hpp"
#include "piola/formulations/nodal/neighbour_records.hpp"
#include "piola/formulations/nodal/options.hpp"
#include "piola/formulations/nodal/set_up.hpp"
#include "piola/formulations/nodal/smoothing.hpp"
#include "piola/formulations/nodal/state.hpp"
#include "piola/math/tensor.hpp"
#include <functional>
#include <memory>
#include <optional>
#include <vector>

namespace piola::nodal {

/// One body of a nodal run: owns its memory, passes its state to the loops, is addressed in Id order.
class NodalBody {
 public:
  /// Code of a FailureSlot: a particle of an axisymmetric body has a negative radius.
  static constexpr int behind_axis = 3;

  /// Keeps a reference to `set`, which must outlive the body. Throws InputError (too few particles across; a body
  /// without an outline). Collective: each rank holds its local particles and their ghosts.
  NodalBody(Assembly const& assembly, ParticleSet const& set, std::size_t body, Options const& options,
            Backend const& backend);
  ~NodalBody();
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
  bool shared() const { return halo_ != nullptr; }  ///< whether the body is distributed over ranks
  /// Slots of the local particles: all on one rank.
  Range own() const;
  /// Lattice lines for observers if the body is distributed; else nullptr.
  LatticeLineHalo* lattice_line_halo() const { return halo_ ? &halo_->lines : nullptr; }
  MirrorImages const& images() const { return images_; }
  /// Created on first use. Collective.
  Smoothing const& smoothing() const;
  std::size_t bytes() const;
  /// Calls f(name, field, components) for the evolved state, i.e. the fields of a checkpoint.
  template <class F>
  void each_evolved(F const& f) const {
    fields_.each_evolved(f);
  }

  /// Advances from `time` to time + dt, with supports and loads. If a cell is inverted, repeats the step in two halves,
  /// up to a few times; if that does not help, the failure remains, or the cell fails where on_crushed() is given.
  /// Returns the number of halvings. `halvings`: of the whole step before this part of it.
  int step(Backend const& backend, double time, double dt, int halvings = 0);
  /// `act` is called at the start of a step that inverts local cells however short it is. Collective.
  void on_crushed(std::function<void(std::vector<Index> const& slots)> act) { on_crushed_ = std::move(act); }
  /// Multiplies the velocities that no support prescribes; the lost kinetic energy is added to damping_loss().
  void damp(double factor);
  /// Largest change of a strain at the last step since the last measurement of the step limit.
  double largest_change() const { return largest_change_; }
  double kinetic_energy() const;                             ///< over all ranks [J]; collective
  double kinetic_energy_of(Index slot) const;                ///< [J]
  double strain_energy() const;                              ///< from Fields::cell, over all ranks [J];
                                                             ///< collective
  double damping_loss() const { return damping_loss_; }      ///< since the start [J]
  double viscous_loss() const;                               ///< over all ranks, since the start [J]; collective
  bool stores_history() const { return state_.has.solids; }  ///< whether it has solids in rate form
  /// Mean over the points of a cell of one number of their histories (HistoryLayout); 0 for bodies without solids in
  /// rate form.
  double mean_of_points(Index slot, int number) const;
  CellCondition condition(Index slot) const { return condition_of(failure_value(slot, FailureLayout::condition)); }
  bool is_broken(Index slot) const { return condition(slot) >= CellCondition::broken; }
  bool is_eulerian(Index slot) const { return state_.has.converts && is_broken(slot); }
  /// A value of FailureLayout; 0 for bodies whose cells cannot fail.
  double failure_value(Index slot, int of) const {
    return state_.has.failure ? value(state_.history, slot, Fields::failure_value(of, state_.dimension)) : 0;
  }
  /// Energy of the contact of its pieces [J], on all ranks alike.
  double fragment_energy() const { return fragment_energy_; }
  void set_fragment_energy(double energy) { fragment_energy_ = energy; }
  void set_damping_loss(double loss) { damping_loss_ = loss; }
  /// Whether Backend::update_output_fields has run at the present state, so that no sweep is needed. Callers that
  /// change the state from outside must reset it.
  bool observed() const { return observed_; }
  void set_observed(bool observed) { observed_ = observed; }
  double next_end_time(double time) const { return boundary_->next_end_time(time); }

  std::array<double, 3> X(Index slot) const { return set_->X[static_cast<std::size_t>(id(slot))]; }
  std::array<double, 3> x(Index slot) const {
    int const D = state_.dimension;
    return D < 3 ? point_at(state_.x, slot, D, X(slot)) : point_at(state_.x, slot, 3);
  }
  std::array<double, 3> v(Index slot) const { return point_at(state_.v, slot, state_.dimension); }
  /// At the centroid of the cell; missing directions: mean over its points. I for Eulerian cells.
  Mat<3> F(Index slot) const;
  MaterialRange const& material(Index slot) const { return materials_.of(slot); }
  std::span<MaterialRange const> materials() const { return materials_.ranges(); }
  double mass(Index slot) const { return reference_.own_fraction(slot) * value(state_.mass, slot); }
  /// Mass of any particle [kg]. On all ranks if surface contact acts on the body, or its cells may fail.
  double replicated_mass(Index slot) const { return reference_.mass[static_cast<std::size_t>(slot)]; }
  /// Area of a particle on a flat face of the body, a box, for contact [m^(D-1)]; as replicated_mass().
  double face_area(Index slot, std::array<double, 3> const& normal) const {
    std::size_t const axis = normal[0] * normal[0] > 0.5 ? 0 : normal[1] * normal[1] > 0.5 ? 1 : 2;
    auto const& areas = reference_.face_areas[2 * axis + (normal[axis] > 0 ? 1 : 0)];
    return reference_.own_fraction(slot) * areas[static_cast<std::size_t>(slot)];
  }
  double volume(Index slot) const { return reference_.own_fraction(slot) * value(state_.V, slot); }
  static double value(FieldRef const& f, Index slot, int c = 0) { return value_at(f, slot, c); }

 private:
  void make_reference(Assembly const& assembly, Backend const& backend);
  void distribute();
  void allocate();
  void fill(Assembly const& assembly, Backend const& backend);
  void make_boundary(Assembly const& assembly, std::size_t body);
  void make_pressure(Backend const& backend);
  bool is_behind_axis(Index slot) const;
  void record_behind_axis();
  void agree_on_step(double change);
  bool find_crushed(std::vector<Index>& slots) const;
  bool failed() const { return failure_.index < order_.particles; }

  Body body_;
  Options options_;
  ParticleSet const* set_;
  SlotOrder order_;
  MirrorImages images_;
  std::vector<MirroredParticle> mirrored_;  ///< on planes
  BodyMaterials materials_;
  FieldList fields_;
  BodyState state_;
  NeighbourRecords records_;
  Reference reference_;
  mutable std::optional<Smoothing> smoothing_;
  std::optional<Boundary> boundary_;
  std::vector<double> partial_;
  double damping_loss_ = 0, largest_change_ = 0, fragment_energy_ = 0;
  bool observed_ = false;
  FailureSlot failure_;
  std::function<void(std::vector<Index> const&)> on_crushed_;  ///< may be empty
  std::unique_ptr<BodyHalo> halo_;                             ///< nullptr on one rank
  std::unique_ptr<ImplicitPressure> implicit_pressure_;        ///< nullptr: explicit
};

}  // namespace piola::nodal
