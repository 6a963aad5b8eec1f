// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/halo_plan.hpp"
#include "piola/base/contracts.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>

namespace piola {
namespace {

/// Splits slots into contiguous runs of at most `longest` slots, the unit of work of a thread.
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

/// Some components of a field for the slots of a message; `values` points to their place in the message.
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
  exec_host::parallel_for_chunks(static_cast<Index>(c.runs.size()), c.slots * c.count, [&](Index number) {
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

HaloPlan::HaloPlan(Partition cut, std::vector<Index> read) : cut_(std::move(cut)) { add_cutoff(std::move(read)); }

int HaloPlan::add_cutoff(std::vector<Index> read) {
  std::sort(read.begin(), read.end());
  read.erase(std::unique(read.begin(), read.end()), read.end());
  std::vector<std::vector<Index>> wanted(static_cast<std::size_t>(comm::size()));
  for (int r = 0; r < comm::size(); ++r) {
    Range const owned = cut_.of(r);
    if (r != comm::rank())
      wanted[static_cast<std::size_t>(r)].assign(std::lower_bound(read.begin(), read.end(), owned.first),
                                                 std::lower_bound(read.begin(), read.end(), owned.last));
  }
  auto const asked = comm::alltoall(wanted);
  std::vector<Index> received;
  for (int r = 0; r < comm::size(); ++r) {
    auto const k = static_cast<std::size_t>(r);
    if (r == comm::rank()) continue;
    add_side(receives_, r, reaches_, wanted[k]);
    add_side(sends_, r, reaches_, asked[k]);
    received.insert(received.end(), wanted[k].begin(), wanted[k].end());
  }
  std::vector<Index> const before = std::move(received_);
  received_.clear();
  std::set_union(before.begin(), before.end(), received.begin(), received.end(), std::back_inserter(received_));
  return reaches_++;
}

void HaloPlan::add_side(std::vector<Side>& sides, int rank, int reach, std::vector<Index> const& slots) {
  if (slots.empty()) return;
  auto side = std::lower_bound(sides.begin(), sides.end(), rank, [](Side const& s, int r) { return s.rank < r; });
  if (side == sides.end() || side->rank != rank) side = sides.insert(side, Side{rank, {}, {}});
  side->reaches.resize(static_cast<std::size_t>(reach) + 1);
  side->reaches.back() = {static_cast<Index>(slots.size()), runs_of(slots)};
}

void HaloPlan::add(FieldRef const& field, int first, int count, int reach) {
  PIOLA_EXPECTS(first >= 0 && count >= 0 && reach >= 0);
  PIOLA_EXPECTS(reach < reaches_);
  if (field.data != nullptr) values_.push_back({field.data, first, count, reach});
}

/// Calls f(field, values) for each declared range of components of `fields`, in the order of the message.
template <class F>
void HaloPlan::each_of(std::span<FieldRef const> fields, F const& f) const {
  for (FieldRef const& field : fields)
    for (Values const& v : values_)
      if (v.data == field.data && v.count > 0) f(field, v);
}

template <bool Out>
void HaloPlan::copy(Side& side, std::span<FieldRef const> fields) const {
  double* place = side.values.data();
  each_of(fields, [&](FieldRef const& field, Values const& v) {
    if (static_cast<std::size_t>(v.reach) >= side.reaches.size()) return;
    Slots const& slots = side.reaches[static_cast<std::size_t>(v.reach)];
    copy_values<Out>(Copied{field, v.first, v.count, slots.runs, slots.count, place});
    place += static_cast<std::ptrdiff_t>(slots.count) * v.count;
  });
}

void HaloPlan::exchange(std::span<FieldRef const> fields) {
  PIOLA_EXPECTS(std::all_of(fields.begin(), fields.end(), [&](FieldRef const& field) {
    return std::any_of(values_.begin(), values_.end(), [&](Values const& v) { return v.data == field.data; });
  }));
  auto const messages_of = [&](std::vector<Side>& sides, auto const& prepare) {
    std::vector<comm::Message> messages;
    for (Side& side : sides) {
      std::size_t size = 0;
      each_of(fields, [&](FieldRef const&, Values const& v) {
        auto const reach = static_cast<std::size_t>(v.reach);
        if (reach < side.reaches.size())
          size += static_cast<std::size_t>(side.reaches[reach].count) * static_cast<std::size_t>(v.count);
      });
      if (size == 0) continue;
      side.values.resize(std::max(size, side.values.size()));
      prepare(side);
      messages.push_back({side.rank, side.values.data(), size});
    }
    return messages;
  };
  auto const in = messages_of(receives_, [](Side&) {});
  auto const out = messages_of(sends_, [&](Side& side) { copy<true>(side, fields); });
  comm::exchange(in, out);
  for (Side& side : receives_) copy<false>(side, fields);
}

HaloPlan HaloPlan::without_fields() const {
  HaloPlan bare(cut_);
  bare.reaches_ = reaches_;
  bare.received_ = received_;
  for (Side const& side : sends_) bare.sends_.push_back({side.rank, side.reaches, {}});
  for (Side const& side : receives_) bare.receives_.push_back({side.rank, side.reaches, {}});
  return bare;
}

std::size_t HaloPlan::bytes() const {
  std::size_t n = received_.capacity() * sizeof(Index);
  for (auto const* sides : {&sends_, &receives_})
    for (Side const& side : *sides) {
      n += side.values.capacity() * sizeof(double);
      for (Slots const& slots : side.reaches) n += slots.runs.size() * sizeof(SlotRun);
    }
  return n;
}

void exchange(HaloPlan& plan, std::span<FieldRef const> fields) { plan.exchange(fields); }

void exchange_once(HaloPlan const& plan, FieldRef const& field, int components, int reach) {
  PIOLA_EXPECTS(field.data != nullptr && components > 0);
  HaloPlan once = plan.without_fields();
  once.add(field, 0, components, reach);
  once.exchange(field);
}

}  // namespace piola
