// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/domain/communicator.hpp"
#include <functional>
#include <optional>

/// Collectives of the run itself; those of loops are in communicator.hpp. Collective except comm_statistics().
namespace piola::comm {

/// Calls f() on each rank. If f() throws on a rank, all ranks throw CollectiveError with the message of the lowest such
/// rank. All ranks must complete the collectives of f() whether it throws or not. On one rank: f() alone.
void agree_after(std::function<void()> const& f);
/// Calls f() on rank 0 only. If it throws, all ranks throw CollectiveError; on one rank the error itself.
void on_root(std::function<void()> const& f);
/// The value that rank 0 passes, on all ranks.
template <class T>
T of_root(T value) {
  static_assert(std::is_trivially_copyable_v<T>, "it travels as bytes");
  broadcast_bytes(&value, sizeof value);
  return value;
}

/// Sends flags of rank 0 to all ranks with the next allreduce() of one item, without a message of their own. Other
/// ranks pass 0. Precondition: there are several ranks.
void send_flags(unsigned own);
/// The flags of rank 0. If no allreduce() has carried them, they travel now.
unsigned received_flags();

/// Returns whether all ranks pass the same `number`.
bool all_equal(std::uint64_t number);
/// Returns the error of the lowest rank that reports one (code != 0), on all ranks; code 0 if none does.
ErrorReport agree(ErrorReport const& own);
/// As agree(), with a timeout [s]. Returns nothing if not all ranks have called it by then; the failed rank must then
/// call abort_all().
std::optional<ErrorReport> agree_within(double seconds, ErrorReport const& own);

/// Communication of this rank since the start: number of collectives, wall time in point-to-point exchanges and in
/// collectives [s].
struct CommStatistics {
  std::int64_t collectives = 0;
  double in_exchanges = 0, in_collectives = 0;
  std::int64_t replicated_bytes = 0;  ///< replicated on all ranks by allreduce_or() and allgather()
  double processor = 0;               ///< processor time of all these [s]
};
CommStatistics comm_statistics();

}  // namespace piola::comm
