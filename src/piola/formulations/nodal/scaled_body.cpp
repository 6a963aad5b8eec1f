// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/scaled_body.hpp"
#include <algorithm>
#include <tuple>

namespace piola::nodal {
namespace {

using Signs = std::array<double, 3>;

ScaledCell reflected(ScaledCell cell, Signs const& sign) {
  for (std::size_t c = 0; c < 3; ++c) cell.centroid[c] *= sign[c];
  for (std::size_t m = 0; m < 6; ++m) cell.spread[m] *= sign[moment_axis[m][0]] * sign[moment_axis[m][1]];
  return cell;
}

SurfacePatch reflected(SurfacePatch patch, Signs const& sign) {
  if (sign[static_cast<std::size_t>(patch.axis)] < 0) patch.upper = !patch.upper;
  for (std::size_t c = 0; c < 3; ++c) patch.first[c] *= sign[c];
  for (std::size_t m = 0; m < 6; ++m) patch.second[m] *= sign[moment_axis[m][0]] * sign[moment_axis[m][1]];
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

void continue_behind_planes(ScaledBody& r, MirrorImages const& images) {
  for (std::size_t i = 0; i < r.particles; ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (images.on_plane(static_cast<Index>(i), axis)) r.cells[i] = completed(r.cells[i], axis);
  r.patches = open_surface(r.patches, images);
  std::vector<std::vector<std::size_t>> patches_of(r.particles);
  for (std::size_t k = 0; k < r.patches.size(); ++k)
    patches_of[static_cast<std::size_t>(r.patches[k].particle)].push_back(k);
  for (Index k = 0; k < images.count(); ++k) {
    auto const source = static_cast<std::size_t>(images.particles().source[static_cast<std::size_t>(k)]);
    r.X.push_back(images.particles().X[static_cast<std::size_t>(k)]);
    for (std::size_t c = 0; c < 3; ++c) r.X.back()[c] /= r.h[c];
    r.cells.push_back(reflected(r.cells[source], images.sign(k)));
    for (std::size_t const p : patches_of[source]) {
      r.patches.push_back(reflected(r.patches[p], images.sign(k)));
      r.patches.back().particle = static_cast<Index>(r.particles) + k;
    }
  }
}

}  // namespace

void keep_cells(ScaledBody& body, IndexSet const& of) {
  LazyZeroArray<ScaledCell> kept(body.cells.size());
  for (Index k = 0; k < of.size(); ++k) kept[of[k]] = body.cells[of[k]];
  body.cells = std::move(kept);
}

ScaledBody scaled_body(SetUp const& from) {
  auto const& [set, body, order] = std::tie(from.set, from.body, from.order);
  ScaledBody r;
  for (std::size_t c = 0; c < static_cast<std::size_t>(set.dimension); ++c) {
    r.h[c] = body.spacing[c];
    r.h_volume *= body.spacing[c];
  }
  BodyCells measured = measure_cells(set, body);
  std::vector<Index> slot_of(measured.cell.size());
  r.X.reserve(measured.cell.size());
  r.cells.reserve(measured.cell.size());
  for (Index i = 0; i < order.particles; ++i) {
    auto const id = order.id[static_cast<std::size_t>(i)];
    auto const local = static_cast<std::size_t>(id - body.first);
    slot_of[local] = i;
    r.X.push_back(set.X[static_cast<std::size_t>(id)]);
    auto const& cell = measured.cell[local];
    r.cells.push_back({cell.volume / r.h_volume, cell.centroid, cell.spread});
    for (std::size_t c = 0; c < 3; ++c) {
      r.X.back()[c] /= r.h[c];
      r.cells.back().centroid[c] /= r.h[c];
    }
    for (std::size_t m = 0; m < 6; ++m) r.cells.back().spread[m] /= r.h[moment_axis[m][0]] * r.h[moment_axis[m][1]];
  }
  r.patches = std::move(measured.patch);
  for (auto& patch : r.patches) {
    patch.particle = slot_of[static_cast<std::size_t>(patch.particle)];
    double const area = r.h_volume / r.h[static_cast<std::size_t>(patch.axis)];
    patch.area /= area;
    for (std::size_t c = 0; c < 3; ++c) patch.first[c] /= area * r.h[c];
    for (std::size_t m = 0; m < 6; ++m) patch.second[m] /= area * r.h[moment_axis[m][0]] * r.h[moment_axis[m][1]];
  }
  r.particles = r.X.size();
  if (from.images != nullptr) continue_behind_planes(r, *from.images);
  return r;
}

}  // namespace piola::nodal
