// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/faces.hpp"
#include "piola/base/contracts.hpp"
#include "piola/particles/body_range.hpp"
#include "piola/setup/packed_bodies.hpp"
#include "piola/setup/solids_of_revolution.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace piola {
namespace {

using Vec3 = std::array<double, 3>;

/// From the centre, or from the axis of a cylinder [m].
Vec3 radial(ShapeSpec const& shape, Vec3 const& X) {
  Vec3 r{};
  for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c)
    if (shape.kind != ShapeSpec::Kind::cylinder || static_cast<int>(c) != shape.axis) r[c] = X[c] - shape.centre[c];
  return r;
}

double length(Vec3 const& r) { return std::sqrt(r[0] * r[0] + r[1] * r[1] + r[2] * r[2]); }

/// Area of the curved surface of radius R [m^(Dim-1)], of axisymmetric shapes a ball or a torus [m^2].
double curved_area(ShapeSpec const& shape, double R) {
  constexpr double pi = std::numbers::pi;
  if (shape.axisymmetric) return shape.centre[0] < R ? 4 * pi * R * R : circle(shape.centre[0]) * circle(R);
  if (shape.kind == ShapeSpec::Kind::cylinder) return 2 * pi * R * shape.length;
  return shape.dimension == 3 ? 4 * pi * R * R : shape.dimension == 2 ? 2 * pi * R : 2;
}

void scale_to(double area, std::vector<FaceWeight>& shares) {
  double sum = 0;
  for (FaceWeight const& s : shares) sum += s.area;
  for (FaceWeight& s : shares) s.area *= area / sum;
}

std::vector<FaceWeight> flat_shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                                    Face const& face) {
  std::vector<FaceWeight> shares;
  Vec3 normal{};
  normal[static_cast<std::size_t>(face.axis)] = face.upper ? 1 : -1;
  for (auto const id : face_particles(particles, body, face))
    shares.push_back({id, face_area(shape, particles, id, face), normal});
  if (particles.axisymmetric) take_ring_areas(shape, particles, face, shares);
  double const R = shape.radius, r = shape.inner_radius;
  if (shape.kind == ShapeSpec::Kind::cylinder) scale_to(std::numbers::pi * (R * R - r * r), shares);
  return shares;
}

/// The outermost or innermost circle of a body in rings: equal parts, each straight outwards.
std::vector<FaceWeight> ring_shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                                    bool outer) {
  auto const distance = [&](std::int64_t id) {
    double const r = length(radial(shape, particles.X[static_cast<std::size_t>(id)]));
    return outer ? -r : r;
  };
  double least = distance(body.first);
  for (auto id = body.first; id < body.last; ++id) least = std::min(least, distance(id));
  std::vector<FaceWeight> shares;
  for (auto id = body.first; id < body.last; ++id)
    if (distance(id) < least + 0.01 * shape.spacing) shares.push_back({id, 1, {}});
  return shares;
}

/// Particles of a lattice with a neighbour missing on that side. A particle's part is that of its open cell faces in
/// the direction of the normal, sum A max(0, n.N): for a staircase along a plane these sum to the plane's area.
std::vector<FaceWeight> stair_shares(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                                     bool outer) {
  std::map<std::array<int, 3>, std::int64_t> at;
  for (auto id = body.first; id < body.last; ++id) at[particles.lattice_index[static_cast<std::size_t>(id)]] = id;
  std::vector<FaceWeight> shares;
  for (auto id = body.first; id < body.last; ++id) {
    auto const i = static_cast<std::size_t>(id);
    Vec3 const r = radial(shape, particles.X[i]);
    double open = 0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(shape.dimension); ++c) {
      bool const along = shape.kind == ShapeSpec::Kind::cylinder && static_cast<int>(c) == shape.axis;
      if (along || r[c] == 0) continue;
      auto next = particles.lattice_index[i];
      next[c] += (r[c] > 0) == outer ? 1 : -1;
      if (at.find(next) == at.end()) open += std::abs(r[c]) / length(r) * particles.volume[i] / body.spacing[c];
    }
    if (open > 0) shares.push_back({id, open, {}});
  }
  return shares;
}

std::vector<FaceWeight> shares_of_patch(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                                        int patch) {
  std::vector<FaceWeight> shares;
  for (PatchWeight const& share : patch_weights(shape, particles, body)) {
    if (share.patch != patch) continue;
    Vec3 normal = share.vector;
    // The normal of a flat patch is exactly along its axis.
    for (double& c : normal) c = std::abs(c) < 1e-9 * share.area ? 0 : c / share.area;
    shares.push_back({share.particle, share.area, normal, share.middle});
  }
  return shares;
}

}  // namespace

std::string face_text(ShapeSpec const& shape, Face const& face) {
  PIOLA_EXPECTS(face.part != Face::Part::patch || shape.solid != nullptr);
  PIOLA_EXPECTS(face.axis >= 0 && (face.part == Face::Part::patch || face.axis < 3));
  if (face.part == Face::Part::patch) return shape.solid->patches()[static_cast<std::size_t>(face.axis)].name;
  if (face.part != Face::Part::flat) return face.part == Face::Part::outer ? "outer" : "inner";
  return std::string(face.upper ? "+" : "-") + "xyz"[face.axis];
}

std::vector<std::int64_t> face_particles(ParticleSet const& particles, Body const& body, Face const& face) {
  PIOLA_EXPECTS(is_range_in(body, particles));
  PIOLA_EXPECTS(face.axis >= 0 && face.axis < 3);
  auto const axis = static_cast<std::size_t>(face.axis);
  int const layer = face.upper ? body.lattice[axis] - 1 : 0;
  std::vector<std::int64_t> ids;
  for (std::int64_t id = body.first; id < body.last; ++id) {
    if (particles.lattice_index[static_cast<std::size_t>(id)][axis] == layer) ids.push_back(id);
  }
  return ids;
}

double face_area(ShapeSpec const& shape, ParticleSet const& particles, std::int64_t id, Face const& face) {
  auto const particle = static_cast<std::size_t>(id);
  Body const& body = particles.bodies[static_cast<std::size_t>(particles.body[particle])];
  double area = 1;
  for (int d = 0; d < shape.dimension; ++d) {
    auto const i = static_cast<std::size_t>(d);
    if (d == face.axis) continue;
    int const index = particles.lattice_index[particle][i], last = body.lattice[i] - 1;
    bool const flat = shape.kind == ShapeSpec::Kind::box || d == shape.axis;
    bool const at_end = flat && last > 0 && (index == 0 || index == last);
    area *= body.spacing[i];
    if (at_end && shape.placement == ShapeSpec::Placement::on_boundary) area /= 2;
  }
  // Where a crack reaches the face, two particles divide the area of one.
  bool const doubled = !particles.crack_side.empty() && particles.crack_side[particle] != 0;
  return doubled ? area / 2 : area;
}

std::vector<FaceWeight> face_weights(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                                     Face const& face) {
  PIOLA_EXPECTS(is_range_in(body, particles));
  PIOLA_EXPECTS(face.part != Face::Part::patch || shape.solid_particles != nullptr);
  if (face.part == Face::Part::patch) return shares_of_patch(shape, particles, body, face.axis);
  if (face.part == Face::Part::flat) return flat_shares(shape, particles, body, face);
  bool const outer = face.part == Face::Part::outer;
  auto shares =
      body.off_lattice ? ring_shares(shape, particles, body, outer) : stair_shares(shape, particles, body, outer);
  for (FaceWeight& share : shares) {
    Vec3 const r = radial(shape, particles.X[static_cast<std::size_t>(share.particle)]);
    for (std::size_t c = 0; c < 3; ++c) share.normal[c] = (outer ? 1 : -1) * r[c] / length(r);
  }
  scale_to(curved_area(shape, outer ? shape.radius : shape.inner_radius), shares);
  return shares;
}

}  // namespace piola
