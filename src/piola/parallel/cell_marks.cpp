// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/cell_marks.hpp"
#include "piola/exec/set_up_loop.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr double parts = 256;  ///< of an edge

}  // namespace

void CellBox::add(std::array<double, 3> const& place) {
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

double CellBox::square_from(std::array<double, 3> const& place) const {
  double sum = 0;
  for (std::size_t c = 0; c < 3 && anywhere_ == 0; ++c) {
    double const low = low_[c] / parts, high = (high_[c] + 1) / parts;
    double const outside = place[c] < low ? low - place[c] : place[c] > high ? place[c] - high : 0;
    sum += outside * outside;
  }
  return sum;
}

template <class F>
void CellMarks::each_occupied(F const& f) const {
  exec_host::for_each_in_set_up(static_cast<Index>(body_.size()), [&](Index cell) {
    if (body_[static_cast<std::size_t>(cell)] != nobody) f(cell);
  });
}

void CellMarks::start(std::array<Index, 3> const& shape, int dimension) {
  shape_ = shape;
  dimension_ = dimension;
  std::size_t cells = 1;
  for (Index const n : shape) cells *= static_cast<std::size_t>(n);
  body_.assign(cells, nobody);
  for (auto* marks : {&flows_, &reads_, &told_}) marks->assign(cells, 0);
  first_.clear();
  said_.clear();
}

void CellMarks::add(Cell const& of_rank, int rank) {
  if (first_.empty()) first_.assign(body_.size(), none);
  Index& first = first_[static_cast<std::size_t>(of_rank.cell)];
  said_.push_back({of_rank, rank, first});
  first = static_cast<Index>(said_.size()) - 1;
  add(of_rank.cell, of_rank.body, of_rank.flows != 0);
}

void CellMarks::finish(bool touching) {
  each_occupied([&](Index cell) {
    bool flows = false, meets = false;
    Index const mine = body_[static_cast<std::size_t>(cell)];
    each_around(cell, [&](std::size_t other) {
      flows = flows || flows_[other] != 0;
      meets = meets || (body_[other] != nobody && body_[other] != mine) || body_[other] == several;
    });
    reads_[static_cast<std::size_t>(cell)] =
        static_cast<std::uint8_t>((flows ? flow : 0) | (touching && meets ? touch : 0));
  });
  // Bodies touch from both sides, so that those who are read of read, too; beside what flows they need not.
  each_occupied([&](Index cell) {
    bool flows = false;
    each_around(cell, [&](std::size_t other) { flows = flows || (reads_[other] & flow) != 0; });
    int const told = (reads_[static_cast<std::size_t>(cell)] & touch) | (flows ? flow : 0);
    told_[static_cast<std::size_t>(cell)] = static_cast<std::uint8_t>(told);
  });
}

std::vector<CellMarks::Reader> CellMarks::readers(Index cell, int own) const {
  std::vector<Reader> all;
  each_around(cell, [&](std::size_t other) {
    if (reads_[other] == 0) return;
    for (Index k = first_[other]; k != none; k = said_[static_cast<std::size_t>(k)].next) {
      Said const& said = said_[static_cast<std::size_t>(k)];
      if (said.rank != own) all.push_back({said.rank, said.cell.cell, said.cell.box});
    }
  });
  std::ranges::sort(all, {}, &Reader::rank);
  return all;
}

std::size_t CellMarks::bytes() const {
  return body_.size() * (sizeof(Index) + 3) + first_.size() * sizeof(Index) + said_.size() * sizeof(Said);
}

}  // namespace piola
