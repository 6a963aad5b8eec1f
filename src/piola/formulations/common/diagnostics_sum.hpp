// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/reproducible_sum.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <vector>

/// Sums over bodies that Diagnostics are made of, for every formulation.
namespace piola {

/// Accumulates Diagnostics over particles, in any order.
struct DiagnosticsSum {
  Diagnostics totals;         ///< except the sums over particles, which finish() adds
  bool axisymmetric = false;  ///< a full circle has momentum along the axis y alone
  /// Starts a body: later contributions also count for it.
  void begin_body(std::string const& name) { bodies_.push_back({name, {}, {}}); }
  void add_strain_energy(double energy);  ///< [J]
  /// One particle: position [m], velocity [m/s], mass [kg].
  void add_motion(std::array<double, 3> const& x, std::array<double, 3> const& v, double mass);
  /// One particle: volume ratio, pressure [Pa], tributary volume.
  void add_state(double jacobian, double pressure, double tributary);
  /// Adds the squared second differences of p along the lattice lines of a body; `p` starts at the body's first
  /// particle. A rough measure for discs of circles, whose particles are not in line.
  void add_oscillation(ParticleSet const& set, Body const& body, std::vector<double> const& p);
  /// Adds one second difference divided by 4.
  void add_second_difference(double difference) {
    double const square = difference * difference;
    second_difference_square_.add(&square);
    ++second_differences_;
  }
  /// Reduces sums and extrema of particles. Strain energies and the other totals must already be reduced. Collective.
  void share();
  /// Returns the totals with the pressure oscillation: rms of (p[i+1] - 2 p[i] + p[i-1]) / 4 over all lattice lines,
  /// divided by the volume-weighted rms of p.
  Diagnostics finish() const;
  double volume() const { return pressures_.value(0); }  ///< sum V

 private:
  struct BodySums {
    std::string name;
    exec::ReproducibleSum strain_energy;
    exec::ReproducibleSums<7> motion;  ///< kinetic energy, linear and angular momentum
  };
  std::vector<BodySums> bodies_;
  exec::ReproducibleSums<2> pressures_;  ///< V, V p^2
  exec::ReproducibleSums<1> second_difference_square_;
  std::int64_t particles_ = 0, second_differences_ = 0;
};

}  // namespace piola
