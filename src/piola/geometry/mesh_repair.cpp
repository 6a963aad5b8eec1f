// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh_repair.hpp"
#include "piola/base/contracts.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <unordered_set>

namespace piola::geometry {

namespace {

using CornerPlace = std::array<double, 3>;

std::vector<CornerPlace> points_of(Surface const& surface) {
  std::vector<CornerPlace> points;
  points.reserve(surface.X.size());
  for (Vec<3> const& X : surface.X) points.push_back({X[0], X[1], X[2]});
  return points;
}

double length_between(CornerPlace const& a, CornerPlace const& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

/// Whether a distance is more than round-off of the corners, and the cells of that size can be counted.
bool is_resolved(Surface const& surface, double distance) {
  constexpr double round_off = 1e-12;
  return distance > round_off * largest_extent(bounds_of(surface));
}

/// Keeps the faces that `keep` names.
void keep_faces(Surface& surface, std::vector<char> const& keep) {
  std::size_t kept = 0;
  for (std::size_t f = 0; f < surface.corner.size(); ++f) {
    if (!keep[f]) continue;
    surface.corner[kept] = surface.corner[f];
    surface.group[kept++] = surface.group[f];
  }
  surface.corner.resize(kept);
  surface.group.resize(kept);
}

/// The corners in rising order, and whether an odd number of swaps leads there: faces with the same corners that differ
/// in it are turned opposite ways.
struct SortedFace {
  std::array<int, 3> corner;
  bool odd = false;
};
SortedFace sorted(std::array<int, 3> c) {
  bool odd = false;
  auto const order = [&](int a, int b) {
    if (c[a] <= c[b]) return;
    std::swap(c[a], c[b]);
    odd = !odd;
  };
  order(0, 1);
  order(1, 2);
  order(0, 1);
  return {c, odd};
}

/// The faces with the same three corners, in the order of the file, by the way they are turned.
using Copies = std::map<std::array<int, 3>, std::array<std::vector<int>, 2>>;

int remove_copies(Surface& surface) {
  Copies copies;
  for (int face = 0; face < surface.faces(); ++face) {
    SortedFace const s = sorted(surface.corner[face]);
    copies[s.corner][s.odd ? 1 : 0].push_back(face);
  }
  bool const two_sided = std::all_of(
      copies.begin(), copies.end(), [](auto const& entry) { return entry.second[0].size() == entry.second[1].size(); });
  std::vector<char> keep(surface.corner.size(), 0);
  for (auto const& [corners, faces] : copies) {
    auto const &even = faces[0], &odd = faces[1];
    if (even.size() != odd.size())
      keep[(even.size() > odd.size() ? even : odd).front()] = 1;
    else if (two_sided)
      keep[std::min(even.front(), odd.front())] = 1;
  }
  auto const before = surface.faces();
  keep_faces(surface, keep);
  return before - surface.faces();
}

int remove_flat_faces(Surface& surface) {
  int removed = 0;
  for (bool changed = true; changed;) {
    Links const links = link_faces(surface);
    std::vector<char> keep(surface.corner.size(), 1);
    changed = false;
    for (int face = 0; face < surface.faces(); ++face) {
      bool const linked =
          links.across[3 * face] >= 0 && links.across[3 * face + 1] >= 0 && links.across[3 * face + 2] >= 0;
      if (linked || !surface.is_flat(face)) continue;
      keep[face] = 0;
      changed = true;
      ++removed;
    }
    keep_faces(surface, keep);
  }
  return removed;
}

}  // namespace

int merge_corners(Surface& surface, double distance) {
  PIOLA_EXPECTS(surface.group.size() == surface.corner.size());
  if (!is_resolved(surface, distance)) return 0;
  auto const points = points_of(surface);
  std::vector<int> first(points.size());
  std::iota(first.begin(), first.end(), 0);
  auto const root = [&](int corner) {
    while (first[corner] != corner) corner = first[corner] = first[first[corner]];
    return corner;
  };
  CellGrid const grid(points, distance);
  for (int a = 0; a < static_cast<int>(points.size()); ++a)
    grid.visit(points[a], [&](Index other) {
      int const b = static_cast<int>(other);
      if (b <= a || length_between(points[a], points[b]) > distance) return;
      int const low = root(a), high = root(b);
      first[std::max(low, high)] = std::min(low, high);
    });
  int merged = 0;
  for (int corner = 0; corner < static_cast<int>(points.size()); ++corner) {
    if (root(corner) != corner) ++merged;
    auto const& at = points[root(corner)];
    surface.X[corner] = {{at[0], at[1], at[2]}};
  }
  weld(surface);
  return merged;
}

double closing_distance(Surface const& surface, Links const& links) {
  PIOLA_EXPECTS(links.across.size() == 3 * surface.corner.size());
  if (links.open.empty()) return 0;
  std::unordered_set<int> at_edges;
  double sum = 0;
  for (int const half : links.open) {
    auto const& c = surface.corner[half / 3];
    at_edges.insert({c[half % 3], c[(half + 1) % 3]});
    sum += surface.edge_length(half / 3, half % 3);
  }
  double const most = 0.25 * sum / static_cast<double>(links.open.size());
  auto const all = points_of(surface);
  std::vector<CornerPlace> open;
  for (int const corner : at_edges) open.push_back(all[corner]);
  if (!is_resolved(surface, most)) return 0;
  CellGrid const grid(open, most);
  double farthest = 0;
  for (std::size_t a = 0; a < open.size(); ++a) {
    double nearest = 2 * most;
    grid.visit(open[a], [&](Index b) {
      if (static_cast<std::size_t>(b) != a) nearest = std::min(nearest, length_between(open[a], open[b]));
    });
    if (nearest > most) return 0;
    farthest = std::max(farthest, nearest);
  }
  constexpr double margin = 1.1;  // for the digits of a message
  Surface trial = surface;
  merge_corners(trial, margin * farthest);
  Links const after = link_faces(trial);
  return after.open.empty() && after.non_manifold.empty() && trial.faces() > 0 ? margin * farthest : 0;
}

RemovedFaces remove_needless_faces(Surface& surface) {
  PIOLA_EXPECTS(surface.group.size() == surface.corner.size());
  RemovedFaces removed;
  removed.twice = remove_copies(surface);
  removed.without_area = remove_flat_faces(surface);
  weld(surface);  // drops corners without faces
  return removed;
}

}  // namespace piola::geometry
