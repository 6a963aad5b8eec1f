// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include "piola/parallel/ranks.hpp"
#include <span>
#include <vector>

namespace piola {

/// The slots of a body that one rank owns: a contiguous share of its blocks of 64 slots, which sums start with, so that
/// they are the same blocks for any number of ranks.
Range share_of(Index slots, int rank, int ranks);

/// Who owns which slots of a body: each rank a run of its blocks of 64, in the order of ranks.
class Shares {
 public:
  /// The same number of blocks for each rank, as share_of() has it.
  explicit Shares(Range whole, int ranks = ranks::count());
  /// first_block: per rank the first of its blocks; they do not fall, and rank 0 begins with block 0.
  Shares(Range whole, std::vector<Index> const& first_block);

  Range whole() const { return {starts_.front(), starts_.back()}; }
  Range of(int rank) const {
    auto const r = static_cast<std::size_t>(rank);
    return {starts_[r], starts_[r + 1]};
  }
  Range own() const { return of(ranks::own()); }
  /// The same of a body whose first slot is 0.
  Shares from_zero() const;
  bool operator==(Shares const&) const = default;

 private:
  std::vector<Index> starts_;  ///< slots: per rank its first one, then that after the last
};

/// Cuts the blocks of a body so that the work of the busiest rank is the least that runs of blocks allow, and that of
/// the others as equal as they can be then. work: of each block, not negative; if it is all zero, blocks count alike.
/// before: what each rank has to do besides; as many as there are ranks. Returns the first block of each rank. If
/// nobody has anything to do besides, each rank gets a block at least, as long as there are enough.
std::vector<Index> cut_by_work(std::span<double const> work, std::span<double const> before);

}  // namespace piola
