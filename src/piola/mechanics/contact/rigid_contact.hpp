// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_model.hpp"
#include "piola/mechanics/contact/contact_state.hpp"
#include "piola/mechanics/contact/entry_faces.hpp"
#include <vector>

namespace piola::contact {

/// Contact of surface points with rigid shapes, by their distance from these.
class RigidContact {
 public:
  /// Lists the points near rigid shapes. skin: margin of the search [m].
  void search(ContactModel const& model, double skin);
  /// Marks the points in the list.
  void mark(std::vector<char>& points) const;
  /// Computes the forces at x [m].
  void evaluate(ContactModel& model, std::vector<Vec<3>> const& x, ContactState& state);
  /// Energy stored by the contact of a point with a rigid shape [J].
  double energy_of(ContactModel const& model, Index point, std::size_t rigid) const {
    return model.tests(point, rigid) ? energy_of_any(model, point, rigid) : 0;
  }
  /// As energy_of(), also of a point that was removed.
  double energy_of_any(ContactModel const& model, Index point, std::size_t rigid) const;
  /// The step in which the fastest pair approaches by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const;

  void save(std::vector<double>& all) const { faces_.save(all); }
  void load(StateVector& from) { faces_.load(from); }

 private:
  void evaluate(Index point, std::size_t rigid, ContactModel& model, ContactState& state) const;

  std::vector<Index> near_rigids_;  ///< ascending
  EntryFaces faces_;
};

}  // namespace piola::contact
