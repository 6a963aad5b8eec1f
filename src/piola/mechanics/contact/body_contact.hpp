// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_model.hpp"
#include "piola/mechanics/contact/contact_state.hpp"
#include "piola/mechanics/contact/gap_offsets.hpp"
#include <vector>

namespace piola::contact {

/// Contact of surface points with the planes of other bodies, or of their own: each point with the planes in its
/// neighbour list.
class BodyContact {
 public:
  /// Lists the planes near each point. of_body: points by body; skin: margin of the search [m].
  void search(ContactModel const& model, std::vector<std::vector<Index>> const& of_body, double skin);
  /// Marks the points in the lists.
  void mark(std::vector<char>& points) const;
  void evaluate(ContactModel& model, ContactState& state);
  /// Keeps the energy of each point for the next evaluation, in which no point may have more. To be called before
  /// planes are removed from the lists, at the places of that evaluation.
  void carry_energies(ContactModel const& model);
  /// Depths of such points for a checkpoint.
  std::vector<double> depths() const { return offsets_.state(); }
  void load_depths(std::vector<double> const& depths) { offsets_.load(depths); }
  /// Energy stored by the contact of a point with a body [J].
  double energy_of(ContactModel const& model, Index point, std::size_t body) const;
  /// The step in which the fastest pair approaches by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const;
  std::size_t bytes() const { return sources_.size() * sizeof(Index) + ranges_.size() * (sizeof(Range) + sizeof(Gap)); }

 private:
  /// The planes of a body near a target point: a range of sources_.
  struct Range {
    Index target;
    std::size_t body;
    std::size_t first, last;
    Index count() const { return static_cast<Index>(last - first); }
  };
  void search_body(ContactModel const& model, std::size_t b, std::vector<Index> const& of_body, double skin);
  void find_gaps(ContactModel const& model);
  void set_offsets(ContactModel const& model);
  double energy_per_area(ContactModel const& model, Range const& range, Gap const& gap) const;
  void evaluate(Range const& range, Gap const& gap, ContactModel& model, ContactState& state);
  double largest_inverse_mass(SurfacePoints const& points, Range const& range) const;

  std::vector<Range> ranges_;
  std::vector<Index> sources_;
  std::vector<Gap> gaps_;        ///< by range
  std::vector<double> weights_;  ///< of sources
  GapOffsets offsets_;           ///< by body and target
  PairValues carried_;           ///< energy per area, by body and target, see carry_energies() [J/m2]
  bool carries_ = false;
};

}  // namespace piola::contact
