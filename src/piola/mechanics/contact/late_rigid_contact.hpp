// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_forces.hpp"
#include "piola/mechanics/contact/contact_model.hpp"
#include "piola/mechanics/contact/late_targets.hpp"
#include <vector>

namespace piola::contact {

/// Contact with rigid shapes of particles that have lost their surface: they keep half a spacing away from the faces of
/// the shapes. Energy: V/dp psi(distance - dp/2), with the layer psi of surface points. No friction. Particles are
/// indices into positions that the caller owns. Theory: docs/theory/contact.md, section 8.
class LateRigidContact {
 public:
  /// Sets the particles of a body that may lose their surface, and their initial volumes [m^dimension].
  void set_particles(std::size_t body, std::vector<Index> const& at, std::vector<double> const& volumes);
  /// Makes marked particles of these targets, by index. Each pushes from its depth in the next evaluation on.
  void add_targets(std::vector<char> const& marked);
  /// Adds energy [J] that a surface point of particle k stored with a rigid shape when the point was removed. In the
  /// next evaluation the particle stores the sum of these energies.
  void inherit(Index k, std::size_t rigid, double energy) { inherited_[{k, static_cast<Index>(rigid)}] += energy; }
  /// Masses of all particles by index, at least those of the targets [kg].
  void set_masses(std::vector<double> const& masses);
  bool any() const { return !targets_.empty(); }
  /// Depths from which targets push, for a checkpoint. To be loaded after add_targets().
  std::vector<double> state() const { return late_.state(); }
  void load(std::vector<double> const& state) { late_.load(state); }

  /// Computes forces at x [m]. Adds their energy, resultants and frequencies to `sums`.
  void evaluate(ContactModel const& model, std::vector<Vec<3>> const& x, ContactForces& sums);
  std::vector<Vec<3>> const& forces() const { return forces_; }                 ///< by index [N]
  std::vector<Index> const& loaded_indices() const { return loaded_indices_; }  ///< with a force, ascending
  /// The step in which the fastest target approaches a shape by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const;

 private:
  struct Particle {
    Index at;
    std::size_t body;
    double volume;
  };
  /// A target near the face of a shape.
  struct Near {
    Particle particle;
    std::size_t rigid;
    Vec<3> y, normal;  ///< place [m]; outward normal of the shape
  };
  static double first_gap(ContactModel const& model, Particle const& target, std::size_t rigid,
                          PairValues const& inherited);
  void push(ContactModel const& model, Near const& target, double gap, ContactForces& sums);

  std::vector<Particle> particles_;  ///< that may become targets
  std::vector<Particle> targets_;    ///< ascending
  std::vector<Near> near_;           ///< in the last evaluation
  std::vector<double> masses_;
  LateTargets late_;
  PairValues inherited_;  ///< energy by particle and rigid shape, see inherit() [J]
  std::vector<Vec<3>> forces_;
  std::vector<Index> loaded_indices_;
};

}  // namespace piola::contact
