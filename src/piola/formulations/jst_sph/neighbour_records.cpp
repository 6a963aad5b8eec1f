// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/neighbour_records.hpp"
#include "piola/particles/ordering.hpp"

namespace piola::jst_sph {

NeighbourRecords::NeighbourRecords(BodyState& state, Options const& options) : state_(state) {
  using Kind = MirrorImages::Kind;
  auto& s = state;
  int const D = s.dimension;
  bool const stabilised = options.biharmonic != Biharmonic::none;
  Ghosts const of_motion = stabilised ? Ghosts::far : Ghosts::near;
  if (s.has.displacement)
    first_.values = {{&s.stage_position, D, Kind::position, of_motion}};
  else
    first_.values = {{&s.v, D, Kind::vector, of_motion}};
  // The first sweep also reads positions, for the Laplacian of the motion without its rigid part.
  if (s.has.verlet) first_.values.push_back({&s.x, D, Kind::position, of_motion});
  if (s.has.smoothed_volume) first_.values.push_back({&s.J, 1, Kind::scalar, of_motion});

  if (stabilised) second_.values = {{&s.w, D, Kind::vector, Ghosts::far}};
  if (s.has.smoothed_volume) second_.values.push_back({&s.w_J, 1, Kind::scalar, Ghosts::far});
  if (options.biharmonic == Biharmonic::adjoint) {
    second_.values.push_back({nullptr, D, Kind::geometric_vector, Ghosts::constant});  // alpha
    second_.values.push_back({nullptr, 1, Kind::scalar, Ghosts::constant});            // beta
  }
  second_.values.push_back({&s.A, D * D, Kind::tensor, Ghosts::near});
}

void NeighbourRecords::place(FieldList& fields, Index slots, Index images) {
  place(first_, fields, slots, images);
  place(second_, fields, slots, images);
}

void NeighbourRecords::place(Sweep& sweep, FieldList& fields, Index slots, Index images) const {
  int count = 0;
  for (Value const& value : sweep.values) count += value.components;
  auto const n = static_cast<std::ptrdiff_t>(slots + images);
  if (state_.regular) {
    // One lane of an entry has the neighbour, so the others are at most `lanes` from a slot of the body.
    sweep.start = SlotOrder::alignment;
    // The zeros after the last value of a component are those before the first of the next.
    sweep.component = 8 * (((n + 7) / 8 + sweep.start / 8) | 1);
    sweep.memory = Memory(static_cast<std::size_t>(sweep.component * count + 2 * sweep.start));
  } else {
    sweep.component = 1;
    sweep.particle = (std::ptrdiff_t{state_.dimension} + count + 7) / 8 * 8;
    sweep.start = state_.dimension;
    sweep.memory = Memory(static_cast<std::size_t>(n * sweep.particle + 8));
  }
  std::ptrdiff_t first = 0;
  for (Value const& value : sweep.values) {
    if (value.field != nullptr)
      fields[*value.field].place(sweep.memory.data(), sweep.component, sweep.particle,
                                 sweep.start + first * sweep.component, slots, &sweep.version);
    first += value.components;
  }
}

void NeighbourRecords::bind(MirrorImages& images) {
  auto const copies = [&](Sweep const& sweep) {
    std::vector<MirrorImages::Kind> kinds;
    for (Value const& value : sweep.values) kinds.push_back(value.image);
    return images.copies(kinds);
  };
  state_.u = *first_.values.front().field;
  state_.u.copies = copies(first_);
  state_.second = {second_.memory.data() + second_.start,
                   second_.component,
                   second_.particle,
                   0,
                   &second_.version,
                   "second sweep",
                   nullptr,
                   copies(second_)};
  for (FieldRef& source : state_.filter_source) source.copies = images.copies({MirrorImages::Kind::scalar});
}

void NeighbourRecords::set_position(Index slot, std::array<double, 3> const& X) {
  for (Sweep* sweep : {&first_, &second_})
    for (int c = 0; c < state_.dimension; ++c)
      sweep->memory.data()[slot * sweep->particle + c] = X[static_cast<std::size_t>(c)];
}

NeighbourRecords::ComponentRange NeighbourRecords::constants() const {
  ComponentRange r{0, 0};
  for (Value const& value : second_.values) {
    if (value.ghosts == Ghosts::constant)
      r.count += value.components;
    else if (r.count == 0)
      r.first += value.components;
  }
  return r;
}

void NeighbourRecords::add_to(HaloPlan& halo) const {
  add_to(halo, state_.u, first_.values);
  add_to(halo, state_.second, second_.values);
  for (FieldRef const& source : state_.filter_source) halo.add(source, 0, 1, 1);
}

/// Values that follow each other and have the same ghosts are sent as one range.
void NeighbourRecords::add_to(HaloPlan& halo, FieldRef const& record, std::vector<Value> const& values) {
  int first = 0;
  for (std::size_t k = 0; k < values.size();) {
    Ghosts const ghosts = values[k].ghosts;
    int count = 0;
    for (; k < values.size() && values[k].ghosts == ghosts; ++k) count += values[k].components;
    if (ghosts != Ghosts::constant) halo.add(record, first, count, ghosts == Ghosts::far ? 1 : 0);
    first += count;
  }
}

}  // namespace piola::jst_sph
