// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/mesh.hpp"
#include "piola/base/contracts.hpp"
#include "piola/base/text.hpp"
#include "piola/geometry/mesh_bytes.hpp"
#include "piola/geometry/mesh_checks.hpp"
#include "piola/geometry/mesh_file.hpp"
#include "piola/geometry/mesh_repair.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

namespace piola::geometry {

namespace {

struct CutTriangle {
  std::array<Vec<3>, 3> X;
  Vec<3> area;
};

/// Halves triangles across their longest side until all sides are short. Halves have half the vector area exactly.
void cut_triangle(CutTriangle const& whole, double edge, int patch, std::vector<SurfacePiece>& pieces) {
  std::vector<CutTriangle> waiting{whole};
  while (!waiting.empty()) {
    CutTriangle const t = waiting.back();
    waiting.pop_back();
    int longest = 0;
    double most = -1;
    for (int side = 0; side < 3; ++side) {
      Vec<3> const e = t.X[(side + 1) % 3] - t.X[side];
      if (double const square = dot(e, e); square > most) {
        most = square;
        longest = side;
      }
    }
    if (!(most > edge * edge)) {
      pieces.push_back({(1.0 / 3.0) * (t.X[0] + t.X[1] + t.X[2]), t.area, patch});
      continue;
    }
    Vec<3> const a = t.X[longest], b = t.X[(longest + 1) % 3], c = t.X[(longest + 2) % 3], middle = 0.5 * (a + b);
    waiting.push_back({{middle, b, c}, 0.5 * t.area});
    waiting.push_back({{a, middle, c}, 0.5 * t.area});
  }
}

class MeshSolid : public Solid {
 public:
  MeshSolid(Surface surface, Links const& links, MeshOptions const& options)
      : surface_(std::move(surface)),
        holes_(!links.open.empty()),
        distance_(surface_, links, holes_ ? MeshDistance::Sign::rays : MeshDistance::Sign::normals),
        box_(bounds_of(surface_)),
        volume_(enclosed_volume(surface_)),
        patch_(patches_of(surface_, links, options.feature_angle, patches_)) {}

  Foot at(Vec<3> const& X) const override { return distance_.at(X); }
  Bounds bounds() const override { return box_; }
  std::optional<double> exact_volume() const override { return holes_ ? std::nullopt : std::optional(volume_); }
  std::vector<Patch> patches() const override { return patches_; }
  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override {
    PIOLA_EXPECTS(edge > 0);
    for (int face = 0; face < surface_.faces(); ++face) {
      auto const& c = surface_.corner[face];
      cut_triangle({{surface_.X[c[0]], surface_.X[c[1]], surface_.X[c[2]]}, 0.5 * surface_.twice_area(face)}, edge,
                   patch_[face], pieces);
    }
  }
  MeshDistance const& distance() const { return distance_; }
  Surface const& surface() const { return surface_; }

 private:
  Surface surface_;
  bool holes_;
  MeshDistance distance_;
  Bounds box_;
  double volume_;
  std::vector<Patch> patches_;
  std::vector<int> patch_;
};

/// Single precision of the reader: a mesh far from the origin loses digits.
void note_offset(std::string const& name, MeshReport& report) {
  constexpr double far_away = 1000;
  double const size = largest_extent(report.bounds);
  double reach = 0;
  for (int i = 0; i < 3; ++i) reach = std::max({reach, std::abs(report.bounds.min[i]), std::abs(report.bounds.max[i])});
  if (reach > far_away * size)
    report.notes.push_back(
        fmt::format("{}: the mesh lies {} from the origin and is {} wide; files are read with 7 "
                    "digits: move it to the origin before it is exported",
                    name, quantity_text(reach, "m", 3), quantity_text(size, "m", 3)));
}

/// Makes near corners one and removes needless faces, as far as that is wanted.
void repair_faces(Surface& surface, std::string const& name, MeshOptions const& options, MeshReport& report) {
  auto const note = [&](std::int64_t count, std::string_view what) {
    if (count > 0) report.notes.push_back(fmt::format("{}: {} {}", name, count_text(count), what));
  };
  int const before = surface.faces();
  report.dropped = weld(surface);
  if (options.merge > 0) {
    report.merged = merge_corners(surface, options.merge);
    note(report.merged,
         fmt::format("corners are merged with others less than {} away", quantity_text(options.merge, "m")));
    report.dropped = before - surface.faces();
  }
  note(report.dropped, "faces with equal corners are left out");
  if (options.repair != MeshOptions::Repair::faces) return;
  RemovedFaces const removed = remove_needless_faces(surface);
  report.twice = removed.twice;
  report.without_area = removed.without_area;
  note(report.twice, "faces that stand twice are removed");
  note(report.without_area, "faces without area are removed");
}

/// Welds, mends if that is wanted, and counts.
Links prepare(Surface& surface, std::string const& name, MeshOptions const& options, MeshReport& report) {
  repair_faces(surface, name, options, report);
  Links links = link_faces(surface);
  bool const turns = options.repair == MeshOptions::Repair::orient || options.repair == MeshOptions::Repair::faces;
  if (turns && links.open.empty() && links.non_manifold.empty()) {
    report.mended = orient(surface, links);
    if (report.mended > 0)
      report.notes.push_back(fmt::format("{}: {} faces are turned", name, count_text(report.mended)));
    links = link_faces(surface);
  }
  report.corners = static_cast<std::int64_t>(surface.X.size());
  report.faces = surface.faces();
  report.shells = links.shells;
  report.bounds = bounds_of(surface);
  report.volume = enclosed_volume(surface);
  report.area = area_of(surface);
  note_offset(name, report);
  return links;
}

}  // namespace

SolidPtr mesh_from_bytes(std::string_view bytes, std::string const& name, MeshOptions const& options,
                         MeshReport& report) {
  PIOLA_EXPECTS(options.scale > 0);
  Surface surface = surface_of_bytes(bytes, name, options, report.problems, report.notes);
  if (!report.problems.empty()) return nullptr;
  Links const links = prepare(surface, name, options, report);
  if (surface.faces() == 0 || !(report.area > 0)) {
    report.problems.push_back(fmt::format("{}: its faces have no area - export it again", name));
    return nullptr;
  }
  check_links(surface, links, name, options, report);
  if (!report.problems.empty()) return nullptr;
  auto const solid = std::make_shared<MeshSolid const>(std::move(surface), links, options);
  if (links.open.empty()) check_crossing(solid->surface(), solid->distance(), name, report);
  if (!report.problems.empty()) return nullptr;
  compare_with_spacing(solid->surface(), solid->distance(), name, options.spacing, report);
  return solid;
}

SolidPtr read_mesh(std::string const& path, MeshOptions const& options, MeshReport& report) {
  std::string const bytes = bytes_of_mesh(path, report.problems);
  if (!report.problems.empty()) return nullptr;
  return mesh_from_bytes(bytes, mesh_name(path), options, report);
}

}  // namespace piola::geometry
