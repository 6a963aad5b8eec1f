// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/parallel/ranks.hpp"
#include <optional>

/// What the run itself needs of ranks, beside what loops need (ranks.hpp). Collective but for spent().
namespace piola::ranks {

/// What rank 0 has, on a way of its own, so that nobody who waits for anything else takes it for that.
void order_bytes(void* data, std::size_t bytes);
/// Whether all ranks have the same number.
bool same(std::uint64_t number);
/// agree() of a rank that has trouble while others may be elsewhere, waiting for it: nothing, if they have not all come
/// within so long [s].
std::optional<Trouble> agree_within(double seconds, Trouble const& own);

/// How many times this rank combined, merged or was told something with all others, and its wall time in exchanges, in
/// these, and in waiting for orders [s].
struct Spent {
  std::int64_t collectives = 0;
  double in_exchanges = 0, in_collectives = 0, for_orders = 0;
  std::int64_t bytes_to_all = 0;  ///< that all ranks were told by merge() and complete()
  double processor = 0;           ///< processor time of all these [s]
};
Spent spent();

}  // namespace piola::ranks
