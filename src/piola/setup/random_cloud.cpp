// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/random_cloud.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/particle_cells.hpp"
#include "piola/particles/body_range.hpp"
#include <random>

namespace piola {
namespace {

constexpr int lloyd_steps = 8;

/// Ids of the particles that are on no face.
std::vector<std::size_t> inner_particles(ShapeSpec const& shape, ParticleSet const& set, Body const& body) {
  std::vector<std::size_t> inner;
  for (auto id = static_cast<std::size_t>(body.first); id < static_cast<std::size_t>(body.last); ++id) {
    bool inside = true;
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c) {
      int const at = set.lattice_index[id][c];
      inside = inside && (body.lattice[c] == 1 || (at > 0 && at + 1 < body.lattice[c]));
    }
    if (inside) inner.push_back(id);
  }
  return inner;
}

}  // namespace

void scatter(ShapeSpec const& shape, ParticleSet& set, Body const& body) {
  PIOLA_EXPECTS(shape.kind == ShapeSpec::Kind::box);
  PIOLA_EXPECTS(is_range_in(body, set));
  auto const inner = inner_particles(shape, set, body);
  auto const D = static_cast<std::size_t>(shape.dimension);
  std::mt19937 engine(shape.seed);
  // The sequence of mt19937 is fixed by the C++ standard, that of its distributions is not.
  auto const fraction = [&] { return (static_cast<double>(engine()) + 0.5) / 4294967296.0; };
  for (auto const id : inner)
    for (std::size_t c = 0; c < D; ++c) {
      double const free = shape.max[c] - shape.min[c] - body.spacing[c];
      if (body.lattice[c] > 1) set.X[id][c] = shape.min[c] + 0.5 * body.spacing[c] + fraction() * free;
    }
  for (int step = 0; step < lloyd_steps; ++step) {
    auto const cells = measure_cells(set, body);
    for (auto const id : inner)
      for (std::size_t c = 0; c < D; ++c)
        set.X[id][c] += cells.cell[id - static_cast<std::size_t>(body.first)].centroid[c];
  }
  take_cell_volumes(set, body);
}

}  // namespace piola
