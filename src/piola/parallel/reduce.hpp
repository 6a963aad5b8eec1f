// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/exec/parallel.hpp"
#include "piola/parallel/ranks.hpp"

namespace piola::inline PIOLA_MACHINE {

/// exec::add_partials of the n blocks of this rank and of those of all others, if they share them: exact, so that all
/// ranks have the bits of one.
template <int N>
exec::Totals<N> add_over_ranks(bool shared, double const* partial, Index n) {
  if (!shared) return exec::add_partials<N>(partial, n);
  exec::ExactSums<N> sums;
  for (Index k = 0; k < n; ++k) sums.add(partial + static_cast<std::ptrdiff_t>(k) * N);
  ranks::add(sums);
  exec::Totals<N> totals;
  for (int c = 0; c < N; ++c) totals.v[c] = sums.value(c);
  return totals;
}

/// exec::reduce over the particles of all ranks, if they share them.
template <int N, class Pass>
exec::Totals<N> reduce_over_ranks(bool shared, Range r, Pass const& pass, double* partial) {
  if (!shared) return exec::reduce<N>(r, pass, partial);
  exec::for_each_block(r, exec::BlockSums<N, Pass>{pass, partial});
  return add_over_ranks<N>(true, partial, exec::block_count(r));
}

}  // namespace piola::inline PIOLA_MACHINE
