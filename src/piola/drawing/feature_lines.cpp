// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/feature_lines.hpp"
#include "piola/base/contracts.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/neighbours/cell_facets.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

/// An edge between two particles, and the normal of an adjacent facet.
struct FacetEdge {
  std::array<Index, 2> ends{};
  Point3 normal{};
};

Point3 corner_place(ReferenceMesh const& mesh, Index corner) {
  auto const i = static_cast<std::size_t>(corner);
  return plus(mesh.X[i], 1, mesh.outward[i]);
}

/// f(corners of an outer facet, in order)
template <class F>
void each_outer_facet(ReferenceMesh const& mesh, F const& f) {
  FacetTable const table = facets_of(mesh.cells);
  for (std::size_t k = 0; k < mesh.across.size(); ++k) {
    if (mesh.across[k] >= 0) continue;
    auto const cell = mesh.cells.of(static_cast<Index>(k / table.facet.size()));
    std::array<Index, 4> corner{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.corners); ++c)
      corner[c] = cell[static_cast<std::size_t>(table.facet[k % table.facet.size()][c])];
    f(std::span<Index const>(corner).first(static_cast<std::size_t>(table.corners)));
  }
}

std::vector<FacetEdge> edges_of_facets(ReferenceMesh const& mesh) {
  std::vector<FacetEdge> edges;
  each_outer_facet(mesh, [&](std::span<Index const> corner) {
    auto const at = [&](std::size_t c) { return corner_place(mesh, corner[c]); };
    std::size_t const last = corner.size() - 1;
    Point3 const normal =
        corner.size() < 3 ? Point3{} : unit(cross(minus(at(last - 1), at(0)), minus(at(last), at(1))));
    for (std::size_t c = 0; c < (corner.size() < 3 ? 1 : corner.size()); ++c) {
      FacetEdge edge{{corner[c], corner[(c + 1) % corner.size()]}, normal};
      std::sort(edge.ends.begin(), edge.ends.end());
      edges.push_back(edge);
    }
  });
  std::stable_sort(edges.begin(), edges.end(), [](auto const& a, auto const& b) { return a.ends < b.ends; });
  return edges;
}

/// Sorts the edges into those that are sharp, which it returns, and mesh.round.
std::vector<std::array<Index, 2>> sharp_edges(ReferenceMesh& mesh) {
  constexpr double flat = 1 - 1e-9;
  auto const edges = edges_of_facets(mesh);
  std::vector<std::array<Index, 2>> sharp;
  for (std::size_t k = 0; k < edges.size();) {
    std::size_t end = k + 1;
    double bend = 1;
    for (; end < edges.size() && edges[end].ends == edges[k].ends; ++end)
      bend = std::min(bend, dot(edges[k].normal, edges[end].normal));
    if (mesh.dimension == 2 || bend < cosine_of_edge)
      sharp.push_back(edges[k].ends);
    else if (end == k + 2 && bend < flat)
      mesh.round.push_back({edges[k].ends, {edges[k].normal, edges[k + 1].normal}});
    k = end;
  }
  return sharp;
}

/// Joins edges to lines. A line ends at particles with other than two edges.
class Joiner {
 public:
  explicit Joiner(std::vector<std::array<Index, 2>> const& edges, std::size_t particles)
      : edges_(edges), begin_(particles + 1, 0), used_(edges.size(), false) {
    for (auto const& e : edges)
      for (Index const end : e) ++begin_[static_cast<std::size_t>(end) + 1];
    for (std::size_t i = 0; i < particles; ++i) begin_[i + 1] += begin_[i];
    edge_of_.resize(begin_.back());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t k = 0; k < edges.size(); ++k)
      for (Index const end : edges[k]) edge_of_[next[static_cast<std::size_t>(end)]++] = k;
  }
  std::vector<std::vector<Index>> lines() {
    std::vector<std::vector<Index>> all;
    // From ends and crossings first; what remains are closed lines.
    for (bool const closed : {false, true})
      for (std::size_t k = 0; k < edges_.size(); ++k)
        for (Index const end : edges_[k])
          if (!used_[k] && (closed || degree(end) != 2)) all.push_back(walk(k, end));
    return all;
  }

 private:
  std::size_t degree(Index i) const {
    return begin_[static_cast<std::size_t>(i) + 1] - begin_[static_cast<std::size_t>(i)];
  }
  std::vector<Index> walk(std::size_t edge, Index from) {
    std::vector<Index> line{from};
    for (;;) {
      used_[edge] = true;
      from = edges_[edge][0] == from ? edges_[edge][1] : edges_[edge][0];
      line.push_back(from);
      if (degree(from) != 2) return line;
      auto const place = static_cast<std::size_t>(from);
      std::size_t const next = edge_of_[begin_[place]] == edge ? edge_of_[begin_[place] + 1] : edge_of_[begin_[place]];
      if (used_[next]) return line;
      edge = next;
    }
  }
  std::vector<std::array<Index, 2>> const& edges_;
  std::vector<std::size_t> begin_, edge_of_;
  std::vector<bool> used_;
};

std::vector<Polyline> joined_lines(ReferenceMesh const& mesh, std::vector<std::array<Index, 2>> const& edges) {
  std::vector<Polyline> lines;
  for (auto const& line : Joiner(edges, mesh.count).lines()) {
    Polyline& places = lines.emplace_back();
    for (Index const i : line) places.push_back(corner_place(mesh, i));
  }
  return lines;
}

using Dot = std::array<double, 2>;

/// One straight piece, in samples.
void cover(Dot const& a, Dot const& b, double width, std::array<int, 2> const& size, std::vector<float>& coverage) {
  double const reach = width / 2, dx = b[0] - a[0], dy = b[1] - a[1], square = dx * dx + dy * dy;
  auto const bound = [](double v, int most) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(most))); };
  int const x0 = bound(std::floor(std::min(a[0], b[0]) - reach), size[0]),
            x1 = bound(std::ceil(std::max(a[0], b[0]) + reach), size[0]);
  int const y0 = bound(std::floor(std::min(a[1], b[1]) - reach), size[1]),
            y1 = bound(std::ceil(std::max(a[1], b[1]) + reach), size[1]);
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      double const px = x + 0.5 - a[0], py = y + 0.5 - a[1];
      double const share = square > 0 ? std::clamp((px * dx + py * dy) / square, 0.0, 1.0) : 0;
      if (std::hypot(px - share * dx, py - share * dy) <= reach)
        coverage[static_cast<std::size_t>(y) * static_cast<std::size_t>(size[0]) + static_cast<std::size_t>(x)] = 1;
    }
}

}  // namespace

void find_feature_lines(ReferenceMesh& mesh) {
  mesh.lines.clear();
  mesh.round.clear();
  if (mesh.cells.count() == 0 || mesh.dimension < 2) return;
  mesh.lines = joined_lines(mesh, sharp_edges(mesh));
}

std::vector<Polyline> silhouette(ReferenceMesh const& mesh, Point3 const& towards_viewer) {
  constexpr double edge_on = 1e-6;
  std::vector<std::array<Index, 2>> seen;
  for (RoundEdge const& edge : mesh.round) {
    double const a = dot(edge.normal[0], towards_viewer), b = dot(edge.normal[1], towards_viewer);
    if (std::min(a, b) < -edge_on && std::max(a, b) >= -edge_on) seen.push_back(edge.ends);
  }
  return joined_lines(mesh, seen);
}

void DashedLines::draw(std::vector<Polyline> const& lines, int columns, int rows, std::vector<float>& coverage) const {
  PIOLA_EXPECTS(fine >= 1 && columns >= 0 && rows >= 0);
  PIOLA_EXPECTS(coverage.size() == static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows));
  double const period = (dash + gap) * fine, on = dash * fine;
  for (Polyline const& line : lines) {
    double way = 0;  // from the start of the line [samples]
    for (std::size_t k = 0; k + 1 < line.size(); ++k) {
      auto const p = project(project.eye.seen(line[k])), q = project(project.eye.seen(line[k + 1]));
      Dot const a{p[0] * fine, p[1] * fine}, b{q[0] * fine, q[1] * fine};
      double const size = std::hypot(b[0] - a[0], b[1] - a[1]);
      constexpr double longest = 1e5;  // what is far outside of the picture is left out
      if (!(size < longest)) continue;
      double at = 0;
      while (at < size) {
        double const phase = std::fmod(way + at, period);
        double const rest = (phase < on ? on : period) - phase, to = std::min(size, at + std::max(rest, 1e-3));
        auto const point = [&](double s) {
          return Dot{a[0] + s / size * (b[0] - a[0]), a[1] + s / size * (b[1] - a[1])};
        };
        if (phase < on) cover(point(at), point(to), width * fine, {columns, rows}, coverage);
        at = to;
      }
      way += size;
    }
  }
}

}  // namespace piola
