// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/field_set_up.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/materials/hypoelastic_registry.hpp"
#include <algorithm>

namespace piola::nodal {
void copy_at(LazyZeroArray<double> const& from, FieldRef const& to, int components, Index i) {
  auto const size = static_cast<std::size_t>(components);
  for (std::size_t c = 0; c < size; ++c)
    value_at(to, i, static_cast<int>(c)) = from[static_cast<std::size_t>(i) * size + c];
}

namespace {

/// F = I at a point whose gradient is stored from `at` on.
void put_unit_gradient(FieldRef const& history, Index i, int at, int D) {
  for (int c = 0; c < D * D; ++c) value_at(history, i, at + c) = c % (D + 1) == 0 ? 1 : 0;
  if (D == 2) value_at(history, i, at + 4) = 1;
}

}  // namespace

void put_reference_shape(FieldRef const& history, Index i, int D) {
  for (int q = 0; q < Fields::points(D); ++q)
    put_unit_gradient(history, i, HistoryLayout::point(q, D) + HistoryLayout::F, D);
}

void FieldSetUp::fill_reference() {
  auto& r = reference_;
  int const D = s_.dimension, second = Fields::second(D);
  bool const lists = r.lattice.empty();
  exec_host::parallel_for(s_.slots, [&](Index i) {
    copy_at(r.V, s_.V, 1, i);
    copy_at(r.mass, s_.mass, 1, i);
    copy_at(r.L, s_.L, D * D, i);
    copy_at(r.own, s_.own, D + second, i);
    if (lists) copy_at(r.k, s_.k, Fields::terms(D) * second, i);
    if (s_.has.axisymmetric) copy_at(r.hoop, s_.hoop, static_cast<int>(HoopSums::size), i);
    // Slots without a particle hold nothing that counts.
    for (int c = 0; c < D && i < body_.particles(); ++c) value_at(s_.C_measured, i, c) = 1;
  });
  if (lists) {
    exec_host::parallel_for(s_.slots, [&](Index i) { copy_at(r.X, s_.X, D, i); });
    for (std::size_t n = 0; n < r.images.size(); ++n) copy_at(r.X, s_.X, D, body_.slots() + static_cast<Index>(n));
    for (Index n = 0; n < s_.ghost_count; ++n) copy_at(r.X, s_.X, D, s_.ghosts[n]);
  }
  for (auto* array : {&r.L, &r.k, &r.own, &r.hoop}) LazyZeroArray<double>().swap(*array);
}

std::vector<MirroredParticle> FieldSetUp::keep_own_side() {
  std::vector<MirroredParticle> on_planes;
  for (Index i = body_.own().first; i < body_.own().last; ++i) {
    int axes = 0;
    for (int axis = 0; axis < s_.dimension; ++axis)
      if (body_.images().on_plane(i, static_cast<std::size_t>(axis))) axes |= 1 << axis;
    if (axes != 0) on_planes.push_back({i, axes});
    auto const slot = static_cast<std::size_t>(i);
    reference_.mass[slot] *= reference_.own_fraction(i);
    for (auto& part : reference_.parts)
      if (!part.empty()) part[slot].area *= reference_.own_fraction(i);
  }
  return on_planes;
}

void FieldSetUp::fill_initial() {
  auto const& moved = assembly_.initial_displacement;
  auto const& X = body_.set().X;
  exec_host::parallel_for(body_.own(), [&](Index i) {
    auto const at = static_cast<std::size_t>(body_.id(i));
    for (int c = 0; c < s_.dimension; ++c) {
      auto const d = static_cast<std::size_t>(c);
      value_at(s_.x, i, c) = X[at][d] + (moved.empty() ? 0 : moved[at][d]);
      if (!assembly_.initial_velocity.empty()) value_at(s_.v, i, c) = assembly_.initial_velocity[at][d];
    }
  });
  for (MirroredParticle const& p : mirrored())
    for (int c = 0; c < s_.dimension; ++c) {
      if ((p.axes >> c & 1) == 0) continue;
      value_at(s_.x, p.slot, c) = X[static_cast<std::size_t>(body_.id(p.slot))][static_cast<std::size_t>(c)];
      value_at(s_.v, p.slot, c) = 0;
    }
}

double FieldSetUp::temperature_above(Index slot, double of_material) const {
  auto const& all = assembly_.initial_temperature;
  double const T = all.empty() ? 0 : all[static_cast<std::size_t>(body_.id(slot))];
  return T > 0 ? T - of_material : 0;
}

void FieldSetUp::fill_histories() {
  int const D = s_.dimension;
  for (MaterialRange const& range : body_.materials()) {
    if (range.block != nullptr && !range.block->elastic()) fill_block_history(range);
    with_solid(range.material, [&](auto const& law) {
      for (Index i = std::max(range.first, body_.own().first); i < std::min(range.last, body_.own().last); ++i) {
        double const warmer = temperature_above(i, law.initial_temperature());
        for (int q = 0; q < Fields::points(D); ++q)
          value_at(s_.history, i, HistoryLayout::point(q, D) + HistoryLayout::temperature) =
              law.initial_temperature() + warmer;
        if (warmer != 0) value_at(s_.history, i, HistoryLayout::energy) = warmer * law.heat().specific_heat;
        put_reference_shape(s_.history, i, D);
        if (!s_.has.failure) continue;
        auto const id = static_cast<std::size_t>(body_.id(i));
        auto const put = [&](int of, double number) { value_at(s_.history, i, Fields::failure_value(of, D)) = number; };
        put(FailureLayout::volume_factor, 1);
        put(FailureLayout::toughness, law.scatter.factor(id, body_.set().volume[id]));
      }
    });
  }
}

void FieldSetUp::fill_block_history(MaterialRange const& range) {
  using At = BlockLawLayout;
  int const D = s_.dimension, count = range.block->history_count();
  std::vector<double> start(static_cast<std::size_t>(count));
  range.block->start(start.data());
  double const c = range.block->p_wave_speed();
  for (Index i = std::max(range.first, body_.own().first); i < std::min(range.last, body_.own().last); ++i) {
    value_at(s_.history, i, At::modulus) = range.block->rho0 * c * c;
    for (int q = 0; q < Fields::points(D); ++q) {
      int const at = At::point(q, D, count);
      put_unit_gradient(s_.history, i, at + At::F, D);
      for (int h = 0; h < count; ++h)
        value_at(s_.history, i, at + At::history(D) + h) = start[static_cast<std::size_t>(h)];
    }
  }
}

void FieldSetUp::fill_offset(Backend const& backend) {
  int const D = s_.dimension;
  Field centroid("CellCentroid", "m", D, Role::reference);
  centroid.allocate_tiled(body_.slots());
  exec_host::parallel_for(body_.own(), [&](Index i) {
    auto const& F = assembly_.initial_deformation_gradient[static_cast<std::size_t>(body_.id(i))];
    for (int c = 0; c < D; ++c) {
      centroid.at(i, c) = reference_.centroid[static_cast<std::size_t>(i * D + c)];
      for (int J = 0; J < D; ++J) value_at(s_.offset, i, c * D + J) = F[std::size_t{3} * c + J];
    }
  });
  backend.subtract_gradients(s_, centroid.ref());
  for (MirroredParticle const& p : mirrored())  // what is odd across a plane vanishes there
    for (int c = 0; c < D; ++c)
      for (int J = 0; J < D; ++J)
        if (((p.axes >> c ^ p.axes >> J) & 1) != 0) value_at(s_.offset, p.slot, c * D + J) = 0;
}

}  // namespace piola::nodal
