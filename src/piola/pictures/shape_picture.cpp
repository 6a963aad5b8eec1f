// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/shape_picture.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/base/text.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/revolved_shapes.hpp"
#include "piola/drawing/rigid_picture.hpp"
#include "piola/model/region_checks.hpp"
#include "piola/pictures/case_scene.hpp"
#include "piola/setup/packed_bodies.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

constexpr Colour inner_grey{200, 203, 208};

/// Colours that can be distinguished with red-green colour blindness (Okabe and Ito, 2008, without black); for more,
/// hues by the golden section, first dark, then light.
Colour colour_number(std::size_t k) {
  constexpr std::array<Colour, 7> first{Colour{86, 180, 233}, {230, 159, 0}, {0, 158, 115}, {204, 121, 167},
                                        {240, 228, 66},       {0, 114, 178}, {213, 94, 0}};
  if (k < first.size()) return first[k];
  constexpr double golden = 0.6180339887498949;
  double const value = k % 2 == 0 ? 0.95 : 0.65, saturation = k % 2 == 0 ? 0.4 : 0.7;
  double const hue = 6 * std::fmod(golden * static_cast<double>(k), 1.0);
  Colour colour{};
  for (std::size_t c = 0; c < 3; ++c) {
    double const k_of_hue = std::fmod(5 - 2 * static_cast<double>(c) + hue, 6.0);
    double const share = std::clamp(std::min(k_of_hue, 4 - k_of_hue), 0.0, 1.0);
    colour[c] = static_cast<std::uint8_t>(std::lround(255 * value * (1 - saturation * share)));
  }
  return colour;
}

/// The colours of particles and their legend.
struct Paint {
  std::vector<Colour> colours;
  std::vector<LegendEntry> legend;
};

Paint by_body(ParticleSet const& particles) {
  Paint paint;
  for (Body const& body : particles.bodies) paint.legend.push_back({body.name, colour_number(paint.legend.size())});
  for (int const body : particles.body) paint.colours.push_back(paint.legend[static_cast<std::size_t>(body)].colour);
  return paint;
}

Paint by_patch(CaseSpec const& spec, ParticleSet const& particles) {
  Paint paint{std::vector<Colour>(particles.X.size(), inner_grey), {}};
  std::vector<double> largest(particles.X.size(), 0);
  for (std::size_t b = 0; b < spec.bodies.size(); ++b) {
    ShapeSpec const& shape = spec.bodies[b].shape;
    if (!shape.solid) continue;
    std::size_t const before = paint.legend.size();
    for (geometry::Patch const& patch : shape.solid->patches()) {
      std::string const name = spec.bodies.size() > 1 ? spec.bodies[b].name + " " + patch.name : patch.name;
      paint.legend.push_back({name, colour_number(paint.legend.size())});
    }
    for (PatchWeight const& share : patch_weights(shape, particles, particles.bodies[b])) {
      auto const i = static_cast<std::size_t>(share.particle);
      if (share.area <= largest[i]) continue;
      largest[i] = share.area;
      paint.colours[i] = paint.legend[before + static_cast<std::size_t>(share.patch)].colour;
    }
  }
  if (paint.legend.empty())
    throw InputError("--patches: no body of the case has patches (allowed: for solids) - leave it out");
  return paint;
}

/// Particles at the start and how much of the space they take.
struct StartOfBodies {
  std::vector<Point3> points;
  std::vector<double> radii;
  std::optional<double> swept;  ///< see PictureData::swept
  RevolvedPoints in_space = {};
  Stage stage = {};

  StartOfBodies(CaseSpec const& spec, ParticleSet const& particles, PictureSpec const& picture)
      : radii(particles.axisymmetric ? ball_radii_of_rings(particles.volume, particles.X.seen(), particles.body)
                                     : ball_radii(particles.volume, particles.body, particles.dimension)),
        swept(sweep_of(picture, particles.axisymmetric)) {
    for (std::size_t i = 0; i < particles.X.size(); ++i)
      points.push_back(start_of(spec.bodies[static_cast<std::size_t>(particles.body[i])], particles.X[i]));
    stage = Stage::around(points);
    if (!swept) return;
    stage = revolved(stage, *swept);
    in_space = revolved({.points = points, .volume = particles.volume, .body = particles.body}, *swept);
  }
  Subject subject(ParticleSet const& particles) const {
    double const margin = radii.empty() ? 0 : *std::max_element(radii.begin(), radii.end());
    if (swept) return {.points = in_space.points, .volume = in_space.volume, .body = in_space.body, .margin = margin};
    return {.points = points, .volume = particles.volume, .body = particles.body, .margin = margin};
  }
};

}  // namespace

Image draw_shape(CaseSpec const& spec, ParticleSet const& particles, ShapePictureOptions const& options) {
  PIOLA_EXPECTS(spec.bodies.size() == particles.bodies.size());
  Paint const paint = options.patches ? by_patch(spec, particles) : by_body(particles);
  auto const shapes = shapes_at(spec.rigids, 0);
  CaseSpec asked = spec;
  PictureSpec& picture = asked.output.pictures;
  for (auto const& change : options.look) change(picture);
  StartOfBodies const start(spec, particles, picture);
  Stage const& stage = start.stage;
  int const dimension = dimension_shown(start.swept, particles.dimension);
  Camera camera = camera_of(picture, upwards(asked), spec.bodies, dimension);
  Subject const subject = start.subject(particles);
  if (dimension == 3) camera.eye = eye_before(camera, picture.perspective, stage.low, stage.high);
  Window window;
  include(window, camera, subject);
  if (camera.followed_body < 0) show_all_shapes(window, camera.view, shapes, stage, start.swept);
  PictureData const data{.points = start.points,
                         .radius = start.radii,
                         .values = {},
                         .label = count_text(particles.size()) + " particles",
                         .unit = {},
                         .title = spec.title,
                         .dimension = dimension,
                         .rigid_shapes = shapes,
                         .stage_low = stage.low,
                         .stage_high = stage.high,
                         .colours = paint.colours,
                         .legend = paint.legend,
                         .eye = eye_at(camera, subject),
                         .swept = start.swept};
  return draw_picture(data, style_of(picture, camera, window), shown_window(window, camera, subject));
}

}  // namespace piola
