// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/domain/load_balancer.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>

namespace piola::adaptle {
namespace {

constexpr double far_away = 1e20;
constexpr Index most_neighbours = 4096;

/// The first particle of the case, where it starts: not of the moment, so that cells stay where they are.
std::array<double, 3> origin_of_cells(System const& s) { return point_at(s.field.X, 0, 3); }

}  // namespace

/// Sorts all particles into cells, on one rank. If all are Eulerian and none is in contact with another body, all take
/// part.
void SpatialLists::sort_all(System const& s) {
  if (s.settings.axisymmetric) {
    sort_with_images(s);
  } else {
    grid_.find_cells(s.position, 3, s.particles, s.dimension, widest_, origin_of_cells(s));
    grid_.sort({s.particles});
  }
  all_interact_ = s.description.eulerians == s.particles && !touching(s) && !s.settings.axisymmetric;
  if (all_interact_) return;
  marks_.start(grid_.shape(), s.dimension);
  for (Index k = 0; k < grid_.count(); ++k) {
    Index const i = grid_.slots()[k];
    marks_.add(grid_.cells()[k], s.body_of[i], s.description.eulerian[i] != 0);
  }
  marks_.finish(touching(s));
}

/// Sorts all particles, and images of those that are near the axis.
void SpatialLists::sort_with_images(System const& s) {
  present_.clear();
  for (Index i = 0; i < s.particles; ++i) present_.push_back(i);
  for (Index i = 0; i < s.particles; ++i)
    if (s.position[std::ptrdiff_t{3} * i] < widest_) present_.push_back(s.image_of(i));
  SlotList const present{static_cast<Index>(present_.size()), present_.data()};
  grid_.lay(bounds_of(s.position, 3, present, s.dimension), s.all_slots(), s.dimension, widest_, origin_of_cells(s),
            [&](std::size_t axis) {
              std::vector<double> along;
              for (Index const i : present_) along.push_back(s.position[3 * at(i) + axis]);
              return along;
            });
  grid_.find_cells(s.position, 3, present);
  grid_.sort(present);
}

/// Sorts local particles and spatial ghosts into cells.
void SpatialLists::sort_with_ghosts(System const& s, RemoteParticles const& others) {
  SpatialHaloExchange& near = *others.near;
  grid_.lay(others.all, s.particles, s.dimension, widest_, origin_of_cells(s),
            [&](std::size_t axis) { return near.coordinates(s, axis); });
  grid_.find_cells(s.position, 3, near.own());
  near.meet(s, grid_, others.of_ranks, marks_);
  grid_.find_cells(s.position, 3, near.received());
  grid_.sort(near.present());
  near.choose(grid_, marks_);
}

void SpatialLists::choose_targets(System const& s) {
  if (near_.size() != at(s.all_slots())) near_ = LazyZeroArray<std::uint8_t>(at(s.all_slots()));
  group_.resize(at(grid_.count()) + 16);
  for (Index k = 0; k < grid_.count(); ++k) {
    Index const slot = grid_.slots()[k], cell = grid_.cells()[k];
    if (all_interact_) {
      spatial_.target.push_back(k);
      continue;
    }
    group_[at(k)] = s.body_of[slot];
    near_[at(slot)] = marks_.exports(cell) & HaloCells::flow;
    if (!s.is_local(slot)) continue;
    if ((marks_.reads(cell) & HaloCells::flow) != 0) spatial_.target.push_back(k);
    if ((marks_.reads(cell) & HaloCells::touch) != 0) contact_.target.push_back(k);
  }
  for (Index const i : present_)
    if (Index const source = s.source_of(i); source != i && near_[at(i)] != 0) near_[at(source)] = near_[at(i)];
}

void SpatialLists::build(System const& s, RemoteParticles const& others, Backend const& backend, double& busy) {
  eulerian_ = s.description.eulerians > 0;
  spatial_.target.clear();
  contact_.target.clear();
  widest_ = 0;
  for (int b = 0; b < s.bodies; ++b) widest_ = std::max(widest_, 2 * s.body[b].h);
  if (others.near != nullptr) others.near->forget();
  if (!needed(s)) return;
  if (others.near != nullptr)
    sort_with_ghosts(s, others);
  else
    sort_all(s);
  choose_targets(s);
  {
    WorkTimer const watch(busy);
    search(s, backend, spatial_, false);
    if (touching(s)) search(s, backend, contact_, true);
  }
  if (!eulerian_) return;
  make_room(s);
  place_results(s);
}

/// After the records and results of all that is sorted one is far away, and one zero.
void SpatialLists::make_room(System const& s) {
  Index const sorted = grid_.count();
  if (record_room_ < sorted + 1) {
    record_room_ = sorted + 1 + (s.shared ? sorted / 8 : 0);  // of ranks it changes from step to step
    // Loads of a part of a record reach beyond its end, of the last record by less than a pack of eight.
    records_ = Memory(static_cast<std::size_t>(record_room_) * static_cast<std::size_t>(s.spatial.stride) + 8);
    results_ = Memory(static_cast<std::size_t>(record_room_) * SpatialResult::stride);
  }
  double* const filler = records_.data() + static_cast<std::ptrdiff_t>(sorted) * s.spatial.stride;
  std::fill_n(filler, s.spatial.stride, 0);
  for (int c = 0; c < s.dimension; ++c) filler[c] = far_away;
  filler[2 * s.dimension + 1] = 1;  // density: it divides
  std::fill_n(results_.data() + static_cast<std::ptrdiff_t>(sorted) * SpatialResult::stride, SpatialResult::stride, 0);
}

/// Particles without a list get the zeros after the last result.
void SpatialLists::place_results(System const& s) {
  constexpr Index beyond = 16;  // padding for groups of lanes
  if (result_of_.size() != at(s.particles + beyond)) result_of_ = LazyZeroArray<Index>(at(s.particles + beyond));
  for (int b = 0; b < s.bodies; ++b)
    std::fill(result_of_.begin() + s.part[b].first, result_of_.begin() + s.part[b].last + beyond, grid_.count());
  for (Index const t : spatial_.target) result_of_[at(grid_.slots()[t])] = t;
}

void SpatialLists::search(System const& s, Backend const& backend, List& list, bool across) {
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
  CellListSearch q;
  q.dimension = s.dimension;
  q.sources = grid_.count();
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
    backend.search(q);
    Index longest = 0;
    for (Index const n : list.length) longest = std::max(longest, n);
    longest_ = longest;
    overflow_ = overflow_ || longest >= most_neighbours;
    if (longest <= list.capacity) return;
    while (list.capacity < longest) list.capacity += 16;
  }
}

void SpatialLists::put_into(System& s) {
  s.spatial.sources = grid_.count();
  s.spatial.slot = grid_.slots();
  s.spatial.sorted = grid_.sorted();
  s.spatial.targets = static_cast<Index>(spatial_.target.size());
  s.spatial.target = spatial_.target.data();
  s.spatial.capacity = spatial_.capacity;
  s.spatial.list = spatial_.entry.data();
  s.spatial.length = spatial_.length.data();
  s.spatial.near = all_interact_ ? nullptr : near_.data();
  s.spatial.record = eulerian_ ? records_.data() : nullptr;
  s.neighbour_overflow = overflow_;
  s.spatial.result = eulerian_ ? results_.data() : nullptr;
  s.spatial.result_of = result_of_.data();
  s.contact.targets = static_cast<Index>(contact_.target.size());
  s.contact.target = contact_.target.data();
  s.contact.capacity = contact_.capacity;
  s.contact.list = contact_.entry.data();
  s.contact.length = contact_.found.data();
}

LazyZeroArray<int> SpatialLists::neighbours_by_slot(System const& s) const {
  LazyZeroArray<int> count(at(s.particles));
  for (std::size_t t = 0; t < spatial_.found.size() && t < spatial_.target.size(); ++t)
    count[at(grid_.slots()[spatial_.target[t]])] = spatial_.found[t];
  return count;
}

std::size_t SpatialLists::bytes() const {
  auto const of = [](List const& l) {
    return sizeof(Index) * (l.target.size() + l.entry.size() + l.length.size() + l.found.size());
  };
  return grid_.bytes() + of(spatial_) + of(contact_) + records_.bytes() + results_.bytes() +
         sizeof(Index) * result_of_.size() + marks_.bytes();
}

}  // namespace piola::adaptle
