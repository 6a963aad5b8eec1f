// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/taylor_sph/boundary_conditions.hpp"
#include "piola/formulations/taylor_sph/options.hpp"
#include "piola/formulations/taylor_sph/state.hpp"
#include "piola/math/tensor.hpp"
#include "piola/mechanics/resultants.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace piola::taylor_sph {

/// Checkpoint data of one body, particle by particle in Id order.
struct Snapshot {
  std::vector<double> x, v, drift, displacement;  ///< D per particle; displacement: fixed configuration
  std::vector<double> stress, across, volume;     ///< SymMat<D>, 1, 1 per particle
  std::vector<double> x_of_lists, x_of_cells;     ///< positions at the last construction of lists and of cells
  std::vector<double> corners;                    ///< of the cells
  std::vector<double> cell_stress, cell_across;   ///< adjoint: SymMat<D>, 1 per cell; empty: means of the corners
  std::vector<double> cell_hourglass;             ///< adjoint, boxes: patterns * D per cell
  std::vector<double> energy_totals;  ///< work, power, filter loss, list updates, triangulations, steps, hasty updates,
                                      ///< momenta, exchange loss, last step
};

/// Wall time in addition to the steps [s].
struct SetupSeconds {
  double triangulation = 0, lists = 0;
};

/// A particle that no longer fits into the cells, and the reason in words.
struct DetachedParticle {
  Index particle = 0;
  std::string what;
};

/// Whether every point of the body's lattice is a particle (particles on cracks count once).
bool is_whole_lattice(ParticleSet const& set, Body const& body);

/// One body of a Taylor-SPH run: owns its memory, passes its state to the loops, is addressed in Id order.
class TaylorBody {
 public:
  /// Reads `assembly` only here. Throws InputError (too few neighbours, shapes that cannot be triangulated).
  TaylorBody(Assembly const& assembly, std::size_t body, Options const& options, Backend const& backend);
  TaylorBody(TaylorBody const&) = delete;
  TaylorBody& operator=(TaylorBody const&) = delete;

  /// Advances from `time` to time + dt.
  void step(double time, double dt);
  /// Multiplies the velocities that are not prescribed, and adds the lost energy to damping_loss().
  void damp(double factor);
  /// Adds to the velocity of a particle [m/s]; call pushed() after the last one.
  void add_velocities(Index i, std::array<double, 3> const& change);
  void velocities_changed() { power_ = boundary_power(); }
  double kinetic_energy() const;                         ///< [J]
  double damping_loss() const { return damping_loss_; }  ///< [J]
  double stable_time_step() const;                       ///< cfl * spacing / c in the current configuration [s]
  double next_end_time(double time) const { return boundary_.next_end_time(time); }

  // Particles are numbered from the body's first particle on.
  Index particles() const { return static_cast<Index>(X_.size()); }
  std::array<double, 3> X(Index i) const { return X_[at(i)]; }
  std::array<double, 3> x(Index i) const;
  std::array<double, 3> v(Index i) const;
  std::array<double, 3> displacement(Index i) const;
  /// Current position of a particle [m]; x() stays in the reference configuration if that is fixed.
  std::array<double, 3> place(Index i) const;
  SymMat<3> stress(Index i) const;     ///< Cauchy stress [Pa]
  double volume_ratio(Index i) const;  ///< rho0 / rho
  double mass(Index i) const { return mass_[at(i)]; }
  double volume(Index i) const { return mass_[at(i)] / state_.k.rho0; }  ///< at the start
  int neighbours(Index i) const;                                         ///< virtual neighbours of a real particle
  CellEnergy cell_energy() const;                                        ///< of the adjoint exchange, else zero
  /// Adjoint: dt^2/8 sum V L:D:L [J]. The sum of energies minus this never rises, except by external work.
  double staggering_energy() const;

  std::vector<double> strain_drift() const;  ///< by particle: strain drift; zeros in the fixed configuration

  Snapshot snapshot() const;
  void restore(Snapshot const& snapshot);

  BodyState const& state() const { return state_; }
  Body const& body() const { return body_; }
  Options const& options() const { return options_; }
  double external_work() const { return work_; }
  /// Adds the impulses of supports and loads in the last step.
  void add_actions(Resultants& actions) const;
  long list_updates() const { return list_updates_; }
  long triangulations() const { return triangulations_; }
  SetupSeconds const& seconds() const { return seconds_; }
  bool inverted() const { return measures_.inverted; }
  /// Set once the cells or lists of a moving body cannot be rebuilt.
  std::optional<DetachedParticle> const& lost() const { return lost_; }
  Index worst_corner() const;  ///< a particle of the cell with the smallest volume
  std::size_t bytes() const;
  /// Communication pattern of the body; empty if not modelled: the exchange of estimates.
  Index local_of(Index slot) const { return local_of_[at(slot)]; }

 private:
  static std::size_t at(Index i) { return static_cast<std::size_t>(i); }
  double* record(Index i) const;
  std::array<double, 6> record_stress(Index i) const;  ///< SymMat<D>
  int D() const { return state_.dimension; }
  std::ptrdiff_t stress_place() const { return 2 * std::ptrdiff_t{D()} + 1; }  ///< index in a record

  void set_constants(Assembly const& assembly, std::size_t body);
  Cells first_cells(ParticleSet const& set) const;
  void weigh_displaced(Assembly const& assembly);
  void weigh_cells(Assembly const& assembly);
  void place_initially(Assembly const& assembly);
  Points positions() const;
  Points middles(Points const& x) const;
  /// Sets memory, order of slots, and tables for the present cells.
  void arrange(Points const& x_of_cells);
  void order_slots(std::vector<Index> const& on_boundary);
  void order_cells();
  void fill_cell_tables(Points const& x);
  void fill_hourglass_tables();
  void fill_cell_memory();
  /// Cells are numbered by slot; lanes without a cell repeat the last one.
  Index cell_in_slot(Index slot) const { return std::min(slot, cells_.count() - 1); }
  double* cell_stress(Index cell) const;
  std::span<double> patterns_of(Index cell) const;
  void restore_cells(Snapshot const& snapshot);
  void step_adjoint(Impulse const& before, double time, double dt);
  std::vector<double> search_radius_in_cells(Points const& x) const;
  std::vector<double> reach_of_particles(std::vector<double> const& cells) const;
  bool sees(Index particle, Index cell) const;
  void make_lists(Points const& x);
  void note_distances(Points const& x);
  void prepare_boundary(double time, double dt, double ahead);
  std::array<double, 3> place_at(Index i, double ahead) const;
  void prepare_loads(double time);
  void follow_motion();
  void renew_lists();
  /// Half the impulse of a traction on a particle.
  struct Push {
    std::size_t load;
    Index particle;
    std::array<double, 3> impulse;
  };
  /// `tractions`: applied to the particles; empty: computed from the surface at half time.
  void add_impulses(double time, double dt, std::vector<Push> const* tractions = nullptr);
  /// Calls add(load, place, impulse) for each particle.
  template <class F>
  void visit_pushes(double time, double dt, std::vector<Push> const* tractions, F const& add);
  void turn_boundary(double ahead);
  void conserve_momentum();
  Impulse momentum();
  void find_reactions(Impulse const& before, double dt);
  double boundary_power() const;
  bool triangulate_anew();

  Body body_;
  Options options_;
  Backend const* backend_;
  Points X_, start_;  ///< reference positions, and positions at which particles start without stress
  std::vector<double> mass_, kernel_volume_;
  std::vector<Crack> cracks_;
  std::vector<std::int8_t> crack_side_;
  double largest_radius_ = 0;  ///< of a simplex inside the body, at the start [m]
  Boundary boundary_;
  Cells cells_, boxes_;  ///< corners numbered within the body
  Points x_of_lists_, x_of_cells_, surface_positions_;
  std::vector<Index> slot_of_, local_of_;
  std::vector<std::int64_t> id_in_slot_;
  Memory real_, virtual_;
  Field across_{"OutOfPlaneStress", "Pa", 1, Role::evolved};
  Field drift_{"Drift", "m/s", 3, Role::evolved};
  Field displacement_{"Displacement", "m", 3, Role::evolved};
  Field acceleration_{"Acceleration", "m/s2", 3, Role::derived};
  Field slot_mass_{"Mass", "kg", 1, Role::reference};
  CrossSetPairs to_virtual_, to_real_;
  std::vector<Index> corner_, box_corner_, box_of_, around_begin_, around_;
  std::vector<double> cell_across_, cell_force_, cell_gradient_, cell_hourglass_;
  std::vector<double> reference_square_, reference_quality_, pattern_, partial_;
  FailureSlot failure_;
  BodyState state_;
  CellMeasures measures_;
  std::optional<DetachedParticle> lost_;
  double first_spacing_ = 0;                   ///< at the start [m]
  bool free_ = false;                          ///< no support: momentum changes by loads alone
  std::array<double, 6> momentum_{};           ///< linear and angular, which a free body must conserve
  std::vector<Impulse> of_support_, of_load_;  ///< in the last step
  double work_ = 0, power_ = 0, damping_loss_ = 0;
  double last_step_ = 0;  ///< [s]
  long list_updates_ = 0, triangulations_ = 0, steps_since_triangulation_ = 0;
  long successive_list_updates_ = 0;  ///< consecutive steps with list updates
  SetupSeconds seconds_;
};

}  // namespace piola::taylor_sph
