// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/taylor_sph/particles.hpp"
#include "piola/neighbours/mesh_cells.hpp"
#include <array>
#include <functional>
#include <vector>

namespace piola::taylor_sph {

/// Prescribed values on the surface of one body and at its supports: the sides that meet at a particle with their
/// normals, the tractions on them (zero without load), the velocities of supports; and their power. Refers to the
/// particles, which must outlive it. Theory: docs/theory/taylor-sph.md.
class Boundary {
 public:
  Boundary(Assembly const& assembly, std::size_t body, Particles const& real);

  /// Sets up the particles with prescribed values and returns them in increasing order, the order of items: those of
  /// the surface except the tips of cracks, and those of supports. Throws InputError if a traction is given without a
  /// surface.
  std::vector<Index> const& arrange(Surface const& surface, Points const& x);

  /// Moves the surface, whose normals are updated later, to place(particle) [m]. Tips of cracks stay where they are.
  template <class F>
  void move_surface(F const& place) {
    for (Index const i : particles_) x_[static_cast<std::size_t>(i)] = place(i);
  }
  /// Updates normals and areas of the sides.
  void update_normals() { update_normals(x_); }
  /// Sets the prescribed values, and normals, before a step from `time` to time + dt. Where no stress was prescribed,
  /// at time 0 and after a release, that of the particle is the earlier value; earlier velocities are those of
  /// particles.
  void prescribe(double time, double dt);
  /// As prescribe(), for the velocities alone, and for normals if there are tractions.
  void prescribe_velocities(double time, double dt);
  /// Number of sides that meet at a particle; 0 in the interior.
  int sides(Index particle) const { return static_cast<int>(sides_[static_cast<std::size_t>(particle)].size()); }
  std::vector<Index> const& particles() const { return particles_; }
  BoundaryItem* items() { return items_.data(); }
  BoundaryItem const& item(std::size_t k) const { return items_[k]; }  ///< of particles()[k]
  /// Power of tractions and supports: sum v.(sigma.a) over the surface [W], with the last normals.
  double power() const;

  /// add(load, particle, value): loads are numbered as in the assembly.
  using AddLoad = std::function<void(std::size_t, Index, std::array<double, 3> const&)>;
  /// Forces of tractions at a time, with the last normals [N per unit of missing directions].
  void each_traction(double time, AddLoad const& add) const;
  /// Force of the stress of a particle on its sides, with the last normals [N].
  std::array<double, 3> force_on_sides(Index particle) const;

  bool has_supports() const { return has_supports_; }
  bool has_tractions() const { return !tractions_.empty(); }
  bool has_accelerations() const { return !accelerations_.empty(); }
  /// Accelerations of loads at a time [m/s2].
  void each_acceleration(double time, AddLoad const& add) const;

  /// The next time after `time` at which a support or a load ends; infinity if there is none.
  double next_end_time(double time) const;

 private:
  using Point = std::array<double, 3>;
  struct HeldDirection {
    std::size_t support;
    Point direction;
  };
  /// A traction on the sides with the normal `normal`.
  struct Traction {
    std::size_t load;
    Point normal;
  };
  /// Facets around a particle that form one smooth side.
  struct Side {
    std::vector<Index> facets;
    Point reference_normal, normal, area;  ///< area: of the particle's part [m^(D-1)]
    std::vector<std::size_t> tractions;    ///< indices of loads
  };
  void read_loads(Assembly const& assembly);
  void sort_facets(Surface const& surface);
  void add_to_side(Index particle, Index facet, Point const& area);
  void attach_tractions();
  void update_normals(Points const& x);
  Point facet_area(Index facet, Points const& x) const;
  Point traction_of_load(std::size_t traction, Side const& side, Index particle, double time) const;
  Point traction_on(Side const& side, Index particle, double time) const;
  void prescribe_velocity(Index particle, double time, double dt, BoundaryItem& item) const;
  void prescribe_stress(Index particle, double time, double dt, BoundaryItem& item) const;

  int D_;
  Particles const& real_;
  Points x_;  ///< of the surface, at the last move_surface()
  bool has_supports_ = false;
  std::vector<std::vector<HeldDirection>> held_;  ///< per particle
  std::vector<std::vector<Traction>> loaded_;     ///< per particle
  std::vector<bool> tip_;                         ///< tips of cracks
  std::vector<Support> supports_;
  std::vector<Load> tractions_, accelerations_;                     ///< tractions have no `particles`
  std::vector<std::size_t> traction_number_, acceleration_number_;  ///< indices in the assembly
  Surface surface_;
  std::vector<std::vector<Side>> sides_;  ///< per particle
  std::vector<Index> particles_;          ///< particles of the items
  std::vector<BoundaryItem> items_;
};

}  // namespace piola::taylor_sph
