// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/camera_view.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/vector_math.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace piola {
namespace {

using Point = std::array<double, 3>;
constexpr double endless = std::numeric_limits<double>::infinity();

double radians(double degrees) { return degrees * std::numbers::pi / 180; }

/// A direction given for y upwards, turned so that another axis points upwards.
Point turned(Up up, Point const& d) {
  switch (up) {
    case Up::z: return {d[0], -d[2], d[1]};
    case Up::x: return {d[1], -d[0], d[2]};
    case Up::minus_y: return {-d[0], -d[1], d[2]};
    case Up::minus_z: return {d[0], d[2], -d[1]};
    case Up::minus_x: return {-d[1], d[0], d[2]};
    default: return d;
  }
}

Point unrolled_right(View const& view) {
  double const a = radians(view.azimuth);
  return turned(view.upwards, {std::cos(a), 0, -std::sin(a)});
}

Point unrolled_up(View const& view) {
  double const a = radians(view.azimuth), e = radians(view.elevation);
  return turned(view.upwards, {-std::sin(e) * std::sin(a), std::cos(e), -std::sin(e) * std::cos(a)});
}

Point mixed(double a, Point const& p, double b, Point const& q) {
  return {a * p[0] + b * q[0], a * p[1] + b * q[1], a * p[2] + b * q[2]};
}

struct Extent {
  double low = endless, high = -endless;
  double size() const { return high - low; }
  void take(double a) {
    low = std::min(low, a);
    high = std::max(high, a);
  }
};

/// Interval along a direction that contains almost all of the volume; estimated from a sample for very many particles.
Extent most_of(Subject const& subject, Point const& direction) {
  constexpr double left_out = 0.002;
  constexpr std::size_t sample = 100000;
  std::vector<std::array<double, 2>> list;  // place, weight
  double all = 0;
  for (std::size_t i = 0; i < subject.points.size(); i += 1 + subject.points.size() / sample) {
    double const at = dot(subject.points[i], direction), weight = subject.volume.empty() ? 1 : subject.volume[i];
    if (!std::isfinite(at)) continue;
    list.push_back({at, weight});
    all += weight;
  }
  std::sort(list.begin(), list.end());
  Extent most;
  double below = 0;
  for (auto const& [at, weight] : list) {
    if (below + weight > left_out * all && below < (1 - left_out) * all) most.take(at);
    below += weight;
  }
  return most;
}

/// Where all points lie but strays; `other` is the size across.
Extent without_strays(Subject const& subject, Point const& direction, Extent const& most, double other) {
  constexpr double near = 0.2, flat = 0.25;  // what is flatter than that may bend by as much
  double const reach = near * std::max(most.size(), flat * other);
  Extent out;
  for (Point const& p : subject.points) {
    double const at = dot(p, direction);
    if (at >= most.low - reach && at <= most.high + reach) out.take(at);
  }
  return out;
}

/// The mean place of a body's volume.
Point centre_of(Subject const& subject, int body) {
  Point sum{};
  double all = 0;
  for (std::size_t i = 0; i < subject.points.size(); ++i) {
    Point const& p = subject.points[i];
    if (subject.body[i] != body || !std::isfinite(p[0] + p[1] + p[2])) continue;
    double const weight = subject.volume.empty() ? 1 : subject.volume[i];
    sum = plus(sum, weight, p);
    all += weight;
  }
  return all > 0 ? plus({}, 1 / all, sum) : Point{};
}

}  // namespace

View View::in(int dimension) const {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  if (dimension == 3) return *this;
  return {0, 0, upwards == Up::z ? Up::y : upwards == Up::minus_z ? Up::minus_y : upwards, roll};
}

std::array<double, 3> View::right() const {
  double const r = radians(roll);
  return mixed(std::cos(r), unrolled_right(*this), -std::sin(r), unrolled_up(*this));
}

std::array<double, 3> View::up() const {
  double const r = radians(roll);
  return mixed(std::sin(r), unrolled_right(*this), std::cos(r), unrolled_up(*this));
}

std::array<double, 3> View::towards_viewer() const {
  double const a = radians(azimuth), e = radians(elevation);
  return turned(upwards, {std::sin(a) * std::cos(e), std::sin(e), std::cos(a) * std::cos(e)});
}

std::optional<std::array<double, 2>> named_view(std::string_view word, Up upwards) {
  static double const diagonal = std::atan(std::sqrt(0.5)) * 180 / std::numbers::pi;
  if (word == "iso") return std::array{45.0, diagonal};
  if (word == "iso2") return std::array{-45.0, diagonal};
  auto const found = std::find(view_words.begin(), view_words.begin() + 6, word);
  if (found == view_words.begin() + 6) return std::nullopt;
  auto const number = static_cast<std::size_t>(found - view_words.begin());
  Point from{};
  from[number % 3] = number < 3 ? 1 : -1;
  constexpr std::array<std::array<double, 2>, 6> candidates{{{0, 0}, {90, 0}, {180, 0}, {270, 0}, {0, 90}, {0, -90}}};
  auto const is_it = [&](auto const& c) { return dot(View{c[0], c[1], upwards}.towards_viewer(), from) > 0.9; };
  return *std::find_if(candidates.begin(), candidates.end(), is_it);
}

void Window::include(View const& view, std::span<Point const> points, double margin) {
  include(view, Subject{.points = points, .margin = margin});
}

void Window::include(View const& view, Subject const& subject) {
  PIOLA_EXPECTS(subject.volume.empty() || subject.volume.size() == subject.points.size());
  Extent const most_x = most_of(subject, view.right()), most_y = most_of(subject, view.up());
  auto x = without_strays(subject, view.right(), most_x, most_y.size()),
       y = without_strays(subject, view.up(), most_y, most_x.size());
  if (!(x.low <= x.high) || !(y.low <= y.high)) return;
  for (auto* const side : {&x, &y}) *side = {side->low - subject.margin, side->high + subject.margin};
  bool const inside = set && x.low >= x0 && x.high <= x1 && y.low >= y0 && y.high <= y1;
  if (inside) return;
  double const room = 0.06 * std::max(x.high - x.low, y.high - y.low);
  auto const grow = [&](double& low, double& high, double new_low, double new_high) {
    low = set && low <= new_low ? low : new_low - room;
    high = set && high >= new_high ? high : new_high + room;
  };
  grow(x0, x1, x.low, x.high);
  grow(y0, y1, y.low, y.high);
  set = true;
}

void Window::cover(Window const& other) {
  if (!other.set) return;
  x0 = set ? std::min(x0, other.x0) : other.x0;
  x1 = set ? std::max(x1, other.x1) : other.x1;
  y0 = set ? std::min(y0, other.y0) : other.y0;
  y1 = set ? std::max(y1, other.y1) : other.y1;
  set = true;
}

double Eye::height(Point const& p) const { return dot(minus(p, axis), towards); }

double Eye::magnification(Point const& p) const {
  constexpr double nearest = 0.95;  // of the way to the eye
  if (!near()) return 1;
  double const h = height(p);
  return h < nearest * distance ? distance / (distance - h) : std::numeric_limits<double>::quiet_NaN();
}

Point Eye::seen(Point const& p) const { return near() ? plus(axis, magnification(p), minus(p, axis)) : p; }

double Eye::shift(Point const& p, double other) const {
  if (!near()) return 0;
  Point const from_axis = minus(p, axis), across = plus(from_axis, -height(p), towards);
  return length(across) * std::abs(other - magnification(p));
}

Eye eye_before(Camera const& camera, double angle, Point const& low, Point const& high) {
  PIOLA_EXPECTS(angle >= 0 && angle < 180);
  Point const diagonal = minus(high, low);
  double const half = length(diagonal) / 2;
  if (!(angle > 0) || !(half > 0)) return {};
  return {half / std::tan(radians(angle / 2)), camera.look_at.value_or(mixed(0.5, low, 0.5, high)),
          camera.view.towards_viewer()};
}

Eye eye_at(Camera const& camera, Subject const& now) {
  PIOLA_EXPECTS(camera.followed_body < 0 || now.body.size() == now.points.size());
  Eye eye = camera.eye;
  if (eye.near() && camera.followed_body >= 0) eye.axis = centre_of(now, camera.followed_body);
  return eye;
}

void include(Window& window, Camera const& camera, Subject const& subject) {
  PIOLA_EXPECTS(camera.followed_body < 0 || subject.body.size() == subject.points.size());
  if (camera.followed_body < 0 && !camera.eye.near()) return window.include(camera.view, subject);
  Eye const eye = eye_at(camera, subject);
  Point const centre = camera.followed_body < 0 ? Point{} : centre_of(subject, camera.followed_body);
  std::vector<Point> points;
  std::vector<double> volume;
  for (std::size_t i = 0; i < subject.points.size(); ++i) {
    if (camera.followed_body >= 0 && subject.body[i] != camera.followed_body) continue;
    points.push_back(minus(eye.seen(subject.points[i]), centre));
    volume.push_back(subject.volume.empty() ? 1 : subject.volume[i]);
  }
  window.include(camera.view, {.points = points, .volume = volume, .margin = subject.margin});
}

Window shown_window(Window const& all, Camera const& camera, Subject const& now) {
  PIOLA_EXPECTS(camera.zoom > 0);
  PIOLA_EXPECTS(camera.followed_body < 0 || now.body.size() == now.points.size());
  auto const right = camera.view.right(), up = camera.view.up();
  double x = (all.x0 + all.x1) / 2, y = (all.y0 + all.y1) / 2;
  if (camera.followed_body >= 0) {
    Point const centre = centre_of(now, camera.followed_body);
    x += dot(centre, right);
    y += dot(centre, up);
  }
  if (camera.look_at) {
    x = dot(*camera.look_at, right);
    y = dot(*camera.look_at, up);
  }
  double const half_x = (all.x1 - all.x0) / 2 / camera.zoom, half_y = (all.y1 - all.y0) / 2 / camera.zoom;
  return {all.set, x - half_x, x + half_x, y - half_y, y + half_y};
}

std::array<int, 2> fitting_size(Window const& window) {
  constexpr double pixels = 550e3, widest = 1200, highest = 1000, least = 260;  // of the area for the bodies
  constexpr double beside = 174, above_and_below = 132;                         // what letters take, see layout_of
  double const x = window.x1 - window.x0, y = window.y1 - window.y0;
  double const aspect = x > 0 && y > 0 ? std::clamp(x / y, 0.05, 20.0) : 1.2;
  double const scale = std::min({std::sqrt(pixels * aspect), widest, highest * aspect});
  auto const even = [](double value) { return 2 * static_cast<int>(std::lround(value / 2)); };
  return {even(std::max(scale, least) + beside), even(std::max(scale / aspect, least) + above_and_below)};
}

}  // namespace piola
