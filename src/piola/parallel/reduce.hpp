// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include "piola/parallel/first_failure.hpp"
#include "piola/parallel/ranks.hpp"

namespace piola::inline PIOLA_MACHINE {

/// What ranks say at one place of a step, in one message: exact sums, and beside them the largest of a value and the
/// first failure.
template <int N>
struct SaidByRanks {
  exec::ExactSums<N> sums;
  double largest = 0;
  FirstFailure first;
  void add(SaidByRanks const& other) {
    sums.add(other.sums);
    ranks::keep_larger(other.largest, largest);
    first.add(other.first);
  }
};

/// What a rank has to say beside sums, and then that of all of them.
struct Beside {
  double* largest = nullptr;       ///< not a number if one is; nullptr: nothing
  FailureSlot* failure = nullptr;  ///< likewise
};

/// exec::add_partials of the n partial sums of this rank and of those of all others, if they share them: exact, so that
/// all ranks have the bits of one.
template <int N>
exec::Totals<N> add_over_ranks(bool shared, double const* partial, Index n, Beside const& beside = {}) {
  if (!shared) return exec::add_partials<N>(partial, n);
  SaidByRanks<N> said;
  said.sums = exec::sum_of_partials<N>(partial, n);
  if (beside.largest != nullptr) said.largest = *beside.largest;
  if (beside.failure != nullptr) said.first = FirstFailure(*beside.failure);
  ranks::add(said);
  if (beside.largest != nullptr) *beside.largest = said.largest;
  if (beside.failure != nullptr) said.first.put(*beside.failure);
  exec::Totals<N> totals;
  for (int c = 0; c < N; ++c) totals.v[c] = said.sums.value(c);
  return totals;
}

/// exec::reduce over the particles of all ranks, if they share them.
template <int N, class Pass>
exec::Totals<N> reduce_over_ranks(bool shared, Range r, Pass const& pass, double* partial, Beside const& beside = {}) {
  if (!shared) return exec::reduce<N>(r, pass, partial);
  exec::for_each_block(r, exec::LeafSums<N, Pass>{pass, partial});
  return add_over_ranks<N>(true, partial, exec::leaf_count(r), beside);
}

}  // namespace piola::inline PIOLA_MACHINE
