// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/taylor_sph/fields.hpp"
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/math/tensor.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <array>
#include <vector>

namespace piola::taylor_sph {

/// An index of a vector.
inline std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// The real particles of one body, numbered in Id order from its first particle on: their reference data, their fields,
/// and the slots of these. Vectors have three components; those that do not exist are zero.
class Particles {
 public:
  using Point = std::array<double, 3>;

  Particles(Assembly const& assembly, std::size_t body, Options const& options);
  Particles(Particles const&) = delete;
  Particles& operator=(Particles const&) = delete;

  /// Gives the particles of `on_boundary` the slots after those of all others, and allocates the fields.
  void arrange(std::vector<Index> const& on_boundary);
  void set_masses(std::vector<double> masses) { mass_ = std::move(masses); }  ///< before arrange() [kg]
  /// Sets the fields at the start: without stress at start(), with the initial velocities.
  void set_initial_state(Assembly const& assembly);
  void set_views(BodyState& state);

  Body const& body() const { return body_; }
  Index count() const { return static_cast<Index>(X_.size()); }
  int dimension() const { return fields_.D_; }
  Index slot(Index i) const { return slot_of_[at(i)]; }
  Index particle_in(Index slot) const { return particle_in_[at(slot)]; }  ///< -1: none
  std::vector<Index> const& slots() const { return slot_of_; }            ///< per particle
  std::vector<Index> const& particles_in_slots() const { return particle_in_; }
  std::int64_t const* ids() const { return id_in_slot_.data(); }  ///< per slot
  Fields& fields() { return fields_; }
  Fields const& fields() const { return fields_; }

  Points const& X() const { return X_; }          ///< reference positions [m]
  Points const& start() const { return start_; }  ///< positions at the start, where particles are free of stress [m]
  Point const& X(Index i) const { return X_[at(i)]; }
  double mass(Index i) const { return mass_[at(i)]; }
  double kernel_volume(Index i) const { return kernel_volume_[at(i)]; }  ///< in kernel sums, at the start [m^D]
  Point x(Index i) const;
  Point v(Index i) const;
  Point displacement(Index i) const;
  /// Current position [m]; x() stays that of the start in the fixed configuration.
  Point place(Index i) const;
  /// Position after drifting for a time; negative: an earlier position [m].
  Point drifted(Index i, double time) const;
  Points positions() const;                                ///< x() of all
  std::array<double, 6> stress_components(Index i) const;  ///< SymMat<D> [Pa]
  SymMat<3> stress(Index i) const;                         ///< Cauchy stress [Pa]
  double volume_ratio(Index i) const;                      ///< rho0 / rho
  double kinetic_energy() const;                           ///< [J]
  void add_velocity(Index i, Point const& change);         ///< [m/s]
  void scale_velocities(double factor);                    ///< v and drift
  std::size_t bytes() const;

 private:
  Body body_;
  bool moving_;
  Points X_, start_;
  std::vector<double> mass_, kernel_volume_;
  Fields fields_;
  Range interior_, boundary_;  ///< slots
  Index boundary_count_ = 0;
  std::vector<Index> slot_of_, particle_in_;
  std::vector<std::int64_t> id_in_slot_;
};

}  // namespace piola::taylor_sph
