// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/solids_of_revolution.hpp"
#include "piola/base/contracts.hpp"
#include "piola/geometry/boolean_solid.hpp"
#include "piola/geometry/patch_measures.hpp"
#include "piola/geometry/primitives.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <algorithm>
#include <numbers>

namespace piola {
namespace {

/// The middle of the part of a particle's cell along the radius, on a lattice [m]. Of a box before jitter.
double radius_of_cell(ParticleSet const& set, Body const& body, std::size_t id) {
  auto const& box = body.outline;
  double const h = body.spacing[0], width = box.max[0] - box.min[0];
  bool const on_faces = h * body.lattice[0] > width + 0.5 * h;
  double const from = box.min[0] + h * (set.lattice_index[id][0] - (on_faces ? 0.5 : 0.0));
  double const low = box.inside ? set.X[id][0] - 0.5 * h : from;
  return 0.5 * (std::max(low, box.min[0]) + std::min(low + h, box.max[0]));
}

/// Volume swept by a section with this outline, int pi R^2 N_R ds, exact for polygons [m^3].
double swept_volume(geometry::Solid const& section, double edge) {
  std::vector<geometry::SurfacePiece> pieces;
  section.cut_surface(edge, pieces);
  double sum = 0;
  for (auto const& piece : pieces) {
    double const R = piece.X[0], width = piece.area[1];
    sum += std::numbers::pi * (R * R + width * width / 12) * piece.area[0];
  }
  return sum;
}

}  // namespace

double circle(double radius) { return 2 * std::numbers::pi * radius; }

void take_ring_volumes(ShapeSpec const& shape, ParticleSet& set, Body const& body) {
  PIOLA_EXPECTS(set.axisymmetric && shape.dimension == 2);
  if (shape.kind == ShapeSpec::Kind::points) return;  // the file has those of rings
  bool const solid = shape.kind == ShapeSpec::Kind::solid;
  auto& volume = set.volume.own();
  double sum = 0;
  for (auto id = static_cast<std::size_t>(body.first); id < static_cast<std::size_t>(body.last); ++id) {
    volume[id] *= circle(solid ? set.X[id][0] : radius_of_cell(set, body, id));
    sum += volume[id];
  }
  if (!solid || !(sum > 0)) return;
  double const factor = swept_volume(*shape.solid, 0.25 * body.spacing[0]) / sum;
  for (auto id = body.first; id < body.last; ++id) volume[static_cast<std::size_t>(id)] *= factor;
}

void take_ring_areas(ShapeSpec const& shape, ParticleSet const& set, Face const& face,
                     std::vector<FaceWeight>& weights) {
  for (FaceWeight& weight : weights) {
    auto const id = static_cast<std::size_t>(weight.particle);
    Body const& body = set.bodies[static_cast<std::size_t>(set.body[id])];
    bool const across = face.part == Face::Part::flat && face.axis == 0;
    weight.area *= circle(across ? (face.upper ? shape.max[0] : shape.min[0]) : radius_of_cell(set, body, id));
  }
}

void cut_at_axis(ShapeSpec& shape) {
  using geometry::BooleanOperation;
  if (shape.kind != ShapeSpec::Kind::solid || shape.dimension != 2 || shape.solid == nullptr) return;
  if (!(shape.solid->bounds().min[0] < 0)) return;
  auto const beyond = geometry::half_space({}, {{-1, 0, 0}}, 2);
  shape.solid = geometry::combined(BooleanOperation::common, {shape.solid, beyond});
  shape.volume = geometry::volume_of(*shape.solid, shape.spacing);
  if (shape.solid_particles) shape.solid_particles->key += "\ncut at the axis";
}

}  // namespace piola
