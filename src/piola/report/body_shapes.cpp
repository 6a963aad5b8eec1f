// SPDX-License-Identifier: Apache-2.0
#include "piola/report/body_shapes.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/observers/results_folder.hpp"
#include "piola/pictures/case_scene.hpp"
#include <algorithm>
#include <cmath>

namespace piola::report {
namespace {

/// Places and states of all particles in a frame.
struct ParticlesNow {
  std::vector<Point3> x;
  std::vector<std::uint8_t> loose;
  Configuration of(ReferenceMesh const& mesh) const {
    return {std::span(x).subspan(mesh.first, mesh.count), std::span(loose).subspan(mesh.first, mesh.count)};
  }
};

ParticlesNow particles_in(FrameReader const& frame) { return {frame.positions(), loose_particles(frame)}; }

/// V of F = V R.
SymMat<3> left_stretch(Mat<3> const& F) {
  Mat<3> const FFt = F * transpose(F);
  SymMat<3> B, V;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) B(a, b) = FFt(a, b);
  Eigen<3> const e = symmetric_eigen(B);
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      V(a, b) = 0;
      for (int k = 0; k < 3; ++k) V(a, b) += std::sqrt(std::max(e.value[k], 0.0)) * e.vector[k][a] * e.vector[k][b];
    }
  return V;
}

constexpr std::array<std::array<int, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

}  // namespace

std::optional<BodyShapes> BodyShapes::of(RunFolder const& run, int dimension, std::vector<std::uint16_t> const& body) {
  ParticleSet particles;
  if (!case_in_results(run.path, &particles) || particles.dimension != dimension) return std::nullopt;
  bool const same = std::equal(body.begin(), body.end(), particles.body.begin(), particles.body.end(),
                               [](std::uint16_t a, int b) { return static_cast<int>(a) == b; });
  if (!same) return std::nullopt;
  return BodyShapes(reference_meshes(particles));
}

void BodyShapes::find_torn_cells(RunFolder const& run) {
  std::vector<std::vector<Index>> before;
  for (auto const& [time, path] : run.frames) {
    FrameReader const frame(path);
    ParticlesNow const now = particles_in(frame);
    before = current_torn_cells(meshes_, now.x, now.loose, before);
    torn_[frame.time()] = before;
  }
}

BodySurfaces BodyShapes::surfaces(FrameReader const& frame) const {
  ParticlesNow const now = particles_in(frame);
  auto const torn = torn_.find(frame.time());
  BodySurfaces all{now.x, {}, std::vector<std::uint8_t>(now.x.size(), 1)};
  for (std::size_t body = 0; body < meshes_.size(); ++body) {
    ReferenceMesh const& mesh = meshes_[body];
    if (mesh.cells.count() == 0 || mesh.dimension == 1) continue;
    Configuration configuration = now.of(mesh);
    if (torn != torn_.end()) configuration.torn = torn->second[body];
    Skin const skin = make_skin(mesh, configuration);
    for (std::size_t i = 0; i < mesh.count; ++i) {
      if (skin.inside[i] == 0) continue;
      all.place[mesh.first + i] = skin.place[i];
      all.alone[mesh.first + i] = 0;
    }
    for (SkinFacet const& facet : skin.facets) {
      auto& corners = all.facets.emplace_back();
      for (std::size_t c = 0; c < 3; ++c)
        corners[c] = static_cast<std::uint32_t>(mesh.first + static_cast<std::size_t>(facet.corner[c]));
    }
  }
  return all;
}

ByteScale BodyShapes::stretch_scale(std::size_t component) {
  PIOLA_EXPECTS(component < stretch_components);
  // Codes represent 1 and 0, the components of an unstretched ball, exactly. Largest values: 4 on the diagonal, half of
  // 4 - 1/3 off it.
  if (component < 3) return {0.3, 0.3 + 0.7 * 254 / 44};
  return {-1.905, 1.905};
}

std::array<std::vector<std::uint8_t>, 6> BodyShapes::stretches(FrameReader const& frame, std::size_t every) const {
  PIOLA_EXPECTS(every >= 1);
  ParticlesNow const now = particles_in(frame);
  std::array<std::vector<std::uint8_t>, stretch_components> bytes;
  for (std::size_t c = 0; c < stretch_components; ++c)
    bytes[c].assign((now.x.size() + every - 1) / every, stretch_scale(c).code(c < 3 ? 1 : 0));
  for (ReferenceMesh const& mesh : meshes_) {
    if (mesh.cells.count() == 0) continue;
    Configuration const body = now.of(mesh);
    exec_host::parallel_for(static_cast<Index>(mesh.count), [&](Index k) {
      auto const i = static_cast<std::size_t>(k);
      if ((mesh.first + i) % every != 0) return;
      Mat<3> const F = with_bounded_stretches(fitted_gradient(mesh, body, i), least_ball_stretch, most_ball_stretch);
      SymMat<3> const V = left_stretch(F);
      bool all_finite = true;
      for (auto const& [a, b] : pairs) all_finite = all_finite && std::isfinite(V(a, b));
      for (std::size_t c = 0; all_finite && c < stretch_components; ++c)
        bytes[c][(mesh.first + i) / every] = stretch_scale(c).code(V(pairs[c][0], pairs[c][1]));
    });
  }
  return bytes;
}

}  // namespace piola::report
