// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/point3.hpp"
#include <array>
#include <optional>
#include <string_view>
#include <vector>

namespace piola {

/// How a body is drawn. Automatic: a skin where particles are connected, balls for the rest.
enum class Representation { automatic, skin, balls, points, none };
inline constexpr std::array<std::string_view, 5> representation_words{"auto", "skin", "balls", "points", "none"};

/// A section plane: removes the parts on the side of its normal.
struct CutPlane {
  Point3 point{}, normal{1, 0, 0};  ///< [m]; of any length
  bool ghost = false;               ///< what is taken away stays as a shade of 12 %
  bool in_reference = false;        ///< cuts the bodies as they were at the start
};

/// Number of samples per pixel and of directions of ambient light.
enum class Quality { normal, high };
inline constexpr std::array<std::string_view, 2> quality_words{"normal", "high"};

/// Selects the parts of a scene that are drawn.
struct Appearance {
  std::vector<Representation> as = {};  ///< per body; those beyond its end: automatic
  bool outline = true;                  ///< edges of the reference shape of bodies that have moved, dashed
  std::optional<CutPlane> cut = {};
  Quality quality = Quality::normal;
  /// Upwards, of length 1: a plane across it below the bodies of the reference configuration, in three dimensions.
  std::optional<Point3> ground = {};
};

}  // namespace piola
