// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/revolved_skin.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/revolution.hpp"
#include "piola/drawing/vector_math.hpp"
#include <algorithm>
#include <cmath>
#include <map>

namespace piola {
namespace {

/// Side of a section that is no side of another triangle; `normal` points outwards.
struct ProfileEdge {
  std::array<Index, 2> ends{};
  std::array<Point3, 2> normal{};  ///< at the ends
};

bool on_axis(Skin const& skin, Index corner) { return skin.place[static_cast<std::size_t>(corner)][0] == 0; }

/// A side of a triangle and the corner opposite to it.
struct TriangleSide {
  std::array<Index, 2> ends{};
  Index third = 0;
};

std::vector<TriangleSide> all_sides(Skin const& section) {
  std::vector<TriangleSide> sides;
  for (SkinFacet const& facet : section.facets)
    for (std::size_t c = 0; c < 3; ++c) {
      TriangleSide side{{facet.corner[c], facet.corner[(c + 1) % 3]}, facet.corner[(c + 2) % 3]};
      std::sort(side.ends.begin(), side.ends.end());
      sides.push_back(side);
    }
  std::stable_sort(sides.begin(), sides.end(), [](auto const& a, auto const& b) { return a.ends < b.ends; });
  return sides;
}

/// The outline of a section without its sides on the axis. Normals are as long as the sides.
std::vector<ProfileEdge> sides_of(Skin const& section) {
  auto const sides = all_sides(section);
  auto const at = [&](Index c) { return section.place[static_cast<std::size_t>(c)]; };
  std::vector<ProfileEdge> profile;
  for (std::size_t k = 0, next = 0; k < sides.size(); k = next) {
    auto const& [ends, third] = sides[k];
    for (next = k + 1; next < sides.size() && sides[next].ends == ends;) ++next;
    if (next > k + 1 || (on_axis(section, ends[0]) && on_axis(section, ends[1]))) continue;
    Point3 const along = minus(at(ends[1]), at(ends[0]));
    Point3 normal{along[1], -along[0], 0};
    if (dot(normal, minus(at(third), at(ends[0]))) > 0) normal = {-normal[0], -normal[1], 0};
    profile.push_back({ends, {normal, normal}});
  }
  return profile;
}

/// Makes normals of length 1 that are smooth where sides meet at less than the angle of an edge.
void smooth(Skin const& section, std::vector<ProfileEdge>& profile) {
  std::map<Index, std::vector<Point3>> around;
  for (ProfileEdge const& side : profile)
    for (Index const end : side.ends) {
      around[end].push_back(side.normal[0]);
      if (on_axis(section, end)) around[end].push_back({-side.normal[0][0], side.normal[0][1], 0});
    }
  for (ProfileEdge& side : profile) {
    Point3 const own = side.normal[0];
    for (std::size_t c = 0; c < 2; ++c) {
      Point3 sum{};
      for (Point3 const& other : around[side.ends[c]])
        if (dot(own, other) >= cosine_of_edge * length(own) * length(other)) sum = plus(sum, 1, other);
      side.normal[c] = unit(sum);
    }
  }
}

/// Appends corners to a skin.
class SkinParts {
 public:
  SkinParts(Skin const& section, Skin& out) : section_(section), out_(out) {}

  /// The corner of a particle, rotated.
  Index add(Index particle, Rotation const& rotate) {
    auto const i = static_cast<std::size_t>(particle);
    out_.place.push_back(rotate(section_.place[i]));
    out_.reference.push_back(rotate(section_.reference[i]));
    out_.particle.push_back(particle);
    return static_cast<Index>(out_.place.size() - 1);
  }
  void add_section(Rotation const& rotate, Point3 const& normal) {
    auto const first = static_cast<Index>(out_.place.size());
    for (std::size_t i = 0; i < section_.place.size(); ++i) add(static_cast<Index>(i), rotate);
    for (SkinFacet facet : section_.facets) {
      for (Index& c : facet.corner) c += first;
      facet.normal.fill(normal);
      out_.facets.push_back(facet);
    }
  }

 private:
  Skin const& section_;
  Skin& out_;
};

/// A side at two angles: two triangles, or one at the axis.
void add_strip(ProfileEdge const& side, std::array<std::array<Index, 2>, 2> const& corner,
               std::array<Rotation, 2> const& rotate, std::array<bool, 2> const& at_axis, Skin& out) {
  auto const triangle = [&](std::array<std::array<std::size_t, 2>, 3> const& of) {  // angle and end
    SkinFacet facet;
    for (std::size_t c = 0; c < 3; ++c) {
      facet.corner[c] = corner[of[c][0]][of[c][1]];
      facet.normal[c] = rotate[of[c][0]](side.normal[of[c][1]]);
    }
    out.facets.push_back(facet);
  };
  if (!at_axis[1]) triangle({{{0, 0}, {0, 1}, {1, 1}}});
  if (!at_axis[0]) triangle({{{0, 0}, {1, 1}, {1, 0}}});
}

void add_surface(Skin const& section, double degrees, Skin& out) {
  auto profile = sides_of(section);
  smooth(section, profile);
  std::map<Index, Index> number;  // of a particle among those of the profile
  for (ProfileEdge const& side : profile)
    for (Index const end : side.ends) number.emplace(end, static_cast<Index>(number.size()));
  std::vector<Index> particle(number.size());
  for (auto const& [of, k] : number) particle[static_cast<std::size_t>(k)] = of;
  SkinParts parts(section, out);
  auto const angles = angles_of_sweep(degrees, degrees_per_segment);
  auto const first = static_cast<Index>(out.place.size()), count = static_cast<Index>(particle.size());
  for (double const angle : angles)
    for (Index const of : particle) parts.add(of, Rotation::by(angle));
  for (std::size_t k = 0; k + 1 < angles.size(); ++k)
    for (ProfileEdge const& side : profile) {
      std::array<std::array<Index, 2>, 2> corner{};
      for (std::size_t s = 0; s < 2; ++s)
        for (std::size_t c = 0; c < 2; ++c)
          corner[s][c] = first + static_cast<Index>(k + s) * count + number.at(side.ends[c]);
      add_strip(side, corner, {Rotation::by(angles[k]), Rotation::by(angles[k + 1])},
                {on_axis(section, side.ends[0]), on_axis(section, side.ends[1])}, out);
    }
}

}  // namespace

Skin revolved(Skin const& section, double degrees, double axis_width) {
  PIOLA_EXPECTS(degrees >= 0 && degrees <= 360);
  PIOLA_EXPECTS(section.particle.empty() && section.reference.size() == section.place.size());
  Skin half = section, out;
  for (std::size_t i = 0; i < half.place.size(); ++i)
    if (std::abs(half.reference[i][0]) <= axis_width) half.place[i][0] = half.reference[i][0] = 0;
  out.whole = half.whole;
  out.inside = half.inside;
  SkinParts parts(half, out);
  if (degrees == 0) {
    parts.add_section(Rotation::by(0), {0, 0, 1});
    parts.add_section(Rotation::by(180), {0, 0, 1});
    return out;
  }
  add_surface(half, degrees, out);
  if (degrees == 360) return out;
  for (double const angle : {0.0, degrees}) {
    Rotation const rotate = Rotation::by(angle);
    parts.add_section(rotate, {rotate.sine, 0, rotate.cosine});
  }
  return out;
}

}  // namespace piola
