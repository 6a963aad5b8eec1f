// SPDX-License-Identifier: Apache-2.0
#include "piola/parallel/cell_marks.hpp"
#include "piola/exec/set_up_loop.hpp"

namespace piola {

template <class F>
void CellMarks::each_occupied(F const& f) const {
  exec_host::for_each_in_set_up(static_cast<Index>(body_.size()), [&](Index cell) {
    if (body_[static_cast<std::size_t>(cell)] != nobody) f(cell);
  });
}

void CellMarks::start(std::array<Index, 3> const& shape, int dimension, bool owners) {
  shape_ = shape;
  dimension_ = dimension;
  std::size_t cells = 1;
  for (Index const n : shape) cells *= static_cast<std::size_t>(n);
  body_.assign(cells, nobody);
  for (auto* marks : {&flows_, &reads_, &told_}) marks->assign(cells, 0);
  owners_.assign(owners ? cells : 0, {});
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

RankSet CellMarks::readers(Index cell) const {
  RankSet all;
  each_around(cell, [&](std::size_t other) {
    if (reads_[other] != 0) all.add(owners_[other]);
  });
  return all;
}

std::size_t CellMarks::bytes() const { return body_.size() * (sizeof(Index) + 3) + owners_.size() * sizeof(RankSet); }

}  // namespace piola
