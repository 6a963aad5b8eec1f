// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/mechanics/contact/contact_model.hpp"
#include "piola/mechanics/contact/contact_state.hpp"
#include "piola/mechanics/contact/surface_mirror.hpp"
#include <vector>

namespace piola::contact {

/// Contact of points of rigid shapes with the planes of bodies, where points of the bodies are too far apart to feel
/// the shape.
class ShapePointContact {
 public:
  explicit ShapePointContact(std::size_t bodies) : mirrors_(bodies) {}
  /// Mirror planes of a body. Behind them its shape points count in their images.
  void set_mirrors(std::size_t body, std::vector<SurfaceMirror> mirrors) { mirrors_[body] = std::move(mirrors); }
  /// Lists the planes near each point. of_body: points by body; skin: margin of the search [m].
  void search(ContactModel const& model, std::vector<std::vector<Index>> const& of_body, double skin);
  /// Marks the points in the lists.
  void mark(std::vector<char>& points) const;
  /// Computes the gaps alone.
  void find_gaps(ContactModel const& model);
  void evaluate(ContactModel& model, ContactState& state);
  /// The step in which the fastest pair approaches by a tenth of a spacing [s]. v [m/s].
  double contact_time_step(ContactModel const& model, std::vector<Vec<3>> const& v) const;
  std::size_t bytes() const { return sources_.size() * sizeof(Index); }

 private:
  /// A point of a shape and the planes near it: a range of sources_.
  struct Range {
    std::size_t pass;
    ShapePoint point;
    std::size_t first, last;
    Plane plane = {};
    Gap gap = {};
    Index count() const { return static_cast<Index>(last - first); }
  };
  double weight_at_mirrors(ContactModel const& model, Range const& range) const;
  void evaluate(Range const& range, ContactModel& model, ContactState& state);
  void record_springs(ContactModel const& model, Range const& range, double area, ContactForces& forces);
  void add_frequencies(ContactModel const& model, ContactForces& forces) const;

  std::vector<std::vector<SurfaceMirror>> mirrors_;
  std::vector<Range> ranges_;
  std::vector<Index> sources_;
  std::vector<double> weights_;  ///< of sources
  std::vector<double> springs_;  ///< by host particle [N/m]
};

}  // namespace piola::contact
