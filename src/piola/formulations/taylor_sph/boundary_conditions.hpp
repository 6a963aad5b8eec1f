// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/taylor_sph/state.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <array>
#include <functional>
#include <optional>
#include <vector>

namespace piola::taylor_sph {

/// Prescribed values on the surface of one body and at its supports: the sides that meet at a particle with their
/// normals, the tractions on them (zero without load), the velocities of supports; and their work. Particles are
/// numbered from the body's first particle on. Theory: docs/theory/taylor-sph.md.
class Boundary {
 public:
  Boundary(Assembly const& assembly, std::size_t body);

  /// Sets up the particles with prescribed values and returns them in increasing order, the order of items: those of
  /// the surface except the tips of cracks, and those of supports. Throws InputError if a traction is given without a
  /// surface.
  std::vector<Index> const& arrange(Surface const& surface, Points const& x);

  /// Before a step from `time` to time + dt. `x`: positions for the normals. `stress_now(k)`: the stress of the item's
  /// particle, used as the earlier prescribed value if there was none: at time 0 and after a release. Earlier
  /// velocities are those of the particles.
  void prepare(double time, double dt, Points const& x, std::function<std::array<double, 3>(Index)> const& velocity,
               std::function<std::array<double, 6>(Index)> const& stress_now);
  /// As prepare(), for the velocities alone, and for normals if there are tractions.
  void prepare_speeds(double time, double dt, Points const& x,
                      std::function<std::array<double, 3>(Index)> const& velocity);
  /// Number of sides that meet at a particle; 0 in the interior.
  int sides(Index particle) const { return static_cast<int>(sides_[static_cast<std::size_t>(particle)].size()); }
  std::vector<Index> const& particles() const { return particles_; }
  BoundaryItem* items() { return items_.data(); }

  /// Power of tractions and supports: sum v.(sigma.a) over the surface [W], with the normals of the last preparation.
  double power(std::function<std::array<double, 3>(Index)> const& velocity,
               std::function<std::array<double, 6>(Index)> const& stress) const;

  /// add(load, particle, value): loads are numbered as in the assembly.
  using AddLoad = std::function<void(std::size_t, Index, std::array<double, 3> const&)>;
  /// Forces of tractions at a time, with the sides of the last preparation [N per unit of missing directions].
  void each_traction(double time, AddLoad const& add) const;
  /// Updates normals and areas of sides for these positions.
  void turn(Points const& x);
  /// Force of the stress of a particle on its sides, with the normals of the last preparation [N].
  std::array<double, 3> force_on_sides(Index particle, std::array<double, 6> const& stress) const;
  bool holds() const;  ///< whether this body has a support

  bool has_tractions() const { return !tractions_.empty(); }
  bool has_accelerations() const { return !accelerations_.empty(); }
  /// Adds the accelerations of loads at a time [m/s2].
  void each_acceleration(double time, AddLoad const& add) const;

  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_end_time(double time) const;

 private:
  struct Held {
    std::size_t support;
    std::array<double, 3> direction;
  };
  /// A traction on the sides with the normal `normal`.
  struct Traction {
    std::size_t load;
    std::array<double, 3> normal;
  };
  /// Facets around a particle that form one smooth side.
  struct Side {
    std::vector<Index> facets;
    std::array<double, 3> reference_normal, normal, area;  ///< area: of the particle's part [m^(D-1)]
    std::vector<std::size_t> tractions;                    ///< indices of loads
  };
  void sort_facets(Surface const& surface, Points const& x);
  void add_to_side(Index particle, Index facet, std::array<double, 3> const& area);
  void attach_tractions();
  std::array<double, 3> facet_area(Index facet, Points const& x) const;
  std::array<double, 3> traction_of_load(std::size_t traction, Side const& side, std::array<double, 3> const& X,
                                         double time) const;
  std::array<double, 3> traction_on(Side const& side, std::array<double, 3> const& X, double time) const;
  void hold(Index particle, double time, double dt, std::array<double, 3> const& velocity, BoundaryItem& item) const;
  void load(Index particle, double time, double dt, std::array<double, 6> const& stress, BoundaryItem& item) const;

  int D_;
  std::int64_t first_;
  Points X_;
  std::vector<std::vector<Held>> held_;        ///< per particle
  std::vector<std::vector<Traction>> loaded_;  ///< per particle
  std::vector<bool> tip_;                      ///< tips of cracks
  std::vector<Support> supports_;
  std::vector<Load> tractions_, accelerations_;                     ///< tractions have no `particles`
  std::vector<std::size_t> traction_number_, acceleration_number_;  ///< indices in the assembly
  Surface surface_;
  std::vector<std::vector<Side>> sides_;  ///< per particle
  std::vector<Index> particles_;          ///< particles of the items
  std::vector<BoundaryItem> items_;
};

}  // namespace piola::taylor_sph
