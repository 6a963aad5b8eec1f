// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface.hpp"
#include <vector>

namespace piola::contact {

/// Damping of the vibration that friction excites under surfaces without dissipation. A cluster is a host particle and
/// its neighbours. If its points slide with friction, velocities are relaxed towards the rigid motion of the cluster
/// with equal momenta. The dissipation is at most a given fraction of the friction heat there in the same step. Momenta
/// are conserved, and kinetic energy never rises. Theory: docs/theory/contact.md, section 4.
class ChatterDamping {
 public:
  ChatterDamping() = default;
  /// fractions: by body, largest fraction of the friction heat that is dissipated; 0: no damping.
  ChatterDamping(HostParticles const& hosts, std::vector<Surface> const& surfaces, std::vector<double> const& fractions,
                 int dimension);
  bool any() const { return !clusters_.empty(); }

  struct State {
    std::vector<Vec<3>> const &x, &v;           ///< by index into ids() [m], [m/s]
    std::vector<double> const& inverse_masses;  ///< by index into ids() [1/kg]
    std::vector<double> const& heat;            ///< by host particle, of the last step [J]
    double dt;                                  ///< [s]
  };
  /// Computes the impulses.
  void evaluate(HostParticles const& hosts, State const& now);
  /// Indices of ids() with an impulse, ascending, and impulses by index [N s].
  std::vector<Index> const& damped() const { return damped_; }
  std::vector<Vec<3>> const& impulses() const { return impulses_; }

 private:
  struct Cluster {
    Index host;
    double stiffness;  ///< M dp^(D-2); divided by the mass of a particle: the square of c/dp [N/m]
    double fraction;   ///< fraction of the heat
    double weight;     ///< the weights of all clusters around a particle sum to at most 1
  };
  struct Motion {
    Vec<3> centre, velocity, spin;
    double factor = 0;
  };
  Motion motion_of(Cluster const& cluster, HostParticles const& hosts, State const& now) const;

  std::vector<Cluster> clusters_;
  std::vector<Index> sliding_;  ///< clusters with friction heat in the step
  std::vector<Motion> motions_;
  std::vector<Vec<3>> impulses_;
  std::vector<char> is_damped_;
  std::vector<Index> damped_;
};

}  // namespace piola::contact
