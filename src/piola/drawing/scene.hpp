// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/projection.hpp"
#include "piola/drawing/raster.hpp"
#include "piola/drawing/skin.hpp"
#include "piola/input/picture_spec.hpp"
#include <vector>

namespace piola {

/// The bodies of a picture as surfaces, in samples. The owner of a surface is the number of its body, plus the number
/// of bodies if it is hatched.
struct Scene {
  Surfaces bodies;
  Surfaces ghosts;             ///< parts removed by a section plane
  float radius = 0;            ///< of a typical ball [samples]
  std::vector<float> spacing;  ///< of the particles of each body [samples]
  bool hatched = false;        ///< there are particles that are
  Owner bodies_in_all = 0;
  std::vector<float> value;     ///< per particle, in the buffers: field value, or index of its colour
  std::vector<Colour> colours;  ///< distinct colours of the particles
};

/// Skins, balls and sections. A body has a skin if its mesh has cells and it is drawn as one; its particles that belong
/// to no whole cell are balls. A ball of a body with a mesh is an ellipsoid, stretched by its F, within 1/3 to 4.
/// `fine`: samples per pixel of the projection.
Scene make_scene(PictureData const& data, Appearance const& appearance, Projection const& project, int fine);

/// The surfaces to which rigid shapes of a section are swept; see PictureData::swept. Owner: RigidCanvas::bright.
Surfaces swept_shapes(PictureData const& data, Projection const& project, int fine);

}  // namespace piola
