// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/scaled_body.hpp"
#include "piola/formulations/nodal/hoop_stretch.hpp"
#include "piola/math/circle.hpp"
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>

namespace piola::nodal {
namespace {

using Signs = std::array<double, 3>;
using Moments = std::array<double, 10>;  // as a row of NormalMoments

ScaledCell reflected(ScaledCell cell, Signs const& sign) {
  for (std::size_t c = 0; c < 3; ++c) cell.centroid[c] *= sign[c];
  for (std::size_t m = 0; m < 6; ++m) cell.spread[m] *= sign[moment_axis[m][0]] * sign[moment_axis[m][1]];
  return cell;
}

Moments reflected(Moments moments, Signs const& sign) {
  for (std::size_t c = 0; c < 3; ++c) moments[1 + c] *= sign[c];
  for (std::size_t m = 0; m < 6; ++m) moments[4 + m] *= sign[moment_axis[m][0]] * sign[moment_axis[m][1]];
  return moments;
}

NormalMoments reflected(NormalMoments moments, Signs const& sign) {
  for (std::size_t J = 0; J < 3; ++J) {
    moments[J] = reflected(moments[J], sign);
    for (double& m : moments[J]) m *= sign[J];
  }
  return moments;
}

SurfacePatch reflected(SurfacePatch patch, Signs const& sign) {
  if (sign[static_cast<std::size_t>(patch.axis)] < 0) patch.upper = !patch.upper;
  patch.moments = reflected(patch.moments, sign);
  patch.extent = reflected(patch.extent, sign);
  return patch;
}

Signs across(std::size_t axis) {
  Signs sign{1, 1, 1};
  sign[axis] = -1;
  return sign;
}

/// A cell on a plane together with its other half.
ScaledCell completed(ScaledCell cell, std::size_t axis) {
  cell.volume *= 2;
  cell.spread[axis] += cell.centroid[axis] * cell.centroid[axis];
  cell.centroid[axis] = 0;
  for (std::size_t m = 3; m < 6; ++m)
    if (moment_axis[m][0] == axis || moment_axis[m][1] == axis) cell.spread[m] = 0;
  return cell;
}

/// The surface of the whole body: without patches on planes, and with the mirrored half of patches of particles on
/// planes.
std::vector<SurfacePatch> open_surface(std::vector<SurfacePatch> const& all, MirrorImages const& images) {
  std::vector<SurfacePatch> open;
  for (auto const& patch : all)
    if (!patch.outermost || !images.has_plane(static_cast<std::size_t>(patch.axis), patch.upper)) open.push_back(patch);
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (std::size_t k = 0, end = open.size(); k < end; ++k)
      if (images.on_plane(open[k].particle, axis)) open.push_back(reflected(open[k], across(axis)));
  return open;
}

/// Particles and images by their positions.
class PlacesOfImages {
 public:
  explicit PlacesOfImages(Points const& X) {
    for (std::size_t a = 0; a < X.size(); ++a) at_.emplace(key(X[a]), static_cast<Index>(a));
  }
  /// -1: none.
  Index operator()(std::array<double, 3> const& X) const {
    auto const found = at_.find(key(X));
    return found == at_.end() ? -1 : found->second;
  }

 private:
  /// Positions are equal if they are in the same cell of a grid of a thousandth of a spacing. The grid is shifted, so
  /// that particles of a lattice are not on the borders of its cells.
  static std::array<long, 3> key(std::array<double, 3> const& X) {
    std::array<long, 3> at{};
    for (std::size_t c = 0; c < 3; ++c) at[c] = std::lround(1024 * X[c] + 0.2718);
    return at;
  }
  std::map<std::array<long, 3>, Index> at_;
};

/// Facets of the whole body: those across planes, and all of them behind the planes.
class FacetsBehindPlanes {
 public:
  FacetsBehindPlanes(ScaledBody& body, MirrorImages const& images)
      : body_(body), images_(images), place_of_(body.X), facets_(std::move(body.facets)) {}

  /// `surface`: of the body itself, with the patches on planes.
  void operator()(std::vector<SurfacePatch> const& surface) {
    for (auto const& patch : surface) {
      auto const axis = static_cast<std::size_t>(patch.axis);
      if (patch.outermost && images_.has_plane(axis, patch.upper) && !images_.on_plane(patch.particle, axis))
        cross(patch, axis);
    }
    body_.facets.clear();
    for (CellFacet const& facet : facets_) add(facet.a, facet.b, facet.moments);
    for (auto const& map : images_.maps())
      for (CellFacet const& facet : facets_) {
        Index const a = image(facet.a, map), b = image(facet.b, map);
        if (a >= 0 && b >= 0) add(a, b, reflected(facet.moments, map.sign));
      }
  }

 private:
  Index image(Index a, MirrorImages::Map const& map) const {
    auto X = body_.X[static_cast<std::size_t>(a)];
    for (std::size_t c = 0; c < 3; ++c) X[c] = map.sign[c] * X[c] + map.shift[c] / body_.h[c];
    return place_of_(X);
  }
  /// Adds the facet between a particle and its image, which is the particle's patch on the plane. Half of it counts,
  /// because the reflection in this plane gives the same facet a second time.
  void cross(SurfacePatch const& patch, std::size_t axis) {
    auto const& X = body_.X[static_cast<std::size_t>(patch.particle)];
    double const height = images_.plane(axis, patch.upper) / body_.h[axis] - X[axis];
    auto behind = X;
    behind[axis] += 2 * height;
    Index const b = place_of_(behind);
    if (b < 0) return;
    auto moments = patch.moments[axis];
    for (double& m : moments) m *= 0.5;
    std::array<double, 3> middle{};
    middle[axis] = height;
    CellFacet facet{patch.particle, b, {}};
    facet.moments[axis] = moments_about(moments, middle);
    facets_.push_back(facet);
  }
  /// Pairs of particles on a plane get the other halves of their facets.
  void add(Index a, Index b, NormalMoments moments) {
    if (a > b)
      for (auto& of_axis : moments)
        for (double& m : of_axis) m = -m;
    auto const [at, is_new] = known_.try_emplace(std::minmax(a, b), body_.facets.size());
    if (is_new) body_.facets.push_back({std::min(a, b), std::max(a, b), {}});
    auto& sum = body_.facets[at->second].moments;
    for (std::size_t J = 0; J < 3; ++J)
      for (std::size_t m = 0; m < 10; ++m) sum[J][m] += moments[J][m];
  }

  ScaledBody& body_;
  MirrorImages const& images_;
  PlacesOfImages place_of_;
  std::vector<CellFacet> facets_;  ///< of the body itself
  std::map<std::pair<Index, Index>, std::size_t> known_;
};

void continue_behind_planes(ScaledBody& r, MirrorImages const& images) {
  for (std::size_t i = 0; i < r.particles; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (images.on_plane(static_cast<Index>(i), axis)) {
        r.cells[i] = completed(r.cells[i], axis);
        if (!r.sections.empty()) r.sections[i] = completed_section(r.sections[i], axis);
      }
  auto const surface = std::move(r.patches);
  r.patches = open_surface(surface, images);
  std::vector<std::vector<std::size_t>> patches_of(r.particles);
  for (std::size_t k = 0; k < r.patches.size(); ++k)
    patches_of[static_cast<std::size_t>(r.patches[k].particle)].push_back(k);
  for (Index k = 0; k < images.count(); ++k) {
    auto const source = static_cast<std::size_t>(images.particles().source[static_cast<std::size_t>(k)]);
    r.X.push_back(images.particles().X[static_cast<std::size_t>(k)]);
    for (std::size_t c = 0; c < 3; ++c) r.X.back()[c] /= r.h[c];
    r.cells.push_back(reflected(r.cells[source], images.sign(k)));
    if (!r.sections.empty()) r.sections.push_back(reflected_section(r.sections[source], images.sign(k)));
    for (std::size_t const p : patches_of[source]) {
      r.patches.push_back(reflected(r.patches[p], images.sign(k)));
      r.patches.back().particle = static_cast<Index>(r.particles) + k;
    }
  }
  FacetsBehindPlanes{r, images}(surface);
}

/// From metres to spacings, over an area of one spacing across `axis`.
void scale(Moments& moments, std::size_t axis, ScaledBody const& body) {
  double const area = body.h_volume / body.h[axis];
  for (double& m : moments) m /= area;
  for (std::size_t c = 0; c < 3; ++c) moments[1 + c] /= body.h[c];
  for (std::size_t m = 0; m < 6; ++m) moments[4 + m] /= body.h[moment_axis[m][0]] * body.h[moment_axis[m][1]];
}

ScaledCell scaled(CellMoments const& cell, ScaledBody const& body) {
  ScaledCell r{cell.volume / body.h_volume, cell.centroid, cell.spread};
  for (std::size_t c = 0; c < 3; ++c) r.centroid[c] /= body.h[c];
  for (std::size_t m = 0; m < 6; ++m) r.spread[m] /= body.h[moment_axis[m][0]] * body.h[moment_axis[m][1]];
  return r;
}

SectionMoments scaled(SectionMoments section, ScaledBody const& body) {
  double const full = circle(1.0);
  for (std::size_t m = 0; m < SectionMoments::powers.size(); ++m) {
    auto const [i, j] = SectionMoments::powers[m];
    section.of[m] /= full * std::pow(body.h[0], i + 1) * std::pow(body.h[1], j + 1);
  }
  return section;
}

/// Which particles need their facets.
std::function<bool(std::size_t)> wanted_facets(SetUp const& from, std::optional<LatticeShape> const& lattice) {
  if (!lattice) return [](std::size_t) { return true; };
  std::vector<bool> wanted(static_cast<std::size_t>(from.order.particles));
  for (Index const slot : representatives_in_lattice(*lattice, beyond_reach))
    wanted[static_cast<std::size_t>(from.order.id[static_cast<std::size_t>(slot)] - from.body.first)] = true;
  return [wanted](std::size_t particle) { return wanted[particle]; };
}

/// The surface and the facets in slot order, slots by particle of the body.
void take_surface(BodyCells&& measured, std::vector<Index> const& slot_of, ScaledBody& r) {
  r.patches = std::move(measured.patch);
  for (auto& patch : r.patches) {
    patch.particle = slot_of[static_cast<std::size_t>(patch.particle)];
    scale(patch.extent, static_cast<std::size_t>(patch.axis), r);
    for (std::size_t J = 0; J < 3; ++J) scale(patch.moments[J], J, r);
  }
  r.facets = std::move(measured.facet);
  for (auto& facet : r.facets) {
    Index const a = slot_of[static_cast<std::size_t>(facet.a)], b = slot_of[static_cast<std::size_t>(facet.b)];
    facet.a = std::min(a, b);
    facet.b = std::max(a, b);
    for (std::size_t J = 0; J < 3; ++J) {
      scale(facet.moments[J], J, r);
      for (double& m : facet.moments[J]) m *= a < b ? 1 : -1;
    }
  }
  r.farthest_move = measured.farthest_move;
  r.unmoved = static_cast<double>(measured.unmoved);
}

}  // namespace

std::array<double, 10> moments_about(std::array<double, 10> const& m, std::array<double, 3> const& by) {
  auto moved = m;
  for (std::size_t c = 0; c < 3; ++c) moved[1 + c] -= by[c] * m[0];
  for (std::size_t k = 0; k < 6; ++k) {
    auto const [c, d] = std::pair(moment_axis[k][0], moment_axis[k][1]);
    if (c == d)
      moved[4 + k] += by[c] * (0.5 * by[c] * m[0] - m[1 + c]);
    else
      moved[4 + k] += by[c] * by[d] * m[0] - by[c] * m[1 + d] - by[d] * m[1 + c];
  }
  return moved;
}

void keep_cells(ScaledBody& body, IndexSet const& of) {
  LazyZeroArray<ScaledCell> kept(body.cells.size());
  for (Index k = 0; k < of.size(); ++k) kept[of[k]] = body.cells[of[k]];
  body.cells = std::move(kept);
}

ScaledBody scaled_body(SetUp const& from, std::optional<LatticeShape> const& lattice) {
  auto const& [set, body, order] = std::tie(from.set, from.body, from.order);
  ScaledBody r;
  for (std::size_t c = 0; c < static_cast<std::size_t>(set.dimension); ++c) {
    r.h[c] = body.spacing[c];
    r.h_volume *= body.spacing[c];
  }
  if (set.axisymmetric) r.h_volume *= circle(r.h[0]);
  BodyCells measured = measure_cells(set, body, wanted_facets(from, lattice));
  std::vector<Index> slot_of(measured.cell.size());
  r.X.reserve(measured.cell.size());
  r.cells.reserve(measured.cell.size());
  for (Index i = 0; i < order.particles; ++i) {
    auto const id = order.id[static_cast<std::size_t>(i)];
    auto const local = static_cast<std::size_t>(id - body.first);
    slot_of[local] = i;
    r.X.push_back(set.X[static_cast<std::size_t>(id)]);
    for (std::size_t c = 0; c < 3; ++c) r.X.back()[c] /= r.h[c];
    r.cells.push_back(scaled(measured.cell[local], r));
    if (set.axisymmetric) r.sections.push_back(scaled(measured.section[local], r));
  }
  r.particles = r.X.size();
  take_surface(std::move(measured), slot_of, r);
  if (from.images != nullptr) continue_behind_planes(r, *from.images);
  return r;
}

}  // namespace piola::nodal
