// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/boolean_solid.hpp"
#include "piola/base/contracts.hpp"
#include "piola/geometry/transformed_solid.hpp"
#include <algorithm>
#include <cmath>
#include <limits>

namespace piola::geometry {
namespace {

Bounds hull_of(Bounds a, Bounds const& b) {
  for (int c = 0; c < 3; ++c) {
    a.min[c] = std::min(a.min[c], b.min[c]);
    a.max[c] = std::max(a.max[c], b.max[c]);
  }
  return a;
}

Bounds common_of(Bounds a, Bounds const& b) {
  for (int c = 0; c < 3; ++c) {
    a.min[c] = std::max(a.min[c], b.min[c]);
    a.max[c] = std::max(a.min[c], std::min(a.max[c], b.max[c]));
  }
  return a;
}

class BooleanSolid final : public Solid {
 public:
  BooleanSolid(BooleanOperation how, std::vector<SolidPtr> parts) : how_(how), parts_(std::move(parts)) {
    for (SolidPtr const& part : parts_) {
      PIOLA_EXPECTS(part != nullptr && part->dimension() == dimension());
      first_patch_.push_back(patches_.size());
      for (Patch const& patch : part->patches())
        patches_.push_back({std::to_string(first_patch_.size()) + "." + patch.name});
    }
  }

  int dimension() const override { return parts_.front()->dimension(); }

  bool distance_is_bound() const override {
    return std::all_of(parts_.begin(), parts_.end(), [](SolidPtr const& part) { return part->distance_is_bound(); });
  }

  Foot at(Vec<3> const& X) const override {
    Foot best = parts_.front()->at(X);
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      Foot const other = seen(k, X);
      if (how_ == BooleanOperation::join ? other.distance < best.distance : other.distance > best.distance)
        best = other;
    }
    return best;
  }

  Bounds bounds() const override {
    Bounds all = parts_.front()->bounds();
    for (std::size_t k = 1; k < parts_.size() && how_ != BooleanOperation::cut; ++k)
      all = how_ == BooleanOperation::join ? hull_of(all, parts_[k]->bounds()) : common_of(all, parts_[k]->bounds());
    return all;
  }

  std::vector<Patch> patches() const override { return patches_; }

  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override {
    PIOLA_EXPECTS(edge > 0);
    Bounds const box = bounds();
    std::size_t const before = pieces.size();
    for (std::size_t k = 0; k < parts_.size(); ++k) {
      std::vector<SurfacePiece> own;
      if (auto const* half = dynamic_cast<HalfSpace const*>(parts_[k].get()))
        half->cut_surface_around(box, edge, own);
      else
        parts_[k]->cut_surface(edge, own);
      for (SurfacePiece& piece : own) {
        double const share = exposed_fraction(k, piece);
        if (share <= 0) continue;
        piece.area = (how_ == BooleanOperation::cut && k > 0 ? -share : share) * piece.area;
        piece.patch += static_cast<int>(first_patch_[k]);
        pieces.push_back(piece);
      }
    }
    close(pieces, before);
  }

 private:
  /// A part as the combination sees it: what is cut away is turned inside out.
  Foot seen(std::size_t k, Vec<3> const& X) const {
    Foot foot = parts_[k]->at(X);
    if (how_ == BooleanOperation::cut && k > 0) foot = {-foot.distance, -1.0 * foot.normal};
    return foot;
  }

  /// Fraction of a surface piece of part k that the other parts leave. Each part cuts it along a straight line, by its
  /// distance at the centre.
  double exposed_fraction(std::size_t k, SurfacePiece const& piece) const {
    double const area = std::sqrt(dot(piece.area, piece.area));
    double const size = dimension() == 3 ? std::sqrt(area) : area;
    if (!(area > 0)) return 0;
    Vec<3> const n = ((how_ == BooleanOperation::cut && k > 0 ? -1.0 : 1.0) / area) * piece.area;
    double share = 1;
    for (std::size_t other = 0; other < parts_.size() && share > 0; ++other) {
      if (other == k) continue;
      Foot foot = seen(other, piece.X);
      double const along = dot(foot.normal, n);
      if (std::abs(foot.distance) < 1e-9 * size && std::abs(along) > 1 - 1e-9) {
        // Common face: belongs to the first part if both normals agree; interior to a union if they are opposite.
        share = along > 0 && k < other ? share : 0;
        continue;
      }
      if (how_ == BooleanOperation::join) foot.distance = -foot.distance;
      double const width = size * std::sqrt(std::max(1 - along * along, 1e-12));
      share *= std::clamp(0.5 - foot.distance / width, 0.0, 1.0);
    }
    return share;
  }

  /// The pieces along seams are cut only to second order: what is missing for a closed surface is spread over all.
  void close(std::vector<SurfacePiece>& pieces, std::size_t before) const {
    Bounds const box = bounds();
    for (int c = 0; c < dimension(); ++c)
      if (!std::isfinite(box.min[c]) || !std::isfinite(box.max[c])) return;
    Vec<3> sum;
    double total = 0;
    for (std::size_t i = before; i < pieces.size(); ++i) {
      sum = sum + pieces[i].area;
      total += std::sqrt(dot(pieces[i].area, pieces[i].area));
    }
    if (!(total > 0)) return;
    for (std::size_t i = before; i < pieces.size(); ++i)
      pieces[i].area = pieces[i].area - (std::sqrt(dot(pieces[i].area, pieces[i].area)) / total) * sum;
  }

  BooleanOperation how_;
  std::vector<SolidPtr> parts_;
  std::vector<std::size_t> first_patch_;
  std::vector<Patch> patches_;
};

}  // namespace

SolidPtr combined(BooleanOperation how, std::vector<SolidPtr> parts) {
  PIOLA_EXPECTS(!parts.empty());
  return std::make_shared<BooleanSolid>(how, std::move(parts));
}

}  // namespace piola::geometry
