// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/patch_measures.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace piola::geometry {
namespace {

/// Halves blocks that the surface may cross.
class BlockVolume {
 public:
  BlockVolume(Solid const& solid, Vec<3> const& edge) : solid_(solid), D_(solid.dimension()), edge_(edge) {}

  double at(Vec<3> const& middle, double scale, int depth) const {
    Vec<3> const half = 0.5 * scale * edge_;
    double volume = 1, diagonal = 0;
    for (int c = 0; c < D_; ++c) {
      volume *= 2 * half[c];
      diagonal += half[c] * half[c];
    }
    bool const last = depth == 0;
    if (last || solid_.distance_is_bound()) {
      Foot const foot = solid_.at(middle);
      if (!last && std::abs(foot.distance) > std::sqrt(diagonal)) return foot.distance < 0 ? volume : 0;
      if (last) {
        double width = 0;
        for (int c = 0; c < D_; ++c) width += 2 * half[c] * std::abs(foot.normal[c]);
        return volume * std::clamp(0.5 - foot.distance / width, 0.0, 1.0);
      }
    }
    double sum = 0;
    for (int part = 0; part < (D_ == 3 ? 8 : 4); ++part) {
      Vec<3> X = middle;
      for (int c = 0; c < D_; ++c) X[c] += ((part >> c & 1) != 0 ? 0.5 : -0.5) * half[c];
      sum += at(X, 0.5 * scale, depth - 1);
    }
    return sum;
  }

 private:
  Solid const& solid_;
  int D_;
  Vec<3> edge_;
};

}  // namespace

double volume_of(Solid const& solid, double spacing) {
  PIOLA_EXPECTS(spacing > 0);
  if (auto const exact = solid.exact_volume()) return *exact;
  constexpr int depth = 3;
  Bounds const box = solid.bounds();
  std::array<Index, 3> count{1, 1, 1};
  Vec<3> edge{{1, 1, 1}};
  for (int c = 0; c < solid.dimension(); ++c) {
    double const length = box.max[c] - box.min[c];
    auto const n = static_cast<Index>(std::ceil(length / spacing - 1e-9));
    count[static_cast<std::size_t>(c)] = std::max<Index>(1, n);
    edge[c] = length / std::max<Index>(1, n);
  }
  BlockVolume const blocks(solid, edge);
  std::vector<double> rows(static_cast<std::size_t>(count[1]) * static_cast<std::size_t>(count[2]));
  auto const all = static_cast<Index>(rows.size());
  exec_host::parallel_for_chunks(all, all * count[0], [&](Index row) {
    double sum = 0;
    for (Index i = 0; i < count[0]; ++i) {
      std::array<Index, 3> const at{i, row % count[1], row / count[1]};
      Vec<3> X;
      for (int c = 0; c < solid.dimension(); ++c) X[c] = box.min[c] + (at[static_cast<std::size_t>(c)] + 0.5) * edge[c];
      sum += blocks.at(X, 1, depth);
    }
    rows[static_cast<std::size_t>(row)] = sum;
  });
  double sum = 0;
  for (double const row : rows) sum += row;
  return sum;
}

std::vector<PatchFacts> patch_facts(Solid const& solid, double edge) {
  PIOLA_EXPECTS(edge > 0);
  std::vector<PatchFacts> facts;
  for (Patch const& patch : solid.patches()) facts.push_back({patch.name, 0, {}, {}});
  std::vector<SurfacePiece> pieces;
  solid.cut_surface(edge, pieces);
  for (SurfacePiece const& piece : pieces) {
    PatchFacts& f = facts[static_cast<std::size_t>(piece.patch)];
    double const area = std::sqrt(dot(piece.area, piece.area));
    f.area += area;
    f.centre = f.centre + area * piece.X;
    f.direction = f.direction + piece.area;
  }
  std::erase_if(facts, [](PatchFacts const& f) { return !(f.area > 0); });
  for (PatchFacts& f : facts) {
    f.centre = (1 / f.area) * f.centre;
    f.direction = (1 / f.area) * f.direction;
  }
  return facts;
}

}  // namespace piola::geometry
