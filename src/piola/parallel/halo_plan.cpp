// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/halo_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>

namespace piola {
namespace {

/// f(value in the message, slot, component) for all that one message has of a field.
template <class F>
void each_value(std::vector<Index> const& slots, int first, int count, std::size_t start, F const& f) {
  exec_host::for_each_in_set_up(static_cast<Index>(slots.size()), [&](Index k) {
    std::size_t const at = start + static_cast<std::size_t>(k) * static_cast<std::size_t>(count);
    for (int c = 0; c < count; ++c) f(at + static_cast<std::size_t>(c), slots[static_cast<std::size_t>(k)], first + c);
  });
}

}  // namespace

Range share_of(Index slots, int rank, int ranks) {
  std::int64_t const blocks = (std::int64_t{slots} + exec::block_size - 1) / exec::block_size;
  auto const start = [&](int r) {
    return static_cast<Index>(std::min<std::int64_t>(slots, blocks * r / ranks * exec::block_size));
  };
  return {start(rank), start(rank + 1)};
}

HaloPlan::HaloPlan(Index slots, std::vector<Index> read) {
  std::sort(read.begin(), read.end());
  read.erase(std::unique(read.begin(), read.end()), read.end());
  std::vector<std::vector<Index>> wanted(static_cast<std::size_t>(ranks::count()));
  for (int r = 0; r < ranks::count(); ++r) {
    Range const owned = share_of(slots, r, ranks::count());
    if (r != ranks::own())
      wanted[static_cast<std::size_t>(r)].assign(std::lower_bound(read.begin(), read.end(), owned.first),
                                                 std::lower_bound(read.begin(), read.end(), owned.last));
  }
  auto const asked = ranks::deal(wanted);
  for (int r = 0; r < ranks::count(); ++r) {
    auto const k = static_cast<std::size_t>(r);
    if (r == ranks::own()) continue;
    if (!wanted[k].empty()) receives_.push_back({r, wanted[k], {}});
    if (!asked[k].empty()) sends_.push_back({r, asked[k], {}});
  }
}

void HaloPlan::add(FieldRef const& field, int first, int count) {
  if (field.data != nullptr) values_.push_back({field.data, first, count});
}

void HaloPlan::exchange(FieldRef const& field) {
  std::size_t per_particle = 0;
  bool known = false;
  for (Values const& v : values_) {
    if (v.data != field.data) continue;
    known = true;
    per_particle += static_cast<std::size_t>(v.count);
  }
  PIOLA_EXPECTS(known);
  if (per_particle == 0) return;
  auto const each_run = [&](Side const& side, auto const& f) {
    std::size_t start = 0;
    for (Values const& v : values_) {
      if (v.data != field.data) continue;
      each_value(side.slots, v.first, v.count, start, f);
      start += side.slots.size() * static_cast<std::size_t>(v.count);
    }
  };
  std::vector<ranks::Message> in, out;
  for (Side& side : receives_) {
    side.values.resize(side.slots.size() * per_particle);
    in.push_back({side.rank, side.values.data(), side.values.size()});
  }
  for (Side& side : sends_) {
    side.values.resize(side.slots.size() * per_particle);
    each_run(side, [&](std::size_t at, Index i, int c) { side.values[at] = value_at(field, i, c); });
    out.push_back({side.rank, side.values.data(), side.values.size()});
  }
  ranks::exchange(in, out);
  for (Side const& side : receives_)
    each_run(side, [&](std::size_t at, Index i, int c) { value_at(field, i, c) = side.values[at]; });
}

Index HaloPlan::received() const {
  Index n = 0;
  for (Side const& side : receives_) n += static_cast<Index>(side.slots.size());
  return n;
}

std::size_t HaloPlan::bytes() const {
  std::size_t n = 0;
  for (auto const* sides : {&sends_, &receives_})
    for (Side const& side : *sides) n += side.slots.size() * sizeof(Index) + side.values.capacity() * sizeof(double);
  return n;
}

void exchange(HaloPlan& plan, FieldRef const& field) { plan.exchange(field); }

}  // namespace piola
