// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/profile.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace piola::geometry {
namespace {

Vec<2> unit(Vec<2> const& a) {
  double const length = std::sqrt(dot(a, a));
  return length > 0 ? (1 / length) * a : Vec<2>{{1, 0}};
}

struct NearestOfEdge {
  Vec<2> foot{}, normal{};
  int end = 0;  ///< -1: the foot is the beginning of the edge, +1 its end
};

NearestOfEdge nearest_of_line(ProfileEdge const& e, Vec<2> const& x) {
  Vec<2> const along = e.to - e.from;
  double const share = dot(x - e.from, along) / dot(along, along);
  Vec<2> const normal = unit({{along[1], -along[0]}});
  if (share <= 0) return {e.from, normal, -1};
  if (share >= 1) return {e.to, normal, 1};
  return {e.from + share * along, normal, 0};
}

NearestOfEdge nearest_of_arc(ProfileEdge const& e, Vec<2> const& x) {
  constexpr double full = 2 * std::numbers::pi;
  Vec<2> const r = x - e.centre;
  double const sign = e.sweep > 0 ? 1 : -1;
  // The angle from the beginning in the sense of the arc, from 0 to a full turn.
  double turn = 0.5 * e.sweep * sign;
  if (dot(r, r) > 0) {
    turn = std::fmod(sign * (std::atan2(r[1], r[0]) - e.start), full);
    if (turn < 0) turn += full;
  }
  double const sweep = std::abs(e.sweep);
  auto const normal_at = [&](double angle) {
    double const a = e.start + sign * angle;
    return sign * Vec<2>{{std::cos(a), std::sin(a)}};
  };
  if (turn <= sweep) {
    Vec<2> const out = dot(r, r) > 0 ? unit(r) : sign * normal_at(turn);
    return {e.centre + e.radius * out, sign * out, 0};
  }
  Vec<2> const a = x - e.from, b = x - e.to;
  if (dot(a, a) <= dot(b, b)) return {e.from, normal_at(0), -1};
  return {e.to, normal_at(sweep), 1};
}

bool is_on_axis(ProfileEdge const& e) { return !e.arc && e.from[0] == 0 && e.to[0] == 0; }

}  // namespace

ProfileEdge straight(Vec<2> const& from, Vec<2> const& to, int patch) {
  ProfileEdge e;
  e.from = from;
  e.to = to;
  e.patch = patch;
  return e;
}

ProfileEdge arc(Vec<2> const& centre, double radius, double start, double sweep, int patch) {
  ProfileEdge e;
  e.arc = true;
  e.centre = centre;
  e.radius = radius;
  e.start = start;
  e.sweep = sweep;
  e.patch = patch;
  e.from = e.point(0).first;
  e.to = e.point(1).first;
  return e;
}

double ProfileEdge::length() const {
  if (arc) return radius * std::abs(sweep);
  return std::sqrt(dot(to - from, to - from));
}

std::pair<Vec<2>, Vec<2>> ProfileEdge::point(double share) const {
  if (arc) {
    double const a = start + share * sweep;
    Vec<2> const out{{std::cos(a), std::sin(a)}};
    return {centre + radius * out, (sweep > 0 ? 1.0 : -1.0) * out};
  }
  Vec<2> const along = to - from;
  return {from + share * along, unit({{along[1], -along[0]}})};
}

Profile::Profile(std::vector<std::vector<ProfileEdge>> const& loops, std::vector<std::string> names)
    : names_(std::move(names)) {
  for (auto const& loop : loops) add_loop(loop, false);
}

Profile Profile::half(std::vector<ProfileEdge> const& loop, std::vector<std::string> names) {
  Profile profile({}, std::move(names));
  profile.add_loop(loop, true);
  return profile;
}

void Profile::add_loop(std::vector<ProfileEdge> const& loop, bool about_axis) {
  std::size_t const n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    ProfileEdge const &e = loop[i], &before = loop[(i + n - 1) % n], &after = loop[(i + 1) % n];
    if (about_axis && is_on_axis(e)) {
      axis_.push_back(e);
      continue;
    }
    Vec<2> const first = e.point(0).second, last = e.point(1).second;
    // Beyond the axis the surface goes on as its own image.
    auto const beyond = [&](ProfileEdge const& other, double share, Vec<2> const& own) {
      return about_axis && is_on_axis(other) ? Vec<2>{{-own[0], own[1]}} : other.point(share).second;
    };
    edges_.push_back(e);
    corners_.push_back({first + beyond(before, 1, first), last + beyond(after, 0, last)});
  }
}

ProfileFoot Profile::at(Vec<2> const& x) const {
  double least = std::numeric_limits<double>::infinity();
  NearestOfEdge best;
  Vec<2> side{};
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    NearestOfEdge const near = edges_[i].arc ? nearest_of_arc(edges_[i], x) : nearest_of_line(edges_[i], x);
    Vec<2> const r = x - near.foot;
    double const square = dot(r, r);
    if (!(square < least)) continue;
    least = square;
    best = near;
    side = near.end == 0 ? near.normal : near.end < 0 ? corners_[i].before : corners_[i].after;
  }
  Vec<2> const r = x - best.foot;
  double const distance = std::sqrt(least);
  double const sign = dot(r, side) < 0 ? -1 : 1;
  // On the surface itself the direction is that of the edge.
  return {sign * distance, distance > 1e-9 * (std::abs(x[0]) + std::abs(x[1])) ? (sign / distance) * r : best.normal};
}

std::pair<Vec<2>, Vec<2>> Profile::bounds() const {
  constexpr double inf = std::numeric_limits<double>::infinity();
  std::pair<Vec<2>, Vec<2>> b{{{inf, inf}}, {{-inf, -inf}}};
  auto const take = [&](Vec<2> const& x) {
    for (int c = 0; c < 2; ++c) {
      b.first[c] = std::min(b.first[c], x[c]);
      b.second[c] = std::max(b.second[c], x[c]);
    }
  };
  for (ProfileEdge const& e : edges_) {
    take(e.from);
    take(e.to);
    if (!e.arc) continue;
    for (int quarter = 0; quarter < 4; ++quarter) {
      double const angle = quarter * std::numbers::pi / 2;
      Vec<2> const x = e.centre + e.radius * Vec<2>{{std::cos(angle), std::sin(angle)}};
      if (NearestOfEdge const near = nearest_of_arc(e, x); near.end == 0) take(x);
    }
  }
  for (ProfileEdge const& e : axis_) take(e.from);
  return b;
}

double Profile::area() const {
  double sum = 0;
  for (ProfileEdge const& e : edges_) {
    sum += 0.5 * (e.from[0] * e.to[1] - e.from[1] * e.to[0]);
    // Between the chord and the arc.
    if (e.arc) sum += 0.5 * e.radius * e.radius * (e.sweep - std::sin(e.sweep));
  }
  for (ProfileEdge const& e : axis_) sum += 0.5 * (e.from[0] * e.to[1] - e.from[1] * e.to[0]);
  return sum;
}

double Profile::revolved_volume() const {
  // pi times the integral of r^2 dz along the outline.
  double sum = 0;
  for (ProfileEdge const& e : edges_) {
    if (!e.arc) {
      sum += (e.to[1] - e.from[1]) * (e.from[0] * e.from[0] + e.from[0] * e.to[0] + e.to[0] * e.to[0]) / 3;
      continue;
    }
    double const c = e.centre[0], R = e.radius;
    auto const primitive = [&](double a) {
      double const s = std::sin(a);
      return c * c * s + 2 * c * R * (a / 2 + std::sin(2 * a) / 4) + R * R * (s - s * s * s / 3);
    };
    sum += R * (primitive(e.start + e.sweep) - primitive(e.start));
  }
  return std::numbers::pi * sum;
}

std::vector<ProfileEdge> polygon_loop(std::vector<Vec<2>> corners, bool hole, double feature_angle,
                                      std::vector<std::string>& names) {
  PIOLA_EXPECTS(corners.size() >= 3);
  PIOLA_EXPECTS(feature_angle >= 0);
  std::size_t const n = corners.size();
  double twice = 0;
  for (std::size_t i = 0; i < n; ++i) {
    Vec<2> const &a = corners[i], &b = corners[(i + 1) % n];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  if ((twice > 0) == hole) std::reverse(corners.begin(), corners.end());
  std::vector<ProfileEdge> loop;
  for (std::size_t i = 0; i < n; ++i) loop.push_back(straight(corners[i], corners[(i + 1) % n], 0));
  auto const turns = [&](std::size_t i) {
    Vec<2> const a = loop[(i + n - 1) % n].point(0).second, b = loop[i].point(0).second;
    return std::abs(std::atan2(a[0] * b[1] - a[1] * b[0], dot(a, b))) > feature_angle;
  };
  std::size_t first = 0;  // an edge at which a patch begins
  while (first < n && !turns(first)) ++first;
  if (first == n) first = 0;
  for (std::size_t k = 0; k < n; ++k) {
    std::size_t const i = (first + k) % n;
    if (k == 0 || turns(i)) names.push_back(std::to_string(names.size() + 1));
    loop[i].patch = static_cast<int>(names.size()) - 1;
  }
  return loop;
}

}  // namespace piola::geometry
