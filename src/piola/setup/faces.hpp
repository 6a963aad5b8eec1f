// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/setup/shapes.hpp"
#include <cstdint>
#include <string>
#include <vector>

namespace piola {

/// A face of a box: across an axis, at the smallest or the largest coordinate.
struct Face {
  int axis = 0;  ///< 0 x, 1 y, 2 z
  bool upper = false;
};

/// "-x", "+y": as case files name a face.
std::string face_text(Face const& face);

/// Ids of the outermost particles of a box towards a face: on it, or half a spacing inside (cell_centred).
std::vector<std::int64_t> face_particles(ParticleSet const& particles, Body const& body, Face const& face);

/// The part of a face that a particle of it stands for [m^(Dim-1); 1 in 1D]: the product of its tributary lengths along
/// the face, halved at the ends of on_boundary directions and between the two faces of a crack. The parts sum to the
/// face.
double face_area(ShapeSpec const& shape, ParticleSet const& particles, std::int64_t id, Face const& face);

}  // namespace piola
