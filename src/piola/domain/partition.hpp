// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/exec/device_loops.hpp"
#include <span>
#include <vector>

namespace piola {

/// Slots that one rank owns by default: a contiguous range of whole blocks of 64 slots. Sums start with blocks, so the
/// blocks are the same for any number of ranks.
Range even_range_of_rank(Index slots, int rank, int ranks);

/// Partition of the slots of a body: each rank owns a contiguous range of blocks of 64, in rank order.
class Partition {
 public:
  /// Equal partition, as by even_range_of_rank().
  explicit Partition(Range whole, int ranks = comm::size());
  /// first_block: first block of each rank, non-decreasing; rank 0 starts at block 0.
  Partition(Range whole, std::vector<Index> const& first_block);

  Range whole() const { return {starts_.front(), starts_.back()}; }
  Range of(int rank) const {
    auto const r = static_cast<std::size_t>(rank);
    return {starts_[r], starts_[r + 1]};
  }
  Range own() const { return of(comm::rank()); }
  /// Returns the partition shifted so that the first slot is 0.
  Partition from_zero() const;
  bool operator==(Partition const&) const = default;

 private:
  std::vector<Index> starts_;  ///< first slot of each rank, then the end of the last
};

/// Partitions the blocks of a body into contiguous runs that minimise the work of the most loaded rank; among those
/// solutions, balances the others. work: one value >= 0 per block; all zero means equal weights. before: other work of
/// each rank, one value per rank. Returns the first block of each rank. If `before` is zero, each rank gets at least
/// one block if there are enough.
std::vector<Index> partition_by_work(std::span<double const> work, std::span<double const> before);

}  // namespace piola
