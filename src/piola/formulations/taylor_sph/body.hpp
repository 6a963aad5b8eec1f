// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/formulation.hpp"
#include "piola/formulations/taylor_sph/cell_mesh.hpp"
#include "piola/formulations/taylor_sph/external_actions.hpp"
#include "piola/formulations/taylor_sph/hourglass_boxes.hpp"
#include "piola/formulations/taylor_sph/neighbour_lists.hpp"
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace piola::taylor_sph {

/// Evolved state of one body; D values per position.
struct Snapshot {
  using Values = std::vector<double>;
  std::vector<Values> fields;       ///< evolved ones of Fields, particle by particle in Id order
  Values x_of_lists, x_of_cells;    ///< positions at the last construction of lists and of cells
  Values corners;                   ///< of the cells
  std::vector<Values> cell_fields;  ///< evolved ones of CellFields, cell by cell; empty: means of the corners
  Values totals;                    ///< TaylorBody::each_total()
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

/// Number of updates of lists and cells.
struct RemeshingCounts {
  long list_updates = 0, triangulations = 0;
  long steps_since_triangulation = 0;
  long successive_list_updates = 0;  ///< in consecutive steps; a triangulation at the earliest time counts as five
};

/// One body of a Taylor-SPH run: advances its particles and cells in time. A moving body updates its neighbour lists
/// and its cells as the distances between particles change. Particles are numbered in Id order from the body's first.
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
  /// Adds to the velocity of a particle [m/s]; call velocities_changed() after the last one.
  void add_velocities(Index i, std::array<double, 3> const& change);
  void velocities_changed() { actions_.update_power(); }
  double stable_time_step() const;  ///< cfl * spacing / c in the current configuration [s]
  double next_end_time(double time) const { return boundary_.next_end_time(time); }

  Particles const& particles() const { return particles_; }
  CellMesh const& mesh() const { return mesh_; }
  CellFields const& cell_fields() const { return cell_fields_; }
  Body const& body() const { return particles_.body(); }
  Options const& options() const { return options_; }
  BodyState const& state() const { return state_; }
  int neighbours(Index i) const;   ///< virtual neighbours of a real particle
  CellEnergy cell_energy() const;  ///< of the adjoint exchange, else zero
  /// Adjoint: dt^2/8 sum V L:D:L [J]. The sum of energies minus this never rises, except by external work.
  double staggering_energy() const { return last_step_ * last_step_ / 8 * cell_energy().square; }
  double kinetic_energy() const { return particles_.kinetic_energy(); }  ///< [J]
  double damping_loss() const { return damping_loss_; }                  ///< [J]
  double external_work() const { return actions_.totals.work; }          ///< [J]
  /// Adds the impulses of supports and loads in the last step.
  void add_actions(Resultants& actions) const { actions_.add_to(actions); }

  RemeshingCounts const& remeshing() const { return counts_; }
  SetupSeconds const& seconds() const { return seconds_; }
  bool inverted() const { return measures_.inverted; }
  /// Set once the cells or lists of a moving body cannot be rebuilt.
  std::optional<DetachedParticle> const& detached() const { return detached_; }
  /// A particle of the cell with the smallest volume.
  Index worst_corner() const { return mesh_.worst_corner(particles_.positions()); }

  Snapshot snapshot() const;
  void restore(Snapshot const& snapshot);
  std::size_t bytes() const;

 private:
  void step_by_kernel_sums(Impulse const& before, double time, double dt);
  void step_by_adjoint_exchange(Impulse const& before, double time, double dt);
  void prescribe_boundary(double time, double dt, double ahead);
  void set_accelerations(double time);
  void arrange(std::vector<Index> corners, Points const& x_of_cells);
  void build_lists(Points const& x);
  void remesh_if_needed();
  void update_lists_or_cells();
  bool triangulate();
  template <class Self, class F>
  static void each_total(Self& self, F const& f);

  Options options_;
  Backend const* backend_;
  Particles particles_;
  Boundary boundary_;
  CellMesh mesh_;
  CellFields cell_fields_;
  HourglassBoxes boxes_;
  NeighbourLists lists_;
  std::vector<double> partial_;
  FailureSlot failure_;
  BodyState state_;
  ExternalActions actions_;
  CellMeasures measures_;
  double first_spacing_ = 0;  ///< at the start [m]
  RemeshingCounts counts_;
  std::optional<DetachedParticle> detached_;
  SetupSeconds seconds_;
  double last_step_ = 0;     ///< [s]
  double damping_loss_ = 0;  ///< [J]
};

/// Saves a body in arrays whose names start with "body<number>_".
void save_body(TaylorBody const& body, std::size_t number, StateWriter& writer);
/// Inverse of save_body(). Throws FileError for cells that are not those of this body.
void load_body(TaylorBody& body, std::size_t number, StateReader& reader);

}  // namespace piola::taylor_sph
