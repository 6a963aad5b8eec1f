// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/own_slots.hpp"
#include "piola/parallel/first_failure.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>
#include <vector>

namespace piola {

Range own_part(Range whole) {
  Range const share = share_of(whole.last - whole.first, ranks::own(), ranks::count());
  return {whole.first + share.first, whole.first + share.last};
}

Range SharedSlots::of(int rank) const {
  Range const share = share_of(slots, rank, ranks::count());
  return {std::min(share.first, particles), std::min(share.last, particles)};
}

void SharedSlots::complete(std::span<double> values, std::size_t width) const {
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < ranks::count(); ++rank) starts.push_back(static_cast<std::size_t>(of(rank).last) * width);
  ranks::complete(values.first(starts.back()), starts);
}

namespace {

void complete(double* data, std::ptrdiff_t size, Shares const& body) {
  if (!ranks::several()) return;
  Index const first = body.whole().first;
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < ranks::count(); ++rank)
    starts.push_back(static_cast<std::size_t>(body.of(rank).last - first) * static_cast<std::size_t>(size));
  ranks::complete({data + first * size, starts.back()}, starts);
}

}  // namespace

void complete_slots(double* data, std::ptrdiff_t size, Range whole) { complete(data, size, Shares(whole)); }

std::vector<double> complete_slots(std::span<SlotArray const> arrays, std::span<double const> said) {
  if (!ranks::several()) return {said.begin(), said.end()};
  // f(values of this rank's slots of an array, how many), array after array.
  auto const each = [&](int rank, auto const& f) {
    for (SlotArray const& array : arrays) {
      Range const part = Shares(array.whole).of(rank);
      f(array.data + part.first * array.size, (part.last - part.first) * array.size);
    }
  };
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < ranks::count(); ++rank) {
    std::size_t count = said.size();
    each(rank, [&](double const*, std::ptrdiff_t numbers) { count += static_cast<std::size_t>(numbers); });
    starts.push_back(starts.back() + count);
  }
  static std::vector<double> values;  // kept, because large ones come from the system, page by page, each time
  values.resize(starts.back());
  auto const own = static_cast<std::size_t>(ranks::own());
  auto to = std::copy(said.begin(), said.end(), values.begin() + static_cast<std::ptrdiff_t>(starts[own]));
  each(ranks::own(), [&](double const* of, std::ptrdiff_t numbers) { to = std::copy_n(of, numbers, to); });
  ranks::complete(values, starts);
  std::vector<double> of_all;
  for (int rank = 0; rank < ranks::count(); ++rank) {
    auto from = values.cbegin() + static_cast<std::ptrdiff_t>(starts[static_cast<std::size_t>(rank)]);
    of_all.insert(of_all.end(), from, from + static_cast<std::ptrdiff_t>(said.size()));
    from += static_cast<std::ptrdiff_t>(said.size());
    if (rank == ranks::own()) continue;
    each(rank, [&](double* into, std::ptrdiff_t numbers) {
      std::copy_n(from, numbers, into);
      from += numbers;
    });
  }
  return of_all;
}

void merge_slots(FieldRef const& field, Range own, std::span<Index const> slots, int components) {
  if (!ranks::several()) return;
  std::vector<double> values;
  for (Index const i : slots)
    for (int c = 0; c < components; ++c) values.push_back(i >= own.first && i < own.last ? value_at(field, i, c) : 0);
  ranks::merge(values);
  auto from = values.begin();
  for (Index const i : slots)
    for (int c = 0; c < components; ++c) value_at(field, i, c) = *from++;
}

void share_failure(FailureSlot& slot) {
  FirstFailure first(slot);
  ranks::add(first);
  first.put(slot);
}

}  // namespace piola
