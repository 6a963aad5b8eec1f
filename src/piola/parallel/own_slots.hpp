// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/field.hpp"
#include "piola/exec/parallel.hpp"
#include "piola/parallel/ranks.hpp"
#include "piola/parallel/shares.hpp"
#include <algorithm>
#include <array>
#include <bit>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

/// A body of which every rank has all slots, in the same order, and works on some of them: what the ranks have to tell
/// each other besides halos. Every function but own_part() is collective, and none does anything on one rank.
namespace piola {

/// The part of a range that this rank works on where all have equal ones.
Range own_part(Range whole);

/// Of values per slot, `size` of slot i at data[i * size], that each rank has right in its own part of a range: all
/// ranks have all of them.
void complete_slots(double* data, std::ptrdiff_t size, Range whole);

/// `size` values per slot, of slot i at data[i * size], of the slots of a range.
struct SlotArray {
  double* data;
  std::ptrdiff_t size;
  Range whole;
};
/// The same of several arrays, in one message; what each rank says besides goes with it, and comes back as that of rank
/// 0, that of rank 1, and so on.
std::vector<double> complete_slots(std::span<SlotArray const> arrays, std::span<double const> said = {});

/// The same of what has `void add(T const&)`, exact sums for example: afterwards `sum` is that of all ranks.
template <class T>
void complete_slots_and_add(std::span<SlotArray const> arrays, T& sum) {
  using Numbers = std::array<double, sizeof(T) / 8>;
  static_assert(std::is_trivially_copyable_v<T> && sizeof(Numbers) == sizeof(T), "it travels as numbers");
  if (!ranks::several()) return;
  Numbers said = std::bit_cast<Numbers>(sum);
  std::vector<double> const all = complete_slots(arrays, said);
  for (std::size_t first = 0; first < all.size(); first += said.size()) {
    std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(first), said.size(), said.begin());
    if (first == 0)
      sum = std::bit_cast<T>(said);
    else
      sum.add(std::bit_cast<T>(said));
  }
}

/// A body of which each rank has a share of the slots, as share_of() has it; the first `particles` of all slots hold
/// one.
struct SharedSlots {
  Index slots, particles;
  /// Slots of particles that a rank has.
  Range of(int rank) const;
  Range own() const { return of(ranks::own()); }
  /// Of values per slot, `width` of each, that each rank has right in its own part: all ranks have those of all
  /// particles. Collective.
  void complete(std::span<double> values, std::size_t width) const;
  /// `values`: of each slot of this rank `width` of them. take(range, values) on rank 0 for one rank after the other,
  /// so that it never has more than a share of them besides its own.
  template <class F>
  void collect(std::size_t width, std::vector<double> values, F const& take) const {
    for (int rank = 0; rank < ranks::count(); ++rank) {
      Range const part = of(rank);
      if (ranks::own() == 0 && rank > 0) values.resize(static_cast<std::size_t>(part.last - part.first) * width);
      if (rank > 0) ranks::carry(rank, 0, values);
      if (ranks::own() == 0) take(part, values);
    }
  }
  /// The other way: give(range, values) on rank 0; each rank has those of its own slots.
  template <class F>
  std::vector<double> deal(std::size_t width, F const& give) const {
    std::vector<double> mine;
    for (int rank = ranks::count() - 1; rank >= 0; --rank) {
      if (ranks::own() != 0 && ranks::own() != rank) continue;
      Range const part = of(rank);
      mine.resize(static_cast<std::size_t>(part.last - part.first) * width);
      if (ranks::own() == 0) give(part, std::span<double>(mine));
      if (rank > 0) ranks::carry(0, rank, mine);
    }
    return mine;
  }
};

/// Of a field that each rank has right in its own slots: these slots, which all ranks name in the same order, are right
/// on all of them. For few slots: all ranks have a message as long as the list.
void merge_slots(FieldRef const& field, Range own, std::span<Index const> slots, int components);

/// The first failure that some rank has recorded is everybody's.
void share_failure(FailureSlot& slot);

}  // namespace piola
