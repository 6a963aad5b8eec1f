// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/shapes.hpp"
#include "piola/base/contracts.hpp"
#include "piola/geometry/packing.hpp"
#include "piola/particles/body_range.hpp"
#include "piola/setup/cloud_file.hpp"
#include "piola/setup/lattice_generator.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "piola/setup/random_cloud.hpp"
#include "piola/setup/rings.hpp"
#include "piola/setup/solids_of_revolution.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

bool are_points(ShapeSpec const& shape) { return shape.kind == ShapeSpec::Kind::points; }
bool is_solid(ShapeSpec const& shape) { return shape.kind == ShapeSpec::Kind::solid; }
bool in_rings(ShapeSpec const& shape) {
  return !is_solid(shape) && !are_points(shape) && shape.arrangement != ShapeSpec::Arrangement::lattice;
}

/// The exact region of a shape, whatever its particles are.
Outline outline_of(ShapeSpec const& shape) {
  if (shape.kind == ShapeSpec::Kind::box) return {shape.min, shape.max};
  Outline outline;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    bool const along = along_axis(shape, d);
    outline.min[i] = along ? shape.centre[i] : shape.centre[i] - shape.radius;
    outline.max[i] = along ? shape.centre[i] + shape.length : shape.centre[i] + shape.radius;
  }
  if (shape.axisymmetric) outline.min[0] = std::max(outline.min[0], 0.0);
  outline.inside = [shape](Vec3 const& X) {
    double square = 0;
    for (int d = 0; d < shape.dimension; ++d) {
      auto const i = static_cast<std::size_t>(d);
      if (!along_axis(shape, d)) square += (X[i] - shape.centre[i]) * (X[i] - shape.centre[i]);
    }
    return square <= shape.radius * shape.radius && square >= shape.inner_radius * shape.inner_radius;
  };
  return outline;
}

double count_estimate(ShapeSpec const& shape) {
  double total = 1;
  for (int const n : lattice_of(shape).count) total *= n;
  if (shape.kind == ShapeSpec::Kind::box) return total;
  return total * 0.5;  // between pi/6 and pi/4 of the enclosing lattice is inside
}

}  // namespace

std::int64_t count_particles(ShapeSpec const& shape) {
  constexpr double countable = 1e8;
  if (are_points(shape)) return shape.cloud ? static_cast<std::int64_t>(shape.cloud->X.size()) : 0;
  if (is_solid(shape))
    return static_cast<std::int64_t>(
        std::min(geometry::packed_count(shape.volume, shape.spacing, shape.dimension), 9e18));
  if (in_rings(shape)) return static_cast<std::int64_t>(std::min(count_ring_particles(shape), 9e18));
  double const estimate = count_estimate(shape);
  if (shape.kind == ShapeSpec::Kind::box || estimate > countable)
    return static_cast<std::int64_t>(std::min(estimate, 9e18));
  return LatticeGenerator(shape).size();
}

std::array<double, 3> spacing_of(ShapeSpec const& shape) {
  if (is_solid(shape) || are_points(shape)) {
    std::array<double, 3> spacing{1, 1, 1};
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c) spacing[c] = shape.spacing;
    return spacing;
  }
  if (!in_rings(shape)) return lattice_of(shape).spacing;
  double const width = shape.radius - shape.inner_radius;
  double const d = shape.inner_radius > 0 ? width / cells_over(width, shape.spacing) : shape.spacing;
  return {d, d, 1};
}

int particles_over(double length, double spacing, ShapeSpec::Placement placement) {
  double const cells = std::round(length / spacing);
  if (!(cells < std::numeric_limits<int>::max() - 1)) return std::numeric_limits<int>::max();
  int const n = std::max(0, static_cast<int>(cells));
  if (placement == ShapeSpec::Placement::on_boundary) return n + 1;
  return std::max(1, n);
}

namespace {

void fill_rings(ShapeSpec const& shape, ParticleSet& set, Body& body) {
  RingParticles const rings = ring_particles(shape);
  body.spacing = rings.spacing;
  body.lattice = rings.lattice;
  body.regular = false;
  body.off_lattice = true;
  auto const append = [](auto const& from, auto& to) {
    auto& own = to.own();
    own.insert(own.end(), from.begin(), from.end());
  };
  append(rings.X, set.X);
  append(rings.lattice_index, set.lattice_index);
  append(rings.volume, set.volume);
  append(rings.volume, set.kernel_volume);
  set.body.resize(set.X.size(), static_cast<int>(set.bodies.size()));
}

void fill_lattice(ShapeSpec const& shape, ParticleSet& set, Body& body) {
  LatticeGenerator const generator(shape);
  body.spacing = generator.lattice().spacing;
  body.lattice = generator.lattice().count;
  body.regular = !(shape.jitter > 0) && !shape.random;
  auto const runs = generator.runs();
  std::size_t const first = set.X.size();
  std::size_t const size =
      runs.empty() ? first : first + static_cast<std::size_t>(runs.back().id + runs.back().last - runs.back().first);
  auto& X = set.X.own();
  auto& lattice_index = set.lattice_index.own();
  auto& volume = set.volume.own();
  X.resize(size);
  lattice_index.resize(size);
  volume.resize(size);
  set.kernel_volume.resize(size, generator.kernel_volume());
  set.body.resize(size, static_cast<int>(set.bodies.size()));
  LatticeGenerator::each_run(runs, [&](std::size_t run, std::int64_t i) {
    std::size_t const at = first + static_cast<std::size_t>(runs[run].id + (i - runs[run].first));
    lattice_index[at] = {static_cast<int>(i), runs[run].j, runs[run].k};
    GeneratedParticle const particle = generator.at(lattice_index[at]);
    X[at] = particle.X;
    volume[at] = particle.volume;
  });
}

}  // namespace

void fill(ShapeSpec const& shape, std::string const& name, ParticleSet& set) {
  PIOLA_EXPECTS(!is_solid(shape) || shape.solid_particles != nullptr);
  PIOLA_EXPECTS(!shape.random || shape.kind == ShapeSpec::Kind::box);
  PIOLA_EXPECTS(shape.dimension >= 1 && shape.dimension <= 3);
  Body body;
  body.name = name;
  body.first = set.size();
  if (!is_solid(shape) && !are_points(shape)) body.outline = outline_of(shape);
  if (is_solid(shape))
    fill_solid(shape, set, body);
  else if (are_points(shape))
    fill_points(shape, set, body);
  else if (in_rings(shape))
    fill_rings(shape, set, body);
  else
    fill_lattice(shape, set, body);
  body.last = set.size();
  if (set.axisymmetric) take_ring_volumes(shape, set, body);
  PIOLA_ENSURES(is_range_in(body, set));
  PIOLA_ENSURES(set.volume.size() == set.X.size() && set.kernel_volume.size() == set.X.size());
  PIOLA_ENSURES(set.lattice_index.size() == set.X.size() && set.body.size() == set.X.size());
  if (!set.crack_side.empty()) set.crack_side.resize(set.X.size());
  set.dimension = shape.dimension;
  if (shape.random) scatter(shape, set, body);
  set.bodies.push_back(std::move(body));
}

}  // namespace piola
