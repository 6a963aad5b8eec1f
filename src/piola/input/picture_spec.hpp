// SPDX-License-Identifier: Apache-2.0
#pragma once
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Settings of pictures: read from a case or from options of a command, used by the renderer as they are.
namespace piola {

/// How a body is drawn. Automatic: a skin where particles are connected, balls for the rest.
enum class Representation { automatic, skin, balls, points, none };
inline constexpr std::array<std::string_view, 5> representation_words{"auto", "skin", "balls", "points", "none"};

/// Number of samples per pixel and of directions of ambient light.
enum class Quality { normal, high };
inline constexpr std::array<std::string_view, 2> quality_words{"normal", "high"};

/// The colours around the bodies. A transparent picture has the letters of a light one.
enum class Theme { light, dark, transparent };
inline constexpr std::array<std::string_view, 3> theme_words{"light", "dark", "transparent"};

/// Colour maps by name. viridis, cividis, magma, grey: lightness rises evenly; blue_red and blue_brown: light grey at
/// zero, the two signs equally dark; heat_on_grey: from the grey of a body through orange to dark red, for what is zero
/// in most of a body. `automatic` is blue_red for a range that has zero well inside, else viridis.
enum class Palette { automatic, viridis, cividis, magma, grey, blue_red, blue_brown, heat_on_grey };
inline constexpr std::array<std::string_view, 8> palette_words{"auto", "viridis",  "cividis",    "magma",
                                                               "grey", "blue_red", "blue_brown", "heat_on_grey"};

/// Names of views: from the positive or negative end of an axis, and from two sides so that all three axes are equally
/// foreshortened.
inline constexpr std::array<std::string_view, 8> view_words{"x", "y", "z", "-x", "-y", "-z", "iso", "iso2"};

/// A section plane: removes the parts on the side of its normal.
struct CutPlane {
  std::array<double, 3> point{}, normal{1, 0, 0};  ///< [m]; of any length
  bool ghost = false;                              ///< what is taken away stays as a shade of 12 %
  bool in_reference = false;                       ///< cuts the bodies as they were at the start
};

/// Selects the parts of a scene that are drawn.
struct Appearance {
  std::vector<Representation> as = {};  ///< per body; those beyond its end: automatic
  bool outline = true;                  ///< edges of the reference shape of bodies that have moved, dashed
  std::optional<CutPlane> cut = {};
  Quality quality = Quality::normal;
};

/// Content and style of a picture or of a panel of one.
struct PictureSpec {
  std::string field = "Pressure";
  std::string component = {};                       ///< of that field, e.g. "x"; empty: see picture_values
  std::string up = "auto";                          ///< auto, x, y, z, -x, -y, -z
  std::optional<std::array<double, 2>> range = {};  ///< SI; otherwise from the data
  std::array<double, 2> view{30, 20};               ///< azimuth, elevation [deg]
  std::string named_view = {};                      ///< x, -y, iso ...; empty: view
  double roll = 0;                                  ///< deg
  double zoom = 1;
  double perspective = 0;                             ///< deg
  std::optional<std::array<double, 3>> look_at = {};  ///< m
  std::string followed_body = {};                     ///< name of the body that stays in the middle; empty: none
  int width = 0, height = 0;                          ///< pixels; 0: fitted to the content
  double scale = 1;                                   ///< factor on a fitted width and height
  Theme theme = Theme::light;
  Palette map = Palette::automatic;
  bool labels = true;
  Appearance appearance = {};
  double warp = 1;           ///< magnification of displacements
  bool ground = false;       ///< a plane below the bodies, with their shadow
  bool supports = false;     ///< what supports hold is hatched
  double revolve = 0;        ///< angle through which sections of axisymmetric bodies are swept [deg]; 0: none
  std::string caption = {};  ///< of a panel
};

/// [output.pictures]
struct PicturesSpec : PictureSpec {
  double every = 0;                      ///< s
  std::vector<PictureSpec> panels = {};  ///< panels of one picture; none: a single view
  int columns = 0;                       ///< of panels; 0: as many as fit
  std::vector<double> times = {};        ///< of the moments that one more picture shows [s]
};

}  // namespace piola
