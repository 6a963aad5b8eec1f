// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/surface.hpp"
#include <vector>

namespace piola::contact {

/// Damping of the vibration that friction excites under surfaces without any dissipation. A cluster is a carrier and
/// its neighbours. Where its points rub, velocities go towards those of the rigid motion of the cluster with the same
/// momenta; what this takes is at most a share of the heat of friction there in the same step. Momenta are kept, and
/// kinetic energy never rises. Theory: docs/theory/contact.md, section 4.
class ChatterDamping {
 public:
  ChatterDamping() = default;
  /// shares: by body, of the heat of friction; 0 damps nothing.
  ChatterDamping(Carriers const& carriers, std::vector<Surface> const& surfaces, std::vector<double> const& shares,
                 int dimension);
  bool any() const { return !clusters_.empty(); }

  struct State {
    std::vector<Vec<3>> const &x, &v;           ///< by index into ids() [m], [m/s]
    std::vector<double> const& inverse_masses;  ///< the same [1/kg]
    std::vector<double> const& heat;            ///< by carrier, of the last step [J]
    double dt;                                  ///< [s]
  };
  /// Finds impulses.
  void look(Carriers const& carriers, State const& now);
  /// Indices of ids() with an impulse, ascending, and impulses by index [N s].
  std::vector<Index> const& damped() const { return damped_; }
  std::vector<Vec<3>> const& impulses() const { return impulses_; }

 private:
  struct Cluster {
    Index carrier;
    double stiffness;  ///< M dp^(D-2): over the mass of a particle the square of c/dp [N/m]
    double share;      ///< of the heat
    double weight;     ///< so that the weights of all clusters around a particle sum to 1 at most
  };
  struct Motion {
    Vec<3> centre, velocity, spin;
    double factor = 0;
  };
  Motion motion_of(Cluster const& cluster, Carriers const& carriers, State const& now) const;

  std::vector<Cluster> clusters_;
  std::vector<Index> rubbing_;
  std::vector<Motion> motions_;
  std::vector<Vec<3>> impulses_;
  std::vector<char> is_damped_;
  std::vector<Index> damped_;
};

}  // namespace piola::contact
