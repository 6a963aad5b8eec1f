// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/slot_collectives.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/first_failure.hpp"
#include <algorithm>
#include <vector>

namespace piola {

Range even_local_range(Range whole) {
  PIOLA_EXPECTS(whole.first <= whole.last);
  Range const share = even_range_of_rank(whole.last - whole.first, comm::rank(), comm::size());
  return {whole.first + share.first, whole.first + share.last};
}

Range DistributedSlots::of(int rank) const {
  PIOLA_EXPECTS(particles >= 0 && particles <= slots);
  Range const share = even_range_of_rank(slots, rank, comm::size());
  return {std::min(share.first, particles), std::min(share.last, particles)};
}

void DistributedSlots::complete(std::span<double> values, std::size_t width) const {
  PIOLA_EXPECTS(values.size() >= static_cast<std::size_t>(particles) * width);
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < comm::size(); ++rank) starts.push_back(static_cast<std::size_t>(of(rank).last) * width);
  comm::allgather(values.first(starts.back()), starts);
}

namespace {

void complete(double* data, std::ptrdiff_t size, Partition const& body) {
  if (!comm::is_parallel()) return;
  Index const first = body.whole().first;
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < comm::size(); ++rank)
    starts.push_back(static_cast<std::size_t>(body.of(rank).last - first) * static_cast<std::size_t>(size));
  comm::allgather({data + first * size, starts.back()}, starts);
}

}  // namespace

void allgather_slots(double* data, std::ptrdiff_t size, Range whole) {
  PIOLA_EXPECTS(size >= 0 && (data != nullptr || whole.first == whole.last));
  complete(data, size, Partition(whole));
}

std::vector<double> allgather_slots(std::span<SlotArray const> arrays, std::span<double const> said) {
  if (!comm::is_parallel()) return {said.begin(), said.end()};
  // f(values of this rank's slots of an array, how many), array after array.
  auto const each = [&](int rank, auto const& f) {
    for (SlotArray const& array : arrays) {
      Range const part = Partition(array.whole).of(rank);
      f(array.data + part.first * array.size, (part.last - part.first) * array.size);
    }
  };
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < comm::size(); ++rank) {
    std::size_t count = said.size();
    each(rank, [&](double const*, std::ptrdiff_t numbers) { count += static_cast<std::size_t>(numbers); });
    starts.push_back(starts.back() + count);
  }
  static std::vector<double> values;  // kept, because large ones come from the system, page by page, each time
  values.resize(starts.back());
  auto const own = static_cast<std::size_t>(comm::rank());
  auto to = std::copy(said.begin(), said.end(), values.begin() + static_cast<std::ptrdiff_t>(starts[own]));
  each(comm::rank(), [&](double const* of, std::ptrdiff_t numbers) { to = std::copy_n(of, numbers, to); });
  comm::allgather(values, starts);
  std::vector<double> of_all;
  for (int rank = 0; rank < comm::size(); ++rank) {
    auto from = values.cbegin() + static_cast<std::ptrdiff_t>(starts[static_cast<std::size_t>(rank)]);
    of_all.insert(of_all.end(), from, from + static_cast<std::ptrdiff_t>(said.size()));
    from += static_cast<std::ptrdiff_t>(said.size());
    if (rank == comm::rank()) continue;
    each(rank, [&](double* into, std::ptrdiff_t numbers) {
      std::copy_n(from, numbers, into);
      from += numbers;
    });
  }
  return of_all;
}

void allgather_selected_slots(FieldRef const& field, Range own, std::span<Index const> slots, int components) {
  PIOLA_EXPECTS(own.first <= own.last && components > 0);
  if (!comm::is_parallel()) return;
  std::vector<double> values;
  for (Index const i : slots)
    for (int c = 0; c < components; ++c) values.push_back(i >= own.first && i < own.last ? value_at(field, i, c) : 0);
  comm::allreduce_or(values);
  auto from = values.begin();
  for (Index const i : slots)
    for (int c = 0; c < components; ++c) value_at(field, i, c) = *from++;
}

void allreduce_first_failure(FailureSlot& slot) {
  FirstFailure first(slot);
  comm::allreduce_sum(first);
  first.put(slot);
}

}  // namespace piola
