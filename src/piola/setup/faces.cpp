// SPDX-License-Identifier: Apache-2.0
#include "piola/setup/faces.hpp"

namespace piola {

std::string face_text(Face const& face) { return std::string(face.upper ? "+" : "-") + "xyz"[face.axis]; }

std::vector<std::int64_t> face_particles(ParticleSet const& particles, Body const& body, Face const& face) {
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
  // Where a crack opens to the face, its two faces share what was one particle.
  bool const doubled = !particles.crack_side.empty() && particles.crack_side[particle] != 0;
  return doubled ? area / 2 : area;
}

}  // namespace piola
