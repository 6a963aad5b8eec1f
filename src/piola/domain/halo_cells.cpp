// SPDX-License-Identifier: Apache-2.0
#include "piola/domain/halo_cells.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <limits>

namespace piola {
namespace {

constexpr double parts = 256;  ///< per edge

}  // namespace

void QuantisedBounds::add(std::array<double, 3> const& place) {
  for (std::size_t c = 0; c < 3; ++c) {
    if (!(place[c] >= 0 && place[c] < 1)) {
      anywhere_ = 1;
      return;
    }
    auto const part = static_cast<std::uint8_t>(parts * place[c]);
    low_[c] = std::min(low_[c], part);
    high_[c] = std::max(high_[c], part);
  }
}

QuantisedBounds::Bounds QuantisedBounds::bounds(std::array<double, 3> const& corner) const {
  constexpr double endless = std::numeric_limits<double>::infinity();
  Bounds here;
  for (std::size_t c = 0; c < 3; ++c) {
    here.low[c] = anywhere_ != 0 ? -endless : corner[c] + low_[c] / parts;
    here.high[c] = anywhere_ != 0 ? endless : corner[c] + (high_[c] + 1) / parts;
  }
  return here;
}

template <class F>
void HaloCells::each_occupied(F const& f) const {
  exec_host::parallel_for(static_cast<Index>(body_.size()), [&](Index cell) {
    if (body_[static_cast<std::size_t>(cell)] != no_body) f(cell);
  });
}

void HaloCells::start(std::array<Index, 3> const& shape, int dimension) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  PIOLA_EXPECTS(shape[0] > 0 && shape[1] > 0 && shape[2] > 0);
  shape_ = shape;
  dimension_ = dimension;
  std::size_t cells = 1;
  for (Index const n : shape) cells *= static_cast<std::size_t>(n);
  body_.assign(cells, no_body);
  for (auto* marks : {&has_eulerian_, &reads_, &exports_}) marks->assign(cells, 0);
  first_.clear();
  said_.clear();
}

void HaloCells::add(Cell const& of_rank, int rank) {
  PIOLA_EXPECTS(of_rank.cell >= 0 && static_cast<std::size_t>(of_rank.cell) < body_.size());
  PIOLA_EXPECTS(rank >= 0);
  if (first_.empty()) first_.assign(body_.size(), none);
  Index& first = first_[static_cast<std::size_t>(of_rank.cell)];
  said_.push_back({of_rank, rank, first});
  first = static_cast<Index>(said_.size()) - 1;
  add(of_rank.cell, of_rank.body, of_rank.is_eulerian != 0);
}

void HaloCells::finish(bool touching) {
  PIOLA_EXPECTS(!body_.empty());
  each_occupied([&](Index cell) {
    Index const mine = body_[static_cast<std::size_t>(cell)];
    bool const is_eulerian = any_around(cell, [&](std::size_t other) { return has_eulerian_[other] != 0; });
    bool const overlaps = touching && any_around(cell, [&](std::size_t other) {
                            return body_[other] == several || (body_[other] != no_body && body_[other] != mine);
                          });
    reads_[static_cast<std::size_t>(cell)] =
        static_cast<std::uint8_t>((is_eulerian ? flow : 0) | (overlaps ? touch : 0));
  });
  // Contact is symmetric: a cell that reads is also read. Next to Eulerian particles it is not, so exports are derived
  // separately.
  each_occupied([&](Index cell) {
    bool const is_eulerian = any_around(cell, [&](std::size_t other) { return (reads_[other] & flow) != 0; });
    int const exported = (reads_[static_cast<std::size_t>(cell)] & touch) | (is_eulerian ? flow : 0);
    exports_[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(exported);
  });
}

std::vector<HaloCells::Reader> HaloCells::readers(Index cell, int own) const {
  std::vector<Reader> all;
  if (exports(cell) == 0) return all;
  each_around(cell, [&](std::size_t other) {
    if (reads_[other] == 0) return;
    for (Index k = first_[other]; k != none; k = said_[static_cast<std::size_t>(k)].next) {
      OccupancyRecord const& said = said_[static_cast<std::size_t>(k)];
      if (said.rank != own) all.push_back({said.rank, said.cell.cell, said.cell.box});
    }
  });
  std::ranges::sort(all, {}, &Reader::rank);
  return all;
}

std::size_t HaloCells::bytes() const {
  return body_.size() * (sizeof(Index) + 3) + first_.size() * sizeof(Index) + said_.size() * sizeof(OccupancyRecord);
}

}  // namespace piola
