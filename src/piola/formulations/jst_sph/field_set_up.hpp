// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/jst_sph/body.hpp"

namespace piola::jst_sph {

/// Fills the fields of a body that has its memory: reference data, then the state of t = 0. Exists only while the body
/// is constructed. Collective if the body is distributed.
class FieldSetUp {
 public:
  FieldSetUp(JstBody& body, Backend const& backend) : body_(body), s_(body.state()), backend_(backend) {}

  /// Positions and constant corrections that sweeps read at neighbours.
  void fill_records(NeighbourRecords& records, ReferencePairs const& pairs) const;
  /// groups: those that the reference fields are stored for; nullptr: one value per slot.
  void fill_reference(UniqueLaneGroups const* groups, ReferencePairs const& pairs) const;
  /// Scaling of the volumetric filter.
  void fill_filter(ReferencePairs const& pairs) const;
  /// Position, velocity and F of t = 0.
  void fill_initial(Assembly const& assembly);
  /// H and J of the start, where they are unknowns: those of F.
  void fill_evolved_geometry() const;

 private:
  void deform_to_positions();

  JstBody& body_;
  BodyState& s_;
  Backend const& backend_;
};

}  // namespace piola::jst_sph
