// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/revolution.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/picture.hpp"
#include "piola/math/circle.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace piola {

Rotation Rotation::by(double degrees) {
  double const turned = std::fmod(degrees, 360);
  if (turned == 0) return {};
  if (turned == 180) return {-1, 0};
  return {std::cos(turned * std::numbers::pi / 180), std::sin(turned * std::numbers::pi / 180)};
}

double width_of_axis(std::span<Point3 const> reference, double spacing) {
  constexpr double on_surface = 1e-3, near_corner = 0.25;  // spacings
  bool const touches = std::any_of(reference.begin(), reference.end(),
                                   [&](Point3 const& X) { return std::abs(X[0]) <= on_surface * spacing; });
  return (touches ? near_corner : on_surface) * spacing;
}

std::vector<double> angles_of_sweep(double degrees, double step) {
  PIOLA_EXPECTS(degrees >= 0 && degrees <= 360 && step > 0);
  if (degrees == 0) return {0, 180};
  auto const parts = std::max(3, static_cast<int>(std::ceil(degrees / step - 1e-9)));
  std::vector<double> angles;
  for (int k = 0; k <= parts; ++k) angles.push_back(degrees * k / parts);
  return angles;
}

RevolvedPoints revolved(Subject const& section, double degrees) {
  PIOLA_EXPECTS(section.volume.empty() || section.volume.size() == section.points.size());
  PIOLA_EXPECTS(section.body.empty() || section.body.size() == section.points.size());
  constexpr double step = 15;  // a circle shrinks by less than a hundredth
  RevolvedPoints all;
  for (double const angle : angles_of_sweep(degrees, step)) {
    Rotation const rotate = Rotation::by(angle);
    for (Point3 const& p : section.points) all.points.push_back(rotate(p));
    all.volume.insert(all.volume.end(), section.volume.begin(), section.volume.end());
    all.body.insert(all.body.end(), section.body.begin(), section.body.end());
  }
  return all;
}

std::vector<double> ball_radii_of_rings(std::span<double const> volume, std::span<Point3 const> X,
                                        std::span<int const> body) {
  PIOLA_EXPECTS(volume.size() == body.size() && X.size() == body.size());
  std::map<int, std::vector<double>> areas;
  for (std::size_t i = 0; i < volume.size(); ++i)
    if (X[i][0] > 0) areas[body[i]].push_back(volume[i] / circle(X[i][0]));
  std::map<int, double> typical;
  for (auto& [number, all] : areas) {
    auto const place = all.begin() + static_cast<std::ptrdiff_t>(9 * (all.size() - 1) / 10);
    std::nth_element(all.begin(), place, all.end());
    typical[number] = *place;
  }
  std::vector<double> area(volume.size());
  for (std::size_t i = 0; i < area.size(); ++i) area[i] = typical[body[i]];
  return ball_radii(area, body, 2);
}

}  // namespace piola
