// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_resultants.hpp"
#include "piola/mechanics/contact/surface_points.hpp"
#include <algorithm>
#include <cstdint>
#include <vector>

namespace piola::contact {

/// Totals of all surface contacts of a run at one instant.
struct Totals {
  double energy = 0;         ///< stored in the layers [J]
  double deepest = 0;        ///< largest depth of a point behind a surface, in spacings
  double frequency2 = 0;     ///< square of the largest frequency that contact adds [1/s2]
  double spring_energy = 0;  ///< of friction springs [J]
  double friction_work = 0;  ///< work taken by friction since the last evaluation, stored or dissipated [J]
  std::int64_t touched = 0;  ///< surface points with a contact force
};

/// Accumulated result of one evaluation: loads of surface points, forces on particles, totals and resultants.
class ContactForces {
 public:
  ContactForces(SurfacePoints const& points, std::size_t rigids);

  void clear();
  void add_load(Index point, PointLoad const& load);
  /// Adds a point behind a surface, by the energy of its layer [J].
  void add_contact(double energy) {
    energy_ += energy;
    ++totals_.touched;
  }
  /// Adds a friction spring, by its energy and the work taken by it [J].
  void add_friction(double energy, double work) {
    spring_energy_ += energy;
    friction_work_ += work;
  }
  void record_gap(Index point, double gap) { gap_[at(point)] = std::min(gap_[at(point)], gap); }
  void record_depth(double in_spacings) { totals_.deepest = std::max(totals_.deepest, in_spacings); }
  void record_frequency2(double frequency2) { totals_.frequency2 = std::max(totals_.frequency2, frequency2); }
  /// Frequencies of springs in addition to the recorded ones [1/s2].
  void add_frequency2(double frequency2) { totals_.frequency2 += frequency2; }
  ContactResultants& resultants() { return resultants_; }
  ContactResultants const& resultants() const { return resultants_; }
  /// Computes the sums, and the forces on particles from the loads of points.
  void finish(SurfacePoints const& points);

  std::vector<Vec<3>> const& forces() const { return forces_; }                 ///< by index into ids() [N]
  std::vector<Index> const& loaded_indices() const { return loaded_indices_; }  ///< with a force, ascending
  Totals const& totals() const { return totals_; }
  double gap(Index point) const { return gap_[at(point)]; }                    ///< smallest one [m], or infinity
  double normal_force(Index point) const { return normal_force_[at(point)]; }  ///< outward [N]

  void save(std::vector<double>& all) const;
  void load(StateVector& from);

 private:
  void add_force(Index particle, Vec<3> const& f);

  std::vector<PointLoad> loads_;  ///< by point
  std::vector<char> has_load_;    ///< by point
  std::vector<Index> loaded_points_;
  std::vector<double> gap_, normal_force_;  ///< by point
  std::vector<Vec<3>> forces_;
  std::vector<char> has_force_;  ///< by index into ids()
  std::vector<Index> loaded_indices_;
  Totals totals_;
  exec::ReproducibleSum energy_, spring_energy_, friction_work_;
  ContactResultants resultants_;
};

}  // namespace piola::contact
