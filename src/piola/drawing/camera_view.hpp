// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/input/picture_spec.hpp"
#include <array>
#include <optional>
#include <span>
#include <string_view>

/// Direction of view, and the part of the projection that a picture shows.
namespace piola {

/// The direction that points upwards in a picture.
enum class Up { y, z, x, minus_y, minus_z, minus_x };
inline constexpr std::array<std::string_view, 6> up_words{"y", "z", "x", "-y", "-z", "-x"};

/// Direction of view: azimuth about the axis that points up and elevation above the plane across it [deg]. At (0, 0)
/// with y upwards x points to the right, with z upwards x to the right and y away from the viewer, with x upwards -y to
/// the right. Parallel projection. In two dimensions z cannot point upwards and counts as y.
struct View {
  double azimuth = 30, elevation = 20;
  Up upwards = Up::y;
  double roll = 0;  ///< by which the picture is turned anticlockwise [deg]
  /// A plane is seen from z.
  View in(int dimension) const;
  std::array<double, 3> right() const;
  std::array<double, 3> up() const;
  std::array<double, 3> towards_viewer() const;
};

/// Azimuth and elevation of a view of view_words [deg]; nothing for another name.
std::optional<std::array<double, 2>> named_view(std::string_view word, Up upwards);

/// An eye at a finite distance. A perspective picture is the parallel projection of points moved by seen(), which
/// preserves lines and the order of depth.
struct Eye {
  double distance = 0;                 ///< from `axis` [m]; 0: endless
  std::array<double, 3> axis = {};     ///< the point that stays where it is
  std::array<double, 3> towards = {};  ///< the viewer, of length 1

  bool near() const { return distance > 0; }
  /// How much nearer than the axis a point is [m].
  double height(std::array<double, 3> const& p) const;
  /// Magnification at a point; NaN near the eye and behind it.
  double magnification(std::array<double, 3> const& p) const;
  std::array<double, 3> seen(std::array<double, 3> const& p) const;
  /// How far a point at `p` would move in the picture [m] if it were magnified by another factor.
  double shift(std::array<double, 3> const& p, double other) const;
};

/// Particles of the bodies at one time, for fitting a window; one entry per particle.
struct Subject {
  std::span<std::array<double, 3> const> points;  ///< m
  std::span<double const> volume = {};            ///< m^dimension; empty: all count the same
  std::span<int const> body = {};
  double margin = 0;  ///< by which a particle reaches beyond its point [m]
};

/// The part of the projected plane that is shown [m]. It starts from the first points and only grows, in generous
/// steps, so that pictures of one run have the same scale almost always.
struct Window {
  bool set = false;
  double x0 = 0, x1 = 0, y0 = 0, y1 = 0;
  void include(View const& view, std::span<std::array<double, 3> const> points, double margin);
  /// Strays do not count: what lies further than a fifth of its size from the box that holds all but 0.2 % of the
  /// volume at each of its sides.
  void include(View const& view, Subject const& subject);
  /// Extends the window to the extent of another one. If the other also covers this one, both then have one size.
  void cover(Window const& other);
  bool operator==(Window const&) const = default;
};

/// Framing of a picture, if it differs from the window of all bodies.
struct Camera {
  View view;
  double zoom = 1;
  std::optional<std::array<double, 3>> look_at = {};  ///< point in the centre of the picture [m]
  Eye eye = {};
  int followed_body = -1;  ///< number of the body that stays in the middle and fills the window; -1: none
};

/// The eye from which the box of the bodies at the start has an angle [deg] over its diagonal; 0: parallel projection.
/// The axis passes through the point that the camera is aimed at, else through the centre of the box.
Eye eye_before(Camera const& camera, double angle, std::array<double, 3> const& low, std::array<double, 3> const& high);
/// The eye at one moment: with a body to follow its axis is the body's centre.
Eye eye_at(Camera const& camera, Subject const& now);

/// Grows a window by one moment of a run. With a body to follow its coordinates are relative to the body's centre.
void include(Window& window, Camera const& camera, Subject const& subject);
/// The window of one picture.
Window shown_window(Window const& all, Camera const& camera, Subject const& now);

/// Width and height [pixels] of a picture whose sides follow the window: about as many pixels as 1000 x 800; upright
/// for a column, flat for a beam. Even numbers.
std::array<int, 2> fitting_size(Window const& window);

}  // namespace piola
