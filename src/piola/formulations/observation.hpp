// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/particles/particle_set.hpp"
#include <array>
#include <vector>

/// Sums over bodies that Diagnostics are made of, for every formulation.
namespace piola {

struct Observation {
  Diagnostics totals;
  double pressure_square = 0;  ///< sum V p^2
  double volume = 0;           ///< sum V
  double second_difference_square = 0;
  double second_difference_count = 0;

  /// What is added from here on belongs to this body, too.
  void open_body(std::string const& name) { totals.bodies.push_back({name, 0, 0, {}}); }
  void add_strain_energy(double energy);  ///< [J]
  /// One particle: position [m], velocity [m/s], mass [kg].
  void add_motion(std::array<double, 3> const& x, std::array<double, 3> const& v, double mass);
  /// One particle: volume ratio, pressure [Pa], tributary volume.
  void add_state(double jacobian, double pressure, double tributary);
  /// Squares of second differences of p along the lattice lines of a body; `p` from the body's first particle on. Of
  /// discs of circles it is a rough measure, because the particles of neighbouring cells are not in line.
  void add_oscillation(ParticleSet const& set, Body const& body, std::vector<double> const& p);
  /// The totals with the pressure oscillation: rms over all lattice lines of (p[i+1] - 2 p[i] + p[i-1]) / 4, divided by
  /// the volume-weighted rms of p.
  Diagnostics finish() const;
};

}  // namespace piola
