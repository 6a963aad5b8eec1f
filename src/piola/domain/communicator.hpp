// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/base/errors.hpp"
#include "piola/math/lanes.hpp"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// Communication between the MPI processes (ranks) of a run. A build without MPI (PIOLA_MPI), or a start without an MPI
/// launcher, has one rank. All functions except start(), rank(), size(), traffic() and abort_all() are collective: all
/// ranks call them in the same order, outside parallel loops. MPI counts are ints, so a message holds at most 2^31
/// values.
namespace piola::comm {

/// Initialises MPI if a launcher (mpirun, srun) started this process as one of several.
void start();
/// Finalises MPI. No function of this namespace may be called afterwards.
void finish();

int rank();  ///< rank of this process, 0 to size() - 1
int size();  ///< number of ranks; 1: serial
inline bool is_parallel() { return size() > 1; }

/// Combines `other` into `mine`. Must be associative and commutative to the bit.
using Combine = void (*)(void const* other, void* mine);

/// Allreduce of `count` items of `bytes` bytes each by `combine`.
void allreduce_bytes(void* items, std::size_t count, std::size_t bytes, Combine combine);
template <class T>
void allreduce(std::span<T> items, Combine how) {
  static_assert(std::is_trivially_copyable_v<T>, "it travels as bytes");
  if (is_parallel() && !items.empty()) allreduce_bytes(items.data(), items.size(), sizeof(T), how);
}
template <class T>
void allreduce(T& item, Combine how) {
  allreduce(std::span<T>(&item, 1), how);
}
/// Allreduce by the member `void add(T const&)`, e.g. of exact sums.
template <class T>
void allreduce_sum(std::span<T> sums) {
  allreduce(sums, [](void const* other, void* mine) { static_cast<T*>(mine)->add(*static_cast<T const*>(other)); });
}
template <class T>
void allreduce_sum(T& sum) {
  allreduce_sum(std::span<T>(&sum, 1));
}
/// Sets `mine` to the larger of both; NaN if one is NaN.
inline void max_or_nan(double other, double& mine) {
  if (std::isnan(other) || other > mine) mine = other;
}
/// Allreduce of the maximum; NaN if one value is NaN.
void allreduce_max(double& value);

/// Allreduce by bitwise or. Each value must be zero in all bits except on the one rank that owns it.
void allreduce_or(std::span<double> values);
/// Gathers the values of all ranks on rank 0, in rank order. Returns an empty vector on other ranks.
std::vector<double> gather(std::span<double const> values);
/// Allgather in place: rank r contributes values[starts[r]] to values[starts[r + 1] - 1].
void allgather(std::span<double> values, std::span<std::size_t const> starts);
/// The items of all ranks, in rank order, of which each passes one.
template <class T>
std::vector<T> allgather_item(T const& own) {
  constexpr std::size_t bytes = sizeof(double), width = sizeof(T) / bytes;
  static_assert(std::is_trivially_copyable_v<T> && width * bytes == sizeof(T), "it travels as numbers");
  auto const ranks = static_cast<std::size_t>(size());
  std::vector<double> numbers(ranks * width);
  std::vector<std::size_t> starts{0};
  while (starts.size() <= ranks) starts.push_back(starts.back() + width);
  std::memcpy(&numbers[static_cast<std::size_t>(rank()) * width], &own, sizeof own);
  allgather(numbers, starts);
  std::vector<T> all(ranks);
  std::memcpy(static_cast<void*>(all.data()), numbers.data(), numbers.size() * bytes);
  return all;
}
/// Broadcasts `bytes` bytes from rank 0 to all ranks.
void broadcast_bytes(void* data, std::size_t bytes);
/// All-to-all: sends to[r] to rank r. Returns the indices received, by sending rank.
std::vector<std::vector<Index>> alltoall(std::vector<std::vector<Index>> const& to);

/// All-to-all of items of `bytes` bytes. `out` holds sent[r] items for each rank r, `in` receives received[r] items of
/// each, both in rank order.
void alltoall_items(void const* out, std::span<Index const> sent, void* in, std::span<Index const> received,
                    std::size_t bytes);

/// Buffer of a message from or to `rank`. Does not own `values`.
struct Message {
  int rank;
  double* values;
  std::size_t count;
};
/// Sends and receives all messages concurrently; returns when all have arrived. Only the ranks named take part.
void exchange(std::span<Message const> receives, std::span<Message const> sends);

/// Sends values.size() values from rank `from` to rank `to` (point to point). Other ranks return at once.
void send_to(int from, int to, std::span<double> values);

/// Messages and bytes that this rank has sent by exchange().
struct Traffic {
  std::int64_t messages = 0, bytes = 0;
};
Traffic traffic();

/// Thrown on all ranks when at least one rank has failed. Carries the message and exit code of the lowest failed rank.
class CollectiveError : public std::runtime_error {
 public:
  explicit CollectiveError(ErrorReport const& trouble) : std::runtime_error(trouble.message), code_(trouble.code) {}
  int code() const { return code_; }

 private:
  int code_;
};
/// Ends all ranks (MPI_Abort). Not collective. Returns only if there is one rank.
void abort_all(int code);

}  // namespace piola::comm
