// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/step_halo_exchanges.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/first_failure.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <array>

namespace piola::adaptle {
namespace {

/// Calls f(layout) with the layout of the records of reference neighbours in `dimension` dimensions.
template <class F>
auto with_material(int dimension, F const& f) {
  return dimension == 2 ? f(MaterialRecord<2>{}) : f(MaterialRecord<3>{});
}

/// Components [first, last) of the records of spatial neighbours: those that the correction reads, or the rest.
struct SpatialParts {
  int corrected, all;
};
template <int D, bool Corrected>
SpatialParts parts_of(Settings const& settings) {
  using R = SpatialRecord<D, Corrected>;
  return {R::volume + 1, R::values(settings.artificial_stress)};
}
SpatialParts parts_of(System const& s) {
  if (s.dimension == 2) return s.settings.corrected ? parts_of<2, true>(s.settings) : parts_of<2, false>(s.settings);
  return s.settings.corrected ? parts_of<3, true>(s.settings) : parts_of<3, false>(s.settings);
}

FieldRef spatial_records(System const& s) {
  return {.data = s.spatial.record, .component_stride = 1, .particle_stride = s.spatial.stride};
}

/// Records of the reference neighbours of a body, by its own slots.
FieldRef material_records(System const& s, int body) {
  MaterialRows const& rows = s.material.rows_of[body];
  if (rows.record != nullptr) return {.data = rows.record, .component_stride = rows.stride, .particle_stride = 1};
  int const stride = with_material(s.dimension, [&](auto r) { return decltype(r)::stride(s.settings.equations); });
  return {.data = s.material.record + std::ptrdiff_t{s.body[body].first} * stride,
          .component_stride = 1,
          .particle_stride = stride};
}

/// By the slots of a body alone.
FieldRef of_body(FieldRef field, BodyConstants const& body) {
  field.data += body.first * field.particle_stride;
  return field;
}

}  // namespace

StepHaloExchanges::StepHaloExchanges(System const& s, ReferenceLists const& lists, std::vector<Partition> cuts)
    : near_(cuts), cuts_(std::move(cuts)) {
  for (int b = 0; b < s.bodies && lists.built(); ++b) to_neighbours_.push_back(reference_halo(s, lists, b));
}

/// Displacement, velocity, volume and viscosity before the first sweep, stress data before the second. If particles
/// beside Eulerian ones remove damping and springs of their neighbours, also F and its rate.
StepHaloExchanges::ReferenceHalo StepHaloExchanges::reference_halo(System const& s, ReferenceLists const& lists,
                                                                   int body) const {
  BodyConstants const& b = s.body[body];
  std::vector<Index> read;
  lists.each_neighbour_of(s.part[body], [&](Index i) { read.push_back(i - b.first); });
  ReferenceHalo halo{
      HaloPlan(cuts_[static_cast<std::size_t>(body)].from_zero(), std::move(read)), material_records(s, body), {}, {}};
  auto const [motion, stress, values] = with_material(s.dimension, [&](auto r) {
    using R = decltype(r);
    return std::array{R::X, R::A, R::values(s.settings.equations)};
  });
  halo.stress = halo.motion;
  halo.stress.data += stress * halo.motion.component_stride;
  for (Index const i : halo.plan.received())
    for (int c = 0; c < s.dimension; ++c) value_at(halo.motion, i, motion + c) = value_at(s.field.X, i + b.first, c);
  halo.plan.add(halo.motion, 0, motion);
  halo.plan.add(halo.stress, 0, values - stress);
  if (b.hourglass > 0 || b.hourglass_stiffness > 0) {
    halo.hourglass = {of_body(s.field.F, b), of_body(s.field.F_rate, b)};
    for (FieldRef const& field : halo.hourglass) halo.plan.add(field, 0, 9);
  }
  return halo;
}

/// Failures travel with the bounds.
SpatialLists::RemoteParticles StepHaloExchanges::before_lists(System const& s) {
  struct RankState {
    FirstFailure first;
    CoordinateBounds bounds;
  } own{FirstFailure(*s.failure), {}};
  if (SpatialLists::needed(s)) own.bounds = bounds_of(s.position, 3, near_.own(), s.dimension);
  SpatialLists::RemoteParticles others{&near_, {}, {}};
  for (RankState const& rank : comm::allgather_item(own)) {
    own.first.add(rank.first);
    others.all.add(rank.bounds);
    others.of_ranks.push_back(rank.bounds);
  }
  own.first.put(*s.failure);
  return others;
}

void StepHaloExchanges::after_prediction(System const& s) {
  for (ReferenceHalo& halo : to_neighbours_)
    if (s.material.used) halo.plan.exchange(halo.motion);
}

/// Contacts read positions where steps have left them.
void StepHaloExchanges::after_lists(System const& s) {
  near_.each_touched([&](Index i) {
    for (int c = 0; c < 3; ++c) value_at(s.field.x, i, c) = s.position[std::ptrdiff_t{3} * i + c];
  });
}

void StepHaloExchanges::after_half_state(System const& s) {
  for (ReferenceHalo& halo : to_neighbours_) {
    if (!s.material.used) break;
    std::vector<FieldRef> fields{halo.stress};
    if (s.description.eulerians > 0) fields.insert(fields.end(), halo.hourglass.begin(), halo.hourglass.end());
    halo.plan.exchange(fields);
  }
  auto const [corrected, all] = parts_of(s);
  near_.exchange({{{{spatial_records(s), 0, s.settings.corrected ? corrected : all}},
                   {{s.field.v_half, 0, 3}, {s.field.volume_half, 0, 1}}}});
}

void StepHaloExchanges::after_correction(System const& s) {
  auto const [corrected, all] = parts_of(s);
  near_.exchange({{{{spatial_records(s), corrected, all - corrected}}, {}}});
}

}  // namespace piola::adaptle
