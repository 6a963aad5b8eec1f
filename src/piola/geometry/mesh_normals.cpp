// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_normals.hpp"
#include "piola/base/contracts.hpp"
#include <cmath>

namespace piola::geometry {

namespace {

Vec<3> unit_or_zero(Vec<3> const& v) {
  double const length = std::sqrt(dot(v, v));
  return length > 0 ? (1 / length) * v : Vec<3>{};
}

double angle_at_corner(Surface const& surface, int face, int k) {
  auto const& c = surface.corner[face];
  Vec<3> const a = surface.X[c[(k + 1) % 3]] - surface.X[c[k]], b = surface.X[c[(k + 2) % 3]] - surface.X[c[k]];
  Vec<3> const n = cross(a, b);
  return std::atan2(std::sqrt(dot(n, n)), dot(a, b));
}

}  // namespace

TriangleFoot foot_on_triangle(Vec<3> const& X, Vec<3> const& a, Vec<3> const& b, Vec<3> const& c) {
  Vec<3> const ab = b - a, ac = c - a, from_a = X - a, from_b = X - b, from_c = X - c;
  double const ab_a = dot(ab, from_a), ac_a = dot(ac, from_a);
  if (ab_a <= 0 && ac_a <= 0) return {a, 4};
  double const ab_b = dot(ab, from_b), ac_b = dot(ac, from_b);
  if (ab_b >= 0 && ac_b <= ab_b) return {b, 5};
  double const ab_c = dot(ab, from_c), ac_c = dot(ac, from_c);
  if (ac_c >= 0 && ab_c <= ac_c) return {c, 6};
  // Shares of the corners: areas of the triangles that the foot forms with the opposite sides.
  double const share_c = ab_a * ac_b - ab_b * ac_a;
  if (share_c <= 0 && ab_a >= 0 && ab_b <= 0) return {a + (ab_a / (ab_a - ab_b)) * ab, 1};
  double const share_b = ab_c * ac_a - ab_a * ac_c;
  if (share_b <= 0 && ac_a >= 0 && ac_c <= 0) return {a + (ac_a / (ac_a - ac_c)) * ac, 3};
  double const share_a = ab_b * ac_c - ab_c * ac_b;
  double const bc_b = ac_b - ab_b, bc_c = ac_c - ab_c;
  if (share_a <= 0 && bc_b >= 0 && bc_c <= 0) return {b + (bc_b / (bc_b - bc_c)) * (c - b), 2};
  double const scale = 1 / (share_a + share_b + share_c);
  return {a + (share_b * scale) * ab + (share_c * scale) * ac, 0};
}

SurfaceNormals::SurfaceNormals(Surface const& surface, Links const& links) : corners_of_(surface.corner) {
  PIOLA_EXPECTS(links.across.size() == 3 * surface.corner.size());
  face_.resize(surface.corner.size());
  std::vector<int> flat;
  for (int face = 0; face < surface.faces(); ++face) {
    if (surface.is_flat(face))
      flat.push_back(face);
    else
      face_[face] = unit_or_zero(surface.twice_area(face));
  }
  for (int const face : flat) {
    int const other = links.across[3 * face + surface.longest_side(face)];
    if (other >= 0 && !surface.is_flat(other / 3)) face_[face] = face_[other / 3];
  }
  side_.resize(links.across.size());
  corner_.resize(surface.X.size());
  for (int half = 0; half < static_cast<int>(links.across.size()); ++half) {
    int const face = half / 3, corner = surface.corner[face][half % 3];
    side_[half] = unit_or_zero(face_[face] + seen_over(surface, links, half));
    corner_[corner] = corner_[corner] + angle_at_corner(surface, face, half % 3) * face_[face];
  }
  for (Vec<3>& n : corner_) n = unit_or_zero(n);
}

Vec<3> SurfaceNormals::seen_over(Surface const& surface, Links const& links, int half) const {
  int const other = links.across[half];
  if (other < 0) return {};
  int const face = other / 3, longest = surface.longest_side(face);
  if (!surface.is_flat(face) || other % 3 != longest) return face_[face];
  Vec<3> sum;
  for (int side = 0; side < 3; ++side)
    if (int const behind = links.across[3 * face + side]; side != longest && behind >= 0) sum = sum + face_[behind / 3];
  return unit_or_zero(sum);
}

Vec<3> SurfaceNormals::at(int face, int feature) const {
  if (feature == 0) return face_[face];
  return feature < 4 ? side_[3 * face + feature - 1] : corner_[corners_of_[face][feature - 4]];
}

}  // namespace piola::geometry
