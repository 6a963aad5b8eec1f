// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/neighbour_records.hpp"
#include "piola/formulations/nodal/list_sums.hpp"

namespace piola::nodal {
namespace {

/// Sizes of Records of a dimension.
struct RecordSizes {
  std::ptrdiff_t motion, stress;
  int one;
};
RecordSizes record_sizes(int D) {
  auto const of = [](auto r) { return RecordSizes{r.motion_size, r.stress_size, r.one}; };
  return D == 1 ? of(Records<1>{}) : D == 2 ? of(Records<2>{}) : of(Records<3>{});
}

}  // namespace

void NeighbourRecords::place_records(Fields& fields, int D, Index slots) {
  RecordSizes const size = record_sizes(D);
  first_ = Memory(static_cast<std::size_t>(slots * size.motion));
  second_ = Memory(static_cast<std::size_t>(slots * size.stress));
  fields.X.place(first_.data(), 1, size.motion, 0, slots, &first_version_);
  fields.x.place(first_.data(), 1, size.motion, D, slots, &first_version_);
  fields.mu.place(first_.data(), 1, size.motion, std::ptrdiff_t{2} * D, slots, &first_version_);
  fields.stress.place(second_.data(), 1, size.stress, 0, slots, &second_version_);
}

void NeighbourRecords::complete_record(int D, Index slot) {
  RecordSizes const size = record_sizes(D);
  first_.data()[slot * size.motion + size.one] = 1;
}

void NeighbourRecords::place_lattice(Fields& fields, Index slots, Index guard) {
  fields.x.allocate(slots, guard);
  fields.products.allocate(slots, guard);
  fields.stress.allocate(slots, guard);
}

}  // namespace piola::nodal
