// SPDX-License-Identifier: Apache-2.0
#include "piola/pictures/case_scene.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/skin.hpp"
#include "piola/math/quaternion.hpp"
#include "piola/model/case_particles.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola {
namespace {

/// The axis along which a vector points; nothing if it is oblique or zero.
std::optional<Up> axis_of(std::array<double, 3> const& v) {
  constexpr double oblique = 1e-6;
  constexpr std::array plus{Up::x, Up::y, Up::z}, minus{Up::minus_x, Up::minus_y, Up::minus_z};
  double const length = std::hypot(v[0], v[1], v[2]);
  for (std::size_t c = 0; c < 3; ++c) {
    if (length > 0 && std::abs(v[c]) >= (1 - oblique) * length) return v[c] > 0 ? plus[c] : minus[c];
  }
  return std::nullopt;
}

std::optional<Up> against_gravity(CaseSpec const& spec) {
  for (LoadSpec const& load : spec.loads) {
    if (load.kind != LoadSpec::Kind::acceleration || load.where || std::isfinite(load.until)) continue;
    std::array<double, 3> up{};
    bool constant = true;
    for (std::size_t c = 0; c < 3; ++c) {
      up[c] = -load.value[c]({});
      constant = constant && !load.value[c].depends_on_time();
    }
    if (auto const axis = axis_of(up); axis && constant) return axis;
  }
  for (RigidSpec const& rigid : spec.rigids)
    if (auto const axis = axis_of({-rigid.gravity[0]({}), -rigid.gravity[1]({}), -rigid.gravity[2]({})})) return axis;
  return std::nullopt;
}

/// Sets the pose of a shape: centre and rotation vector.
void put(RigidShape& shape, std::span<double const> pose) {
  Mat<3> const turn = matrix_of(turn_by({{pose[3], pose[4], pose[5]}}));
  auto const turned = [&](std::array<double, 3> const& a) {
    Vec<3> const b = turn * Vec<3>{{a[0], a[1], a[2]}};
    return std::array{b[0], b[1], b[2]};
  };
  std::copy_n(pose.begin(), 3, shape.centre.begin());
  shape.axis = turned(shape.axis);
  for (auto& edge : shape.edges) edge = turned(edge);
}

bool rests(RigidShape const& shape) {
  return !shape.turns() && std::all_of(shape.velocity.begin(), shape.velocity.end(),
                                       [](Expression const& v) { return v({}) == 0 && !v.depends_on_time(); });
}

}  // namespace

Up upwards(CaseSpec const& spec) {
  for (std::size_t k = 0; k < up_words.size(); ++k)
    if (spec.output.pictures.up == up_words[k]) return static_cast<Up>(k);
  if (auto const up = against_gravity(spec)) return *up;
  for (RigidSpec const& rigid : spec.rigids) {
    if (rigid.kind != RigidShape::Kind::plane || !rests(rigid)) continue;
    if (auto const up = axis_of(rigid.axis)) return *up;
  }
  return Up::y;
}

std::vector<RigidShape> shapes_at(std::vector<RigidSpec> const& rigids, double time, std::span<double const> poses) {
  PIOLA_EXPECTS(poses.size() % 6 == 0);
  // Midpoints of this number of intervals: exact for the constant and linear velocities of most cases.
  constexpr int intervals = 1000;
  std::vector<RigidShape> shapes;
  for (RigidSpec const& rigid : rigids) {
    RigidShape shape = rigid;
    if (shape.turns()) {
      if (poses.size() >= 6) {
        put(shape, poses.first(6));
        poses = poses.subspan(6);
      }
      shapes.push_back(std::move(shape));
      continue;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      Expression const& velocity = rigid.velocity[c];
      int const parts = velocity.depends_on_time() ? intervals : 1;
      double sum = 0;
      for (int k = 0; k < parts; ++k) sum += velocity({}, time * (k + 0.5) / parts);
      shape.centre[c] += sum * time / parts;
    }
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

std::span<PictureSpec const> panels_of(PicturesSpec const& pictures) {
  if (pictures.panels.empty()) return {static_cast<PictureSpec const*>(&pictures), 1};
  return pictures.panels;
}

std::optional<Point3> ground_of(CaseSpec const& spec, PictureSpec const& picture) {
  if (!picture.ground) return std::nullopt;
  return View{0, 0, upwards(spec)}.up();
}

std::optional<double> sweep_of(PictureSpec const& picture, bool axisymmetric) {
  if (picture.revolve > 0 && !axisymmetric)
    throw InputError(
        "revolve: the bodies are not axisymmetric (allowed with geometry = \"axisymmetric\" only) - leave it "
        "out");
  if (picture.revolve > 0 && picture.appearance.cut)
    throw InputError("revolve: there is a cut, too (allowed: one of both) - an angle below 360 cuts the bodies open");
  if (!axisymmetric) return std::nullopt;
  return picture.revolve;
}

int dimension_shown(std::optional<double> const& swept, int dimension) { return swept && *swept > 0 ? 3 : dimension; }

std::string title_of(std::string const& title, PictureSpec const& picture) {
  if (picture.warp == 1) return title;
  return fmt::format("{}{}displacements \u00d7 {:g}", title, title.empty() ? "" : ", ", picture.warp);
}

std::vector<std::array<double, 3>> warped(std::span<std::array<double, 3> const> x,
                                          std::span<std::array<double, 3> const> X, double warp) {
  std::vector<std::array<double, 3>> out(x.begin(), x.end());
  if (warp == 1) return out;
  for (std::size_t i = 0; i < std::min(out.size(), X.size()); ++i)
    for (std::size_t c = 0; c < 3; ++c) out[i][c] = X[i][c] + warp * (x[i][c] - X[i][c]);
  return out;
}

std::vector<std::uint8_t> held_particles(CaseSpec const& spec, ParticleSet const& particles) {
  std::vector<std::uint8_t> held(particles.X.size(), 0);
  for (SupportSpec const& support : spec.supports)
    for (std::size_t b = 0; b < std::min(spec.bodies.size(), particles.bodies.size()); ++b)
      if (spec.bodies[b].name == support.body)
        for (std::int64_t const id : supported_particles(particles, particles.bodies[b], support))
          held[static_cast<std::size_t>(id)] = 1;
  return held;
}

std::vector<std::vector<Index>> current_torn_cells(std::span<ReferenceMesh const> meshes,
                                                   std::span<std::array<double, 3> const> points,
                                                   std::span<std::uint8_t const> loose,
                                                   std::vector<std::vector<Index>> const& before) {
  PIOLA_EXPECTS(loose.empty() || loose.size() == points.size());
  std::vector<std::vector<Index>> torn;
  for (std::size_t b = 0; b < meshes.size(); ++b) {
    ReferenceMesh const& mesh = meshes[b];
    Configuration const now{points.subspan(mesh.first, mesh.count),
                            loose.empty() ? loose : loose.subspan(mesh.first, mesh.count)};
    torn.push_back(
        torn_cells(mesh, now, b < before.size() ? std::span<Index const>(before[b]) : std::span<Index const>()));
  }
  return torn;
}

std::vector<std::uint8_t> loose_particles(std::span<double const> damage, std::span<double const> kernel_type,
                                          std::size_t particles) {
  constexpr double all_of_it = 1 - 1e-6;  // frames hold single precision
  std::vector<std::uint8_t> loose(particles, 0);
  for (auto const values : {damage, kernel_type})
    for (std::size_t i = 0; i < std::min(particles, values.size()); ++i)
      if (values[i] >= all_of_it) loose[i] = 1;
  return loose;
}

std::vector<std::uint8_t> loose_particles(FrameReader const& frame) {
  auto const numbers = [&](char const* field) {
    auto const values = frame.knows(field) ? frame.values(field) : std::vector<float>();
    return std::vector<double>(values.begin(), values.end());
  };
  return loose_particles(numbers("Damage"), numbers("KernelType"), frame.particles());
}

}  // namespace piola
