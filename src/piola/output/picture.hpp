// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/output/appearance.hpp"
#include "piola/output/image.hpp"
#include "piola/output/reference_mesh.hpp"
#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// The direction that points upwards in a picture.
enum class Up { y, z, x, minus_y, minus_z, minus_x };
inline constexpr std::array<std::string_view, 6> up_words{"y", "z", "x", "-y", "-z", "-x"};

/// Where one looks from: azimuth about the axis that points up and elevation above the plane across it [deg]. At (0, 0)
/// with y upwards x points to the right, with z upwards x to the right and y away from the viewer, with x upwards -y to
/// the right. Parallel projection. In two dimensions z cannot point upwards and counts as y.
struct View {
  double azimuth = 30, elevation = 20;
  Up upwards = Up::y;
  /// A plane is seen from z.
  View in(int dimension) const;
  std::array<double, 3> right() const;
  std::array<double, 3> up() const;
  std::array<double, 3> towards_viewer() const;
};

/// The part of the projected plane that is shown [m]. It starts from the first points and only grows, in generous
/// steps, so that pictures of one run have the same scale almost always.
struct Window {
  bool set = false;
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  void include(View const& view, std::span<std::array<double, 3> const> points, double margin);
};

/// What a colour stands for.
struct LegendEntry {
  std::string name;
  Colour colour{};
};

/// What one picture shows; one entry per particle.
struct PictureData {
  std::span<std::array<double, 3> const> points;  ///< m
  std::span<double const> radius;                 ///< m
  std::span<double const> values;                 ///< SI
  std::string label;                              ///< of the values, e.g. "pressure"
  std::string unit;                               ///< SI
  std::string title;
  double time = 0;  ///< s
  int dimension = 3;
  std::span<RigidShape const> rigid_shapes = {};    ///< as they stand at that time
  std::array<double, 3> stage_low{}, stage_high{};  ///< the box around the bodies at the start [m]
  /// If given, particles have these colours, a legend stands in place of the bar, and the label in place of the time;
  /// values and unit are not used.
  std::span<Colour const> colours = {};
  std::span<LegendEntry const> legend = {};
  std::span<int const> body = {};              ///< numbers, particles of a body one after the other; empty: one body
  std::span<ReferenceMesh const> meshes = {};  ///< per body; none: particles are balls that do not stretch
  std::span<std::uint8_t const> loose = {};    ///< not 0: has lost its neighbours for good; empty: none has
};

struct PictureStyle {
  int width = 1000, height = 800;
  View view;
  std::optional<std::array<double, 2>> range;  ///< SI; otherwise typical_range of the values
  Appearance appearance = {};
};

/// Bodies as surfaces or balls and rigid shapes, shaded, with title, time, colour bar and axes.
Image draw_picture(PictureData const& data, PictureStyle const& asked, Window const& window);

/// Radius of the ball that stands for each particle: half the spacing (from the largest volume of its body) and a
/// little more, so that a body looks closed.
std::vector<double> ball_radii(std::span<double const> volume, std::span<int const> body, int dimension);

/// One number per particle for the picture: that component or, of the whole field, scalars as they are, vectors by
/// their length, of six stress components the von Mises stress, of other tensors the largest absolute component.
std::vector<double> picture_values(std::span<double const> values, int components, int component = whole_field);
/// The range between the lowest and the highest hundredth of the values, so that a few extreme particles (at the edge
/// of a clamp, say) do not take the colours from all others. All values if there are fewer than a hundred; (0, 0) if
/// there are none.
std::array<double, 2> typical_range(std::span<double const> values);
/// What that number is called, e.g. "velocity magnitude", "Cauchy stress xx".
std::string picture_label(std::string const& field, int components, int component = whole_field);
/// "Pressure-000012.png", "Velocity-x-000012.png"
std::string picture_name(std::string const& field, int components, int component, std::size_t number);

}  // namespace piola
