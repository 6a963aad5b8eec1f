// SPDX-License-Identifier: Apache-2.0
#include "piola/mechanics/contact/rigid_samples.hpp"
#include "piola/base/contracts.hpp"
#include "piola/math/array_conversion.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace piola::contact {
namespace {

constexpr double along_longest = 12;  // intervals
constexpr int around = 32;            // points on a circle

struct Row {
  int intervals = 1;
  double length = 0;
  double at(int k) const { return length * (static_cast<double>(k) / intervals - 0.5); }
  bool is_end(int k) const { return k == 0 || k == intervals; }
  /// Length that a point represents; half for end points.
  double share(int k) const { return (is_end(k) ? 0.5 : 1.0) * length / intervals; }
};

Row row(double length, double longest) {
  return {std::max(1, static_cast<int>(std::lround(along_longest * length / longest))), length};
}

std::vector<SurfaceSample> of_box(RigidShape const& shape, int dimension) {
  auto const& half = shape.half_lengths;
  double const longest = 2 * *std::max_element(half.begin(), half.begin() + dimension);
  std::array<Row, 3> rows{Row{0, 0}, Row{0, 0}, Row{0, 0}};
  for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) rows[c] = row(2 * half[c], longest);
  std::vector<SurfaceSample> all;
  std::array<int, 3> k{};
  for (k[0] = 0; k[0] <= rows[0].intervals; ++k[0])
    for (k[1] = 0; k[1] <= rows[1].intervals; ++k[1])
      for (k[2] = 0; k[2] <= rows[2].intervals; ++k[2]) {
        SurfaceSample sample;
        for (std::size_t face = 0; face < static_cast<std::size_t>(dimension); ++face) {
          if (!rows[face].is_end(k[face])) continue;
          double area = 1;  // of this face
          for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c)
            if (c != face) area *= rows[c].share(k[c]);
          sample.area += area;
        }
        if (!(sample.area > 0)) continue;
        for (std::size_t c = 0; c < static_cast<std::size_t>(dimension); ++c) {
          Vec<3> const edge = vector_of(shape.edges[c]);
          sample.arm = sample.arm + rows[c].at(k[c]) * edge;
        }
        all.push_back(sample);
      }
  return all;
}

std::vector<SurfaceSample> of_cylinder(RigidShape const& shape) {
  double const R = shape.radius, length = 2 * shape.half_lengths[0], longest = std::max(length, 2 * R);
  Vec<3> const axis = vector_of(shape.axis);
  Vec<3> const other = std::fabs(axis[0]) < 0.9 ? Vec<3>{{1, 0, 0}} : Vec<3>{{0, 1, 0}};
  Vec<3> u = other - dot(other, axis) * axis;
  u = (1 / std::sqrt(dot(u, u))) * u;
  Vec<3> const v = cross(axis, u);
  Row const side = row(length, longest), spoke = row(R, longest);
  double const ring = R / spoke.intervals, turn = 2 * std::numbers::pi / around;
  std::vector<SurfaceSample> all;
  for (double const end : {-0.5, 0.5})  // middles of the ends
    all.push_back({(end * length) * axis, std::numbers::pi * 0.25 * ring * ring});
  for (int k = 0; k < around; ++k) {
    Vec<3> const out = std::cos(turn * k) * u + std::sin(turn * k) * v;
    for (int j = 0; j <= side.intervals; ++j) {
      double area = turn * R * side.share(j);
      if (side.is_end(j)) area += turn * (R - 0.25 * ring) * 0.5 * ring;  // the outermost half of a ring
      all.push_back({side.at(j) * axis + R * out, area});
    }
    for (int j = 1; j < spoke.intervals; ++j)
      for (double const end : {-0.5, 0.5}) {
        double const r = R * j / spoke.intervals;
        all.push_back({(end * length) * axis + r * out, turn * r * ring});
      }
  }
  return all;
}

}  // namespace

std::vector<SurfaceSample> samples_of(RigidShape const& shape, int dimension) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(shape.kind == RigidShape::Kind::box || shape.kind == RigidShape::Kind::cylinder);
  return shape.kind == RigidShape::Kind::box ? of_box(shape, dimension) : of_cylinder(shape);
}

}  // namespace piola::contact
