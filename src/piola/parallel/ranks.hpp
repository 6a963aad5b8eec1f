// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/lanes.hpp"
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

/// The processes (ranks) that share a run, by MPI; one rank where Piola is built without it (PIOLA_MPI) or not started
/// by an MPI launcher. Every function here but start(), own(), count(), traffic() and abort_all() is collective: all
/// ranks call it, in the same order, outside parallel loops. Numbers that an MPI call counts are ints, so no message
/// holds more than 2^31 values.
namespace piola::ranks {

/// Joins the other ranks if a launcher (mpirun, srun) started this process as one of several.
void start();
/// Leaves them; nothing of this may be called afterwards.
void finish();

int own();    ///< 0 to count() - 1; rank 0 is the first, which reads, writes and decides
int count();  ///< 1: nobody else
inline bool several() { return count() > 1; }

/// Adds what `other` is to `mine`. The result must not depend on which is added to which, nor in what order.
using Combine = void (*)(void const* other, void* mine);

/// Combines items of so many bytes over all ranks; all have the result.
void combine_bytes(void* items, std::size_t count, std::size_t bytes, Combine combine);
template <class T>
void combine(std::span<T> items, Combine how) {
  static_assert(std::is_trivially_copyable_v<T>, "it travels as bytes");
  if (several() && !items.empty()) combine_bytes(items.data(), items.size(), sizeof(T), how);
}
template <class T>
void combine(T& item, Combine how) {
  combine(std::span<T>(&item, 1), how);
}
/// The same for what has `void add(T const&)`: exact sums, for example.
template <class T>
void add(std::span<T> sums) {
  combine(sums, [](void const* other, void* mine) { static_cast<T*>(mine)->add(*static_cast<T const*>(other)); });
}
template <class T>
void add(T& sum) {
  add(std::span<T>(&sum, 1));
}
/// The larger of both is mine; not a number if one is.
inline void keep_larger(double other, double& mine) {
  if (std::isnan(other) || other > mine) mine = other;
}
/// The largest of all; not a number if one is.
void take_largest(double& value);

/// Every rank has some of the values and zero (all bits) for the others: afterwards all ranks have all of them.
void merge(std::span<double> values);
/// The values of rank 0, then those of rank 1, and so on; on rank 0 alone, elsewhere nothing.
std::vector<double> gather(std::span<double const> values);
/// Rank r has values[starts[r]] to values[starts[r + 1] - 1]; afterwards all ranks have all of them.
void complete(std::span<double> values, std::span<std::size_t const> starts);
/// What rank 0 has.
void broadcast_bytes(void* data, std::size_t bytes);
/// to[r] goes to rank r; what comes from rank r is in place r.
std::vector<std::vector<Index>> deal(std::vector<std::vector<Index>> const& to);

/// Items of so many bytes, those for rank 0 first, then those for rank 1, and so on, sent[r] of them; they come in the
/// order of the ranks that send them, received[r] of each.
void deal_items(void const* out, std::span<Index const> sent, void* in, std::span<Index const> received,
                std::size_t bytes);

/// A message from or to a rank.
struct Message {
  int rank;
  double* values;
  std::size_t count;
};
/// Sends and receives these at once; returns when all have arrived. Only the ranks that are named take part.
void exchange(std::span<Message const> receives, std::span<Message const> sends);

/// What one rank has goes to another one, which has room for as many values; all others do nothing.
void carry(int from, int to, std::span<double> values);

/// What this rank has sent by exchange().
struct Traffic {
  std::int64_t messages = 0, bytes = 0;
};
Traffic traffic();

/// What ended the work of a rank.
struct Trouble {
  int code = 0;  ///< exit code; 0: there is none
  std::string message;
};
/// What some rank has found out counts for all of them: that of the lowest one.
class Disagreement : public std::runtime_error {
 public:
  explicit Disagreement(Trouble const& trouble) : std::runtime_error(trouble.message), code_(trouble.code) {}
  int code() const { return code_; }

 private:
  int code_;
};
/// All ranks say whether they can go on; of those that cannot, the lowest one's trouble is everybody's.
Trouble agree(Trouble const& own);
/// Ends all ranks from one, without the others' doing. Returns only where there are no others.
void abort_all(int code);

}  // namespace piola::ranks
