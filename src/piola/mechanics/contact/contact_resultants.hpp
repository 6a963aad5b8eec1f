// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/force_moment.hpp"
#include <map>
#include <utility>
#include <vector>

namespace piola::contact {

class StateVector;

/// Resultants of contact between bodies and on rigid shapes in one evaluation, and the springs of free rigid shapes.
/// Sums do not depend on the order of points.
class ContactResultants {
 public:
  /// Springs between a free rigid shape and the points near it: the largest square of the frequency that one of them
  /// gives its point, and the sum of the squares for the shape [1/s2]. The sum of both is a bound.
  struct Frequencies {
    double of_points = 0, of_shape = 0;
  };
  ContactResultants(std::size_t bodies, std::size_t rigids);

  void clear();
  /// Adds a force [N] on a point at y [m] of body a, by body b. Internal forces of a body sum to 0.
  void add_between(std::size_t a, std::size_t b, Vec<3> const& y, Vec<3> const& force);
  /// moment: about the centre [N m].
  void add_on_rigid(std::size_t k, Vec<3> const& force, Vec<3> const& moment) { on_rigid_sums_[k].add(force, moment); }
  void add_spring(std::size_t k, double square_of_frequency) { spring_sums_[k] += square_of_frequency; }
  Frequencies& own_frequencies(std::size_t k) { return frequencies_[k]; }
  /// Computes the sums.
  void finish();

  /// Sets the load of ties on a rigid shape; moment about its centre. springs: as in Frequencies [1/s2].
  void tie_rigid(std::size_t k, ForceMoment const& load, double springs) { ties_[k] = {load, springs}; }
  /// Force of bodies on a rigid shape, with that of ties; moment about its centre.
  ForceMoment on_rigid(std::size_t k) const {
    return {on_rigid_[k].force + ties_[k].load.force, on_rigid_[k].moment + ties_[k].load.moment};
  }
  Frequencies frequencies(std::size_t k) const {
    return {frequencies_[k].of_points, frequencies_[k].of_shape + ties_[k].springs};
  }
  /// Force of body b on body a; moment about the origin.
  ForceMoment const& between(std::size_t a, std::size_t b) const { return between_[a][b]; }

  void save(std::vector<double>& all) const;
  void load(StateVector& from);

 private:
  struct Tied {
    ForceMoment load;
    double springs = 0;
  };
  std::vector<ForceMoment> on_rigid_;  ///< without ties
  std::vector<Tied> ties_;             ///< by rigid shape
  std::vector<Frequencies> frequencies_;
  std::vector<std::vector<ForceMoment>> between_;
  std::vector<ForceMomentSum> on_rigid_sums_;
  std::vector<exec::ReproducibleSum> spring_sums_;                           ///< by rigid shape
  std::map<std::pair<std::size_t, std::size_t>, ForceMomentSum> pair_sums_;  ///< of two bodies, on the first
};

}  // namespace piola::contact
