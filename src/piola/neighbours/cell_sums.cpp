// SPDX-License-Identifier: Apache-2.0
#include "piola/neighbours/cell_sums.hpp"
#include "piola/base/contracts.hpp"
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace piola {
namespace {

using Point = BlockSide::Point;

constexpr std::array<std::size_t, 3> mixed_first{1, 0, 0}, mixed_second{2, 2, 1};  // YZ XZ XY

/// Gauss points of an interval [0, 1].
struct GaussPoints {
  int count;
  std::array<double, 3> at, weight;
};
GaussPoints const two_points{2, {0.5 - 0.5 / std::sqrt(3.0), 0.5 + 0.5 / std::sqrt(3.0)}, {0.5, 0.5}};
GaussPoints const three_points{
    3, {0.5 - 0.5 * std::sqrt(0.6), 0.5, 0.5 + 0.5 * std::sqrt(0.6)}, {5.0 / 18, 8.0 / 18, 5.0 / 18}};

/// Calls f(X, N dA) at the points of a quadrature that is exact for cubic fields; quartic: and for those of fourth
/// degree in 2D. N points along the axis.
template <class F>
void integrate(BlockSide const& side, std::size_t D, bool quartic, F const& f) {
  auto const& P = side.corner;
  if (D == 1) return f(P[0], Point{1, 0, 0});
  // N dA of a bilinear piece is linear in both directions, so that the integrand is of fourth degree.
  GaussPoints const& points = (D == 2 ? !quartic : side.flat) ? two_points : three_points;
  auto const n = static_cast<std::size_t>(points.count);
  if (D == 2) {
    double const sign = side.axis == 0 ? 1 : -1;
    for (std::size_t q = 0; q < n; ++q) {
      Point X{};
      for (std::size_t c = 0; c < 2; ++c) X[c] = P[0][c] + points.at[q] * (P[1][c] - P[0][c]);
      f(X, Point{sign * points.weight[q] * (P[1][1] - P[0][1]), -sign * points.weight[q] * (P[1][0] - P[0][0]), 0});
    }
    return;
  }
  for (std::size_t p = 0; p < n; ++p)
    for (std::size_t q = 0; q < n; ++q) {
      double const u = points.at[p], v = points.at[q], weight = points.weight[p] * points.weight[q];
      Point X{}, du{}, dv{};
      for (std::size_t c = 0; c < 3; ++c) {
        X[c] = (1 - v) * ((1 - u) * P[0][c] + u * P[1][c]) + v * ((1 - u) * P[3][c] + u * P[2][c]);
        du[c] = (1 - v) * (P[1][c] - P[0][c]) + v * (P[2][c] - P[3][c]);
        dv[c] = (1 - u) * (P[3][c] - P[0][c]) + u * (P[2][c] - P[1][c]);
      }
      f(X, Point{weight * (du[1] * dv[2] - du[2] * dv[1]), weight * (du[2] * dv[0] - du[0] * dv[2]),
                 weight * (du[0] * dv[1] - du[1] * dv[0])});
    }
}

/// The monomials of NormalMoments.
std::array<double, 10> monomials_of(Point const& r) {
  return {1,           r[0],        r[1],       r[2], 0.5 * r[0] * r[0], 0.5 * r[1] * r[1], 0.5 * r[2] * r[2],
          r[1] * r[2], r[0] * r[2], r[0] * r[1]};
}

void add_moments(NormalMoments& sum, std::array<double, 10> const& p, Point const& N, double sign) {
  for (std::size_t J = 0; J < 3; ++J)
    for (std::size_t m = 0; m < p.size(); ++m) sum[J][m] += sign * N[J] * p[m];
}

}  // namespace

BlockSide::Point BlockSide::middle(std::size_t D) const {
  Point X{};
  for (std::size_t k = 0; k < corners(D); ++k)
    for (std::size_t c = 0; c < D; ++c) X[c] += corner[k][c] / static_cast<double>(corners(D));
  return X;
}

CellSums::CellSums(int dimension, bool axisymmetric, std::span<Point const> X,
                   std::function<bool(std::size_t)> wants_facets)
    : D_(static_cast<std::size_t>(dimension)),
      axisymmetric_(axisymmetric),
      X_(X),
      wants_facets_(std::move(wants_facets)),
      patches_(X.size()) {
  PIOLA_EXPECTS(dimension >= 1 && dimension <= 3);
  PIOLA_EXPECTS(dimension == 2 || !axisymmetric);
  cells_.cell.resize(X.size());
  if (axisymmetric_) cells_.section.resize(X.size());
  if (wants_facets_) facets_.resize(X.size());
}

void CellSums::add_facet(std::size_t lower, std::size_t upper, BlockSide const& side) {
  CellFacet* const sum = wants_facet(lower, upper) ? &facet(std::min(lower, upper), std::max(lower, upper)) : nullptr;
  double const sign = lower < upper ? 1 : -1;
  Point middle{};
  for (std::size_t c = 0; c < D_; ++c) middle[c] = 0.5 * (X_[lower][c] + X_[upper][c]);
  integrate(side, D_, axisymmetric_, [&](Point const& X, Point const& N) {
    add_to_cell(lower, X, N, 1);
    add_to_cell(upper, X, N, -1);
    if (sum != nullptr) add_moments(sum->moments, monomials_of(from(middle, X)), N, sign * weight(X));
  });
}

void CellSums::add_surface(SurfacePatch const& like, BlockSide const& side) {
  auto const a = static_cast<std::size_t>(like.particle);
  SurfacePatch& sum = patch(like);
  double const sign = like.upper ? 1 : -1;
  integrate(side, D_, axisymmetric_, [&](Point const& X, Point const& N) {
    auto const p = monomials_of(from(X_[a], X));
    add_moments(sum.moments, p, N, sign * weight(X));
    double const size = weight(X) * std::sqrt(N[0] * N[0] + N[1] * N[1] + N[2] * N[2]);
    for (std::size_t m = 0; m < p.size(); ++m) sum.extent[m] += size * p[m];
    add_to_cell(a, X, N, sign);
  });
}

BodyCells CellSums::finish() {
  if (axisymmetric_) finish_rings();
  for (auto& cell : cells_.cell) {
    if (!(cell.volume > 0)) continue;
    for (double& c : cell.centroid) c /= cell.volume;
    for (double& m : cell.spread) m /= cell.volume;
    for (std::size_t c = 0; c < 3; ++c) cell.spread[c] -= cell.centroid[c] * cell.centroid[c];
    for (std::size_t m = 0; m < 3; ++m)
      cell.spread[3 + m] -= cell.centroid[mixed_first[m]] * cell.centroid[mixed_second[m]];
  }
  return std::move(cells_);
}

Point CellSums::from(Point const& origin, Point const& X) const {
  Point r{};
  for (std::size_t c = 0; c < D_; ++c) r[c] = X[c] - origin[c];
  return r;
}

/// Moments of rings from those of their cross-sections: the weight is the radius.
void CellSums::finish_rings() {
  for (std::size_t a = 0; a < X_.size(); ++a) {
    auto const of = [&](int i, int j) {
      auto const& section = cells_.section[a].of;
      return X_[a][0] * section[SectionMoments::at(i, j)] + section[SectionMoments::at(i + 1, j)];
    };
    auto& cell = cells_.cell[a];
    cell.volume = of(0, 0);
    cell.centroid = {of(1, 0), of(0, 1), 0};
    cell.spread = {of(2, 0), of(0, 2), 0, 0, 0, of(1, 1)};
  }
}

/// Volume integrals as surface integrals, averaged over the components of the field that has the integrand as its
/// divergence.
void CellSums::add_to_cell(std::size_t a, Point const& X, Point const& N, double sign) {
  Point const r = from(X_[a], X);
  if (axisymmetric_) return add_to_section(a, r, N, sign);
  auto& cell = cells_.cell[a];
  for (std::size_t c = 0; c < D_; ++c) {
    double const flux = sign * N[c] * r[c];
    cell.volume += flux / static_cast<double>(D_);
    cell.centroid[c] += flux * r[c] / 2;
    cell.spread[c] += flux * r[c] * r[c] / 3;
  }
  for (std::size_t m = 0; m < 3; ++m) {
    std::size_t const c = mixed_first[m], d = mixed_second[m];
    cell.spread[3 + m] += sign * (N[c] * r[c] + N[d] * r[d]) * r[c] * r[d] / 4;
  }
}

/// Area integrals as fluxes along the axis.
void CellSums::add_to_section(std::size_t a, Point const& r, Point const& N, double sign) {
  auto const power = [](double x, int n) {
    double product = 1;
    for (int k = 0; k < n; ++k) product *= x;
    return product;
  };
  for (std::size_t m = 0; m < SectionMoments::powers.size(); ++m) {
    auto const [i, j] = SectionMoments::powers[m];
    cells_.section[a].of[m] += 2 * std::numbers::pi * sign * N[1] * power(r[0], i) * power(r[1], j + 1) / (j + 1);
  }
}

SurfacePatch& CellSums::patch(SurfacePatch const& like) {
  auto& own = patches_[static_cast<std::size_t>(like.particle)];
  for (Index const known : own) {
    auto& p = cells_.patch[static_cast<std::size_t>(known)];
    if (p.patch == like.patch &&
        (p.patch >= 0 || (p.axis == like.axis && p.upper == like.upper && p.outermost == like.outermost)))
      return p;
  }
  own.push_back(static_cast<Index>(cells_.patch.size()));
  return cells_.patch.emplace_back(like);
}

CellFacet& CellSums::facet(std::size_t a, std::size_t b) {
  for (Index const known : facets_[a])
    if (auto& f = cells_.facet[static_cast<std::size_t>(known)]; f.b == static_cast<Index>(b)) return f;
  facets_[a].push_back(static_cast<Index>(cells_.facet.size()));
  return cells_.facet.emplace_back(CellFacet{static_cast<Index>(a), static_cast<Index>(b), {}});
}

}  // namespace piola
