// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/scene.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/revolved_shapes.hpp"
#include "piola/drawing/revolved_skin.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <map>
#include <numbers>
#include <optional>

namespace piola {
namespace {

constexpr std::size_t most_balls = 2'000'000;      // above it there are more balls than samples
constexpr std::size_t most_bodies = no_owner / 2;  // with their hatched twins

/// From metres to samples.
struct ToSamples {
  Projection const& project;
  double fine;
  Vertex operator()(Point3 const& p) const {
    auto const pixel = project(p);
    Vertex v;
    v.x = static_cast<float>(pixel[0] * fine);
    v.y = static_cast<float>(pixel[1] * fine);
    v.depth = static_cast<float>(dot(p, project.towards) * project.scale * fine);
    return v;
  }
  /// A direction, of length one: right, down and towards the viewer.
  SurfaceBuffers::Normal normal(Point3 const& n) const {
    double const sign = dot(n, project.towards) < 0 ? -1 : 1;  // both sides are drawn
    return SurfaceBuffers::packed(sign * dot(n, project.right), -sign * dot(n, project.up));
  }
  std::array<Point3, 3> axes() const {
    return {project.right, Point3{-project.up[0], -project.up[1], -project.up[2]}, project.towards};
  }
};

/// How far a place is beyond a cut; below zero: it is kept.
double beyond(CutPlane const& cut, Point3 const& x) { return dot(minus(x, cut.point), cut.normal); }

/// One body on its way into the scene.
class BodyDrawing {
 public:
  BodyDrawing(PictureData const& data, Appearance const& appearance, ToSamples const& to_samples, std::size_t body,
              Scene& scene)
      : data_(data), appearance_(appearance), to_samples_(to_samples), body_(body), scene_(scene) {
    if (body < data.meshes.size()) mesh_ = &data.meshes[body];
    as_ = body < appearance.as.size() ? appearance.as[body] : Representation::automatic;
  }

  /// `first`, `count`: its particles.
  void draw(std::size_t first, std::size_t count) {
    if (as_ == Representation::none) return;
    bool const solid = as_ == Representation::automatic || as_ == Representation::skin;
    if (mesh_ && mesh_->count != count) mesh_ = nullptr;
    Configuration now;
    if (mesh_) {
      now = {data_.points.subspan(first, count), {}};
      if (!data_.loose.empty()) now.loose = data_.loose.subspan(first, count);
      if (body_ < data_.torn.size()) now.torn = data_.torn[body_];
    }
    Skin skin;
    if (mesh_ && solid && mesh_->dimension > 1) skin = make_skin(*mesh_, now);
    if (data_.swept && !skin.facets.empty())
      skin = revolved(skin, *data_.swept, width_of_axis(skin.reference, mesh_->spacing));
    if (!skin.facets.empty()) {
      add_skin(skin, first);
      add_section(skin, first);
    }
    add_balls(now, skin, first, count);
  }

 private:
  float value(std::size_t i) const { return scene_.value[i]; }
  bool held(std::size_t i) const { return scene_.hatched && data_.held[i] != 0; }
  Owner owner(bool hatched) const { return static_cast<Owner>(body_ + (hatched ? scene_.bodies_in_all : 0)); }

  void add_skin(Skin const& skin, std::size_t first) {
    Surfaces& out = scene_.bodies;
    std::vector<std::int32_t> vertex(skin.place.size(), -1);
    std::size_t const first_vertex = out.vertices.size(), first_triangle = out.triangles.size();
    for (SkinFacet const& facet : skin.facets) {
      Triangle t;
      // A support often holds one layer of particles: its cells are hatched, which can be seen from the side.
      t.owner = owner(std::any_of(facet.corner.begin(), facet.corner.end(), [&](Index c) {
        return held(first + skin.particle_of(static_cast<std::size_t>(c)));
      }));
      for (std::size_t c = 0; c < 3; ++c) {
        auto const i = static_cast<std::size_t>(facet.corner[c]);
        if (vertex[i] < 0) {
          vertex[i] = static_cast<std::int32_t>(out.vertices.size());
          out.vertices.push_back(vertex_of(skin, i, first));
        }
        t.corner[c] = vertex[i];
        t.normal[c] = to_samples_.normal(facet.normal[c]);
      }
      out.triangles.push_back(t);
    }
    if (appearance_.cut && appearance_.cut->ghost) copy_other_side(first_vertex, first_triangle);
  }

  Vertex vertex_of(Skin const& skin, std::size_t i, std::size_t first) const {
    Vertex v = to_samples_(skin.place[i]);
    v.value = value(first + skin.particle_of(i));
    if (appearance_.cut)
      v.beyond = static_cast<float>(
          beyond(*appearance_.cut, appearance_.cut->in_reference ? skin.reference[i] : skin.place[i]));
    return v;
  }

  void copy_other_side(std::size_t first_vertex, std::size_t first_triangle) {
    Surfaces& out = scene_.ghosts;
    auto const shift = static_cast<std::int32_t>(out.vertices.size()) - static_cast<std::int32_t>(first_vertex);
    for (std::size_t k = first_vertex; k < scene_.bodies.vertices.size(); ++k) {
      out.vertices.push_back(scene_.bodies.vertices[k]);
      out.vertices.back().beyond *= -1;
    }
    for (std::size_t k = first_triangle; k < scene_.bodies.triangles.size(); ++k) {
      out.triangles.push_back(scene_.bodies.triangles[k]);
      for (std::int32_t& c : out.triangles.back().corner) c += shift;
    }
  }

  void add_section(Skin const& skin, std::size_t first) {
    if (!appearance_.cut || mesh_->dimension < 3) return;
    std::vector<double> far(skin.place.size());
    for (std::size_t i = 0; i < far.size(); ++i)
      far[i] = beyond(*appearance_.cut, appearance_.cut->in_reference ? skin.reference[i] : skin.place[i]);
    for (auto const& corners : section(*mesh_, skin, far)) {
      std::array<Point3, 3> x{};
      Triangle t;
      bool hatched = false;
      for (std::size_t c = 0; c < 3; ++c) {
        auto const a = static_cast<std::size_t>(corners[c].particle[0]),
                   b = static_cast<std::size_t>(corners[c].particle[1]);
        double const share = corners[c].share;
        hatched = hatched || held(first + a) || held(first + b);
        x[c] = plus(skin.place[a], share, minus(skin.place[b], skin.place[a]));
        Vertex v = to_samples_(x[c]);
        float const s = static_cast<float>(share), from = value(first + a), to = value(first + b);
        v.value = !data_.colours.empty() ? from : (1 - s) * from + s * to;
        t.corner[c] = static_cast<std::int32_t>(scene_.bodies.vertices.size());
        scene_.bodies.vertices.push_back(v);
      }
      t.owner = owner(hatched);
      t.normal.fill(to_samples_.normal(unit(cross(minus(x[1], x[0]), minus(x[2], x[0])))));
      scene_.bodies.triangles.push_back(t);
    }
  }

  void add_balls(Configuration const& now, Skin const& skin, std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> alone;
    for (std::size_t i = 0; i < count; ++i)
      if (skin.facets.empty() || skin.inside[i] == 0) alone.push_back(static_cast<std::uint32_t>(i));
    bool const as_points =
        as_ == Representation::points || (as_ == Representation::automatic && alone.size() > most_balls);
    if (data_.swept) return add_rings(now, alone, first, as_points);
    std::vector<Ellipsoid> balls(alone.size());
    exec_host::parallel_for(static_cast<Index>(alone.size()), [&](Index k) {
      std::size_t const i = alone[static_cast<std::size_t>(k)];
      balls[static_cast<std::size_t>(k)] = ball(now, i, first, as_points);
    });
    for (std::size_t k = 0; k < alone.size(); ++k)
      (is_gone(alone[k], first) ? scene_.ghosts : scene_.bodies).ellipsoids.push_back(balls[k]);
  }

  /// Balls on both sides of the axis, or along a circle at the distance of `overlap`.
  void add_rings(Configuration const& now, std::vector<std::uint32_t> const& alone, std::size_t first, bool as_points) {
    constexpr double overlap = 1.4, most = 360;  // distance in radii; of a circle
    for (std::size_t const i : alone) {
      double const radians = *data_.swept * std::numbers::pi / 180;
      double const parts =
          std::clamp(radians * data_.points[first + i][0] / (overlap * data_.radius[first + i]), 1.0, most);
      auto& out = (is_gone(i, first) ? scene_.ghosts : scene_.bodies).ellipsoids;
      for (double const angle : angles_of_sweep(*data_.swept, std::max(*data_.swept, 1.0) / std::ceil(parts)))
        out.push_back(ball(now, i, first, as_points, Rotation::by(angle)));
    }
  }

  Ellipsoid ball(Configuration const& now, std::size_t i, std::size_t first, bool as_point,
                 std::optional<Rotation> const& rotate = {}) const {
    Point3 const x = rotate ? (*rotate)(data_.points[first + i]) : data_.points[first + i];
    Ellipsoid e;
    Vertex const centre = to_samples_(x);
    e.x = centre.x;
    e.y = centre.y;
    e.depth = centre.depth;
    e.value = value(first + i);
    e.owner = owner(held(first + i));
    e.flat = data_.dimension < 3;
    double const least = (data_.dimension == 1 ? 5.0 : 1.2) * to_samples_.fine;  // thinner ones cannot be seen
    double const radius = data_.radius[first + i] * to_samples_.project.scale * to_samples_.fine;
    bool const small = as_point || !(radius > least);
    std::array<Point3, 3> S = to_samples_.axes();
    if (rotate)
      for (Point3& row : S) row = rotate->seen_from_section(row);
    if (mesh_ && !small)
      stretch(S, with_bounded_stretches(fitted_gradient(*mesh_, now, i), least_ball_stretch, most_ball_stretch));
    for (Point3& row : S) row = plus({}, small ? least : radius, row);
    set_shape(e, S);
    return e;
  }

  bool is_gone(std::size_t i, std::size_t first) const {
    if (!appearance_.cut) return false;
    bool const then = appearance_.cut->in_reference && mesh_;
    return beyond(*appearance_.cut, then ? mesh_->X[i] : data_.points[first + i]) > 0;
  }

  static void stretch(std::array<Point3, 3>& S, Mat<3> const& F) {
    for (Point3& row : S) {
      Point3 const axis = row;
      for (int b = 0; b < 3; ++b) {
        row[static_cast<std::size_t>(b)] = 0;
        for (int a = 0; a < 3; ++a) row[static_cast<std::size_t>(b)] += axis[static_cast<std::size_t>(a)] * F(a, b);
      }
    }
  }

  PictureData const& data_;
  Appearance const& appearance_;
  ToSamples const& to_samples_;
  std::size_t body_;
  Scene& scene_;
  ReferenceMesh const* mesh_ = nullptr;
  Representation as_ = Representation::automatic;
};

/// Runs of particles of one body each, in the order of the particles: as setup made them.
template <class F>
void each_body(PictureData const& data, F const& f) {
  std::size_t const n = data.points.size();
  if (n > 0 && data.body.empty()) return f(std::size_t{0}, std::size_t{0}, n);
  for (std::size_t first = 0; first < n;) {
    std::size_t last = first + 1;
    while (last < n && data.body[last] == data.body[first]) ++last;
    f(static_cast<std::size_t>(std::max(data.body[first], 0)), first, last - first);
    first = last;
  }
}

/// Sets the value of each particle in the buffers: its field value, or the index of its colour.
void set_values(PictureData const& data, Scene& scene) {
  std::map<Colour, float> number;
  for (Colour const& colour : data.colours) {
    auto const known = number.try_emplace(colour, static_cast<float>(scene.colours.size()));
    if (known.second) scene.colours.push_back(colour);
    scene.value.push_back(known.first->second);
  }
  if (data.colours.empty())
    for (double const v : data.values) scene.value.push_back(static_cast<float>(v));
}

/// The middle one of the radii.
double typical_radius(std::span<double const> radius) {
  std::vector<double> all(radius.begin(), radius.end());
  if (all.empty()) return 0;
  auto const middle = all.begin() + static_cast<std::ptrdiff_t>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

}  // namespace

Scene make_scene(PictureData const& data, Appearance const& appearance, Projection const& project, int fine) {
  PIOLA_EXPECTS(fine >= 1);
  PIOLA_EXPECTS(data.radius.size() >= data.points.size());
  PIOLA_EXPECTS((data.colours.empty() ? data.values.size() : data.colours.size()) >= data.points.size());
  PIOLA_EXPECTS(data.body.empty() || data.body.size() == data.points.size());
  PIOLA_EXPECTS(data.loose.empty() || data.loose.size() == data.points.size());
  Scene scene;
  ToSamples const to_samples{project, static_cast<double>(fine)};
  scene.bodies.nearest_value = scene.ghosts.nearest_value = !data.colours.empty();
  set_values(data, scene);
  double const radius_of_spacing = 0.58;  // see ball_radii
  scene.hatched = data.held.size() == data.points.size() && !data.held.empty();
  each_body(data, [&](std::size_t body, std::size_t, std::size_t) {
    body = std::min<std::size_t>(body, most_bodies - 1);
    scene.bodies_in_all = std::max(scene.bodies_in_all, static_cast<Owner>(body + 1));
  });
  each_body(data, [&](std::size_t body, std::size_t first, std::size_t count) {
    body = std::min<std::size_t>(body, most_bodies - 1);
    scene.spacing.resize(std::max(scene.spacing.size(), body + 1), 0);
    scene.spacing[body] = static_cast<float>(data.radius[first] / radius_of_spacing * project.scale * fine);
    BodyDrawing(data, appearance, to_samples, body, scene).draw(first, count);
  });
  if (scene.hatched) {
    scene.spacing.resize(scene.bodies_in_all, 0);
    std::vector<float> const twins = scene.spacing;
    scene.spacing.insert(scene.spacing.end(), twins.begin(), twins.end());
  }
  scene.radius = static_cast<float>(typical_radius(data.radius) * project.scale * fine);
  return scene;
}

Surfaces swept_shapes(PictureData const& data, Projection const& project, int fine) {
  PIOLA_EXPECTS(data.swept && *data.swept > 0);
  Surfaces out;
  ToSamples const to_samples{project, static_cast<double>(fine)};
  for (RigidShape const& shape : data.rigid_shapes) {
    Skin const skin = revolved(shape, {data.stage_low, data.stage_high}, *data.swept);
    auto const first = static_cast<std::int32_t>(out.vertices.size());
    for (Point3 const& p : skin.place) out.vertices.push_back(to_samples(p));
    for (SkinFacet const& facet : skin.facets) {
      Triangle t{.owner = RigidCanvas::bright};
      for (std::size_t c = 0; c < 3; ++c) {
        t.corner[c] = first + static_cast<std::int32_t>(facet.corner[c]);
        t.normal[c] = to_samples.normal(facet.normal[c]);
      }
      out.triangles.push_back(t);
    }
  }
  return out;
}

}  // namespace piola
