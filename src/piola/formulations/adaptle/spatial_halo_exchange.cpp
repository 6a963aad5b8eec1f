// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/adaptle/spatial_halo_exchange.hpp"
#include "piola/domain/communicator.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/adaptle/spatial_lists.hpp"
#include "piola/formulations/adaptle/subscript.hpp"
#include <algorithm>
#include <cstring>
#include <iterator>

namespace piola::adaptle {
namespace {

/// A particle in a message: its slot, then its position.
constexpr std::size_t of_position = 4;

/// Start of the values of each rank among those of all, and their number last. own: number of this rank.
std::vector<std::size_t> starts_of(std::size_t own) {
  std::vector<std::size_t> starts{0};
  for (std::size_t const count : comm::allgather_item(own)) starts.push_back(starts.back() + count);
  return starts;
}

}  // namespace

SpatialHaloExchange::SpatialHaloExchange(std::span<Partition const> cuts)
    : others_(at(comm::size())), is_near_(others_.size()), sends_(at(comm::size())), receives_(at(comm::size())) {
  for (Partition const& body : cuts)
    for (Index i = body.own().first; i < body.own().last; ++i) own_.push_back(i);
}

std::vector<double> SpatialHaloExchange::coordinates(System const& s, std::size_t axis) const {
  std::vector<std::size_t> const starts = starts_of(own_.size());
  std::vector<double> all(starts.back());
  double* to = all.data() + starts[at(comm::rank())];
  for (Index const slot : own_) *to++ = s.position[3 * at(slot) + axis];
  comm::allgather(all, starts);
  return all;
}

void SpatialHaloExchange::forget() {
  for (auto* sides : {&sends_, &receives_})
    for (Side& side : *sides) {
      side.overlaps = false;
      side.slots.clear();
      for (auto& particles : side.particles) particles.clear();
    }
}

void SpatialHaloExchange::find_own_cells(System const& s, CellList const& grid) {
  constexpr Index none = -1;
  number_of_.assign(at(grid.cell_count()), none);
  mine_.clear();
  std::vector<std::array<double, 3>> corner;
  for (Index const slot : own_) {
    Index const cell = grid.keys()[slot];
    Index& number = number_of_[at(cell)];
    if (number == none) {
      number = static_cast<Index>(mine_.size());
      mine_.push_back({cell, s.body_of[slot]});
      corner.push_back(grid.corner(cell));
    }
    std::array<double, 3> place = grid.where(slot);
    for (std::size_t c = 0; c < 3; ++c) place[c] -= corner[at(number)][c];
    mine_[at(number)].add(s.body_of[slot], s.description.eulerian[slot] != 0, place);
  }
}

/// Finds the remote ranks that are near, and the local cells near each of them: those from which that rank derives what
/// its cells and the adjacent ones read and export.
void SpatialHaloExchange::select_cells(CellList const& grid, std::span<CoordinateBounds const> bounds) {
  constexpr Index layers = 3;  // adjacent cells, those that these read, and those around them
  auto const box_of = [&](CoordinateBounds const& of_rank) {
    if (!of_rank.all_finite) return CellBox{{0, 0, 0}, grid.shape()};
    return CellBox{grid.indices_of(of_rank.low), grid.indices_of(of_rank.high)};
  };
  auto const is_empty = [](CoordinateBounds const& b) { return b.all_finite && b.low[0] > b.high[0]; };
  CoordinateBounds const& own = bounds[at(comm::rank())];
  for (std::size_t rank = 0; rank < bounds.size(); ++rank) {
    CellBox const box = box_of(bounds[rank]);
    others_[rank].clear();
    is_near_[rank] =
        rank != at(comm::rank()) && !is_empty(own) && !is_empty(bounds[rank]) && box.is_within(box_of(own), layers);
    for (std::size_t k = 0; k < mine_.size() && is_near_[rank]; ++k) {
      std::array<Index, 3> const place = grid.indices_of(mine_[k].cell);
      if (CellBox{place, place}.is_within(box, layers)) others_[rank].push_back(mine_[k]);
    }
  }
}

/// Exchanges the cells of select_cells(): first their numbers.
void SpatialHaloExchange::exchange_cells() {
  constexpr std::size_t width = sizeof(HaloCells::Cell) / sizeof(double);
  static_assert(width * sizeof(double) == sizeof(HaloCells::Cell), "a cell travels as numbers");
  for (std::size_t rank = 0; rank < others_.size(); ++rank) {
    sends_[rank].values.assign(is_near_[rank] ? 1 : 0, static_cast<double>(others_[rank].size()));
    receives_[rank].values.assign(is_near_[rank] ? 1 : 0, 0);
  }
  send();
  for (std::size_t rank = 0; rank < others_.size(); ++rank) {
    std::vector<double>&out = sends_[rank].values, &in = receives_[rank].values;
    out.resize(others_[rank].size() * width);
    std::memcpy(out.data(), others_[rank].data(), out.size() * sizeof(double));
    others_[rank].resize(is_near_[rank] ? static_cast<std::size_t>(in.front()) : 0);
    in.resize(others_[rank].size() * width);
  }
  send();
  for (std::size_t rank = 0; rank < others_.size(); ++rank) {
    std::vector<double> const& in = receives_[rank].values;
    std::memcpy(static_cast<void*>(others_[rank].data()), in.data(), in.size() * sizeof(double));
  }
}

/// Selects the particles to send to each rank: those within one cell edge of the bounds of that rank's reading
/// particles.
void SpatialHaloExchange::select_sends(CellList const& grid, HaloCells const& marks) {
  int const own = comm::rank();
  readers_.clear();
  first_reader_.assign(1, 0);
  for (HaloCells::Cell const& mine : mine_) {
    for (HaloCells::Reader const& reader : marks.readers(mine.cell, own)) {
      readers_.push_back({reader.rank, reader.box.bounds(grid.corner(reader.cell))});
      sends_[at(reader.rank)].overlaps = true;
    }
    first_reader_.push_back(readers_.size());
    marks.each_exporter(mine.cell, own, [&](int rank) { receives_[at(rank)].overlaps = true; });
  }
  double const reach = grid.search_radius_in_cells();
  for (Index const slot : own_) {
    auto const number = at(number_of_[at(grid.keys()[slot])]);
    if (first_reader_[number] == first_reader_[number + 1]) continue;
    std::array<double, 3> const place = grid.where(slot);
    int last_sent = own;
    for (std::size_t k = first_reader_[number]; k < first_reader_[number + 1]; ++k) {
      // The comparison is false for NaN, so particles with NaN positions are sent.
      if (readers_[k].rank == last_sent || readers_[k].where.square_from(place) > reach * reach) continue;
      last_sent = readers_[k].rank;
      sends_[at(last_sent)].slots.push_back(slot);
    }
  }
}

/// Exchanges the number of particles to send, between ranks with adjacent cells.
void SpatialHaloExchange::send_counts() {
  for (Side& side : sends_) side.values.assign(side.overlaps ? 1 : 0, static_cast<double>(side.slots.size()));
  for (Side& side : receives_) side.values.assign(side.overlaps ? 1 : 0, 0);
  send();
  for (Side& side : receives_) side.slots.resize(side.overlaps ? static_cast<std::size_t>(side.values.front()) : 0);
}

/// The values of all sides, which have their sizes.
void SpatialHaloExchange::send() {
  auto const messages = [](std::vector<Side>& sides) {
    std::vector<comm::Message> all;
    for (std::size_t rank = 0; rank < sides.size(); ++rank)
      if (std::vector<double>& values = sides[rank].values; !values.empty())
        all.push_back({static_cast<int>(rank), values.data(), values.size()});
    return all;
  };
  comm::exchange(messages(receives_), messages(sends_));
}

void SpatialHaloExchange::send_positions(System const& s) {
  for (auto* sides : {&sends_, &receives_})
    for (Side& side : *sides) side.values.resize(side.slots.size() * of_position);
  for (Side& side : sends_)
    for (std::size_t k = 0; k < side.slots.size(); ++k) {
      double* to = &side.values[k * of_position];
      *to = side.slots[k];
      std::copy_n(s.position + std::ptrdiff_t{3} * side.slots[k], 3, to + 1);
    }
  send();
  received_.clear();
  for (Side& side : receives_)
    for (std::size_t k = 0; k < side.slots.size(); ++k) {
      double const* from = &side.values[k * of_position];
      side.slots[k] = static_cast<Index>(*from);
      std::copy_n(from + 1, 3, s.position + std::ptrdiff_t{3} * side.slots[k]);
      received_.push_back(side.slots[k]);
    }
}

void SpatialHaloExchange::meet(System const& s, CellList const& grid, std::span<CoordinateBounds const> bounds,
                               HaloCells& marks) {
  forget();
  find_own_cells(s, grid);
  select_cells(grid, bounds);
  exchange_cells();
  marks.start(grid.shape(), s.dimension);
  for (std::size_t rank = 0; rank < sends_.size(); ++rank)
    for (HaloCells::Cell const& cell : rank == at(comm::rank()) ? mine_ : others_[rank])
      marks.add(cell, static_cast<int>(rank));
  marks.finish(SpatialLists::touching(s));
  select_sends(grid, marks);
  send_counts();
  send_positions(s);
  std::ranges::sort(received_);
  present_.clear();
  std::ranges::merge(own_, received_, std::back_inserter(present_));
}

void SpatialHaloExchange::Side::choose(CellList const& grid, HaloCells const& marks) {
  for (Index const slot : slots) {
    std::uint8_t const exported = marks.exports(grid.keys()[slot]);
    if ((exported & HaloCells::flow) != 0) particles[flow].push_back(grid.sorted()[slot]);
    if ((exported & HaloCells::touch) != 0) particles[touch].push_back(slot);
  }
}

void SpatialHaloExchange::choose(CellList const& grid, HaloCells const& marks) {
  for (auto* sides : {&sends_, &receives_})
    for (Side& side : *sides) side.choose(grid, marks);
}

std::size_t SpatialHaloExchange::width_of(std::vector<FieldPart> const& parts) {
  std::size_t width = 0;
  for (FieldPart const& part : parts) width += at(part.count);
  return width;
}

std::size_t SpatialHaloExchange::Side::numbers(FieldGroups const& fields) const {
  std::size_t count = 0;
  for (std::size_t kind = 0; kind < fields.size(); ++kind) count += particles[kind].size() * width_of(fields[kind]);
  return count;
}

template <class F>
void SpatialHaloExchange::Side::each(FieldGroups const& fields, F const& f) {
  double* first = values.data();
  for (std::size_t kind = 0; kind < fields.size(); ++kind) {
    std::size_t const width = width_of(fields[kind]);
    exec_host::parallel_for(static_cast<Index>(particles[kind].size()), [&](Index k) {
      double* value = first + at(k) * width;
      for (FieldPart const& part : fields[kind])
        for (int c = 0; c < part.count; ++c) f(*value++, value_at(part.field, particles[kind][at(k)], part.first + c));
    });
    first += particles[kind].size() * width;
  }
}

void SpatialHaloExchange::exchange(FieldGroups const& fields) {
  for (auto* sides : {&sends_, &receives_})
    for (Side& side : *sides) side.values.resize(side.numbers(fields));
  for (Side& side : sends_) side.each(fields, [](double& value, double& here) { value = here; });
  send();
  for (Side& side : receives_) side.each(fields, [](double& value, double& here) { here = value; });
}

}  // namespace piola::adaptle
