// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/own_slots.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/parallel/first_failure.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>
#include <cstdint>
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

void complete_slots(FieldRef const& field, int components, Shares const& body) {
  PIOLA_EXPECTS(field.particle_stride == 1 && field.tile_extra == 0);
  for (int c = 0; c < components; ++c) complete(field.data + c * field.component_stride, 1, body);
}

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

namespace {

/// Values of a slot in the message.
std::size_t width_of(ToldToAll const& told) {
  std::size_t width = 0;
  for (FieldPart const& part : told.parts) width += static_cast<std::size_t>(part.count);
  return width;
}

/// f(value in the message, value in its field) of what a rank tells, whose values begin at `values`.
template <class F>
void each_told(std::span<ToldToAll const> all, std::size_t rank, double* values, F const& f) {
  for (ToldToAll const& told : all) {
    std::size_t const width = width_of(told), first = told.some->starts[rank];
    auto const count = static_cast<Index>(told.some->starts[rank + 1] - first);
    exec_host::for_each_in_set_up(count, [&](Index k) {
      double* value = values + static_cast<std::size_t>(k) * width;
      Index const slot = told.some->slots[first + static_cast<std::size_t>(k)];
      for (FieldPart const& part : told.parts)
        for (int c = 0; c < part.count; ++c) f(*value++, value_at(part.field, slot, part.first + c));
    });
    values += static_cast<std::size_t>(count) * width;
  }
}

}  // namespace

void complete_slots(std::span<ToldToAll const> all) {
  if (!ranks::several()) return;
  auto const count = static_cast<std::size_t>(ranks::count());
  std::vector<std::size_t> starts(count + 1, 0);
  for (ToldToAll const& told : all)
    for (std::size_t r = 0; r <= count; ++r) starts[r] += told.some->starts[r] * width_of(told);
  if (starts.back() == 0) return;
  static std::vector<double> values;  // kept, because large ones come from the system, page by page, each time
  values.resize(starts.back());
  auto const own = static_cast<std::size_t>(ranks::own());
  each_told(all, own, values.data() + starts[own], [](double& told, double& here) { told = here; });
  ranks::complete(values, starts);
  for (std::size_t r = 0; r < count; ++r)
    if (r != own) each_told(all, r, values.data() + starts[r], [](double& told, double& here) { here = told; });
}

FailuresOfRanks::FailuresOfRanks(FailureSlot const& own) : said_(each_.slots.size()) {
  FirstFailure const first(own);
  said_[static_cast<std::size_t>(ranks::own())] = {static_cast<double>(first.id), static_cast<double>(first.index),
                                                   static_cast<double>(first.code)};
}

ToldToAll FailuresOfRanks::told() {
  constexpr int size = std::tuple_size_v<Said>;
  FieldRef const values{.data = said_.front().data(), .component_stride = 1, .particle_stride = size};
  return {{{values, 0, size}}, &each_};
}

void FailuresOfRanks::put(FailureSlot& slot) const {
  double lowest = static_cast<double>(FirstFailure().id);
  for (auto const& [id, index, code] : said_) {
    if (!(id < lowest)) continue;
    lowest = id;
    slot.index = static_cast<Index>(index);
    slot.code = static_cast<int>(code);
  }
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
