// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/halo_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/parallel/ranks.hpp"
#include <algorithm>

namespace piola {
namespace {

/// Slots one after the other, in pieces that threads share.
std::vector<SlotRun> runs_of(std::vector<Index> const& slots) {
  constexpr Index longest = 512;
  std::vector<SlotRun> runs;
  for (Index k = 0; k < static_cast<Index>(slots.size()); ++k) {
    Index const slot = slots[static_cast<std::size_t>(k)];
    if (runs.empty() || runs.back().first + runs.back().count != slot || runs.back().count == longest)
      runs.push_back({slot, 0, k});
    runs.back().count += 1;
  }
  return runs;
}

/// Some values of a field, for the slots of a message; the message has them from `values` on.
struct Copied {
  FieldRef const& field;
  int first, count;
  std::vector<SlotRun> const& runs;
  Index slots;
  double* values;
};

/// Between a field and a message: component after component where particles lie one after the other in memory, so that
/// runs of slots are copied as they are; else particle after particle, as records lie.
template <bool Out>
void copy_values(Copied const& c) {
  FieldRef const& f = c.field;
  bool const rows = f.particle_stride == 1 && f.tile_extra == 0;
  exec_host::for_each_part_in_set_up(static_cast<Index>(c.runs.size()), c.slots * c.count, [&](Index number) {
    SlotRun const& run = c.runs[static_cast<std::size_t>(number)];
    auto const copy = [](double* from, double* to, std::ptrdiff_t n) { std::copy(from, from + n, to); };
    for (int k = 0; rows && k < c.count; ++k) {
      double* const at = f.data + (c.first + k) * f.component_stride + run.first;
      double* const in_message = c.values + static_cast<std::ptrdiff_t>(k) * c.slots + run.place;
      Out ? copy(at, in_message, run.count) : copy(in_message, at, run.count);
    }
    for (Index i = 0; !rows && i < run.count; ++i)
      for (int k = 0; k < c.count; ++k) {
        double& at = value_at(f, run.first + i, c.first + k);
        double& in_message = c.values[static_cast<std::ptrdiff_t>(run.place + i) * c.count + k];
        Out ? in_message = at : at = in_message;
      }
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
  auto const side_of = [](int rank, std::vector<Index> const& some) {
    return Side{rank, static_cast<Index>(some.size()), runs_of(some), {}};
  };
  for (int r = 0; r < ranks::count(); ++r) {
    auto const k = static_cast<std::size_t>(r);
    if (r == ranks::own()) continue;
    if (!wanted[k].empty()) receives_.push_back(side_of(r, wanted[k]));
    if (!asked[k].empty()) sends_.push_back(side_of(r, asked[k]));
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
  auto const each_run = [&](Side& side, auto const& copy) {
    double* start = side.values.data();
    for (Values const& v : values_) {
      if (v.data != field.data) continue;
      copy(Copied{field, v.first, v.count, side.runs, side.slots, start});
      start += static_cast<std::ptrdiff_t>(side.slots) * v.count;
    }
  };
  std::vector<ranks::Message> in, out;
  auto const message_of = [&](Side& side) {
    side.values.resize(static_cast<std::size_t>(side.slots) * per_particle);
    return ranks::Message{side.rank, side.values.data(), side.values.size()};
  };
  for (Side& side : receives_) in.push_back(message_of(side));
  for (Side& side : sends_) {
    out.push_back(message_of(side));
    each_run(side, copy_values<true>);
  }
  ranks::exchange(in, out);
  for (Side& side : receives_) each_run(side, copy_values<false>);
}

Index HaloPlan::received() const {
  Index n = 0;
  for (Side const& side : receives_) n += side.slots;
  return n;
}

std::size_t HaloPlan::bytes() const {
  std::size_t n = 0;
  for (auto const* sides : {&sends_, &receives_})
    for (Side const& side : *sides) n += side.runs.size() * sizeof(SlotRun) + side.values.capacity() * sizeof(double);
  return n;
}

void exchange(HaloPlan& plan, FieldRef const& field) { plan.exchange(field); }

}  // namespace piola
