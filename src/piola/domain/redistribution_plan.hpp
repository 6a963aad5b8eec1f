// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/device_loops.hpp"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace piola {

/// A table distributed over the ranks by rows; each row has one owner.
struct DistributedRows {
  std::int64_t set = 0;  ///< tables with the same distribution of rows have the same number
  Index count = 0;       ///< rows of all ranks
  /// Global indices of the rows of this rank, 0 to count - 1; nothing: this rank has all rows, in order.
  std::optional<std::span<Index const>> places = {};
  int columns = 1;
};

inline std::size_t value_count(DistributedRows const& rows) {
  return static_cast<std::size_t>(rows.count) * static_cast<std::size_t>(rows.columns);
}

/// Redistributes rows of a table between the ranks that own the particles and the ranks that write or read the file
/// (two-phase I/O). Each writing rank holds a contiguous range of whole blocks; a table of a single block is written by
/// rank 0.
class RedistributionPlan {
 public:
  /// Collective.
  RedistributionPlan(DistributedRows const& rows, Index block);
  /// Rows of the file that a rank reads or writes.
  Range of(int rank) const;
  Range own() const;
  /// Collective. In: the values of the rows that this rank owns, `columns` per row. Returns the values of the rows that
  /// it writes, own(), in file order.
  template <class T>
  std::vector<T> collect(std::span<T const> values, int columns) const {
    static_assert(std::is_trivially_copyable_v<T>, "it travels as bytes");
    auto const width = static_cast<std::size_t>(columns);
    std::vector<T> whole(static_cast<std::size_t>(own().last - own().first) * width);
    move(std::as_bytes(values), scattered_, std::as_writable_bytes(std::span(whole)), stretch_, sizeof(T) * width);
    return whole;
  }
  /// Inverse of collect(). Collective.
  template <class T>
  void from_file_order(std::span<T const> whole, std::span<T> values, int columns) const {
    move(std::as_bytes(whole), stretch_, std::as_writable_bytes(values), scattered_,
         sizeof(T) * static_cast<std::size_t>(columns));
  }

 private:
  /// Rows in the order of the ranks to which they are sent or from which they are received.
  struct Side {
    std::vector<Index> rows, counts;  ///< counts: rows per rank
  };
  void move(std::span<std::byte const> from, Side const& there, std::span<std::byte> to, Side const& here,
            std::size_t row) const;
  Index count_, block_;
  Side scattered_;  ///< rows of this rank
  Side stretch_;    ///< rows of own(), from 0
};

}  // namespace piola
