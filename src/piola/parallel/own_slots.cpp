// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/own_slots.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/parallel/first_failure.hpp"
#include "piola/parallel/halo_plan.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>
#include <cstdint>
#include <vector>

namespace piola {

Range part_of(Range whole, int rank) {
  Range const share = share_of(whole.last - whole.first, rank, ranks::count());
  return {whole.first + share.first, whole.first + share.last};
}

Range own_part(Range whole) { return part_of(whole, ranks::own()); }

Range SharedSlots::of(int rank) const {
  Range const share = share_of(slots, rank, ranks::count());
  return {std::min(share.first, particles), std::min(share.last, particles)};
}

void SharedSlots::complete(std::span<double> values, std::size_t width) const {
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < ranks::count(); ++rank) starts.push_back(static_cast<std::size_t>(of(rank).last) * width);
  ranks::complete(values.first(starts.back()), starts);
}

void complete_slots(double* data, std::ptrdiff_t size, Range whole) {
  if (!ranks::several()) return;
  std::vector<std::size_t> starts{0};
  for (int rank = 0; rank < ranks::count(); ++rank)
    starts.push_back(static_cast<std::size_t>(part_of(whole, rank).last - whole.first) *
                     static_cast<std::size_t>(size));
  ranks::complete({data + whole.first * size, starts.back()}, starts);
}

void complete_slots(FieldRef const& field, int components, Range whole) {
  PIOLA_EXPECTS(field.particle_stride == 1 && field.tile_extra == 0);
  for (int c = 0; c < components; ++c) complete_slots(field.data + c * field.component_stride, 1, whole);
}

void complete_slots(std::span<FieldPart const> parts, SlotsOfRanks const& some) {
  if (!ranks::several() || some.slots.empty()) return;
  std::size_t width = 0;
  for (FieldPart const& part : parts) width += static_cast<std::size_t>(part.count);
  static std::vector<double> values;  // kept, because large ones come from the system, page by page, each time
  values.resize(width * some.slots.size());
  // f(value in the message, value in its field) of the slots k in [first, last).
  auto const each = [&](std::size_t first, std::size_t last, auto const& f) {
    exec_host::for_each_in_set_up(static_cast<Index>(last - first), [&](Index k) {
      std::size_t const place = first + static_cast<std::size_t>(k);
      double* value = &values[place * width];
      for (FieldPart const& part : parts)
        for (int c = 0; c < part.count; ++c) f(*value++, value_at(part.field, some.slots[place], part.first + c));
    });
  };
  auto const own = static_cast<std::size_t>(ranks::own());
  each(some.starts[own], some.starts[own + 1], [](double& told, double& here) { told = here; });
  std::vector<std::size_t> starts = some.starts;
  for (std::size_t& start : starts) start *= width;
  ranks::complete(values, starts);
  auto const take = [](double& told, double& here) { here = told; };
  each(0, some.starts[own], take);
  each(some.starts[own + 1], some.slots.size(), take);
}

void gather_slots(FieldRef const& field, Range own, int components) {
  auto const n = static_cast<std::size_t>(components);
  std::vector<double> values(static_cast<std::size_t>(own.last - own.first) * n);
  exec_host::for_each_in_set_up(own.last - own.first, [&](Index k) {
    for (std::size_t c = 0; c < n; ++c)
      values[static_cast<std::size_t>(k) * n + c] = value_at(field, own.first + k, static_cast<int>(c));
  });
  std::vector<double> const all = ranks::gather(values);
  exec_host::for_each_in_set_up(static_cast<Index>(all.size() / n), [&](Index i) {
    for (std::size_t c = 0; c < n; ++c)
      value_at(field, i, static_cast<int>(c)) = all[static_cast<std::size_t>(i) * n + c];
  });
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
