// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/draw_bodies.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/feature_lines.hpp"
#include "piola/drawing/ground_shadow.hpp"
#include "piola/drawing/revolved_outline.hpp"
#include "piola/drawing/revolved_shapes.hpp"
#include "piola/drawing/rigid_picture.hpp"
#include "piola/drawing/scene.hpp"
#include "piola/drawing/shade.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

/// Samples per pixel in each direction.
int samples_across(Quality quality) { return quality == Quality::high ? 4 : 2; }

std::vector<SurfaceFinish> finish_of_bodies(PictureData const& data, Scene const& scene, ColourMap const& map,
                                            int hatch) {
  SurfaceFinish finish;
  finish.flat = data.dimension < 3;
  if (scene.colours.empty()) {
    finish.map = [&map](double value) { return map(value); };
  } else {
    finish.map = [&scene](double value) {
      auto const last = static_cast<double>(scene.colours.size() - 1);
      return scene.colours[value > 0 ? static_cast<std::size_t>(std::min(value, last)) : 0];  // NaN compares false and
                                                                                              // gets the first colour
    };
  }
  std::vector<SurfaceFinish> all(scene.spacing.size(), finish);
  for (std::size_t body = 0; body < all.size(); ++body) {
    all[body].spacing = scene.spacing[body];
    if (scene.hatched && body >= scene.bodies_in_all) all[body].hatch = hatch;
  }
  return all;
}

std::vector<SurfaceFinish> finish_of_tools(PictureData const& data, float spacing) {
  std::vector<SurfaceFinish> all;
  for (Colour const& colour : RigidCanvas::colours)
    all.push_back({.colour = colour, .spacing = spacing, .flat = data.dimension < 3});
  return all;
}

/// Distance of stripes [samples]: a fixed fraction of the picture.
int hatch_of(SceneArea const& area, int fine) {
  double const unit = std::sqrt(static_cast<double>(area.width) * area.height / 800000.0);
  return fine * std::max(4, static_cast<int>(std::lround(9 * unit)));
}

/// Moves what a picture in perspective shows to where the eye sees it; see Projection. What is not before the eye is no
/// longer finite, and is left out.
void move_to_where_seen(Surfaces& surfaces, Projection const& project, int samples) {
  auto const fine = static_cast<float>(samples);
  double const scale = project.scale * samples;
  auto const moved = [&](auto& place) {
    Point3 const p = plus(project.point(place.x / fine, place.y / fine), place.depth / scale, project.towards);
    Point3 const q = project.eye.seen(p);
    auto const pixel = project(q);
    place.x = static_cast<float>(pixel[0] * samples);
    place.y = static_cast<float>(pixel[1] * samples);
    place.depth = static_cast<float>(dot(q, project.towards) * scale);
    return static_cast<float>(project.eye.magnification(p));
  };
  for (Vertex& vertex : surfaces.vertices) moved(vertex);
  for (Ellipsoid& one : surfaces.ellipsoids) {
    float const larger = moved(one);
    for (float& q : one.Q) q /= larger * larger;
    for (float& half : one.half) half *= larger;
  }
}

/// Whether a particle is farther from its place in the reference configuration than half a spacing.
bool has_moved(ReferenceMesh const& mesh, std::span<Point3 const> x) {
  for (std::size_t i = 0; i < mesh.count; ++i)
    if (distance(x[mesh.first + i], mesh.X[i]) > 0.5 * mesh.spacing) return true;
  return false;
}

/// The axis of a section, a little longer than the bodies are.
Polyline axis_of_section(PictureData const& data) {
  constexpr double longer = 0.08;
  double low = std::min(data.stage_low[1], data.stage_high[1]), high = std::max(data.stage_low[1], data.stage_high[1]);
  for (Point3 const& p : data.points) {
    if (!std::isfinite(p[1])) continue;
    low = std::min(low, p[1]);
    high = std::max(high, p[1]);
  }
  double const more = longer * (high - low);
  return {{0, low - more, 0}, {0, high + more, 0}};
}

/// A thin line of long dashes.
void draw_axis(PictureData const& data, Projection const& project, SurfaceBuffers const& like, int fine,
               std::vector<float>& coverage) {
  coverage.resize(like.depth.size(), 0);
  DashedLines const line{.project = project, .fine = fine, .width = 1, .dash = 16, .gap = 5};
  line.draw({axis_of_section(data)}, like.width, like.height, coverage);
}

/// The outlines of the bodies that have moved, and the axis of a section.
std::vector<float> outlines(PictureData const& data, Appearance const& appearance, Projection const& project,
                            SurfaceBuffers const& like, int fine) {
  std::vector<float> coverage;
  for (std::size_t body = 0; appearance.outline && body < data.meshes.size(); ++body) {
    ReferenceMesh const& mesh = data.meshes[body];
    bool const shown = body >= appearance.as.size() || appearance.as[body] != Representation::none;
    if (!shown || mesh.lines.empty() || mesh.first + mesh.count > data.points.size()) continue;
    if (!has_moved(mesh, data.points)) continue;
    coverage.resize(like.depth.size(), 0);
    DashedLines const dashed{project, fine};
    if (data.swept) {
      dashed.draw(revolved_outline(mesh, *data.swept, project), like.width, like.height, coverage);
      continue;
    }
    dashed.draw(mesh.lines, like.width, like.height, coverage);
    dashed.draw(silhouette(mesh, project.towards), like.width, like.height, coverage);
  }
  if (data.swept == 0.0) draw_axis(data, project, like, fine, coverage);
  return coverage;
}

/// Shading parameters that do not depend on the buffers.
Shading shading_of(Scene const& scene, Appearance const& appearance, ColourMap const& map,
                   std::optional<Colour> background) {
  Shading shading;
  shading.fine = samples_across(appearance.quality);
  shading.directions = appearance.quality == Quality::high ? 96 : 28;
  shading.transparent = !background;
  if (background) shading.background = *background;
  shading.radius = scene.radius;
  shading.range = {map.low(), map.high()};
  if (!scene.colours.empty()) shading.range = {0, Shading::steps - 1.0};
  return shading;
}

/// A rectangle of a picture [pixels].
struct Part {
  int x = 0, y = 0, width = 0, height = 0;
};

/// Grows with the places that are drawn [pixels].
class Covered {
 public:
  void add(double x, double y, double half_width = 0, double half_height = 0) {
    if (!std::isfinite(x + y + half_width + half_height)) return;
    low_ = {std::min(low_[0], x - half_width), std::min(low_[1], y - half_height)};
    high_ = {std::max(high_[0], x + half_width), std::max(high_[1], y + half_height)};
  }
  void add(Surfaces const& surfaces, double fine) {
    for (Vertex const& v : surfaces.vertices) add(static_cast<double>(v.x) / fine, static_cast<double>(v.y) / fine);
    for (Ellipsoid const& e : surfaces.ellipsoids)
      add(static_cast<double>(e.x) / fine, static_cast<double>(e.y) / fine, static_cast<double>(e.half[0]) / fine,
          static_cast<double>(e.half[1]) / fine);
  }
  /// All of it, with air for edges; occlusion has a pattern of four pixels, hence the steps.
  Part part(SceneArea const& area) const {
    constexpr int step = 16, air = 8;
    auto const from = [&](double low, int most) {
      return static_cast<int>(std::clamp(low - air, 0.0, static_cast<double>(most))) / step * step;
    };
    auto const to = [&](double high, int most) {
      return static_cast<int>(std::clamp(high + air, 0.0, static_cast<double>(most)));
    };
    if (!(low_[0] <= high_[0])) return {0, 0, std::min(step, area.width), std::min(step, area.height)};
    int const x = from(low_[0], area.width), y = from(low_[1], area.height);
    return {x, y, std::max(to(high_[0], area.width) - x, 1), std::max(to(high_[1], area.height) - y, 1)};
  }

 private:
  std::array<double, 2> low_{1e300, 1e300}, high_{-1e300, -1e300};
};

/// Where there is something to draw; all of it where a ground, rigid shapes, sections or perspective may reach
/// anywhere.
Part part_to_draw(PictureData const& data, Appearance const& appearance, Projection const& project,
                  SceneArea const& area, Scene const& scene, int fine) {
  if (!data.rigid_shapes.empty() || data.ground || data.swept || project.eye.near())
    return {0, 0, area.width, area.height};
  Covered covered;
  covered.add(scene.bodies, fine);
  covered.add(scene.ghosts, fine);
  for (ReferenceMesh const& mesh : data.meshes)
    for (std::size_t i = 0; appearance.outline && i < mesh.count; ++i) {
      auto const pixel = project(plus(mesh.X[i], 1, mesh.outward[i]));
      covered.add(pixel[0], pixel[1]);
    }
  return covered.part(area);
}

void move_by(Surfaces& surfaces, Part const& part, int fine) {
  auto const move = [&](auto& place) {
    place.x -= static_cast<float>(part.x * fine);
    place.y -= static_cast<float>(part.y * fine);
  };
  for (Vertex& vertex : surfaces.vertices) move(vertex);
  for (Ellipsoid& one : surfaces.ellipsoids) move(one);
}

/// A part of a picture in the picture.
Image pasted(Image const& drawn, Part const& part, SceneArea const& area, std::optional<Colour> background) {
  if (drawn.width == area.width && drawn.height == area.height) return drawn;
  Image out(area.width, area.height, background.value_or(Colour{}));
  auto const columns = static_cast<std::size_t>(drawn.width);
  if (!background) out.alpha.assign(out.rgb.size() / 3, 0);
  for (int y = 0; y < drawn.height; ++y) {
    std::size_t const from = static_cast<std::size_t>(y) * columns,
                      to = static_cast<std::size_t>(y + part.y) * static_cast<std::size_t>(area.width) +
                           static_cast<std::size_t>(part.x);
    std::copy_n(&drawn.rgb[3 * from], 3 * columns, &out.rgb[3 * to]);
    if (!background) std::copy_n(&drawn.alpha[from], columns, &out.alpha[to]);
  }
  return out;
}

/// Rigid shapes, those of sections as these are shown.
void draw_shapes(PictureData const& data, Projection const& project, SceneArea const& area, int fine,
                 SurfaceBuffers& tools) {
  if (data.swept && *data.swept > 0) {
    Surfaces shapes = swept_shapes(data, project, fine);
    if (project.eye.near()) move_to_where_seen(shapes, project, fine);
    for (Vertex& vertex : shapes.vertices) vertex.depth -= 1;  // cut faces of bodies lie in the same planes
    return rasterise(shapes, tools);
  }
  Stage const stage{data.stage_low, data.stage_high};
  RigidCanvas const canvas{project, stage, data.dimension, fine, area.top * fine, area.right * fine};
  if (data.swept)
    canvas.draw(tools, with_mirror_images(data.rigid_shapes));
  else
    canvas.draw(tools, data.rigid_shapes);
}

}  // namespace

Image draw_bodies(PictureData const& data, Appearance const& appearance, Projection const& whole, SceneArea const& area,
                  ColourMap const& map, std::optional<Colour> background) {
  PIOLA_EXPECTS(area.width > 0 && area.height > 0);
  PIOLA_EXPECTS(data.dimension >= 1 && data.dimension <= 3);
  int const fine = samples_across(appearance.quality);
  Scene scene = make_scene(data, appearance, whole, fine);
  if (whole.eye.near()) {
    move_to_where_seen(scene.bodies, whole, fine);
    move_to_where_seen(scene.ghosts, whole, fine);
  }
  Part const part = part_to_draw(data, appearance, whole, area, scene, fine);
  move_by(scene.bodies, part, fine);
  move_by(scene.ghosts, part, fine);
  Projection project = whole;
  project.x_shift -= part.x;
  project.y_shift -= part.y;

  SurfaceBuffers bodies(part.width * fine, part.height * fine), tools, ghosts;
  rasterise(scene.bodies, bodies);
  Shading shading = shading_of(scene, appearance, map, background);
  shading.bodies = {&bodies, finish_of_bodies(data, scene, map, hatch_of(area, fine))};
  if (!data.rigid_shapes.empty()) {
    tools = SurfaceBuffers(bodies.width, bodies.height);
    draw_shapes(data, project, area, fine, tools);
    shading.tools = {&tools, finish_of_tools(data, 2 * scene.radius)};
  }
  if (!scene.ghosts.triangles.empty() || !scene.ghosts.ellipsoids.empty()) {
    ghosts = SurfaceBuffers(bodies.width, bodies.height);
    rasterise(scene.ghosts, ghosts);
    shading.ghosts = {&ghosts, shading.bodies.finish};
  }
  auto const lines = outlines(data, appearance, project, bodies, fine);
  shading.lines = lines;
  auto const ground = ground_below(data, appearance, project, area);
  shading.ground = ground;
  return pasted(shade(shading), part, area, background);
}

}  // namespace piola
