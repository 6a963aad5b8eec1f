// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace piola {

/// A face of a body: of a box, or an end of a cylinder, across an axis, at the smallest or the largest coordinate; or
/// the curved surface of a cylinder, a ball or a disc, outside or around its hole; or a patch of a solid.
struct Face {
  enum class Part { flat, outer, inner, patch };
  int axis = 0;  ///< 0 x, 1 y, 2 z; patch: its number
  bool upper = false;
  Part part = Part::flat;
  bool operator==(Face const&) const = default;
};

/// "-x", "+y", "outer", "inner": as case files name a face; patches by their names.
std::string face_text(ShapeSpec const& shape, Face const& face);

/// Ids of the outermost particles of a box towards a face: on it, or half a spacing inside (cell_centred).
std::vector<std::int64_t> face_particles(ParticleSet const& particles, Body const& body, Face const& face);

/// Area of a face that a particle on it represents [m^(Dim-1); 1 in 1D]: the product of its tributary lengths along the
/// face, halved at the ends of on_boundary directions and between the two faces of a crack. The parts sum to the face.
double face_area(ShapeSpec const& shape, ParticleSet const& particles, std::int64_t id, Face const& face);

/// Area of a face that a particle represents.
struct FaceWeight {
  std::int64_t particle = 0;       ///< id
  double area = 0;                 ///< [m^(Dim-1); 1 in 1D]
  std::array<double, 3> normal{};  ///< outward unit normal of the exact surface; patch: vector area over area
  std::array<double, 3> middle{};  ///< patch: of this part of it [m]
};

/// The particles of a face with their parts of it. The parts sum to the area of the exact face: 2 pi R L of a cylinder,
/// 4 pi R^2 of a ball, 2 pi R of a disc, pi (R^2 - r^2) of an end, whatever the staircase of a lattice has. Opposite
/// particles of a closed surface have equal parts, so that a constant pressure on it has no resultant.
std::vector<FaceWeight> face_weights(ShapeSpec const& shape, ParticleSet const& particles, Body const& body,
                                     Face const& face);

}  // namespace piola
