// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/drawing/camera_view.hpp"
#include "piola/drawing/image.hpp"
#include "piola/drawing/overlay.hpp"
#include "piola/drawing/point3.hpp"
#include "piola/drawing/reference_mesh.hpp"
#include "piola/formulations/assembly.hpp"
#include "piola/formulations/quantity_names.hpp"
#include "piola/input/picture_spec.hpp"
#include <array>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace piola {

/// Range of the values in all pictures of a run.
struct Spread {
  std::array<double, 2> typical{infinite, -infinite};   ///< of all typical ranges
  std::array<double, 2> extremes{infinite, -infinite};  ///< lowest and highest finite value
  bool not_a_number = false;                            ///< there are such values
  void include(std::span<double const> values);
  void include(Spread const& other);
  bool operator==(Spread const&) const = default;

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
};

/// Data of one picture, one entry per particle. Does not own the arrays.
struct PictureData {
  std::span<std::array<double, 3> const> points;  ///< m
  std::span<double const> radius;                 ///< m
  std::span<double const> values;                 ///< SI
  std::string label;                              ///< of the values, e.g. "pressure"
  std::string unit;                               ///< SI
  std::string title;
  double time = 0;  ///< s
  int dimension = 3;
  std::span<RigidShape const> rigid_shapes = {};    ///< at their positions at that time
  std::array<double, 3> stage_low{}, stage_high{};  ///< the box around the bodies at the start [m]
  /// If given, particles have these colours, a legend replaces the bar, and the label replaces the time; values and
  /// unit are not used.
  std::span<Colour const> colours = {};
  std::span<LegendEntry const> legend = {};
  std::optional<Spread> spread = {};           ///< of all pictures of the run; else of these values
  std::string_view case_text = {};             ///< the case as run: pictures carry its check sum
  Eye eye = {};                                ///< in three dimensions
  std::optional<TimeFormat> time_format = {};  ///< of all times of the run; else one that fits this time
  std::span<int const> body = {};              ///< numbers, particles of a body one after the other; empty: one body
  std::optional<Point3> ground = {};           ///< upwards, of length 1: across a plane below the bodies; 3D only
  std::span<ReferenceMesh const> meshes = {};  ///< per body; none: particles are balls that do not stretch
  std::span<std::uint8_t const> loose = {};    ///< not 0: has lost its neighbours for good; empty: none has
  std::span<std::uint8_t const> held = {};     ///< not 0: hatched; empty: none is
  /// Axisymmetric bodies, whose points lie in a half section: the angle through which it is swept [deg], in three
  /// dimensions; 0: the section and its mirror image, in two. Nothing: other bodies. See revolution.hpp.
  std::optional<double> swept = {};
  /// Torn cells of the mesh of each body; empty: determined from the points.
  std::span<std::vector<Index> const> torn = {};
};

struct PictureStyle {
  int width = 1000, height = 800;
  View view;
  std::optional<std::array<double, 2>> range;  ///< SI; otherwise the typical range of the spread
  Theme theme = Theme::light;
  bool labels = true;  ///< title, time, colour bar, axes, scale bar
  Palette palette = Palette::automatic;
  Appearance appearance = {};
};

/// Bodies as surfaces or balls and rigid shapes, lit, with title, time, colour bar, axes and scale bar. Throws
/// FileError if there is no memory for so large a picture. The image has notes: title, time, field, range, version and
/// the check sum of the case.
Image draw_picture(PictureData const& data, PictureStyle const& style, Window const& window);

/// Draws only the letters of a picture over `image`: title, `at_right` (usually the time), the colour bar of the
/// style's range, and the axes and the scale that a picture of the style's size without labels has.
void draw_letters(Image& image, Layout const& layout, PictureData const& data, PictureStyle const& style,
                  Window const& window, std::string const& at_right, bool marks = true);

/// Axes and scale of a picture of the style's size without labels, as a strip of this height below it.
Image draw_marks(Layout const& layout, int height, PictureData const& data, PictureStyle const& style,
                 Window const& window);

/// Radius of the ball drawn for each particle: half the spacing (from the largest volume of its body) and a little
/// more, so that a body looks closed.
std::vector<double> ball_radii(std::span<double const> volume, std::span<int const> body, int dimension);

/// One number per particle for the picture: that component or, of the whole field, scalars as they are, vectors by
/// their length, of six stress components the von Mises stress, of other tensors the largest absolute component.
std::vector<double> picture_values(std::span<double const> values, int components, int component = whole_field);
/// The range between the lowest and the highest hundredth of the values, so that a few extreme particles (e.g. at the
/// edge of a clamp) do not compress the colours of the rest. All values if there are fewer than a hundred; (0, 0) if
/// there are none.
std::array<double, 2> typical_range(std::span<double const> values);
/// Label of the values of picture_values(), e.g. "velocity magnitude", "Cauchy stress xx".
std::string picture_label(std::string const& field, int components, int component = whole_field);
/// "Pressure-000012.png", "Velocity-x-000012.png"
std::string picture_name(std::string const& field, int components, int component, std::size_t number);

}  // namespace piola
