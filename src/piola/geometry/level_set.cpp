// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/level_set.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/geometry/tetrahedra.hpp"
#include <algorithm>
#include <cmath>
#include <mutex>

namespace piola::geometry {
namespace {

/// Formulas are not thread-safe: each call uses a copy of its own.
class FormulaPool {
 public:
  explicit FormulaPool(Expression const& f) : first_(f) {}
  template <class F>
  auto with(F const& use) {
    std::unique_ptr<Expression> own = take();
    auto const result = use(*own);
    std::scoped_lock const lock(mutex_);
    free_.push_back(std::move(own));
    return result;
  }

 private:
  std::unique_ptr<Expression> take() {
    std::scoped_lock const lock(mutex_);
    if (free_.empty()) return std::make_unique<Expression>(first_);
    auto own = std::move(free_.back());
    free_.pop_back();
    return own;
  }
  Expression first_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Expression>> free_;
};

class LevelSet final : public Solid {
 public:
  LevelSet(Expression const& f, Bounds const& box, double spacing, int dimension)
      : pool_(std::make_shared<FormulaPool>(f)), box_(box), spacing_(spacing), dimension_(dimension) {}
  int dimension() const override { return dimension_; }
  bool distance_is_bound() const override { return false; }
  Bounds bounds() const override { return box_; }
  std::vector<Patch> patches() const override { return {{"surface"}}; }
  /// By Gauss over the surface: what chords miss of its curvature is second order in a sixth of the spacing.
  std::optional<double> exact_volume() const override {
    std::vector<SurfacePiece> pieces;
    cut_surface(spacing_ / 6, pieces);
    Vec<3> const middle = 0.5 * (box_.min + box_.max);
    double sum = 0;
    for (SurfacePiece const& piece : pieces) sum += dot(piece.X - middle, piece.area);
    return sum / dimension_;
  }

  Foot at(Vec<3> const& X) const override {
    return pool_->with([&](Expression const& f) { return foot(f, X); });
  }

  void cut_surface(double edge, std::vector<SurfacePiece>& pieces) const override {
    PIOLA_EXPECTS(edge > 0);
    // Corners of the triangles are brought to the surface, so that only its curvature within one is lost.
    auto const value = [this](Vec<3> const& X) {
      return pool_->with([&](Expression const& f) { return value_at(f, X); });
    };
    auto const onto = [this](Vec<3> const& X) {
      Foot const own = at(X);
      return std::abs(own.distance) < spacing_ ? X - own.distance * own.normal : X;
    };
    Triangles const triangles = level_surface(value, box_, edge, dimension_);
    std::vector<Vec<3>> corner(triangles.corner.size());
    exec_host::parallel_for(static_cast<Index>(corner.size()), [&](Index i) {
      auto const k = static_cast<std::size_t>(i);
      corner[k] = onto(triangles.corner[k]);
    });
    append_pieces(triangles, corner, dimension_, pieces);
  }

 private:
  static double value_at(Expression const& f, Vec<3> const& X) {
    double const value = f({X[0], X[1], X[2]});
    return std::isfinite(value) ? value : 1e300;
  }
  Vec<3> gradient(Expression const& f, Vec<3> const& X) const {
    double const step = 1e-4 * spacing_;
    Vec<3> g;
    for (int c = 0; c < dimension_; ++c) {
      Vec<3> up = X, down = X;
      up[c] += step;
      down[c] -= step;
      g[c] = (value_at(f, up) - value_at(f, down)) / (2 * step);
    }
    return g;
  }
  Foot foot(Expression const& f, Vec<3> const& X) const {
    double const value = value_at(f, X), sign = value < 0 ? -1 : 1;
    Vec<3> const g = gradient(f, X);
    double const slope = std::sqrt(dot(g, g));
    double const far = std::sqrt(dot(box_.max - box_.min, box_.max - box_.min));
    if (!(slope > 0) || !std::isfinite(slope)) return {sign * far, {{1, 0, 0}}};
    Foot const rough{std::clamp(value / slope, -far, far), (1 / slope) * g};
    if (std::abs(rough.distance) > 3 * spacing_) return rough;
    // To the foot point: down the gradient of where we are.
    Vec<3> Y = X;
    Vec<3> n = rough.normal;
    for (int turn = 0; turn < 2; ++turn) {
      Vec<3> const here = turn == 0 ? g : gradient(f, Y);
      double const square = dot(here, here);
      if (!(square > 0)) return rough;
      n = (1 / std::sqrt(square)) * here;
      Y = Y - (value_at(f, Y) / square) * here;
    }
    Vec<3> const r = X - Y;
    double const distance = std::sqrt(dot(r, r));
    return {sign * distance, distance > 1e-6 * spacing_ ? (sign / distance) * r : n};
  }

  std::shared_ptr<FormulaPool> pool_;
  Bounds box_;
  double spacing_;
  int dimension_;
};

}  // namespace

std::optional<std::string> level_of(std::string const& formula) {
  int depth = 0;
  std::size_t at = std::string::npos, after = 0;
  for (std::size_t i = 0; i < formula.size(); ++i) {
    char const c = formula[i];
    if (c == '(') ++depth;
    if (c == ')') --depth;
    if (c == '&' || c == '|' || c == '?' || c == '!') return {};
    if (c != '<' && c != '>') continue;
    if (depth != 0 || at != std::string::npos) return {};
    at = i;
    after = i + 1 < formula.size() && formula[i + 1] == '=' ? i + 2 : i + 1;
  }
  if (at == std::string::npos) return {};
  std::string const left = "(" + formula.substr(0, at) + ")", right = "(" + formula.substr(after) + ")";
  return formula[at] == '<' ? left + " - " + right : right + " - " + left;
}

SolidPtr level_set(Expression const& f, Bounds const& box, double spacing, int dimension) {
  PIOLA_EXPECTS(dimension == 2 || dimension == 3);
  PIOLA_EXPECTS(box.min[0] < box.max[0] && box.min[1] < box.max[1]);
  PIOLA_EXPECTS(dimension == 2 || box.min[2] < box.max[2]);
  return std::make_shared<LevelSet>(f, box, spacing, dimension);
}

}  // namespace piola::geometry
