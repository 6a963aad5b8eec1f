// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

namespace piola {

/// A table of which each rank has some rows, and all ranks together have each once.
struct RowsOfRanks {
  std::int64_t set = 0;  ///< tables whose rows are dealt out alike have the same number
  Index count = 0;       ///< of all ranks
  /// Of the rows of this rank, from 0 to count - 1; nothing: it has all of them, in order.
  std::optional<std::span<Index const>> places = {};
  int columns = 1;
};

inline std::size_t numbers_of(RowsOfRanks const& rows) {
  return static_cast<std::size_t>(rows.count) * static_cast<std::size_t>(rows.columns);
}

/// The way of the rows of a table, wherever they are, to the ranks that read or write them: those have a stretch of the
/// whole each, of so many blocks of rows; a table of one block is that of rank 0.
class RowPlan {
 public:
  /// Collective.
  RowPlan(RowsOfRanks const& rows, Index block);
  /// Rows that a rank reads or writes.
  Range of(int rank) const;
  Range own() const;
  /// `values`: of each row of this rank so many. Those of the rows of own(), in order. Collective.
  template <class T>
  std::vector<T> collect(std::span<T const> values, int columns) const {
    static_assert(std::is_trivially_copyable_v<T>, "it travels as bytes");
    auto const width = static_cast<std::size_t>(columns);
    std::vector<T> whole(static_cast<std::size_t>(own().last - own().first) * width);
    move(std::as_bytes(values), scattered_, std::as_writable_bytes(std::span(whole)), stretch_, sizeof(T) * width);
    return whole;
  }
  /// The way back. Collective.
  template <class T>
  void hand_out(std::span<T const> whole, std::span<T> values, int columns) const {
    move(std::as_bytes(whole), stretch_, std::as_writable_bytes(values), scattered_,
         sizeof(T) * static_cast<std::size_t>(columns));
  }

 private:
  /// Rows in the order in which they go to, or come from, rank 0, rank 1, and so on.
  struct Side {
    std::vector<Index> rows, counts;  ///< counts: per rank
  };
  void move(std::span<std::byte const> from, Side const& there, std::span<std::byte> to, Side const& here,
            std::size_t row) const;
  Index count_, block_;
  Side scattered_;  ///< rows of this rank
  Side stretch_;    ///< rows of own(), from 0
};

}  // namespace piola
