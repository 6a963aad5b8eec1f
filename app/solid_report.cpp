// SPDX-License-Identifier: Apache-2.0
#include "solid_report.hpp"
#include "piola/base/text.hpp"
#include "piola/geometry/patch_measures.hpp"
#include "piola/setup/cloud_checks.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "streams.hpp"
#include <cmath>

namespace piola::app {
namespace {

/// "(1, 2, 0)"; values that are 0 up to round-off are printed as 0.
std::string place_text(Vec<3> const& v, int dimension, double size) {
  std::string text = "(";
  for (int c = 0; c < dimension; ++c)
    text += (c > 0 ? ", " : "") + number_text(std::abs(v[c]) < 1e-4 * size ? 0.0 : v[c], 4);
  return text + ")";
}

double size_of(ShapeSpec const& shape) {
  geometry::Bounds const box = shape.solid->bounds();
  return std::sqrt(dot(box.max - box.min, box.max - box.min));
}

void say_volume(ShapeSpec const& shape) {
  print_result("  {} {}", shape.axisymmetric ? "section" : "volume",
               quantity_text(shape.volume, shape.dimension == 2 ? "m^2" : "m^3"));
  if (shape.arrangement == ShapeSpec::Arrangement::packed) {
    SolidParticles const& particles = SolidParticles::of(shape);
    geometry::PackingQuality const q =
        geometry::quality_of(*shape.solid, {particles.X, particles.volume, particles.spacing, particles.sweeps});
    print_result(
        "; packed in {} sweeps: nearest particles {:.2f} spacings apart on average, {:.2f} at least, {:.0f} % of the "
        "outer layer in place, the surface within {:.2f} spacings of a particle",
        particles.sweeps, q.nearest_mean, q.nearest_least, 100 * q.in_place, q.gap);
  }
  print_result("\n");
  if (auto const thin = shape.solid_particles->thinnest(shape))
    print_result("  thinnest where it is {:.3g} spacings thick, around {} m\n", thin->thickness / shape.spacing,
                 place_text(thin->X, shape.dimension, size_of(shape)));
}

void say_patches(ShapeSpec const& shape) {
  for (geometry::PatchFacts const& patch : geometry::patch_facts(*shape.solid, 0.25 * shape.spacing)) {
    print_result("  patch \"{}\": {} around {} m", patch.name,
                 quantity_text(patch.area, shape.dimension == 2 ? "m" : "m^2"),
                 place_text(patch.centre, shape.dimension, size_of(shape)));
    if (std::sqrt(dot(patch.direction, patch.direction)) > 0.999)
      print_result(", normal {}", place_text(patch.direction, shape.dimension, 1));
    print_result("\n");
  }
}

void say_neighbourhood(ParticleSet const& particles, Body const& body) {
  if (body.first == body.last) return;
  WorstNeighbourhood const worst = worst_neighbourhood(particles, body);
  auto const& X = particles.X[worst.point];
  double const across = static_cast<double>(std::max({body.lattice[0], body.lattice[1], body.lattice[2]}));
  print_result(
      "  worst neighbourhood: the smallest eigenvalue of the gradient's matrix is {:.2g} of the usual one, with {} "
      "neighbours, at {} m\n",
      worst.part(), worst.neighbours, place_text({{X[0], X[1], X[2]}}, particles.dimension, across * body.spacing[0]));
}

}  // namespace

void print_solid_report(ShapeSpec const& shape, ParticleSet const& particles, Body const& body) {
  if (shape.solid) say_volume(shape);
  if (body.off_lattice) say_neighbourhood(particles, body);
  if (shape.solid) say_patches(shape);
}

}  // namespace piola::app
