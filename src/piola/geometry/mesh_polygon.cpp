// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_polygon.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cstddef>

namespace piola::geometry {

namespace {

/// The polygon's normal times twice its area (Newell).
Vec<3> normal_of_loop(std::span<Vec<3> const> X, std::vector<int> const& loop) {
  Vec<3> sum;
  for (std::size_t i = 1; i + 1 < loop.size(); ++i)
    sum = sum + cross(X[loop[i]] - X[loop[0]], X[loop[i + 1]] - X[loop[0]]);
  return sum;
}

bool is_ear(std::span<Vec<3> const> X, std::vector<int> const& loop, std::size_t tip, Vec<3> const& n) {
  std::size_t const size = loop.size();
  int const corner[3] = {loop[(tip + size - 1) % size], loop[tip], loop[(tip + 1) % size]};
  Vec<3> const a = X[corner[0]], b = X[corner[1]], c = X[corner[2]];
  if (!(dot(n, cross(b - a, c - a)) > 0)) return false;
  auto const blocks = [&](int other) {
    if (other == corner[0] || other == corner[1] || other == corner[2]) return false;
    Vec<3> const p = X[other];
    return dot(n, cross(b - a, p - a)) >= 0 && dot(n, cross(c - b, p - b)) >= 0 && dot(n, cross(a - c, p - c)) >= 0;
  };
  return std::none_of(loop.begin(), loop.end(), blocks);
}

std::size_t next_tip(std::span<Vec<3> const> X, std::vector<int> const& loop, Vec<3> const& n) {
  std::size_t const size = loop.size();
  for (std::size_t tip = 1; tip < size; ++tip)
    if (is_ear(X, loop, tip, n)) return tip;
  if (is_ear(X, loop, 0, n)) return 0;
  std::size_t best = 1;
  double most = -1e300;
  for (std::size_t tip = 0; tip < size; ++tip) {
    Vec<3> const a = X[loop[(tip + size - 1) % size]];
    double const turn = dot(n, cross(X[loop[tip]] - a, X[loop[(tip + 1) % size]] - a));
    if (turn > most) {
      most = turn;
      best = tip;
    }
  }
  return best;
}

}  // namespace

void cut_polygon(std::span<Vec<3> const> X, std::span<int const> loop, std::vector<std::array<int, 3>>& triangles) {
  PIOLA_EXPECTS(loop.size() >= 3);
  std::vector<int> left(loop.begin(), loop.end());
  Vec<3> const n = normal_of_loop(X, left);
  while (left.size() > 3) {
    std::size_t const tip = next_tip(X, left, n), size = left.size();
    triangles.push_back({left[(tip + size - 1) % size], left[tip], left[(tip + 1) % size]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(tip));
  }
  triangles.push_back({left[0], left[1], left[2]});
}

}  // namespace piola::geometry
