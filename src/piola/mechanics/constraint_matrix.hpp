// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/envelope_cholesky.hpp"
#include "piola/mechanics/prescribed.hpp"
#include <algorithm>
#include <vector>

namespace piola {

/// C M^-1 C^T, factorised. Row r of C is the weighted mean of a vector over particles along a direction: `rows` have
/// first and last, indices in `weights`, and direction; `weights` have particle and weight, each particle once in a
/// row. `mass`: of particle a, or its substitute.
template <class Rows, class Weights, class Mass>
EnvelopeCholesky constraint_matrix(Rows const& rows, Weights const& weights, std::size_t particles, Mass const& mass) {
  struct RowEntry {
    std::size_t row;
    double weight;
  };
  std::vector<std::vector<RowEntry>> of_particle(particles);
  for (std::size_t r = 0; r < rows.size(); ++r)
    for (auto k = rows[r].first; k < rows[r].last; ++k)
      of_particle[weights[k].particle].push_back({r, weights[k].weight});
  auto const each_entry = [&](auto const& f) {
    for (std::size_t a = 0; a < particles; ++a)
      for (auto const& i : of_particle[a])
        for (auto const& j : of_particle[a]) {
          double const along = dot(rows[i.row].direction, rows[j.row].direction);
          if (j.row <= i.row && along != 0) f(i.row, j.row, i.weight * j.weight * along / mass(a));
        }
  };
  std::vector<std::size_t> first(rows.size());
  for (std::size_t r = 0; r < rows.size(); ++r) first[r] = r;
  each_entry([&](std::size_t i, std::size_t j, double) { first[i] = std::min(first[i], j); });
  EnvelopeCholesky matrix(std::move(first));
  each_entry([&](std::size_t i, std::size_t j, double entry) { matrix.at(i, j) += entry; });
  matrix.factorise();
  return matrix;
}

}  // namespace piola
