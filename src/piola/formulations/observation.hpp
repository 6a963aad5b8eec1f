// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/exact_sum.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <vector>

/// Sums over bodies that Diagnostics are made of, for every formulation.
namespace piola {

/// The particles may come in any order.
struct Observation {
  Diagnostics totals;  ///< but for what is summed over particles, which `finish` puts in
  /// What is added from here on belongs to this body, too.
  void open_body(std::string const& name) { bodies_.push_back({name, {}, {}}); }
  void add_strain_energy(double energy);  ///< [J]
  /// One particle: position [m], velocity [m/s], mass [kg].
  void add_motion(std::array<double, 3> const& x, std::array<double, 3> const& v, double mass);
  /// One particle: volume ratio, pressure [Pa], tributary volume.
  void add_state(double jacobian, double pressure, double tributary);
  /// Squares of second differences of p along the lattice lines of a body; `p` from the body's first particle on. Of
  /// discs of circles it is a rough measure, because the particles of neighbouring cells are not in line.
  void add_oscillation(ParticleSet const& set, Body const& body, std::vector<double> const& p);
  /// One of these differences, divided by 4.
  void add_second_difference(double difference) {
    double const square = difference * difference;
    second_difference_square_.add(&square);
    ++second_differences_;
  }
  /// What all ranks have added is everybody's, but for strain energies and totals, which each has in full. Collective.
  void share();
  /// The totals with the pressure oscillation: rms over all lattice lines of (p[i+1] - 2 p[i] + p[i-1]) / 4, divided by
  /// the volume-weighted rms of p.
  Diagnostics finish() const;
  double volume() const { return pressures_.value(0); }  ///< sum V

 private:
  struct BodySums {
    std::string name;
    exec::ExactSum strain_energy;
    exec::ExactSums<7> motion;  ///< kinetic energy, linear and angular momentum
  };
  std::vector<BodySums> bodies_;
  exec::ExactSums<2> pressures_;  ///< V, V p^2
  exec::ExactSums<1> second_difference_square_;
  std::int64_t particles_ = 0, second_differences_ = 0;
};

}  // namespace piola
