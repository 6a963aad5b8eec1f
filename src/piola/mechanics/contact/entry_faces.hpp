// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_model.hpp"
#include "piola/mechanics/contact/passages.hpp"
#include <vector>

namespace piola::contact {

/// The faces by which surface points have entered thin rigid shapes. Such a point is pushed out by this face, at any
/// depth, until it is out of the shape.
class EntryFaces {
 public:
  bool has(Index point, std::size_t rigid) const { return find(point, rigid) != nullptr; }
  /// Signed distance of a point from a shape, seen from its entry face.
  Distance distance(ContactModel const& model, Index point, std::size_t rigid) const;
  /// Finds the faces for an evaluation at x [m] of the points in `near_rigids`, ascending. Points that have left
  /// through the far face are passages.
  void update(ContactModel& model, std::vector<Index> const& near_rigids, std::vector<Vec<3>> const& x,
              Passages& passages);

  void save(std::vector<double>& all) const;
  void load(StateVector& from);

 private:
  struct Entry {
    Index point;
    std::size_t rigid;
    Sides sides;
  };
  Entry const* find(Index point, std::size_t rigid) const;
  void update_point(ContactModel& model, Index point, std::size_t rigid, std::vector<Vec<3>> const& x,
                    std::vector<Entry>& now, Passages& passages) const;

  std::vector<Entry> entries_;  ///< by point and shape
};

/// The step in which no point crosses half a spacing relative to a thin shape [s]. v [m/s].
double crossing_time_step(ContactModel const& model, std::vector<Vec<3>> const& v);

}  // namespace piola::contact
