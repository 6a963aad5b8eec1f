// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/slot_collectives.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/first_failure.hpp"
#include <algorithm>
#include <vector>

namespace piola {

Range DistributedSlots::of(int rank) const {
  PIOLA_EXPECTS(particles >= 0 && particles <= slots);
  Range const share = even_range_of_rank(slots, rank, comm::size());
  return {std::min(share.first, particles), std::min(share.last, particles)};
}

void DistributedSlots::complete(std::span<double> values, std::size_t width) const {
  PIOLA_EXPECTS(values.size() >= static_cast<std::size_t>(particles) * width);
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < comm::size(); ++rank) starts.push_back(static_cast<std::size_t>(of(rank).last) * width);
  comm::allgather(values.first(starts.back()), starts);
}

void allgather_selected_slots(FieldRef const& field, Range own, std::span<Index const> slots, int components) {
  PIOLA_EXPECTS(own.first <= own.last && components > 0);
  if (!comm::is_parallel()) return;
  std::vector<double> values;
  for (Index const i : slots)
    for (int c = 0; c < components; ++c) values.push_back(i >= own.first && i < own.last ? value_at(field, i, c) : 0);
  comm::allreduce_or(values);
  auto from = values.begin();
  for (Index const i : slots)
    for (int c = 0; c < components; ++c) value_at(field, i, c) = *from++;
}

void allreduce_first_failure(FailureSlot& slot) {
  FirstFailure first(slot);
  comm::allreduce_sum(first);
  first.put(slot);
}

}  // namespace piola
