// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/body.hpp"
#include <string>
#include <vector>

namespace piola::nodal {

/// Nonlinear conjugate gradients (Polak and Ribiere) towards the least potential energy of one body, in the metric of
/// the masses. An iteration has two right-hand sides: one for the curvature along the direction, at a small distance,
/// and one at the least of the parabola.
class EnergyDescent {
 public:
  EnergyDescent(NodalBody& body, Backend const& backend) : body_(body), backend_(backend) {}

  /// One iteration, with loads from `time` to time + dt. Velocities are zero before and after. Collective.
  Descent iterate(double time, double dt);

  /// The direction, which determines the next iteration; complete on root. Collective.
  std::vector<double> state() const;
  /// Collective.
  void load(StateReader& reader, std::string const& name);

 private:
  using Vector = std::vector<double>;  ///< see ParticleVectors
  Vector free_accelerations() const;
  double curvature(double time, double distance);
  void move(double time, double dt, double distance, Vector const& accelerations);

  NodalBody& body_;
  Backend const& backend_;
  Vector direction_;
  bool restarts_ = true;  ///< whether the next direction is that of the forces; equal on all ranks
};

}  // namespace piola::nodal
