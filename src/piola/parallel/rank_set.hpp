// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <bit>
#include <cstdint>

namespace piola {

/// Some of the ranks, in eight bytes: ranks whose numbers differ by a multiple of 64 are not told apart, so a set of
/// many ranks may have more than were put in, on all ranks the same ones.
class RankSet {
 public:
  void add(int rank) { bits_ |= bit(rank); }
  void add(RankSet other) { bits_ |= other.bits_; }
  bool has(int rank) const { return (bits_ & bit(rank)) != 0; }
  bool empty() const { return bits_ == 0; }
  /// f(rank) for those of the ranks 0 to ranks - 1 that it has.
  template <class F>
  void each(int ranks, F const& f) const {
    for (std::uint64_t rest = bits_; rest != 0; rest &= rest - 1)
      for (int rank = std::countr_zero(rest); rank < ranks; rank += 64) f(rank);
  }

 private:
  static std::uint64_t bit(int rank) { return std::uint64_t{1} << (rank % 64); }
  std::uint64_t bits_ = 0;
};

}  // namespace piola
