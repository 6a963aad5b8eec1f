// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/face_parts.hpp"
#include "piola/formulations/nodal/loaded_face.hpp"
#include <cmath>

namespace piola::nodal {
namespace {

using Point = std::array<double, 3>;

/// Areas times normals, added up over patches as they are.
template <int D>
PartFilled<FacePart> vector_parts(LoadedFace<D> const& face, Divergence<D> const& divergence, Point const& area) {
  PartFilled<Point> sum(divergence.particles());
  for (int axis = 0; axis < D; ++axis) {
    auto const share = divergence.shares([&](SurfacePatch const& p) {
      double const whole = p.axis == axis && face.has(p) ? area[static_cast<std::size_t>(axis)] : 0;
      return p.upper ? whole : -whole;
    });
    divergence.each_own([&](std::size_t b) { sum[b][static_cast<std::size_t>(axis)] = share[b]; });
  }
  PartFilled<FacePart> parts(sum.size());
  divergence.each_own([&](std::size_t b) {
    double const size = std::sqrt(sum[b][0] * sum[b][0] + sum[b][1] * sum[b][1] + sum[b][2] * sum[b][2]);
    if (size > 0) parts[b] = {size, {sum[b][0] / size, sum[b][1] / size, sum[b][2] / size}};
  });
  return parts;
}

/// Areas of the exact surface: what patches show of themselves along its normals.
template <int D>
PartFilled<FacePart> scalar_parts(LoadedFace<D> const& face, Divergence<D> const& divergence, Point const& area,
                                  std::optional<Point> const& normal) {
  auto const share =
      divergence.shares([&](SurfacePatch const& p) { return face.cosine(p) * area[static_cast<std::size_t>(p.axis)]; });
  PartFilled<FacePart> parts(share.size());
  divergence.each_own([&](std::size_t b) { parts[b] = {share[b], normal.value_or(Point{})}; });
  return parts;
}

}  // namespace

template <int D>
std::vector<PartFilled<FacePart>> face_parts(SetUp const& from, Fits<D> const& fits, Divergence<D> const& divergence,
                                             std::array<double, 3> const& h) {
  std::vector<PartFilled<FacePart>> parts;
  Point area{1, 1, 1};  // of a patch of size one in spacings, by its axis
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < static_cast<std::size_t>(D); ++c) area[axis] *= c == axis ? 1 : h[c];
  for (auto const& load : from.loads) {
    parts.emplace_back();
    if (!load.on_face()) continue;
    LoadedFace<D> const face(from, fits, divergence.patches(), load);
    parts.back() = load.normal || !load.pressure ? scalar_parts<D>(face, divergence, area, load.normal)
                                                 : vector_parts<D>(face, divergence, area);
  }
  return parts;
}

template std::vector<PartFilled<FacePart>> face_parts<1>(SetUp const&, Fits<1> const&, Divergence<1> const&,
                                                         std::array<double, 3> const&);
template std::vector<PartFilled<FacePart>> face_parts<2>(SetUp const&, Fits<2> const&, Divergence<2> const&,
                                                         std::array<double, 3> const&);
template std::vector<PartFilled<FacePart>> face_parts<3>(SetUp const&, Fits<3> const&, Divergence<3> const&,
                                                         std::array<double, 3> const&);

}  // namespace piola::nodal
