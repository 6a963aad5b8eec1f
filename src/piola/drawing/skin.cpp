// SPDX-License-Identifier: Apache-2.0
#include "piola/drawing/skin.hpp"
#include "piola/drawing/vector_math.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include "piola/neighbours/cell_facets.hpp"
#include <algorithm>
#include <cmath>

namespace piola {
namespace {

bool is_longer(ReferenceMesh const& mesh, Configuration const& now, Index a, Index b, double stretch) {
  auto const i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  Point3 const d = minus(now.x[j], now.x[i]), D = minus(mesh.X[j], mesh.X[i]);
  return !(dot(d, d) <= stretch * stretch * dot(D, D));  // not-a-number parts
}

bool has_parted(ReferenceMesh const& mesh, Configuration const& now, Index a, Index b) {
  auto const i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
  if (!now.loose.empty() && (now.loose[i] != 0 || now.loose[j] != 0)) return true;
  if (!is_longer(mesh, now, a, b, tearing.stretch)) return false;
  std::array<Index, 2> const edge{std::min(a, b), std::max(a, b)};
  return !std::binary_search(now.drawn_out.begin(), now.drawn_out.end(), edge);
}

/// Whether f(a, b) holds for an edge (a, b) of a cell.
template <class F>
bool any_edge(ReferenceMesh const& mesh, Index cell, F const& f) {
  auto const corner = mesh.cells.of(cell);
  auto const edges = edges_of(mesh.cells);
  return std::any_of(edges.begin(), edges.end(), [&](auto const& e) {
    return f(corner[static_cast<std::size_t>(e[0])], corner[static_cast<std::size_t>(e[1])]);
  });
}

/// The determinant of as many directions as the mesh has dimensions [m^dimension].
double volume_of(std::array<Point3, 3> const& d, int dimension) {
  if (dimension == 1) return length(d[0]);
  return dimension == 2 ? d[0][0] * d[1][1] - d[0][1] * d[1][0] : dot(d[0], cross(d[1], d[2]));
}

/// By how much the volume of a cell has grown at the corner where it has grown most. Flat simplices, which packed
/// bodies have, count as a tenth of a cube: their own volume is not informative.
double growth_of(ReferenceMesh const& mesh, Configuration const& now, Index cell) {
  auto const corner = mesh.cells.of(cell);
  auto const dimension = static_cast<std::size_t>(mesh.dimension);
  bool const simplex = corner.size() == dimension + 1;
  double const least = simplex ? 0.1 * std::pow(mesh.spacing, mesh.dimension) : 0;
  double most = 0;
  for (std::size_t c = 0; c < (simplex ? 1 : corner.size()); ++c) {
    std::array<Point3, 3> d{}, D{};
    for (std::size_t k = 0; k < dimension; ++k) {
      std::size_t const bit = std::size_t{1} << k;
      auto const from = static_cast<std::size_t>(corner[simplex ? 0 : c & ~bit]),
                 to = static_cast<std::size_t>(corner[simplex ? k + 1 : c | bit]);
      d[k] = minus(now.x[to], now.x[from]);
      D[k] = minus(mesh.X[to], mesh.X[from]);
    }
    most = std::max(most, volume_of(d, mesh.dimension) / std::max(std::abs(volume_of(D, mesh.dimension)), least));
  }
  return most;
}

bool is_beyond(TearingCriterion const& bounds, ReferenceMesh const& mesh, Configuration const& now, Index cell) {
  auto const longer_than = [&](double stretch) {
    return any_edge(mesh, cell, [&](Index a, Index b) { return is_longer(mesh, now, a, b, stretch); });
  };
  return longer_than(bounds.stretch) && (longer_than(bounds.sheared_off) || growth_of(mesh, now, cell) > bounds.growth);
}

bool has_loose_corner(ReferenceMesh const& mesh, Configuration const& now, Index cell) {
  auto const corner = mesh.cells.of(cell);
  return !now.loose.empty() && std::any_of(corner.begin(), corner.end(),
                                           [&](Index c) { return now.loose[static_cast<std::size_t>(c)] != 0; });
}

std::vector<std::uint8_t> whole_cells(ReferenceMesh const& mesh, Configuration const& now) {
  std::vector<std::uint8_t> whole(static_cast<std::size_t>(mesh.cells.count()), 1);
  if (now.torn) {
    for (Index const cell : *now.torn)
      if (cell >= 0 && cell < mesh.cells.count()) whole[static_cast<std::size_t>(cell)] = 0;
    return whole;
  }
  exec_host::parallel_for(mesh.cells.count(), [&](Index cell) {
    whole[static_cast<std::size_t>(cell)] =
        has_loose_corner(mesh, now, cell) || is_beyond(tearing, mesh, now, cell) ? 0 : 1;
  });
  return whole;
}

/// See Configuration::drawn_out.
std::vector<std::array<Index, 2>> drawn_out_edges(ReferenceMesh const& mesh, Configuration const& now,
                                                  std::vector<std::uint8_t> const& whole) {
  auto const is_long = [&](Index a, Index b) { return is_longer(mesh, now, a, b, tearing.stretch); };
  std::vector<std::uint8_t> has_one(whole.size(), 0);
  exec_host::parallel_for(mesh.cells.count(), [&](Index cell) {
    auto const k = static_cast<std::size_t>(cell);
    has_one[k] = whole[k] != 0 && any_edge(mesh, cell, is_long) ? 1 : 0;
  });
  std::vector<std::array<Index, 2>> edges;
  for (Index cell = 0; cell < mesh.cells.count(); ++cell) {
    if (has_one[static_cast<std::size_t>(cell)] == 0) continue;
    auto const corner = mesh.cells.of(cell);
    for (auto const& e : edges_of(mesh.cells)) {
      Index const a = corner[static_cast<std::size_t>(e[0])], b = corner[static_cast<std::size_t>(e[1])];
      if (is_long(a, b)) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

/// How far the skin goes on beyond a particle at a tear: half a cell across each side that is torn off.
class TornEdges {
 public:
  TornEdges(ReferenceMesh const& mesh, std::vector<std::uint8_t> const& whole) : mesh_(mesh) {
    if (mesh.cells.count() == 0 || mesh.dimension == 1) return;
    FacetTable const table = facets_of(mesh.cells);
    for (std::size_t f = 0; f < mesh.across.size(); ++f) {
      Index const other = mesh.across[f];
      std::size_t const cell = f / table.facet.size();
      if (other >= 0 && whole[cell] != 0 && whole[static_cast<std::size_t>(other)] == 0)
        add(mesh.cells.of(static_cast<Index>(cell)), table.facet[f % table.facet.size()], table.corners);
    }
    sum_up();
  }

  /// In the reference configuration [m]. Both sides of a layer that is one particle thick leave it where it is.
  Point3 beyond(std::size_t particle) const { return beyond_.empty() ? Point3{} : beyond_[particle]; }

 private:
  struct Side {
    Index particle;
    int number;  ///< of boxes: twice the axis, and one more at its upper end
    Point3 way;
  };

  bool simplices() const { return mesh_.cells.corners == mesh_.dimension + 1; }

  void add(std::span<Index const> cell, std::array<int, 4> const& facet, int corners) {
    auto const at = [&](int c) { return cell[static_cast<std::size_t>(c)]; };
    auto const between = [&](int from, int to) {
      return minus(mesh_.X[static_cast<std::size_t>(at(to))], mesh_.X[static_cast<std::size_t>(at(from))]);
    };
    std::span const own(facet.data(), static_cast<std::size_t>(corners));
    if (simplices()) {
      Point3 const along = between(own[0], own[1]);
      Point3 const normal = corners == 2 ? Point3{along[1], -along[0], 0} : cross(along, between(own[0], own[2]));
      for (int const c : own) sides_.push_back({at(c), 0, unit(normal)});
      return;
    }
    for (int axis = 0; axis < mesh_.dimension; ++axis) {
      int const bit = 1 << axis, end = own[0] & bit;
      if (!std::all_of(own.begin(), own.end(), [&](int c) { return (c & bit) == end; })) continue;
      for (int const c : own) sides_.push_back({at(c), 2 * axis + (end != 0 ? 1 : 0), between(c ^ bit, c)});
    }
  }

  void sum_up() {
    if (sides_.empty()) return;
    std::stable_sort(sides_.begin(), sides_.end(), [](Side const& a, Side const& b) {
      return std::pair(a.particle, a.number) < std::pair(b.particle, b.number);
    });
    beyond_.assign(mesh_.count, Point3{});
    for (std::size_t k = 0; k < sides_.size(); ++k) {
      auto const& [particle, number, way] = sides_[k];
      Point3& sum = beyond_[static_cast<std::size_t>(particle)];
      bool const again = k > 0 && sides_[k - 1].particle == particle && sides_[k - 1].number == number;
      Point3 const& outward = mesh_.outward[static_cast<std::size_t>(particle)];
      bool const reaches_out = dot(outward, way) > 0.25 * dot(way, way);  // the surface of the shape is there, too
      if (simplices() || (!again && !reaches_out)) sum = plus(sum, simplices() ? 1 : 0.5, way);
    }
    for (Point3& way : beyond_)
      if (simplices()) way = plus({}, 0.5 * mesh_.spacing, unit(way));
  }

  ReferenceMesh const& mesh_;
  std::vector<Side> sides_;
  std::vector<Point3> beyond_;
};

void add_triangles(std::span<Index const> corner, std::vector<SkinFacet>& facets) {
  facets.push_back({{corner[0], corner[1], corner[2]}});
  if (corner.size() == 4) facets.push_back({{corner[0], corner[2], corner[3]}});
}

/// Outer facets; those of a box are cut along the shorter diagonal of where they are now.
void find_surface(ReferenceMesh const& mesh, Skin& skin) {
  FacetTable const table = facets_of(mesh.cells);
  for (std::size_t f = 0; f < mesh.across.size(); ++f) {
    std::size_t const cell = f / table.facet.size();
    Index const other = mesh.across[f];
    if (skin.whole[cell] == 0 || (other >= 0 && skin.whole[static_cast<std::size_t>(other)] != 0)) continue;
    auto const& of = table.facet[f % table.facet.size()];
    std::array<Index, 4> corner{};
    for (std::size_t c = 0; c < static_cast<std::size_t>(table.corners); ++c)
      corner[c] = mesh.cells.of(static_cast<Index>(cell))[static_cast<std::size_t>(of[c])];
    auto const at = [&](std::size_t c) { return skin.place[static_cast<std::size_t>(corner[c])]; };
    if (table.corners == 4 && distance(at(1), at(3)) < distance(at(0), at(2)))
      std::rotate(corner.begin(), corner.begin() + 1, corner.end());
    add_triangles(std::span(corner).first(static_cast<std::size_t>(table.corners)), skin.facets);
  }
}

/// Whole cells of two dimensions.
void find_area(ReferenceMesh const& mesh, Skin& skin) {
  for (Index cell = 0; cell < mesh.cells.count(); ++cell) {
    if (skin.whole[static_cast<std::size_t>(cell)] == 0) continue;
    auto const c = mesh.cells.of(cell);
    if (c.size() == 3)
      add_triangles(c, skin.facets);
    else
      add_triangles(std::array{c[0], c[1], c[3], c[2]}, skin.facets);
  }
  for (SkinFacet& facet : skin.facets) facet.normal.fill({0, 0, 1});
}

/// Facets at each particle.
struct Incidence {
  std::vector<std::size_t> begin;
  std::vector<std::uint32_t> facet;
  Incidence(std::vector<SkinFacet> const& facets, std::size_t particles) : begin(particles + 1, 0) {
    for (SkinFacet const& f : facets)
      for (Index const c : f.corner) ++begin[static_cast<std::size_t>(c) + 1];
    for (std::size_t i = 0; i < particles; ++i) begin[i + 1] += begin[i];
    facet.resize(begin.back());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t k = 0; k < facets.size(); ++k)
      for (Index const c : facets[k].corner) facet[next[static_cast<std::size_t>(c)]++] = static_cast<std::uint32_t>(k);
  }
};

/// Normals at corners: area-weighted sum over the facets at the corner whose angle to this one is below that of a
/// feature edge.
void smooth_normals(Skin& skin) {
  auto const count = static_cast<Index>(skin.facets.size());
  std::vector<Point3> area(skin.facets.size());
  exec_host::parallel_for(count, [&](Index k) {
    auto const& c = skin.facets[static_cast<std::size_t>(k)].corner;
    auto const at = [&](std::size_t n) { return skin.place[static_cast<std::size_t>(c[n])]; };
    area[static_cast<std::size_t>(k)] = cross(minus(at(1), at(0)), minus(at(2), at(0)));
  });
  Incidence const incidence(skin.facets, skin.place.size());
  exec_host::parallel_for(count, [&](Index k) {
    SkinFacet& facet = skin.facets[static_cast<std::size_t>(k)];
    Point3 const own = area[static_cast<std::size_t>(k)];
    double const size = length(own);
    for (std::size_t n = 0; n < 3; ++n) {
      auto const c = static_cast<std::size_t>(facet.corner[n]);
      Point3 sum{};
      for (std::size_t m = incidence.begin[c]; m < incidence.begin[c + 1]; ++m) {
        Point3 const& other = area[incidence.facet[m]];
        if (dot(own, other) >= cosine_of_edge * size * length(other)) sum = plus(sum, 1, other);
      }
      facet.normal[n] = unit(sum);
    }
  });
}

/// The six tetrahedra of a box around its diagonal from corner 0 to corner 7: those of neighbouring boxes match.
constexpr std::array<std::array<int, 4>, 6> tetrahedra_of_box{
    {{0, 1, 3, 7}, {0, 1, 5, 7}, {0, 2, 3, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 4, 6, 7}}};
constexpr std::array<std::array<int, 4>, 1> itself{{{0, 1, 2, 3}}};

/// One or two triangles where a function that is linear in a tetrahedron vanishes.
void cut_tetrahedron(std::array<Index, 4> const& corner, std::span<double const> beyond,
                     std::vector<std::array<SectionCorner, 3>>& out) {
  std::array<Index, 4> kept{}, gone{};
  std::size_t n = 0, m = 0;
  for (Index const c : corner) (beyond[static_cast<std::size_t>(c)] > 0 ? gone[m++] : kept[n++]) = c;
  if (n == 0 || m == 0) return;
  auto const between = [&](Index a, Index b) {
    double const from = beyond[static_cast<std::size_t>(a)], to = beyond[static_cast<std::size_t>(b)];
    return SectionCorner{{a, b}, from / (from - to)};
  };
  if (n == 2) {
    SectionCorner const ac = between(kept[0], gone[0]), ad = between(kept[0], gone[1]), bc = between(kept[1], gone[0]),
                        bd = between(kept[1], gone[1]);
    out.push_back({ac, ad, bd});
    out.push_back({ac, bd, bc});
    return;
  }
  bool const one_kept = n == 1;
  Index const tip = one_kept ? kept[0] : gone[0];
  auto const& base = one_kept ? gone : kept;
  out.push_back({between(tip, base[0]), between(tip, base[1]), between(tip, base[2])});
}

}  // namespace

std::vector<Index> torn_cells(ReferenceMesh const& mesh, Configuration const& now, std::span<Index const> before) {
  auto whole = whole_cells(mesh, {now.x, now.loose, {}});
  for (Index const cell : before)
    if (is_beyond(joining, mesh, now, cell)) whole[static_cast<std::size_t>(cell)] = 0;
  std::vector<Index> torn;
  for (Index cell = 0; cell < mesh.cells.count(); ++cell)
    if (whole[static_cast<std::size_t>(cell)] == 0) torn.push_back(cell);
  return torn;
}

Mat<3> fitted_gradient(ReferenceMesh const& mesh, Configuration const& now, std::size_t particle) {
  Mat<3> mixed, moment;
  double size = 0;
  for (Index const j : mesh.around(particle)) {
    if (has_parted(mesh, now, static_cast<Index>(particle), j)) continue;
    auto const other = static_cast<std::size_t>(j);
    Point3 const d = minus(now.x[other], now.x[particle]), D = minus(mesh.X[other], mesh.X[particle]);
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        mixed(a, b) += d[static_cast<std::size_t>(a)] * D[static_cast<std::size_t>(b)];
        moment(a, b) += D[static_cast<std::size_t>(a)] * D[static_cast<std::size_t>(b)];
      }
    size += dot(D, D);
  }
  if (!(size > 0)) return identity<3>();
  constexpr double little = 2e-4;
  for (int a = 0; a < 3; ++a) {
    mixed(a, a) += little * size;
    moment(a, a) += little * size;
  }
  return mixed * inverse(moment);
}

Mat<3> with_bounded_stretches(Mat<3> const& F, double least, double most) {
  Mat<3> const FtF = transpose(F) * F;
  double off = 0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) off += (FtF(a, b) - (a == b)) * (FtF(a, b) - (a == b));
  if (off < 0.5) return F;  // stretches between 0.54 and 1.31
  SymMat<3> C;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) C(a, b) = FtF(a, b);
  Eigen<3> const e = symmetric_eigen(C);
  Mat<3> scaled;
  for (int k = 0; k < 3; ++k) {
    double const stretch = std::sqrt(std::max(e.value[k], 1e-12));
    double const factor = std::clamp(stretch, least, most) / stretch;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) scaled(a, b) += factor * e.vector[k][a] * e.vector[k][b];
  }
  return F * scaled;
}

Skin make_skin(ReferenceMesh const& mesh, Configuration const& now) {
  Skin skin;
  skin.whole = whole_cells(mesh, now);
  skin.inside.assign(mesh.count, 0);
  for (Index cell = 0; cell < mesh.cells.count(); ++cell)
    if (skin.whole[static_cast<std::size_t>(cell)] != 0)
      for (Index const c : mesh.cells.of(cell)) skin.inside[static_cast<std::size_t>(c)] = 1;
  skin.place.assign(now.x.begin(), now.x.end());
  skin.reference = mesh.X;
  auto const drawn_out = drawn_out_edges(mesh, now, skin.whole);
  Configuration const with_drawn_out{now.x, now.loose, now.torn, drawn_out};
  TornEdges const edges(mesh, skin.whole);
  exec_host::parallel_for(static_cast<Index>(mesh.count), [&](Index k) {
    auto const i = static_cast<std::size_t>(k);
    Point3 const S = plus(mesh.outward[i], 1, edges.beyond(i));
    if (dot(S, S) == 0 || skin.inside[i] == 0) return;
    Vec<3> const s = fitted_gradient(mesh, with_drawn_out, i) * Vec<3>{{S[0], S[1], S[2]}};
    skin.place[i] = plus(skin.place[i], 1, {s[0], s[1], s[2]});
    skin.reference[i] = plus(skin.reference[i], 1, S);
  });
  if (mesh.cells.count() == 0 || mesh.dimension == 1) return skin;
  if (mesh.dimension == 2) {
    find_area(mesh, skin);
  } else {
    find_surface(mesh, skin);
    smooth_normals(skin);
  }
  return skin;
}

std::vector<std::array<SectionCorner, 3>> section(ReferenceMesh const& mesh, Skin const& skin,
                                                  std::span<double const> beyond) {
  std::vector<std::array<SectionCorner, 3>> out;
  if (mesh.dimension < 3) return out;
  bool const box = mesh.cells.corners == 8;
  auto const parts = box ? std::span<std::array<int, 4> const>(tetrahedra_of_box) : itself;
  for (Index cell = 0; cell < mesh.cells.count(); ++cell) {
    if (skin.whole[static_cast<std::size_t>(cell)] == 0) continue;
    auto const corner = mesh.cells.of(cell);
    bool const gone = beyond[static_cast<std::size_t>(corner[0])] > 0;
    if (std::all_of(corner.begin(), corner.end(),
                    [&](Index c) { return (beyond[static_cast<std::size_t>(c)] > 0) == gone; }))
      continue;
    for (auto const& part : parts) {
      std::array<Index, 4> tetrahedron{};
      for (std::size_t c = 0; c < 4; ++c) tetrahedron[c] = corner[static_cast<std::size_t>(part[c])];
      cut_tetrahedron(tetrahedron, beyond, out);
    }
  }
  return out;
}

}  // namespace piola
