// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/domain/partition.hpp"
#include "piola/exec/device_loops.hpp"
#include "piola/exec/field.hpp"
#include <algorithm>
#include <span>
#include <vector>

/// Collectives for a body whose slots are numbered alike on all ranks, each of which owns some of them. Halos are in
/// halo_plan.hpp. Every function is collective; on one rank none communicates.
namespace piola {

/// Partition of the slots of a body by even_range_of_rank(); the first `particles` of all slots hold a particle.
struct DistributedSlots {
  Index slots, particles;
  /// Occupied slots of a rank.
  Range of(int rank) const;
  Range own() const { return of(comm::rank()); }
  /// Replicates `width` values per particle. In: the values of local particles; out: those of all particles.
  /// Collective.
  void complete(std::span<double> values, std::size_t width) const;
  /// Gathers on rank 0. `values`: `width` values per slot of this rank. Calls take(range, values) on rank 0 for one
  /// rank after the other, so that it holds at most one more partition at a time. Inverse of deal(). Collective.
  template <class F>
  void collect(std::size_t width, std::vector<double> values, F const& take) const {
    for (int rank = 0; rank < comm::size(); ++rank) {
      Range const part = of(rank);
      if (comm::rank() == 0 && rank > 0) values.resize(static_cast<std::size_t>(part.last - part.first) * width);
      if (rank > 0) comm::send_to(rank, 0, values);
      if (comm::rank() == 0) take(part, values);
    }
  }
  /// Scatters from rank 0: give(range, values) is called on rank 0 for each rank and fills its values. Returns the
  /// values of this rank's slots. Inverse of collect(). Collective.
  template <class F>
  std::vector<double> deal(std::size_t width, F const& give) const {
    std::vector<double> mine;
    for (int rank = comm::size() - 1; rank >= 0; --rank) {
      if (comm::rank() != 0 && comm::rank() != rank) continue;
      Range const part = of(rank);
      mine.resize(static_cast<std::size_t>(part.last - part.first) * width);
      if (comm::rank() == 0) give(part, std::span<double>(mine));
      if (rank > 0) comm::send_to(0, rank, mine);
    }
    return mine;
  }
};

/// Replicates a field at `slots`, a list that is identical on all ranks; each value is taken from the rank that owns
/// the slot. For short lists: the message has the length of the list on every rank. Collective.
void allgather_selected_slots(FieldRef const& field, Range own, std::span<Index const> slots, int components);

/// Reduces a failure over ranks: the one at the lowest particle id is set on all ranks. Collective.
void allreduce_first_failure(FailureSlot& slot);

}  // namespace piola
