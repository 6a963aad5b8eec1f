// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include <optional>

/// Collectives of the run itself; those of loops are in communicator.hpp. Collective except comm_statistics().
namespace piola::comm {

/// Broadcasts `bytes` bytes of rank 0 to all ranks. Uses a communicator of its own, so that a broadcast of commands
/// cannot match any other collective.
void broadcast_command(void* data, std::size_t bytes);
/// Returns whether all ranks pass the same `number`.
bool all_equal(std::uint64_t number);
/// As agree(), with a timeout [s]. Returns nothing if not all ranks have called it by then; the failed rank must then
/// call abort_all().
std::optional<RankError> agree_within(double seconds, RankError const& own);

/// Communication of this rank since the start: number of collectives, wall time in point-to-point exchanges, in
/// collectives and in waiting for commands of rank 0 [s].
struct CommStatistics {
  std::int64_t collectives = 0;
  double in_exchanges = 0, in_collectives = 0, waiting_for_commands = 0;
  std::int64_t replicated_bytes = 0;  ///< replicated on all ranks by allreduce_or() and allgather()
  double processor = 0;               ///< processor time of all these [s]
};
CommStatistics comm_statistics();

}  // namespace piola::comm
