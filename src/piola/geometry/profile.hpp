// SPDX-License-Identifier: Apache-2.0
#pragma once
#include "piola/math/tensor.hpp"
#include <string>
#include <utility>
#include <vector>

namespace piola::geometry {

/// An edge of a profile: a straight line, or an arc about a centre. The region lies on its left.
struct ProfileEdge {
  Vec<2> from{}, to{};
  int patch = 0;
  bool arc = false;
  Vec<2> centre{};    ///< arc
  double radius = 0;  ///< arc [m]
  double start = 0;   ///< arc: angle of `from` [rad]
  double sweep = 0;   ///< arc: angle from there to `to`, negative if clockwise [rad]

  double length() const;
  /// Point at a fraction of the length, 0 to 1, and the unit normal there, away from the region.
  std::pair<Vec<2>, Vec<2>> point(double share) const;
};

ProfileEdge straight(Vec<2> const& from, Vec<2> const& to, int patch);
ProfileEdge arc(Vec<2> const& centre, double radius, double start, double sweep, int patch);

/// Distance and normal of the nearest point of a profile's outline.
struct ProfileFoot {
  double distance = 0;  ///< signed, negative inside
  Vec<2> normal{};      ///< unit vector away from the region
};

/// A region of the plane between closed loops of edges, with its exact signed distance.
class Profile {
 public:
  /// The edges of each loop follow one another; outer loops run anticlockwise, holes clockwise. `names` are those of
  /// the patches.
  Profile(std::vector<std::vector<ProfileEdge>> const& loops, std::vector<std::string> names);
  /// Half profile of a body of revolution about the second axis. Edges on that axis are no surface.
  static Profile half(std::vector<ProfileEdge> const& loop, std::vector<std::string> names);

  ProfileFoot at(Vec<2> const& x) const;
  std::pair<Vec<2>, Vec<2>> bounds() const;
  double area() const;
  std::vector<std::string> const& names() const { return names_; }
  /// Edges that are surface, i.e. not on the axis of revolution.
  std::vector<ProfileEdge> const& edges() const { return edges_; }
  /// 2 pi times its static moment about the second axis: the volume of the body of revolution [m3].
  double revolved_volume() const;

 private:
  struct Corner {
    Vec<2> before{}, after{};  ///< sums of normals that decide the side of a place nearest to an end
  };
  void add_loop(std::vector<ProfileEdge> const& loop, bool about_axis);
  std::vector<ProfileEdge> edges_, axis_;
  std::vector<Corner> corners_;  ///< per edge
  std::vector<std::string> names_;
};

/// A closed polygon as a loop: each corner's edge to the next one. Patches change where the normal turns by more than
/// `feature_angle` [rad], counted from `first_patch`; reversed if its orientation is wrong. `names` gets "1", "2", ...
std::vector<ProfileEdge> polygon_loop(std::vector<Vec<2>> corners, bool hole, double feature_angle,
                                      std::vector<std::string>& names);

}  // namespace piola::geometry
