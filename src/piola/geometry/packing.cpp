// SPDX-License-Identifier: Apache-2.0
#include "piola/geometry/packing.hpp"
#include "piola/base/contracts.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/math/array_conversion.hpp"
#include "piola/neighbours/cell_grid.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

namespace piola::geometry {
namespace {

using Point = std::array<double, 3>;

// Measured best, see docs/theory/packing.md. All in spacings.
constexpr double support = 2.4, skin = 0.4, pace = 0.3, largest_move = 0.15, still = 1e-3, depth = 0.5,
                 piece_edge = 0.4;
constexpr int sweeps_per_list = 5, pushes = 3;

/// Wendland's C2 kernel with support 1 (Adv. Comput. Math. 4, 1995); scaled by the caller.
double shape_of_kernel(double q) { return q < 1 ? (1 - q) * (1 - q) * (1 - q) * (1 - q) * (1 + 4 * q) : 0; }
/// Its derivative over q.
double slope_over_q(double q) { return q < 1 ? -20 * (1 - q) * (1 - q) * (1 - q) : 0; }

/// Pieces of surface, those of one small cube added up: W n dS is a sum.
std::vector<SurfacePiece> merged(std::vector<SurfacePiece> const& pieces, double edge) {
  std::vector<std::pair<std::array<std::int64_t, 3>, std::size_t>> order;
  order.reserve(pieces.size());
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::array<std::int64_t, 3> cube{};
    for (int c = 0; c < 3; ++c)
      cube[static_cast<std::size_t>(c)] = static_cast<std::int64_t>(std::floor(pieces[i].X[c] / edge));
    order.emplace_back(cube, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<SurfacePiece> sums;
  for (std::size_t first = 0; first < order.size();) {
    SurfacePiece sum;
    double weight = 0;
    std::size_t i = first;
    for (; i < order.size() && order[i].first == order[first].first; ++i) {
      SurfacePiece const& piece = pieces[order[i].second];
      double const area = std::sqrt(dot(piece.area, piece.area));
      sum.X = sum.X + area * piece.X;
      sum.area = sum.area + piece.area;
      weight += area;
    }
    first = i;
    if (!(weight > 0)) continue;
    sum.X = (1 / weight) * sum.X;
    sums.push_back(sum);
  }
  return sums;
}

/// The places of a lattice about the middle of the box that lie deepest inside: as many as wanted.
class Start {
 public:
  Start(Solid const& solid, double spacing) : solid_(solid), spacing_(spacing) {
    Bounds const box = solid.bounds();
    for (int c = 0; c < solid.dimension(); ++c) {
      auto const i = static_cast<std::size_t>(c);
      // Two more beyond the box on each side, for slender bodies. A length of whole spacings but for rounding is one.
      constexpr double fits = 1e-3;
      count_[i] = static_cast<Index>(std::ceil((box.max[c] - box.min[c]) / spacing - fits)) + 4;
      first_[i] = 0.5 * (box.min[c] + box.max[c]) - 0.5 * (count_[i] - 1) * spacing;
    }
  }

  std::vector<Point> deepest(std::size_t wanted) const {
    Index const rows = count_[1] * count_[2];
    std::vector<std::vector<std::pair<double, Point>>> found(static_cast<std::size_t>(rows));
    exec_host::parallel_for_chunks(rows, rows * count_[0],
                                   [&](Index row) { find_row(row, found[static_cast<std::size_t>(row)]); });
    std::vector<std::pair<double, Point>> all;
    for (auto const& row : found) all.insert(all.end(), row.begin(), row.end());
    std::vector<std::size_t> order(all.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::vector<std::pair<double, double>> keys;
    for (std::size_t i = 0; i < all.size(); ++i) keys.push_back(rank_of(all[i].first, i));
    std::stable_sort(order.begin(), order.end(), [&](auto a, auto b) { return keys[a] < keys[b]; });
    order.resize(std::min(wanted, order.size()));
    std::sort(order.begin(), order.end());
    std::vector<Point> X;
    X.reserve(order.size());
    for (auto const i : order) X.push_back(all[i].second);
    return X;
  }

 private:
  /// Places whose depths differ by less than a hundredth of a spacing are ties, e.g. a whole row in a bar. Any subset
  /// of them is spread evenly over the body by the fractional parts of i times the golden section. Otherwise one end
  /// would be denser, and the sweeps do not move particles that far.
  std::pair<double, double> rank_of(double phi, std::size_t i) const {
    constexpr double golden = 0.6180339887498949, steps = 100, aside = 0.37;
    double whole = 0;
    return {std::floor(std::max(phi / spacing_, -1e6) * steps + aside),
            std::modf(golden * static_cast<double>(i), &whole)};
  }

  void find_row(Index row, std::vector<std::pair<double, Point>>& found) const {
    std::array<Index, 3> at{0, row % count_[1], row / count_[1]};
    double far = 0;  // how far along the row the last distance still holds
    bool inside = false;
    for (; at[0] < count_[0]; ++at[0]) {
      Point X{};
      for (std::size_t c = 0; c < static_cast<std::size_t>(solid_.dimension()); ++c)
        X[c] = first_[c] + at[c] * spacing_;
      far -= spacing_;
      double phi = inside ? -1e30 : 1e30;
      if (!(far > 0 && solid_.distance_is_bound())) {
        phi = solid_.at(vector_of(X)).distance;
        far = std::abs(phi) - 3 * spacing_;
        inside = phi < 0;
      }
      if (far > 0 && solid_.distance_is_bound()) phi = inside ? -1e30 : 1e30;
      if (phi < 1.5 * spacing_) found.emplace_back(phi, X);
    }
  }
  Solid const& solid_;
  double spacing_;
  std::array<Index, 3> count_{1, 1, 1};
  Point first_{};
};

class Packer {
 public:
  Packer(Solid const& solid, double volume, std::vector<Point> X)
      : solid_(solid), D_(solid.dimension()), X_(std::move(X)) {
    out_.volume = volume / static_cast<double>(X_.size());
    spacing_ = out_.spacing = std::pow(out_.volume, 1.0 / D_);
    reach_ = support * spacing_;
    // The kernel's slope is sigma/H^2 times slope_over_q times the distance.
    double const H = reach_;
    sigma_ = D_ == 3 ? 21 / (2 * std::numbers::pi * H * H * H) : 7 / (std::numbers::pi * H * H);
    std::vector<SurfacePiece> pieces;
    solid.cut_surface(piece_edge * spacing_, pieces);
    pieces_ = merged(pieces, piece_edge * spacing_);
    away_.assign(X_.size(), 0);
    known_at_ = X_;
  }

  Packing run(PackingOptions const& options) {
    std::vector<Point> at_piece;
    for (SurfacePiece const& piece : pieces_) at_piece.push_back(array_of(piece.X));
    CellGrid const surface(at_piece, reach_);
    while (out_.sweeps < options.sweeps) {
      if (out_.sweeps % sweeps_per_list == 0) listed_ = X_;
      if (begin_.empty() || out_.sweeps % sweeps_per_list == 0) find_lists();
      double const most = sweep(surface);
      ++out_.sweeps;
      bool const stopped = options.progress && !options.progress(out_.sweeps);
      if (most < still * spacing_) break;
      if (!stopped) continue;
      if (out_.sweeps < options.sweeps) out_.unfinished = {X_, listed_, known_at_, away_, out_.sweeps};
      break;
    }
    out_.X = X_;
    return std::move(out_);
  }
  void continue_from(UnfinishedPacking const& before) {
    listed_ = before.listed;
    known_at_ = before.known_at;
    away_ = before.away;
    out_.sweeps = before.sweeps;
  }

 private:
  Index size() const { return static_cast<Index>(X_.size()); }

  void find_lists() {
    double const far = (support + skin) * spacing_;
    CellGrid const grid(listed_, far);
    auto const each = [&](Index a, auto const& f) {
      Point const& x = listed_[static_cast<std::size_t>(a)];
      grid.visit(x, [&](Index b) {
        Vec<3> const r = vector_of(listed_[static_cast<std::size_t>(b)]) - vector_of(x);
        if (b != a && dot(r, r) < far * far) f(b);
      });
    };
    begin_.assign(X_.size() + 1, 0);
    exec_host::parallel_for(size(),
                            [&](Index a) { each(a, [&](Index) { ++begin_[static_cast<std::size_t>(a) + 1]; }); });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    neighbour_.resize(static_cast<std::size_t>(begin_.back()));
    exec_host::parallel_for(size(), [&](Index a) {
      auto at = static_cast<std::size_t>(begin_[static_cast<std::size_t>(a)]);
      each(a, [&](Index b) { neighbour_[at++] = b; });
    });
  }

  double sweep(CellGrid const& surface) {
    next_.resize(X_.size());
    moved_.resize(X_.size());
    exec_host::parallel_for(size(), [&](Index a) {
      auto const i = static_cast<std::size_t>(a);
      Vec<3> const x = vector_of(X_[i]);
      Vec<3> y = x + step_of(a, surface);
      y = pushed_inside(i, y);
      next_[i] = array_of(y);
      moved_[i] = dot(y - x, y - x);
    });
    X_.swap(next_);
    double const most = *std::max_element(moved_.begin(), moved_.end());
    return std::sqrt(most);
  }

  Vec<3> step_of(Index a, CellGrid const& surface) const {
    auto const i = static_cast<std::size_t>(a);
    Vec<3> const x = vector_of(X_[i]);
    Vec<3> sum;
    for (auto p = begin_[i]; p < begin_[i + 1]; ++p) {
      Vec<3> const r = x - vector_of(X_[static_cast<std::size_t>(neighbour_[static_cast<std::size_t>(p)])]);
      double const q = std::sqrt(dot(r, r)) / reach_;
      sum = sum + (out_.volume * slope_over_q(q) / (reach_ * reach_)) * r;
    }
    if (away(i, x) < reach_) {
      // The gradient of the kernel integrated over the outside, by Gauss.
      surface.visit(X_[i], [&](Index k) {
        SurfacePiece const& piece = pieces_[static_cast<std::size_t>(k)];
        Vec<3> const r = x - piece.X;
        double const square = dot(r, r);
        if (square < reach_ * reach_) sum = sum + shape_of_kernel(std::sqrt(square) / reach_) * piece.area;
      });
    }
    Vec<3> const step = (-pace * spacing_ * spacing_ * sigma_) * sum;
    double const length = std::sqrt(dot(step, step)), most = largest_move * spacing_;
    return length > most ? (most / length) * step : step;
  }

  /// At least so far from the surface.
  double away(std::size_t i, Vec<3> const& x) const {
    Vec<3> const r = x - vector_of(known_at_[i]);
    return away_[i] - std::sqrt(dot(r, r));
  }

  Vec<3> pushed_inside(std::size_t i, Vec<3> x) {
    if (away(i, x) > depth * spacing_) return x;
    for (int turn = 0; turn < pushes; ++turn) {
      Foot const foot = solid_.at(x);
      away_[i] = solid_.distance_is_bound() ? -foot.distance : std::min(-foot.distance, 2 * spacing_);
      known_at_[i] = array_of(x);
      double const out = foot.distance + depth * spacing_;
      if (out <= 1e-6 * spacing_) return x;
      x = x - out * foot.normal;
    }
    away_[i] = 0;
    return x;
  }

  Solid const& solid_;
  int D_;
  std::vector<Point> X_, next_;
  std::vector<Point> listed_;  ///< places of the lists
  std::vector<double> moved_;
  std::vector<Point> known_at_;  ///< where the surface was last asked for
  std::vector<double> away_;     ///< and how far it was at least
  std::vector<SurfacePiece> pieces_;
  std::vector<std::int64_t> begin_;
  std::vector<Index> neighbour_;
  Packing out_;
  double spacing_ = 0, reach_ = 0, sigma_ = 0;
};

double nearest_of(CellGrid const& grid, std::vector<Point> const& X, Point const& x, Index self) {
  double least = 1e300;
  grid.visit(x, [&](Index b) {
    if (b == self) return;
    Vec<3> const r = vector_of(X[static_cast<std::size_t>(b)]) - vector_of(x);
    least = std::min(least, dot(r, r));
  });
  return std::sqrt(least);
}

}  // namespace

double packed_count(double volume, double spacing, int dimension) {
  return std::max(1.0, std::round(volume / std::pow(spacing, dimension)));
}

Packing pack(Solid const& solid, double volume, double spacing, PackingOptions const& options) {
  PIOLA_EXPECTS(volume > 0 && std::isfinite(volume));
  PIOLA_EXPECTS(spacing > 0 && std::isfinite(spacing));
  PIOLA_EXPECTS(options.sweeps >= 0);
  PIOLA_EXPECTS(!options.from || options.from->listed.size() == options.from->X.size());
  PIOLA_EXPECTS(!options.from || options.from->known_at.size() == options.from->X.size());
  PIOLA_EXPECTS(!options.from || options.from->away.size() == options.from->X.size());
  if (options.from) {
    Packer packer(solid, volume, options.from->X);
    packer.continue_from(*options.from);
    return packer.run(options);
  }
  auto const wanted = static_cast<std::size_t>(packed_count(volume, spacing, solid.dimension()));
  return Packer(solid, volume, Start(solid, spacing).deepest(wanted)).run(options);
}

PackingQuality quality_of(Solid const& solid, Packing const& packing) {
  PIOLA_EXPECTS(packing.spacing > 0);
  PackingQuality q;
  q.nearest_least = 1e300;
  CellGrid const grid(packing.X, 1.5 * packing.spacing);
  std::size_t outer = 0, placed = 0;
  for (std::size_t a = 0; a < packing.X.size(); ++a) {
    double const near = nearest_of(grid, packing.X, packing.X[a], static_cast<Index>(a)) / packing.spacing;
    q.nearest_least = std::min(q.nearest_least, near);
    q.nearest_mean += near / static_cast<double>(packing.X.size());
    double const phi = solid.at(vector_of(packing.X[a])).distance / packing.spacing;
    if (phi <= -0.9) continue;
    ++outer;
    placed += std::abs(phi + depth) < 0.02 ? 1 : 0;
  }
  q.in_place = outer > 0 ? static_cast<double>(placed) / static_cast<double>(outer) : 0;
  std::vector<SurfacePiece> pieces;
  solid.cut_surface(0.5 * packing.spacing, pieces);
  for (SurfacePiece const& piece : pieces)
    q.gap = std::max(q.gap, nearest_of(grid, packing.X, array_of(piece.X), -1) / packing.spacing);
  return q;
}

}  // namespace piola::geometry
