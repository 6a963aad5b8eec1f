// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/nodal/state.hpp"

namespace piola::nodal {

/// Storage of the data that sweeps read from neighbours: X, x and the stress. Lists: one record per particle and
/// sweep. Lattices: component after component, padded with zeros.
class NeighbourRecords {
 public:
  NeighbourRecords() = default;
  NeighbourRecords(NeighbourRecords const&) = delete;
  NeighbourRecords& operator=(NeighbourRecords const&) = delete;

  void place_records(FieldList& fields, BodyState const& state, Index slots);
  /// guard: slots that loops over a lattice may read before the first and after the last one.
  static void place_lattice(FieldList& fields, BodyState const& state, Index slots, Index guard);
  std::size_t bytes() const { return first_.bytes() + second_.bytes(); }

 private:
  Memory first_, second_;
  FieldVersion first_version_, second_version_;
};

}  // namespace piola::nodal
