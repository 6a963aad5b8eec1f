// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/reference_mesh.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/errors.hpp"
#include "piola/drawing/feature_lines.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/neighbours/cell_facets.hpp"
#include <algorithm>

namespace piola {
namespace {

constexpr std::array<std::array<int, 2>, 1> edge_of_interval{{{0, 1}}};
constexpr std::array<std::array<int, 2>, 3> edges_of_triangle{{{0, 1}, {1, 2}, {0, 2}}};
constexpr std::array<std::array<int, 2>, 4> edges_of_rectangle{{{0, 1}, {2, 3}, {0, 2}, {1, 3}}};
constexpr std::array<std::array<int, 2>, 6> edges_of_tetrahedron{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
constexpr std::array<std::array<int, 2>, 12> edges_of_box{
    {{0, 1}, {2, 3}, {4, 5}, {6, 7}, {0, 2}, {1, 3}, {4, 6}, {5, 7}, {0, 4}, {1, 5}, {2, 6}, {3, 7}}};

Cells cells_of(ParticleSet const& set, Body const& body, Points const& X, double spacing) {
  if (!body.off_lattice) return lattice_cells(set, body);
  // As far as two particles of a packed body may lie apart, with the diagonal of what lies between them.
  double const largest_radius = (0.6 + 0.35 * set.dimension) * spacing;
  try {
    return delaunay(X, set.dimension, largest_radius);
  } catch (InputError const&) {  // on a line, in one place, too few
    return {};
  }
}

void connect(ReferenceMesh& mesh) {
  std::vector<std::array<Index, 2>> pairs;
  auto const edges = edges_of(mesh.cells);
  pairs.reserve(2 * edges.size() * static_cast<std::size_t>(mesh.cells.count()));
  for (Index cell = 0; cell < mesh.cells.count(); ++cell) {
    auto const corner = mesh.cells.of(cell);
    for (auto const& e : edges) {
      Index const a = corner[static_cast<std::size_t>(e[0])], b = corner[static_cast<std::size_t>(e[1])];
      pairs.push_back({a, b});
      pairs.push_back({b, a});
    }
  }
  // By counting, then each short list on its own: an edge belongs to several cells.
  std::vector<std::size_t> begin(mesh.count + 1, 0);
  for (auto const& p : pairs) ++begin[static_cast<std::size_t>(p[0]) + 1];
  for (std::size_t i = 0; i < mesh.count; ++i) begin[i + 1] += begin[i];
  std::vector<Index> all(pairs.size());
  std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
  for (auto const& p : pairs) all[next[static_cast<std::size_t>(p[0])]++] = p[1];
  mesh.begin.assign(1, 0);
  for (std::size_t i = 0; i < mesh.count; ++i) {
    auto const from = all.begin() + static_cast<std::ptrdiff_t>(begin[i]),
               to = all.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]);
    std::sort(from, to);
    mesh.neighbour.insert(mesh.neighbour.end(), from, std::unique(from, to));
    mesh.begin.push_back(mesh.neighbour.size());
  }
}

/// Outward unit normal of a facet given by its corners in order; the corners of a box's facet need not lie in a plane.
Point3 facet_normal(Points const& X, std::span<Index const> corner, std::array<int, 4> const& of, int corners) {
  auto const at = [&](int k) { return X[static_cast<std::size_t>(corner[static_cast<std::size_t>(of[k])])]; };
  if (corners == 1) return {};
  if (corners == 2) {
    Point3 const t = minus(at(1), at(0));
    return unit({t[1], -t[0], 0});
  }
  return unit(corners == 3 ? cross(minus(at(1), at(0)), minus(at(2), at(0)))
                           : cross(minus(at(2), at(0)), minus(at(3), at(1))));
}

/// Sum of the normals of the adjacent outer facets, per particle.
std::vector<Point3> normals_outside(ReferenceMesh const& mesh) {
  std::vector<Point3> sum(mesh.count, Point3{});
  if (mesh.cells.count() == 0) return sum;
  FacetTable const table = facets_of(mesh.cells);
  for (std::size_t f = 0; f < mesh.across.size(); ++f) {
    if (mesh.across[f] >= 0) continue;
    auto const corner = mesh.cells.of(static_cast<Index>(f / table.facet.size()));
    auto const& of = table.facet[f % table.facet.size()];
    Point3 const n = facet_normal(mesh.X, corner, of, table.corners);
    for (int c = 0; c < table.corners; ++c) {
      Point3& s = sum[static_cast<std::size_t>(corner[static_cast<std::size_t>(of[static_cast<std::size_t>(c)])])];
      s = plus(s, 1, n);
    }
  }
  return sum;
}

/// Moves a particle to the surface of its shape along the normals of the adjacent facets.
class OutwardStep {
 public:
  OutwardStep(Outline const& shape, double spacing) : shape_(shape), spacing_(spacing) {}

  /// `direction`: the sum of the unit normals of these facets. Flat ends of the box around the shape come first, so
  /// that the edge between an end and a side stays sharp.
  Point3 operator()(Point3 const& X, Point3 const& direction) const {
    constexpr double slanted = 0.1;           // smaller components of a normal count as zero
    constexpr double just_inside = 1 - 1e-6;  // what is on the surface but for rounding counts as inside
    if (!inside(X)) return {};
    Point3 way{}, rest = direction;
    for (std::size_t c = 0; c < 3; ++c) {
      double const gap = (direction[c] > 0 ? shape_.max[c] : shape_.min[c]) - X[c];
      if (std::abs(direction[c]) < slanted || std::abs(gap) > 0.8 * spacing_) continue;
      Point3 moved = way;
      moved[c] = gap;
      if (!inside(plus(X, just_inside, moved))) continue;
      way[c] = moved[c];
      rest[c] = 0;
    }
    if (shape_.inside && length(rest) > slanted) way = plus(way, 1, to_end(plus(X, just_inside, way), unit(rest)));
    return way;
  }

 private:
  bool inside(Point3 const& X) const {
    double const rounding = 1e-9 * spacing_;
    for (std::size_t c = 0; c < 3; ++c)
      if (X[c] < shape_.min[c] - rounding || X[c] > shape_.max[c] + rounding) return false;
    return !shape_.inside || shape_.inside(X);
  }

  /// As far as the shape goes on in that direction; nothing if that is farther than across the corner of a cell and a
  /// little more.
  Point3 to_end(Point3 const& X, Point3 const& direction) const {
    constexpr int steps = 6, halvings = 9;
    double const most = 1.8 * spacing_;
    double within = 0, outside = 0;
    for (int k = 1; k <= steps && outside == 0; ++k) {
      double const at = most * k / steps;
      (inside(plus(X, at, direction)) ? within : outside) = at;
    }
    if (outside == 0) return {};
    for (int k = 0; k < halvings; ++k) {
      double const middle = (within + outside) / 2;
      (inside(plus(X, middle, direction)) ? within : outside) = middle;
    }
    return plus({}, within, direction);
  }

  Outline const& shape_;
  double spacing_;
};

void reach_surface(ReferenceMesh& mesh, Outline const& shape) {
  mesh.outward.assign(mesh.count, Point3{});
  auto const direction = normals_outside(mesh);
  OutwardStep const way_out(shape, mesh.spacing);
  exec_host::parallel_for(static_cast<Index>(mesh.count), [&](Index k) {
    auto const i = static_cast<std::size_t>(k);
    if (dot(direction[i], direction[i]) > 0) mesh.outward[i] = way_out(mesh.X[i], direction[i]);
  });
}

bool known(Outline const& shape) {
  return shape.inside || shape.max[0] > shape.min[0] || shape.max[1] > shape.min[1] || shape.max[2] > shape.min[2];
}

}  // namespace

std::span<std::array<int, 2> const> edges_of(Cells const& cells) {
  if (cells.dimension == 1) return edge_of_interval;
  if (cells.dimension == 2)
    return cells.corners == 3 ? std::span<std::array<int, 2> const>(edges_of_triangle) : edges_of_rectangle;
  return cells.corners == 4 ? std::span<std::array<int, 2> const>(edges_of_tetrahedron) : edges_of_box;
}

ReferenceMesh reference_mesh(ParticleSet const& set, Body const& body) {
  PIOLA_EXPECTS(set.dimension >= 1 && set.dimension <= 3);
  PIOLA_EXPECTS(body.first >= 0 && body.first <= body.last && body.last <= set.size());
  ReferenceMesh mesh;
  mesh.first = static_cast<std::size_t>(body.first);
  mesh.count = static_cast<std::size_t>(body.last - body.first);
  mesh.dimension = set.dimension;
  mesh.X.assign(set.X.begin() + body.first, set.X.begin() + body.last);
  mesh.spacing = *std::max_element(body.spacing.begin(), body.spacing.begin() + set.dimension);
  mesh.cells = cells_of(set, body, mesh.X, mesh.spacing);
  if (mesh.cells.count() > 0) mesh.across = cells_across(mesh.cells);
  connect(mesh);
  if (mesh.cells.count() > 0 && known(body.outline))
    reach_surface(mesh, body.outline);
  else
    mesh.outward.assign(mesh.count, Point3{});
  PIOLA_ENSURES(mesh.outward.size() == mesh.count && mesh.begin.size() == mesh.count + 1);
  find_feature_lines(mesh);
  return mesh;
}

std::vector<ReferenceMesh> reference_meshes(ParticleSet const& set) {
  std::vector<ReferenceMesh> meshes;
  for (Body const& body : set.bodies) meshes.push_back(reference_mesh(set, body));
  return meshes;
}

}  // namespace piola
