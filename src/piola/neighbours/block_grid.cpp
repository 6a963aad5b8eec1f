// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/block_grid.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <cmath>

namespace piola {

BlockGrid::BlockGrid(Body const& body, int dimension)
    : outline_(body.outline), D_(static_cast<std::size_t>(dimension)) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  constexpr double per_spacing = 6;
  for (std::size_t c = 0; c < D_; ++c) {
    double const length = outline_.max[c] - outline_.min[c];
    count_[c] = std::max(1L, std::lround(per_spacing * length / body.spacing[c]));
    edge_[c] = length / static_cast<double>(count_[c]);
  }
  if (outline_.inside) fill_inside();
}

void BlockGrid::fill_inside() {
  std::vector<char> inside(static_cast<std::size_t>(rows() * in_row()));
  exec_host::parallel_for(static_cast<Index>(rows()), [&](Index row) {
    long known = 0;  // up to here all is as the block before
    for (long i = 0; i < in_row(); ++i) {
      Place const place = place_of(row, i);
      std::size_t const at = index(place);
      if (i < known) {
        inside[at] = inside[at - 1];
        continue;
      }
      Point const X = middle(place);
      double const distance = outline_.distance ? outline_.distance(X) : 0;
      inside[at] = outline_.distance ? distance <= 0 : outline_.inside(X);
      known = i + std::max(1L, static_cast<long>(std::abs(distance) / edge_[0]));
    }
  });
  inside_ = std::move(inside);
}

std::size_t BlockGrid::index(Place const& at) const {
  return static_cast<std::size_t>((at[2] * count_[1] + at[1]) * count_[0] + at[0]);
}

BlockGrid::Point BlockGrid::middle(Place const& at) const {
  Point X{};
  for (std::size_t c = 0; c < D_; ++c) X[c] = outline_.min[c] + (static_cast<double>(at[c]) + 0.5) * edge_[c];
  return X;
}

bool BlockGrid::is_beyond(Place const& at) const {
  for (std::size_t c = 0; c < 3; ++c)
    if (at[c] < 0 || at[c] >= count_[c]) return true;
  return false;
}

bool BlockGrid::is_inside(Place const& at) const {
  return !is_beyond(at) && (inside_.empty() || inside_[index(at)] != 0);
}

std::size_t BlockGrid::corners() const {
  std::size_t product = 1;
  for (std::size_t c = 0; c < D_; ++c) product *= static_cast<std::size_t>(count_[c]) + 1;
  return product;
}

std::size_t BlockGrid::corner_index(Place const& at) const {
  std::size_t index = 0;
  for (std::size_t c = D_; c-- > 0;)
    index = index * (static_cast<std::size_t>(count_[c]) + 1) + static_cast<std::size_t>(at[c]);
  return index;
}

BlockGrid::Point BlockGrid::corner_at(Place const& at) const {
  Point X{};
  for (std::size_t c = 0; c < D_; ++c)
    X[c] = at[c] == count_[c] ? outline_.max[c] : outline_.min[c] + static_cast<double>(at[c]) * edge_[c];
  return X;
}

std::array<BlockGrid::Place, 4> BlockGrid::corners_of(Place low, std::size_t axis, bool upper) const {
  if (upper) ++low[axis];
  std::array<Place, 4> corner{low, low, low, low};
  if (D_ == 2) ++corner[1][1 - axis];
  if (D_ < 3) return corner;
  std::size_t const u = (axis + 1) % 3, v = (axis + 2) % 3;
  ++corner[1][u];
  ++corner[2][u];
  ++corner[2][v];
  ++corner[3][v];
  return corner;
}

}  // namespace piola
