// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/point3.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

/// Rasterises surfaces: the nearest surface at each sample, its depth, normal and value. Colour and light are in
/// shade.hpp. Lengths are in samples: x to the right, y downwards, depth towards the viewer. Sample (i, j) lies at (i +
/// 0.5, j + 0.5).
namespace piola {

/// Number of a surface in the buffers, which determines its colour.
using Owner = std::uint16_t;
inline constexpr Owner no_owner = std::numeric_limits<Owner>::max();

/// The nearest surface at each sample, row by row from the top.
struct SurfaceBuffers {
  using Normal = std::array<std::int16_t, 2>;  ///< right and down, in units of 1 / 32767; the third one is positive
  int width = 0, height = 0;
  std::vector<float> depth;  ///< minus infinity: nothing
  std::vector<Normal> normal;
  std::vector<float> value;
  std::vector<Owner> owner;

  SurfaceBuffers() = default;
  SurfaceBuffers(int columns, int rows);
  bool empty() const { return depth.empty(); }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
  }
  void put(std::size_t sample, float new_depth, Normal new_normal, float new_value, Owner new_owner) {
    depth[sample] = new_depth;
    normal[sample] = new_normal;
    value[sample] = new_value;
    owner[sample] = new_owner;
  }
  static Normal packed(double right, double down) {
    return {static_cast<std::int16_t>(right * 32767), static_cast<std::int16_t>(down * 32767)};
  }
  /// Right, down, towards the viewer.
  static std::array<float, 3> unpacked(Normal n) {
    float const a = static_cast<float>(n[0]) / 32767, b = static_cast<float>(n[1]) / 32767;
    return {a, b, std::sqrt(std::max(0.0F, 1 - a * a - b * b))};
  }
};

/// p.Q.p = 1 about its centre.
struct Ellipsoid {
  float x = 0, y = 0, depth = 0;  ///< centre
  std::array<float, 6> Q{};       ///< xx yy zz xy yz xz
  std::array<float, 3> half{};    ///< of the box around it
  float value = 0;
  Owner owner = 0;
  bool flat = false;  ///< its normal counts as that of a plane across the line of sight
};

/// The ellipsoid that a ball becomes under F: S is its radius times F, its rows in the directions right, down and
/// towards the viewer [samples]; Q = (S S^T)^-1.
void set_shape(Ellipsoid& ellipsoid, std::array<Point3, 3> const& S);

struct Vertex {
  float x = 0, y = 0, depth = 0, value = 0;
  float beyond = -1;  ///< above zero: cut away
};
/// Corners in any order: both sides are drawn.
struct Triangle {
  std::array<std::int32_t, 3> corner{};
  std::array<SurfaceBuffers::Normal, 3> normal{};
  Owner owner = 0;
};

/// Surfaces to be drawn.
struct Surfaces {
  std::vector<Ellipsoid> ellipsoids;
  std::vector<Vertex> vertices;
  std::vector<Triangle> triangles;
  bool nearest_value = false;  ///< values of triangles are names, not numbers: that of the nearest corner counts
};

/// Draws into the buffers, on top of their content. The result does not depend on the number of threads: of surfaces at
/// the same depth the first one in the list counts, triangles before ellipsoids. Non-finite places are skipped. In
/// parallel projection depth and normal of an ellipsoid are exact to single precision: z = (-b + sqrt(b^2 - a c)) / a
/// with a = Q_zz, b = Q_xz x + Q_yz y and c = p.Q.p - 1 at z = 0.
void rasterise(Surfaces const& surfaces, SurfaceBuffers& buffers);

}  // namespace piola
