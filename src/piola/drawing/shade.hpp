// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/image.hpp"
#include "piola/drawing/raster.hpp"
#include <array>
#include <functional>
#include <vector>

/// Shades samples to pixels: colour, light, occlusion and edges. Each pixel is a pure function of the buffers, so
/// pictures do not depend on the number of threads.
namespace piola {

/// Red, green and blue in proportion to light (sRGB's curve undone), 0 to 1.
using Light3 = std::array<float, 3>;
Light3 linear(Colour colour);
Colour encoded(Light3 const& light);

/// Appearance of the surfaces of one owner.
struct SurfaceFinish {
  /// The colour of a value; nothing: `colour` for all.
  std::function<Colour(double)> map = {};
  Colour colour{};
  float spacing = 0;  ///< of its particles [samples]: jumps of depth above 1.5 of them are edges
  bool flat = false;  ///< a plane seen straight on: colours as they are in the bar
  int hatch = 0;      ///< distance of dark stripes [samples]; 0: none
};

/// Surfaces that are drawn together.
struct ShadedLayer {
  SurfaceBuffers const* surfaces = nullptr;
  std::vector<SurfaceFinish> finish;  ///< by owner
};

/// The ground at a pixel: how much of it covers the background, and how light it is.
struct GroundLight {
  float share = 0, light = 1;
};

/// Input of shade(). Does not own buffers and lines.
struct Shading {
  static constexpr int steps = 1024;  ///< of the table of colours
  ShadedLayer bodies;
  ShadedLayer tools = {};             ///< drawn half-transparent where they hide bodies
  ShadedLayer ghosts = {};            ///< a shade of 12 % over what they hide
  std::span<float const> lines = {};  ///< coverage per sample of lines behind everything; empty: none
  int fine = 2;                       ///< pixels are the mean of fine x fine samples
  float radius = 0;                   ///< of a typical ball [samples]: occlusion radii are 1.2 and 5 times this
  std::array<double, 2> range{0, 1};  ///< of values: colours in between are taken from a table
  Colour background{255, 255, 255};
  bool transparent = false;                  ///< there is no background: the picture has opacity
  std::span<GroundLight const> ground = {};  ///< per pixel, behind everything; empty: none
  int directions = 28;                       ///< of the light from around
};

/// Key light from the upper left 0.42, fill from the right 0.16, ambient 0.50, a highlight of 0.10 (power 40): how much
/// of its colour a surface with this unit normal (right, down, towards the viewer) sends back, and how much white.
struct Reflected {
  float colour = 1, white = 0;
};
Reflected reflected(std::array<float, 3> const& normal);

/// Ambient light at each pixel of a layer, 1 (open) to 0.4 (ambient occlusion in screen space, Mittring 2007 in idea):
/// over some directions on a golden spiral and two radii, the mean elevation of nearby surfaces over the tangent plane;
/// blurred where depths are equal. A plane has 1 whatever its slope. `around`: the nearest depth of all layers at each
/// pixel; sizes in pixels.
struct PixelSurface {
  int width = 0, height = 0;
  std::vector<float> depth;  ///< minus infinity: nothing [pixels]
  std::vector<std::array<float, 3>> normal;
  /// The nearest sample of each pixel.
  PixelSurface(SurfaceBuffers const& samples, int fine);
};
std::vector<float> openness(PixelSurface const& surface, std::span<float const> around, float ball_radius,
                            int directions = 28);

/// The picture.
Image shade(Shading const& shading);

}  // namespace piola
