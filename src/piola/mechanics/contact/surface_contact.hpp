// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/body_contact.hpp"
#include "piola/mechanics/contact/contact_model.hpp"
#include "piola/mechanics/contact/contact_state.hpp"
#include "piola/mechanics/contact/late_rigid_contact.hpp"
#include "piola/mechanics/contact/rigid_contact.hpp"
#include "piola/mechanics/contact/shape_point_contact.hpp"
#include "piola/mechanics/contact/verlet_skin.hpp"
#include <utility>
#include <vector>

namespace piola::contact {

/// Contact between bodies, and between bodies and rigid shapes, by blended planes on oriented surface points. Input:
/// positions; output: forces; both by index into ids(). Particles that have lost their surface are in contact with
/// rigid shapes in late_rigids(), with indices beyond those of ids() and forces of their own.
class SurfaceContactSystem {
 public:
  SurfaceContactSystem(ParticleSet const& particles, std::vector<Surface> surfaces, std::vector<RigidSurface> rigids,
                       PairSettings settings);

  std::vector<std::int64_t> const& ids() const { return model_.points.ids(); }
  HostParticles const& hosts() const { return model_.points.hosts(); }
  SurfacePoints& points() { return model_.points; }
  void set_masses(std::vector<double> const& masses) { model_.points.set_masses(masses); }  ///< by index into ids()
  /// Mirror planes of a body. Their images are among its surface points.
  void set_mirrors(std::size_t body, std::vector<SurfaceMirror> mirrors) {
    shape_points_.set_mirrors(body, std::move(mirrors));
  }
  /// Whether bodies a and b are in surface contact here.
  bool is_active(std::size_t a, std::size_t b) const { return model_.definition.pair(a, b).is_active; }
  /// Excludes the contact of this surface point with body `other`, or includes it again. Rigid shapes are numbered
  /// after the bodies.
  void exclude_pair(std::size_t body, std::size_t point, std::size_t other, bool out);
  /// Removes the points of particles that have lost their surface permanently, by index into ids(); empty: none. Not in
  /// state(): call before restore() again.
  void drop(std::vector<char> const& lost);
  /// Energy stored by the contact of this point with `other` [J].
  double stored_at(std::size_t body, std::size_t point, std::size_t other) const;
  LateRigidContact& late_rigids() { return late_rigids_; }
  LateRigidContact const& late_rigids() const { return late_rigids_; }
  RigidSurface& rigid(std::size_t k) { return model_.rigids[k]; }
  RigidSurface const& rigid(std::size_t k) const { return model_.rigids[k]; }
  std::vector<RigidSurface>& rigids() { return model_.rigids; }
  std::vector<RigidSurface> const& rigids() const { return model_.rigids; }

  /// Computes the forces [N] at x [m]: functions of x and of the poses of rigid shapes and, with friction, of the
  /// springs and the positions of the last evaluation, dt [s] ago.
  void evaluate(std::vector<Vec<3>> const& x, double dt);
  /// As evaluate(), without motion before it: at the start.
  void start(std::vector<Vec<3>> const& x);
  /// State after the last evaluation, for a checkpoint, without the poses of rigid shapes.
  std::vector<double> state() const;
  void restore(std::vector<Vec<3>> const& x, std::vector<double> const& state);
  /// Depths from which points push beside those that were dropped, for a checkpoint; not in state().
  std::vector<double> depths() const { return bodies_.depths(); }
  void load_depths(std::vector<double> const& depths) { bodies_.load_depths(depths); }
  std::vector<Vec<3>> const& forces() const { return state_.forces.forces(); }
  /// Indices of ids() that have a force, ascending.
  std::vector<Index> const& loaded_indices() const { return state_.forces.loaded_indices(); }
  Totals const& totals() const { return state_.forces.totals(); }
  std::vector<Passed> const& passed() const { return state_.passages.passed(); }  ///< since the start
  /// Sets the load of ties on a rigid shape; moment about its centre. springs: as in Frequencies [1/s2].
  void tie_rigid(std::size_t k, ForceMoment const& load, double springs) {
    state_.forces.resultants().tie_rigid(k, load, springs);
  }
  /// Force of bodies on a rigid shape; moment about its centre.
  ForceMoment resultant_on_rigid(std::size_t k) const { return state_.forces.resultants().on_rigid(k); }
  ContactResultants::Frequencies frequencies(std::size_t k) const { return state_.forces.resultants().frequencies(k); }
  /// Force of body b on body a; moment about the origin.
  ForceMoment const& between(std::size_t a, std::size_t b) const { return state_.forces.resultants().between(a, b); }

  /// Contact values of a particle with surface points.
  struct ParticleContactState {
    std::int64_t id = 0;
    double pressure = 0;  ///< of contact, mean over its points [Pa]
    double gap = 0;       ///< smallest gap of its points [m], capped at the search distance of `near` spacings
    double slid = 0;      ///< sliding distance, maximum over its points [m]
    double heat = 0;      ///< half of the friction heat [J/m2]
  };
  std::vector<ParticleContactState> at_particles() const;

  /// Enables chatter damping; fractions: by body, largest fraction of the friction heat.
  void damp_chatter(std::vector<double> const& fractions) { state_.friction.damp_chatter(model_, fractions); }
  /// Chatter-damping impulses after the last evaluation, which must have been one with friction. v [m/s].
  ChatterDamping const& chatter(std::vector<Vec<3>> const& x, std::vector<Vec<3>> const& v) {
    return state_.friction.chatter(model_, x, v);
  }
  bool damps_chatter() const { return state_.friction.damps_chatter(); }

  /// The step in which the fastest pair of near points approaches by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(std::vector<Vec<3>> const& v) const;
  std::size_t bytes() const;

 private:
  void make_lists(std::vector<Vec<3>> const& x);
  void evaluate_forces(std::vector<Vec<3>> const& x);

  ContactModel model_;
  VerletSkin skin_;
  BodyContact bodies_;
  RigidContact rigids_;
  LateRigidContact late_rigids_;
  ShapePointContact shape_points_;
  ContactState state_;
  bool drops_ = false;                                  ///< points were removed since the last evaluation
  std::vector<std::pair<Index, std::size_t>> dropped_;  ///< these points, and rigid shapes that they were tested with
};

}  // namespace piola::contact
