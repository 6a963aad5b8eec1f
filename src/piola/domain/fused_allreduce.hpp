// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include "piola/domain/first_failure.hpp"
#include "piola/exec/device_loops.hpp"

namespace piola::inline PIOLA_BACKEND {

/// Payload of one allreduce: N reproducible sums, one maximum and the first failure.
template <int N>
struct ReductionPayload {
  exec::ReproducibleSums<N> sums;
  double largest = 0;
  FirstFailure first;
  void add(ReductionPayload const& other) {
    sums.add(other.sums);
    comm::max_or_nan(other.largest, largest);
    first.add(other.first);
  }
};

/// Values that are reduced in the same message as the sums: in, the local ones; out, the global ones.
struct FusedReductions {
  double* largest = nullptr;       ///< maximum, NaN if one value is NaN; nullptr: not reduced
  FailureSlot* failure = nullptr;  ///< failure at the lowest id; nullptr: not reduced
};

/// exec::add_partials of the n partial sums of this rank, over all ranks if `shared`. The sums are reproducible: their
/// bits do not depend on the number of ranks. Collective if `shared`.
template <int N>
exec::Totals<N> allreduce_partial_sums(bool shared, double const* partial, Index n,
                                       FusedReductions const& beside = {}) {
  if (!shared) return exec::add_partials<N>(partial, n);
  ReductionPayload<N> said;
  said.sums = exec::sum_of_partials<N>(partial, n);
  if (beside.largest != nullptr) said.largest = *beside.largest;
  if (beside.failure != nullptr) said.first = FirstFailure(*beside.failure);
  comm::allreduce_sum(said);
  if (beside.largest != nullptr) *beside.largest = said.largest;
  if (beside.failure != nullptr) said.first.put(*beside.failure);
  exec::Totals<N> totals;
  for (int c = 0; c < N; ++c) totals.v[c] = said.sums.value(c);
  return totals;
}

/// exec::reduce over the particles of this rank, or of all ranks if `shared` (then collective).
template <int N, class Pass>
exec::Totals<N> reduce_over_ranks(bool shared, Range r, Pass const& pass, double* partial,
                                  FusedReductions const& beside = {}) {
  if (!shared) return exec::reduce<N>(r, pass, partial);
  exec::for_each_block(r, exec::LeafSums<N, Pass>{pass, partial});
  return allreduce_partial_sums<N>(true, partial, exec::leaf_count(r), beside);
}

}  // namespace piola::inline PIOLA_BACKEND
