// SPDX-License-Identifier: Apache-2.0
#include "piola/input/read_polygon.hpp"
#include "piola/base/text.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

using Corner = Vec<2>;

double cross_of(Corner const& a, Corner const& b) { return a[0] * b[1] - a[1] * b[0]; }

/// Whether two lines have a point in common.
bool cross_each_other(Corner const& a, Corner const& b, Corner const& c, Corner const& d) {
  double const u = cross_of(b - a, c - a), v = cross_of(b - a, d - a);
  double const s = cross_of(d - c, a - c), t = cross_of(d - c, b - c);
  if (((u > 0 && v < 0) || (u < 0 && v > 0)) && ((s > 0 && t < 0) || (s < 0 && t > 0))) return true;
  auto const on = [](Corner const& p, Corner const& q, Corner const& x) { return dot(x - p, x - q) <= 0; };
  return (u == 0 && on(a, b, c)) || (v == 0 && on(a, b, d)) || (s == 0 && on(c, d, a)) || (t == 0 && on(c, d, b));
}

std::string corner_text(Corner const& x) { return "(" + number_text(x[0]) + ", " + number_text(x[1]) + ") m"; }

/// The line from one corner of a polygon to the next one.
struct Line {
  Corner from, to;
  std::size_t polygon = 0, number = 0, corners = 0;
};

bool are_neighbours(Line const& a, Line const& b) {
  return a.polygon == b.polygon && ((a.number + 1) % a.corners == b.number || (b.number + 1) % a.corners == a.number);
}

}  // namespace

std::vector<Vec<2>> read_polygon(Value const& value, bool radius_first, Problems& problems) {
  constexpr std::size_t most = 10000;
  std::vector<Vec<2>> corners;
  auto const items = read_list(value, 3, most, problems);
  for (std::size_t i = 0; items && i < items->size(); ++i) {
    auto const pair = read_list((*items)[i], 2, 2, problems);
    if (!pair) return {};
    Vec<2> corner;
    for (std::size_t c = 0; c < 2; ++c) {
      auto const number = read_number((*pair)[c], "m", {-1e15, 1e15, false, false}, problems);
      if (!number) return {};
      corner[static_cast<int>(c)] = *number;
    }
    if (radius_first && corner[0] < 0) {
      problems.add((*pair)[0].node.place, (*pair)[0].name + " is " + number_text(corner[0]) +
                                              " m (allowed: at least 0) - a radius has no sign");
      return {};
    }
    if (!corners.empty() && corners.back()[0] == corner[0] && corners.back()[1] == corner[1]) {
      problems.add((*items)[i].node.place,
                   (*items)[i].name + " is " + corner_text(corner) +
                       ", the same as the corner before it (allowed: another place) - remove it");
      return {};
    }
    corners.push_back(corner);
  }
  if (corners.size() > 1 && corners.front()[0] == corners.back()[0] && corners.front()[1] == corners.back()[1])
    corners.pop_back();  // closed by the user
  return corners;
}

void check_polygons(std::vector<std::vector<Vec<2>>> const& polygons, Place const& place, std::string const& name,
                    Problems& problems) {
  std::vector<Line> lines;
  for (std::size_t p = 0; p < polygons.size(); ++p) {
    double twice = 0;
    std::size_t const n = polygons[p].size();
    for (std::size_t i = 0; i < n; ++i) {
      lines.push_back({polygons[p][i], polygons[p][(i + 1) % n], p, i, n});
      twice += cross_of(polygons[p][i], polygons[p][(i + 1) % n]);
    }
    if (n >= 3 && twice != 0) continue;
    problems.add(place, name + " has a polygon without area (allowed: three corners or more that are not in line)");
    return;
  }
  for (std::size_t a = 0; a < lines.size(); ++a)
    for (std::size_t b = a + 1; b < lines.size(); ++b) {
      if (are_neighbours(lines[a], lines[b]) ||
          !cross_each_other(lines[a].from, lines[a].to, lines[b].from, lines[b].to))
        continue;
      problems.add(place, name + ": the line from " + corner_text(lines[a].from) + " to " + corner_text(lines[a].to) +
                              " meets that from " + corner_text(lines[b].from) + " to " + corner_text(lines[b].to) +
                              " (allowed: an outline that does not cross or touch itself or its holes) - check the "
                              "order of the corners");
      return;
    }
}

}  // namespace piola
