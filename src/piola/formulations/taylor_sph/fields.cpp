// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/taylor_sph/fields.hpp"

namespace piola::taylor_sph {
namespace {

/// Position of slots without particles: so far away that every kernel vanishes.
constexpr double far_away = 1e20;

/// Records of `slots` particles, and one more as filler of neighbour lists.
Memory empty_records(int D, Index slots) {
  std::ptrdiff_t const stride = record_stride(D);
  Memory memory(static_cast<std::size_t>(slots + 1) * static_cast<std::size_t>(stride));
  for (Index i = 0; i <= slots; ++i)
    for (int c = 0; c < D; ++c) memory.data()[i * stride + c] = far_away;
  return memory;
}

}  // namespace

/// Position of a field in Record; -1: it has an array of its own.
int Fields::place_in_record(Field const& field) const {
  if (&field == &x) return 0;
  if (&field == &kernel_volume) return D_;
  if (&field == &v) return D_ + 1;
  return &field == &stress ? stress_in_record(D_) : -1;
}

void Fields::allocate(Index slots) {
  constexpr Index guard = 16;  // loops read whole lanes
  records_ = empty_records(D_, slots);
  each([&](Field& field) {
    int const first = place_in_record(field);
    if (first < 0)
      field.allocate(slots, guard);
    else
      field.place(records_.data(), 1, record_stride(D_), first, slots);
  });
}

void Fields::set_views(BodyState& state) {
  state.real = records_.data();
  state.out_of_plane = out_of_plane.ref();
  state.drift = drift.ref();
  state.displacement = displacement.ref();
  state.acceleration = acceleration.ref();
  state.mass = mass.ref();
}

void CellFields::allocate(Index slots) {
  records_ = empty_records(D_, slots);
  if (!adjoint_) return;
  stress.place(records_.data(), 1, record_stride(D_), stress_in_record(D_), slots);
  std::ptrdiff_t values = 0;
  each([&](Field const& field) { values += &field == &stress ? 0 : field.components(); });
  memory_ = Memory(static_cast<std::size_t>(values * slots));
  std::ptrdiff_t first = 0;
  each([&](Field& field) {
    if (&field == &stress) return;
    field.place(memory_.data(), 1, field.components(), first, slots);
    first += std::ptrdiff_t{slots} * field.components();
  });
}

void CellFields::set_views(BodyState& state) {
  state.virtual_ = records_.data();
  if (adjoint_)
    state.cell_state = {out_of_plane.ref().data, force.ref().data, gradient.ref().data, hourglass.ref().data,
                        patterns_};
}

}  // namespace piola::taylor_sph
