// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_surface.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <tuple>
#include <unordered_map>

namespace piola::geometry {

namespace {

struct SamePlace {
  bool operator()(Vec<3> const& a, Vec<3> const& b) const { return a[0] == b[0] && a[1] == b[1] && a[2] == b[2]; }
};

struct PlaceHash {
  std::size_t operator()(Vec<3> const& X) const {
    std::uint64_t hash = 0;
    for (double const x : X.c) {
      hash = (hash ^ std::bit_cast<std::uint64_t>(x + 0.0)) * 0x9E3779B97F4A7C15ull;  // + 0.0: -0 equals 0
      hash ^= hash >> 29;
    }
    return hash;
  }
};

struct SideOfFace {
  int low, high, half;
  bool same_edge(SideOfFace const& o) const { return low == o.low && high == o.high; }
};

std::vector<SideOfFace> sorted_sides(Surface const& surface) {
  std::vector<SideOfFace> sides(3 * surface.corner.size());
  for (int half = 0; half < static_cast<int>(sides.size()); ++half) {
    auto const& c = surface.corner[half / 3];
    auto const [low, high] = std::minmax(c[half % 3], c[(half + 1) % 3]);
    sides[half] = {low, high, half};
  }
  std::sort(sides.begin(), sides.end(), [](SideOfFace const& a, SideOfFace const& b) {
    return a.low != b.low ? a.low < b.low : a.high != b.high ? a.high < b.high : a.half < b.half;
  });
  return sides;
}

void number_shells(Links& links) {
  int const faces = static_cast<int>(links.across.size() / 3);
  links.shell.assign(faces, -1);
  std::vector<int> waiting;
  for (int first = 0; first < faces; ++first) {
    if (links.shell[first] >= 0) continue;
    links.shell[first] = links.shells++;
    waiting.push_back(first);
    while (!waiting.empty()) {
      int const face = waiting.back();
      waiting.pop_back();
      for (int side = 0; side < 3; ++side) {
        int const other = links.across[3 * face + side];
        if (other < 0 || links.shell[other / 3] >= 0) continue;
        links.shell[other / 3] = links.shell[first];
        waiting.push_back(other / 3);
      }
    }
  }
}

}  // namespace

Vec<3> Surface::twice_area(int face) const {
  auto const& c = corner[face];
  return cross(X[c[1]] - X[c[0]], X[c[2]] - X[c[0]]);
}

Vec<3> Surface::middle(int face) const {
  auto const& c = corner[face];
  return (1.0 / 3.0) * (X[c[0]] + X[c[1]] + X[c[2]]);
}

double Surface::edge_length(int face, int side) const {
  Vec<3> const e = X[corner[face][(side + 1) % 3]] - X[corner[face][side]];
  return std::sqrt(dot(e, e));
}

int Surface::longest_side(int face) const {
  int longest = 0;
  for (int side = 1; side < 3; ++side)
    if (edge_length(face, side) > edge_length(face, longest)) longest = side;
  return longest;
}

bool Surface::is_flat(int face) const {
  constexpr double round_off = 1e-12;
  double const length = edge_length(face, longest_side(face));
  Vec<3> const n = twice_area(face);
  return std::sqrt(dot(n, n)) <= round_off * length * length;
}

int weld(Surface& surface) {
  PIOLA_EXPECTS(surface.group.size() == surface.corner.size());
  std::unordered_map<Vec<3>, int, PlaceHash, SamePlace> known;
  known.reserve(surface.X.size());
  std::vector<Vec<3>> X;
  std::size_t kept = 0;
  for (std::size_t f = 0; f < surface.corner.size(); ++f) {
    auto c = surface.corner[f];
    auto const& [a, b, d] = std::tie(surface.X[c[0]], surface.X[c[1]], surface.X[c[2]]);
    SamePlace const same;
    if (same(a, b) || same(b, d) || same(d, a)) continue;
    for (int& corner : c) {
      auto const [entry, is_new] = known.try_emplace(surface.X[corner], static_cast<int>(X.size()));
      if (is_new) X.push_back(surface.X[corner]);
      corner = entry->second;
    }
    surface.corner[kept] = c;
    surface.group[kept++] = surface.group[f];
  }
  int const dropped = static_cast<int>(surface.corner.size() - kept);
  surface.corner.resize(kept);
  surface.group.resize(kept);
  surface.X = std::move(X);
  return dropped;
}

Links link_faces(Surface const& surface) {
  Links links;
  links.across.assign(3 * surface.corner.size(), -1);
  auto const sides = sorted_sides(surface);
  for (std::size_t begin = 0, end = 0; begin < sides.size(); begin = end) {
    while (end < sides.size() && sides[end].same_edge(sides[begin])) ++end;
    int const half = sides[begin].half;
    if (end - begin == 1) links.open.push_back(half);
    if (end - begin > 2) links.non_manifold.push_back(half);
    if (end - begin != 2) continue;
    int const other = sides[begin + 1].half;
    links.across[half] = other;
    links.across[other] = half;
    if (surface.corner[half / 3][half % 3] == surface.corner[other / 3][other % 3]) links.turned.push_back(half);
  }
  for (auto* list : {&links.open, &links.non_manifold, &links.turned}) std::sort(list->begin(), list->end());
  number_shells(links);
  PIOLA_ENSURES(links.shell.size() == surface.corner.size());
  return links;
}

double enclosed_volume(Surface const& surface) {
  Bounds const box = bounds_of(surface);
  Vec<3> const centre = 0.5 * (box.min + box.max);
  double sum = 0;
  for (int face = 0; face < surface.faces(); ++face)
    sum += dot(surface.X[surface.corner[face][0]] - centre, surface.twice_area(face));
  return sum / 6;
}

double area_of(Surface const& surface) {
  double sum = 0;
  for (int face = 0; face < surface.faces(); ++face) {
    Vec<3> const n = surface.twice_area(face);
    sum += 0.5 * std::sqrt(dot(n, n));
  }
  return sum;
}

Bounds bounds_of(Surface const& surface) {
  if (surface.X.empty()) return {};
  Bounds box{surface.X[0], surface.X[0]};
  for (Vec<3> const& X : surface.X)
    for (int i = 0; i < 3; ++i) {
      box.min[i] = std::min(box.min[i], X[i]);
      box.max[i] = std::max(box.max[i], X[i]);
    }
  return box;
}

double largest_extent(Bounds const& box) {
  Vec<3> const size = box.max - box.min;
  return std::max({size[0], size[1], size[2]});
}

}  // namespace piola::geometry
