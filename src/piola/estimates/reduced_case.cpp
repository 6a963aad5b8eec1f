// SPDX-License-Identifier: Apache-2.0
#include "piola/estimates/reduced_case.hpp"
#include "piola/base/contracts.hpp"
#include "piola/setup/shapes.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

/// Moves the last body of the set along x, out of reach of those before it.
void move_away(ParticleSet& set) {
  constexpr double far = 20;  // spacings
  Body const& last = set.bodies.back();
  auto& X = set.X.own();
  double before = 0, first = 0, spacing = 0;
  for (std::int64_t id = 0; id < last.last; ++id) {
    double const x = X[static_cast<std::size_t>(id)][0];
    if (id < last.first)
      before = id == 0 ? x : std::max(before, x);
    else
      first = id == last.first ? x : std::min(first, x);
  }
  for (Body const& body : set.bodies)
    spacing = std::max(spacing, *std::max_element(body.spacing.begin(), body.spacing.begin() + set.dimension));
  for (std::int64_t id = last.first; id < last.last; ++id)
    X[static_cast<std::size_t>(id)][0] += before + far * spacing - first;
}

}  // namespace

ShapeSpec part_of(ShapeSpec const& shape, int particles) {
  PIOLA_EXPECTS(shape.dimension >= 1 && shape.dimension <= 3);
  PIOLA_EXPECTS(particles >= 3);
  ShapeSpec part = shape;
  if (shape.kind == ShapeSpec::Kind::solid || shape.kind == ShapeSpec::Kind::points) {
    // A shaken box stands for it.
    part.kind = ShapeSpec::Kind::box;
    part.jitter = shape.arrangement == ShapeSpec::Arrangement::packed ? 0.2 : 0;
    part.arrangement = ShapeSpec::Arrangement::lattice;
    auto const n = static_cast<double>(count_particles(shape));
    int const across = std::clamp(static_cast<int>(std::pow(n, 1.0 / shape.dimension)), 3, particles);
    for (std::size_t d = 0; d < static_cast<std::size_t>(shape.dimension); ++d) {
      part.particles[d] = across;
      part.max[d] = across * shape.spacing;
    }
    return part;
  }
  auto const spacing = spacing_of(shape);
  bool const cells = shape.placement == ShapeSpec::Placement::cell_centred;
  for (std::size_t d = 0; d < static_cast<std::size_t>(shape.dimension); ++d) {
    if (shape.particles[d] <= particles || shape.kind != ShapeSpec::Kind::box) continue;
    part.particles[d] = particles;
    part.max[d] = shape.min[d] + (cells ? particles : particles - 1) * spacing[d];
  }
  if (shape.kind == ShapeSpec::Kind::box) return part;
  double const reach = particles * shape.spacing;
  part.length = std::min(shape.length, reach);
  part.radius = std::min(shape.radius, 0.5 * reach);
  if (part.radius < shape.radius) part.inner_radius = std::max(0.0, part.radius - (shape.radius - shape.inner_radius));
  if (part.inner_radius < 0.05 * part.radius) part.inner_radius = 0;
  return part;
}

Assembly part_of_case(CaseSpec const& spec, std::size_t body, int particles) {
  PIOLA_EXPECTS(body < spec.bodies.size());
  constexpr int few = 4;
  Assembly a;
  a.cfl = spec.run.cfl;
  a.backend = spec.run.backend;
  auto const add = [&](BodySpec const& from, int along) {
    a.materials.push_back(from.material);
    a.formulations.push_back(from.formulation);
    fill(part_of(from.shape, along), from.name, a.particles);
  };
  add(spec.bodies[body], particles);
  auto const info = find_formulation(spec.bodies[body].formulation.name);
  if (!info || !info->contact) return a;
  if (spec.contact) a.contact = *spec.contact;
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    if (b == body || spec.bodies[b].formulation.name != info->name) continue;
    add(spec.bodies[b], few);
    move_away(a.particles);
  }
  return a;
}

}  // namespace piola
