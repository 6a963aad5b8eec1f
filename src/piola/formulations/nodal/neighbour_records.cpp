// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/neighbour_records.hpp"
#include "piola/formulations/nodal/list_sums.hpp"

namespace piola::nodal {
namespace {

/// Sizes of Records of a dimension.
struct RecordSizes {
  std::ptrdiff_t motion, position, stress;
};
RecordSizes record_sizes(int D) {
  auto const of = [](auto r) { return RecordSizes{r.motion_size, r.position, r.stress_size}; };
  return D == 1 ? of(Records<1>{}) : D == 2 ? of(Records<2>{}) : of(Records<3>{});
}

}  // namespace

void NeighbourRecords::place_records(FieldList& fields, BodyState const& state, Index slots) {
  RecordSizes const size = record_sizes(state.dimension);
  first_ = Memory(static_cast<std::size_t>(slots * size.motion));
  second_ = Memory(static_cast<std::size_t>(slots * size.stress));
  fields[state.X].place(first_.data(), 1, size.motion, 0, slots, &first_version_);
  fields[state.x].place(first_.data(), 1, size.motion, size.position, slots, &first_version_);
  fields[state.stress].place(second_.data(), 1, size.stress, 0, slots, &second_version_);
}

void NeighbourRecords::place_lattice(FieldList& fields, BodyState const& state, Index slots, Index guard) {
  for (FieldRef const* field : {&state.x, &state.resultants}) fields[*field].allocate(slots, guard);
}

}  // namespace piola::nodal
