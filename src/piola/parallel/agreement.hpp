// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/parallel/ranks.hpp"
#include <optional>

/// Collectives of the run itself; those of loops are in ranks.hpp. Collective except spent().
namespace piola::ranks {

/// Broadcasts `bytes` bytes of rank 0 to all ranks. Uses a communicator of its own, so that a broadcast of commands
/// cannot match any other collective.
void order_bytes(void* data, std::size_t bytes);
/// Returns whether all ranks pass the same `number`.
bool same(std::uint64_t number);
/// As agree(), with a timeout [s]. Returns nothing if not all ranks have called it by then; the failed rank must then
/// call abort_all().
std::optional<Trouble> agree_within(double seconds, Trouble const& own);

/// Communication of this rank since the start: number of collectives, wall time in point-to-point exchanges, in
/// collectives and in waiting for commands of rank 0 [s].
struct Spent {
  std::int64_t collectives = 0;
  double in_exchanges = 0, in_collectives = 0, for_orders = 0;
  std::int64_t bytes_to_all = 0;  ///< replicated on all ranks by merge() and complete()
  double processor = 0;           ///< processor time of all these [s]
};
Spent spent();

}  // namespace piola::ranks
