// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include "piola/parallel/work_balance.hpp"
#include <algorithm>

namespace piola::adaptle {
namespace {

constexpr double far_away = 1e20;
constexpr Index most_neighbours = 4096;

/// The first particle of the case, where it starts: not of the moment, so that cells stay where they are.
std::array<double, 3> origin_of_cells(System const& s) {
  return point_at(s.field.X, s.slot_of != nullptr ? s.slot_of[0] : 0, 3);
}

/// Whether this rank works on it.
bool is_own(System const& s, Index slot) {
  Range const own = s.part[s.body_of[slot]];
  return slot >= own.first && slot < own.last;
}

/// Calls f(cell) for the cells around one.
template <class F>
void each_cell_around(Index cell, std::array<Index, 3> const& shape, int dimension, F const& f) {
  Index const row = shape[0], layer = shape[0] * shape[1];
  for (Index dz = dimension == 3 ? -1 : 0; dz <= (dimension == 3 ? 1 : 0); ++dz)
    for (Index dy = -1; dy <= 1; ++dy)
      for (Index dx = -1; dx <= 1; ++dx) f(cell + dz * layer + dy * row + dx);
}

}  // namespace

/// Which cells hold Eulerian particles, and of which bodies.
void SpatialLists::mark_cells(System const& s) {
  auto const cells = static_cast<std::size_t>(grid_.cell_count());
  cell_has_eulerian_.assign(cells, 0);
  cell_low_.assign(cells, s.bodies);
  cell_high_.assign(cells, -1);
  group_.resize(at(s.particles) + 16);
  for (Index k = 0; k < s.particles; ++k) {
    Index const i = grid_.slots()[k];
    std::size_t const cell = at(grid_.cells()[k]);
    group_[at(k)] = s.body_of[i];
    if (s.eulerian[i] != 0) cell_has_eulerian_[cell] = 1;
    cell_low_[cell] = std::min(cell_low_[cell], s.body_of[i]);
    cell_high_[cell] = std::max(cell_high_[cell], s.body_of[i]);
  }
}

void SpatialLists::choose_targets(System const& s) {
  spatial_.target.clear();
  contact_.target.clear();
  cell_near_.assign(static_cast<std::size_t>(grid_.cell_count()), 0);
  meets_.assign(touching(s) ? at(s.particles) : 0, 0);
  Index last = -1;
  bool eulerian = false;
  std::int32_t low = 0, high = 0;
  for (Index k = 0; k < s.particles; ++k) {
    Index const cell = grid_.cells()[k];
    if (cell != last) {
      last = cell;
      eulerian = false;
      low = s.bodies;
      high = -1;
      each_cell_around(cell, grid_.shape(), s.dimension, [&](Index other) {
        eulerian = eulerian || cell_has_eulerian_[at(other)] != 0;
        low = std::min(low, cell_low_[at(other)]);
        high = std::max(high, cell_high_[at(other)]);
      });
      // Targets read the records of all particles around them.
      if (eulerian) each_cell_around(cell, grid_.shape(), s.dimension, [&](Index other) { cell_near_[at(other)] = 1; });
    }
    Index const slot = grid_.slots()[k];
    bool const touches = s.contact.law > 0 && high > low;
    if (touches) meets_[at(slot)] = 1;
    if (!is_own(s, slot)) continue;
    if (eulerian) spatial_.target.push_back(k);
    if (touches) contact_.target.push_back(k);
  }
  near_.resize(at(s.particles));
  for (Index k = 0; k < s.particles; ++k) near_[at(grid_.slots()[k])] = cell_near_[at(grid_.cells()[k])];
}

void SpatialLists::build(System const& s, Machine const& machine, double& busy) {
  eulerian_ = s.eulerians > 0;
  spatial_.target.clear();
  contact_.target.clear();
  if (!needed(s)) return;
  widest_ = 0;
  for (int b = 0; b < s.bodies; ++b) widest_ = std::max(widest_, 2 * s.body[b].h);
  grid_.sort(s.position, 3, s.particles, s.dimension, widest_, origin_of_cells(s), s.slot_of);
  everyone_ = s.eulerians == s.particles && !touching(s);
  if (everyone_) {
    for (Index k = 0; k < s.particles; ++k)
      if (is_own(s, grid_.slots()[k])) spatial_.target.push_back(k);
  } else {
    mark_cells(s);
    choose_targets(s);
  }
  {
    BusyWatch const watch(busy);
    search(s, machine, spatial_, false);
    if (touching(s)) search(s, machine, contact_, true);
  }
  if (!eulerian_) return;
  if (record_room_ < s.particles + 1) {
    record_room_ = s.particles + 1;
    // Loads of a part of a record reach beyond its end, of the last record by less than a pack of eight.
    records_ = Memory(static_cast<std::size_t>(record_room_) * static_cast<std::size_t>(s.spatial.stride) + 8);
    double* filler = records_.data() + static_cast<std::ptrdiff_t>(s.particles) * s.spatial.stride;
    for (int c = 0; c < s.dimension; ++c) filler[c] = far_away;
    filler[2 * s.dimension + 1] = 1;  // density: it divides
    results_ = Memory(static_cast<std::size_t>(record_room_) * SpatialResult::stride);
  }
  place_results(s);
}

/// Those without a list have the zeros after the last.
void SpatialLists::place_results(System const& s) {
  result_of_.assign(at(s.particles) + 16, s.particles);
  for (Index const t : spatial_.target) result_of_[at(grid_.slots()[t])] = t;
}

void SpatialLists::search(System const& s, Machine const& machine, List& list, bool across) {
  auto const targets = static_cast<Index>(list.target.size());
  list.length.resize(list.target.size());
  list.found.resize(list.target.size());
  reach_.assign(static_cast<std::size_t>(s.bodies), 0);
  for (int b = 0; b < s.bodies; ++b) {
    double radius = 2 * s.body[b].h;
    // Smoothing lengths of pairs of bodies are means.
    for (int other = 0; other < s.bodies && across; ++other) radius = std::max(radius, s.body[b].h + s.body[other].h);
    double const reach = radius / widest_ + grid_.slack();
    reach_[static_cast<std::size_t>(b)] = static_cast<float>(reach * reach);
  }
  MovingSearch q;
  q.dimension = s.dimension;
  q.sources = s.particles;
  for (int c = 0; c < 3; ++c) q.place[c] = grid_.place(c);
  q.group = touching(s) ? group_.data() : nullptr;
  q.across = across;
  q.cell = grid_.cells();
  q.begin = grid_.begins();
  q.cells = grid_.shape();
  q.reach = reach_.data();
  q.targets = targets;
  q.target = list.target.data();
  for (;;) {
    list.entry.resize(at(targets) * at(list.capacity));
    q.capacity = list.capacity;
    q.list = list.entry.data();
    q.length = list.length.data();
    q.found = list.found.data();
    machine.search(q);
    Index longest = 0;
    for (Index const n : list.length) longest = std::max(longest, n);
    longest_ = longest;
    overflow_ = overflow_ || longest >= most_neighbours;
    if (longest <= list.capacity) return;
    while (list.capacity < longest) list.capacity += 16;
  }
}

void SpatialLists::put_into(System& s) {
  s.spatial.sources = s.particles;
  s.spatial.slot = grid_.slots();
  s.spatial.sorted = grid_.sorted();
  s.spatial.targets = static_cast<Index>(spatial_.target.size());
  s.spatial.target = spatial_.target.data();
  s.spatial.capacity = spatial_.capacity;
  s.spatial.list = spatial_.entry.data();
  s.spatial.length = spatial_.length.data();
  s.spatial.near = everyone_ ? nullptr : near_.data();
  s.spatial.record = eulerian_ ? records_.data() : nullptr;
  s.crowded = overflow_;
  s.spatial.result = eulerian_ ? results_.data() : nullptr;
  s.spatial.result_of = result_of_.data();
  s.contact.targets = static_cast<Index>(contact_.target.size());
  s.contact.target = contact_.target.data();
  s.contact.capacity = contact_.capacity;
  s.contact.list = contact_.entry.data();
  s.contact.length = contact_.found.data();
}

PartFilled<int> SpatialLists::neighbours_by_slot(System const& s) const {
  PartFilled<int> count(at(s.particles));
  for (std::size_t t = 0; t < spatial_.found.size() && t < spatial_.target.size(); ++t)
    count[at(grid_.slots()[spatial_.target[t]])] = spatial_.found[t];
  return count;
}

std::size_t SpatialLists::bytes() const {
  auto const of = [](List const& l) {
    return sizeof(Index) * (l.target.size() + l.entry.size() + l.length.size() + l.found.size());
  };
  return grid_.bytes() + of(spatial_) + of(contact_) + records_.bytes() + results_.bytes() +
         sizeof(Index) * result_of_.size() + cell_has_eulerian_.size() * (1 + 2 * sizeof(std::int32_t));
}

}  // namespace piola::adaptle
