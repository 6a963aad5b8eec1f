// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/jst_sph/field_set_up.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/materials/elastic_constants.hpp"
#include "piola/materials/laws.hpp"
#include <vector>

namespace piola::jst_sph {
namespace {

constexpr int far = 1;  ///< cutoff level of the halo whose ghosts Laplacians and the filter read

}  // namespace

void FieldSetUp::fill_records(NeighbourRecords& records, ReferencePairs const& pairs) const {
  if (!s_.regular) {
    exec_host::parallel_for(body_.own(), [&](Index i) { records.set_position(i, body_.X(i)); });
    if (s_.halo != nullptr)
      for (Index const i : s_.halo->received()) records.set_position(i, body_.X(i));
    auto const& images = body_.images().particles().X;
    for (std::size_t k = 0; k < images.size(); ++k)
      records.set_position(body_.slots() + static_cast<Index>(k), images[k]);
  }
  auto const [first, count] = records.constants();
  if (count == 0) return;
  auto const& corrections = pairs.corrections();
  int const D = s_.dimension, at = first;
  exec_host::parallel_for(body_.own(), [&](Index i) {
    auto const slot = corrections.at(i);
    for (int c = 0; c < D; ++c) value_at(s_.second, i, at + c) = corrections.alpha[slot][static_cast<std::size_t>(c)];
    value_at(s_.second, i, at + D) = corrections.beta[slot];
  });
  if (s_.halo == nullptr) return;
  FieldRef constants = s_.second;
  constants.data += first * constants.component_stride;
  exchange_once(*s_.halo, constants, count, far);
}

void FieldSetUp::fill_reference(UniqueLaneGroups const* groups, ReferencePairs const& pairs) const {
  int const D = s_.dimension;
  exec_host::parallel_for(s_.slots, [&](Index i) {
    for (int c = 0; c < D; ++c) {
      value_at(s_.F, i, c * D + c) = 1;
      if (!s_.has.verlet) value_at(s_.F_star, i, c * D + c) = 1;
    }
  });
  auto const& corrections = pairs.corrections();
  static constexpr int packed[3][6] = {{0}, {0, 1, 3}, {0, 1, 2, 3, 4, 5}};
  auto const fill = [&](Index to, Index i) {
    auto const slot = corrections.at(i);
    value_at(s_.V, to) = body_.mirrored_volume(i);
    for (int c = 0; c < D * (D + 1) / 2; ++c)
      value_at(s_.C, to, c) = corrections.C[slot][static_cast<std::size_t>(packed[D - 1][c])];
    for (int c = 0; c < D; ++c) {
      value_at(s_.G, to, c) = corrections.G[slot][static_cast<std::size_t>(c)];
      value_at(s_.alpha, to, c) = corrections.alpha[slot][static_cast<std::size_t>(c)];
    }
    value_at(s_.beta, to) = corrections.beta[slot];
    value_at(s_.diagonal, to) = corrections.diagonal[slot];
  };
  if (groups != nullptr)
    groups->each(body_.particles(), fill);
  else
    exec_host::parallel_for(body_.own(), [&](Index i) { fill(i, i); });
  if (s_.has.mirrored) exec_host::parallel_for(body_.own(), [&](Index i) { value_at(s_.weight, i) = body_.volume(i); });
}

void FieldSetUp::fill_filter(ReferencePairs const& pairs) const {
  std::vector<double> volumes(static_cast<std::size_t>(body_.slots()));
  for (Index i = 0; i < body_.particles(); ++i) volumes[static_cast<std::size_t>(i)] = body_.mirrored_volume(i);
  ReferencePairs::FilterShare const communication{
      body_.own(), [&](std::vector<double>& values) { exchange_once(*s_.halo, {.data = values.data()}, 1, far); },
      comm::allreduce_max};
  auto const filter = pairs.make_filter(volumes, s_.halo != nullptr ? &communication : nullptr);
  exec_host::parallel_for(body_.own(), [&](Index i) {
    value_at(s_.filter_scale, i) = filter.scale[static_cast<std::size_t>(i)];
    value_at(s_.filter_sum, i) = filter.sum[static_cast<std::size_t>(i)];
  });
}

void FieldSetUp::fill_initial(Assembly const& assembly) {
  int const D = s_.dimension;
  auto const& moved = assembly.initial_displacement;
  auto const& deformed = assembly.initial_deformation_gradient;
  exec_host::parallel_for(body_.own(), [&](Index i) {
    auto const at = static_cast<std::size_t>(body_.id(i));
    for (int c = 0; c < D; ++c) {
      auto const k = static_cast<std::size_t>(c);
      value_at(s_.x, i, c) = body_.set().X[at][k] + (moved.empty() ? 0 : moved[at][k]);
      if (!assembly.initial_velocity.empty()) value_at(s_.v, i, c) = assembly.initial_velocity[at][k];
    }
  });
  if (!deformed.empty() && !s_.has.displacement) {
    exec_host::parallel_for(body_.own(), [&](Index i) {
      for (int c = 0; c < D * D; ++c)
        value_at(s_.F, i, c) = deformed[static_cast<std::size_t>(body_.id(i))][std::size_t{3} * (c / D) + c % D];
    });
  } else if (!moved.empty() || s_.has.displacement) {
    deform_to_positions();
  }
}

/// F = GRAD x. The sweep reads `u`, whose values return unless it is the position of the stage.
void FieldSetUp::deform_to_positions() {
  Range const mine = s_.slots;
  int const D = s_.dimension;
  std::vector<double> saved(static_cast<std::size_t>(mine.last - mine.first) * static_cast<std::size_t>(D));
  auto const each = [&](auto const& f) {
    for (Index i = mine.first; i < mine.last; ++i)
      for (int c = 0; c < D; ++c) f(i, c, saved[static_cast<std::size_t>(i - mine.first) * D + c]);
  };
  each([&](Index i, int c, double& value) {
    value = value_at(s_.u, i, c);
    value_at(s_.u, i, c) = value_at(s_.x, i, c);
  });
  Copies const* const copies = s_.u.copies;
  s_.u.copies = body_.images().copies({MirrorImages::Kind::position});  // present content of `u`
  backend_.update_deformation(s_);
  s_.u.copies = copies;
  if (!s_.has.displacement) each([&](Index i, int c, double& value) { value_at(s_.u, i, c) = value; });
  for (Index i = body_.own().last; i < mine.last; ++i)
    for (int c = 0; c < D; ++c) value_at(s_.F, i, c * D + c) = 1;
}

void FieldSetUp::fill_evolved_geometry() const {
  if (!s_.has.volume) return;
  for (Index i = s_.slots.first; i < s_.slots.last; ++i) {
    Mat<3> const F = i < body_.particles() ? body_.F(i) : identity<3>(), H = cofactor(F);
    for (int c = 0; s_.has.area && c < 9; ++c) value_at(s_.H, i, c) = value_at(s_.H_star, i, c) = H.c[c];
    with_law(s_.material, [&](auto const& law) { value_at(s_.J, i) = volume_ratio_of(law.small_strain, F); });
  }
}

}  // namespace piola::jst_sph
