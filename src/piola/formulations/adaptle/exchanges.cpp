// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/exchanges.hpp"
#include "piola/formulations/adaptle/records.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <array>

namespace piola::adaptle {
namespace {

/// f(layout) with the layout of the records of reference neighbours in so many dimensions.
template <class F>
auto with_material(int dimension, F const& f) {
  return dimension == 2 ? f(MaterialRecord<2>{}) : f(MaterialRecord<3>{});
}

/// Components [first, last) of the records of spatial neighbours: what the correction reads of them, or the rest.
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

FieldRef positions(System const& s) { return {.data = s.position, .component_stride = 1, .particle_stride = 3}; }
FieldRef spatial_records(System const& s) {
  return {.data = s.spatial.record, .component_stride = 1, .particle_stride = s.spatial.stride};
}

/// Records of the reference neighbours of a body, by its own slots.
FieldRef material_records(System const& s, int body) {
  MaterialRows const& rows = s.material.rows_of[body];
  if (rows.record != nullptr) return {.data = rows.record, .component_stride = rows.stride, .particle_stride = 1};
  int const stride = with_material(s.dimension, [&](auto r) { return decltype(r)::stride(s.settings.published); });
  return {.data = s.material.record + std::ptrdiff_t{s.body[body].first} * stride,
          .component_stride = 1,
          .particle_stride = stride};
}

/// By the slots of a body alone.
FieldRef of_body(FieldRef field, BodyConstants const& body) {
  field.data += body.first * field.particle_stride;
  return field;
}

/// Particles stand in the order of ids.
SlotOrder id_order(ParticleSet const&, Body const& body, int /*ranks*/) {
  SlotOrder order;
  for (std::int64_t id = body.first; id < body.last; ++id) order.id.push_back(id);
  order.particles = static_cast<Index>(order.id.size());
  return order;
}

}  // namespace

Exchanges::Exchanges(System const& s, MaterialLists const& lists, std::vector<Shares> cuts)
    : cuts_(std::move(cuts)), all_({}, [](Index) { return false; }), near_({}, [](Index) { return false; }) {
  for (int b = 0; b < s.bodies && lists.built(); ++b) to_neighbours_.push_back(to_neighbours(s, lists, b));
}

/// Displacement, velocity, volume and viscosity before the first sweep, what carries stress before the second; where
/// particles beside Eulerian ones leave damping and springs to the others, also F and its rate.
Exchanges::ToNeighbours Exchanges::to_neighbours(System const& s, MaterialLists const& lists, int body) const {
  BodyConstants const& b = s.body[body];
  std::vector<Index> read;
  lists.each_neighbour_of(s.part[body], [&](Index i) { read.push_back(i - b.first); });
  ToNeighbours told{
      HaloPlan(cuts_[static_cast<std::size_t>(body)].from_zero(), std::move(read)), material_records(s, body), {}, {}};
  auto const [motion, stress, values] = with_material(s.dimension, [&](auto r) {
    using R = decltype(r);
    return std::array{R::X, R::A, R::values(s.settings.published)};
  });
  told.stress = told.motion;
  told.stress.data += stress * told.motion.component_stride;
  for (Index const i : told.plan.received())
    for (int c = 0; c < s.dimension; ++c) value_at(told.motion, i, motion + c) = value_at(s.field.X, i + b.first, c);
  told.plan.add(told.motion, 0, motion);
  told.plan.add(told.stress, 0, values - stress);
  if (b.hourglass > 0 || b.hourglass_stiffness > 0) {
    told.hourglass = {of_body(s.field.F, b), of_body(s.field.F_rate, b)};
    for (FieldRef const& field : told.hourglass) told.plan.add(field, 0, 9);
  }
  return told;
}

/// Failures travel with positions, where all ranks are told these.
void Exchanges::after_prediction(System const& s) {
  FailuresOfRanks failures(*s.failure);
  if (SpatialLists::needed(s) && all_.slots.empty()) all_ = SlotsOfRanks(cuts_, [](Index) { return true; });
  std::array const with_positions{ToldToAll{{{positions(s), 0, 3}}, &all_}, failures.told()};
  complete_slots(std::span(with_positions).subspan(SpatialLists::needed(s) ? 0 : 1));
  failures.put(*s.failure);
  for (ToNeighbours& told : to_neighbours_)
    if (s.material.used) told.plan.exchange(told.motion);
}

/// Contacts read positions where steps have left them.
void Exchanges::after_lists(System const& s, SpatialLists const& lists) {
  for (Index i = 0; i < s.particles && SpatialLists::touching(s); ++i)
    for (int c = 0; c < 3 && lists.meets(i); ++c) value_at(s.field.x, i, c) = s.position[std::ptrdiff_t{3} * i + c];
  near_ = SlotsOfRanks(cuts_, [&](Index i) { return s.spatial.record != nullptr && lists.near(i); });
  for (Index& slot : near_.slots) slot = s.spatial.sorted[slot];
}

void Exchanges::after_half_state(System const& s, SpatialLists const& lists) {
  for (ToNeighbours& told : to_neighbours_) {
    if (!s.material.used) break;
    std::vector<FieldRef> fields{told.stress};
    if (s.eulerians > 0) fields.insert(fields.end(), told.hourglass.begin(), told.hourglass.end());
    told.plan.exchange(fields);
  }
  auto const [corrected, all] = parts_of(s);
  SlotsOfRanks const meet(cuts_, [&](Index i) { return SpatialLists::touching(s) && lists.meets(i); });
  complete_slots(std::array{ToldToAll{{{s.field.v_half, 0, 3}, {s.field.volume_half, 0, 1}}, &meet},
                            ToldToAll{{{spatial_records(s), 0, s.settings.corrected ? corrected : all}}, &near_}});
}

void Exchanges::after_correction(System const& s) {
  auto const [corrected, all] = parts_of(s);
  complete_slots({{spatial_records(s), corrected, all - corrected}}, near_);
}

Talk Exchanges::talk(System const& s, SpatialLists const& lists, int body) {
  BodyConstants const& b = s.body[body];
  bool const touching = SpatialLists::touching(s), flows = s.eulerians > 0;
  Talk talk;
  talk.order = &id_order;
  if (s.material.used) {
    auto const [motion, stress] = with_material(s.dimension, [&](auto r) {
      using R = decltype(r);
      return std::array{R::X, R::values(s.settings.published) - R::A};
    });
    bool const with_F = flows && (b.hourglass > 0 || b.hourglass_stiffness > 0);
    talk.messages = {{{2 * b.material_h, motion}}, {{2 * b.material_h, stress + (with_F ? 18 : 0)}}};
  }
  auto const [corrected, all] = parts_of(s);
  bool meet = false;  // bodies that are not near each other have nothing to tell
  for (Index i = 0; i < s.particles && touching && body == 0; ++i) meet = meet || lists.meets(i);
  for (Index i = b.first; i < b.last && SpatialLists::needed(s); ++i)
    talk.to_all += 3 + (flows && lists.near(i) ? all : 0) + (touching && lists.meets(i) ? 4 : 0);
  if (body > 0) return talk;
  // Failures with positions, what the step says; who is near, and what their correction leaves to be told.
  talk.collectives = 2 + (meet || flows ? 1 : 0) + (flows && s.settings.corrected ? 1 : 0);
  return talk;
}

}  // namespace piola::adaptle
