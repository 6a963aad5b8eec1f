// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/closure.hpp"
#include "piola/math/solve.hpp"
#include <array>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr int most_iterations = 2000;

/// Monomials with the constant in front.
template <int D>
std::array<double, static_cast<std::size_t>(Quadratic<D>::values)> with_constant(Fits<D> const& fits, std::size_t a,
                                                                                 std::size_t b) {
  auto const p = fits.monomials_of(a, b);
  std::array<double, static_cast<std::size_t>(Quadratic<D>::values)> r{1};
  std::copy(p.begin(), p.end(), r.begin() + 1);
  return r;
}

/// Where the moments of a patch or a cell (XX YY ZZ YZ XZ XY) are for second derivative `at` of D dimensions.
template <int D>
constexpr std::size_t moment(int at) {
  return D == 2 && at == 2 ? 5 : static_cast<std::size_t>(at);
}

/// Sums over particles, one per column.
template <int D>
using Columns = std::array<double, static_cast<std::size_t>(D)>;

template <int D>
Columns<D> products(std::vector<double> const& u, std::vector<double> const& v) {
  Columns<D> sum{};
  for (std::size_t k = 0; k < u.size(); ++k) sum[k % static_cast<std::size_t>(D)] += u[k] * v[k];
  return sum;
}

}  // namespace

template <int D>
Divergence<D>::Divergence(Fits<D> const& fits, std::vector<ScaledCell> const& cells,
                          std::vector<SurfacePatch> const& patches)
    : fits_(fits), cells_(cells), patches_(patches) {
  make_projectors();
}

template <int D>
std::vector<double> Divergence<D>::shares(std::function<double(SurfacePatch const&)> const& weight) const {
  std::vector<double> share(fits_.X().size(), 0);
  for (auto const& patch : patches_) {
    double const counts = weight(patch);
    if (counts == 0) continue;
    auto const a = static_cast<std::size_t>(patch.particle);
    share[a] += counts * patch.area;
    for (std::size_t k = fits_.pairs().first(a); k < fits_.pairs().end(a); ++k) {
      auto const e = fits_.derivatives(a, k);
      double moved = 0;
      for (int i = 0; i < D; ++i) moved += patch.first[static_cast<std::size_t>(i)] * e[static_cast<std::size_t>(i)];
      for (int m = 0; m < Quadratic<D>::second; ++m)
        moved += patch.second[moment<D>(m)] * e[static_cast<std::size_t>(D + m)];
      moved *= counts;
      share[fits_.pairs().at(k)] += moved;
      share[a] -= moved;
    }
  }
  return share;
}

template <int D>
std::vector<double> Divergence<D>::surface_vectors() const {
  std::vector<double> A(fits_.X().size() * D, 0);
  for (int axis = 0; axis < D; ++axis)
    for (bool const upper : {false, true}) {
      auto const share = shares([&](SurfacePatch const& p) { return p.axis == axis && p.upper == upper ? 1.0 : 0.0; });
      for (std::size_t b = 0; b < share.size(); ++b)
        A[b * D + static_cast<std::size_t>(axis)] += upper ? share[b] : -share[b];
    }
  return A;
}

template <int D>
std::vector<double> Divergence<D>::residual() const {
  auto R = surface_vectors();
  auto const& pairs = fits_.pairs();
  for (std::size_t a = 0; a < cells_.size(); ++a)
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const e = fits_.derivatives(a, k);
      for (int J = 0; J < D; ++J) {
        double const G = cells_[a].volume * at_centroid<D>(e, cells_[a], J);
        R[pairs.at(k) * D + static_cast<std::size_t>(J)] -= G;
        R[a * D + static_cast<std::size_t>(J)] += G;
      }
    }
  return R;
}

template <int D>
void Divergence<D>::make_projectors() {
  auto const& pairs = fits_.pairs();
  constexpr auto size = static_cast<std::size_t>(values * values);
  projector_.resize(cells_.size() * size);
  diagonal_.assign(cells_.size(), 0);
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    double A[values * values]{}, inverse[values * values];
    A[0] = fits_.own_weight(a);
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = with_constant<D>(fits_, a, pairs.at(k));
      for (std::size_t i = 0; i < values; ++i)
        for (std::size_t j = 0; j < values; ++j) A[i * values + j] += pairs.weight[k] * p[i] * p[j];
    }
    invert<values>(A, inverse);
    std::copy(inverse, inverse + size, projector_.begin() + static_cast<std::ptrdiff_t>(a * size));
    double const V = cells_[a].volume, own = fits_.own_weight(a);
    diagonal_[a] += V * own * (1 - own * inverse[0]);
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = with_constant<D>(fits_, a, pairs.at(k));
      double reach = 0;
      for (std::size_t i = 0; i < values; ++i)
        for (std::size_t j = 0; j < values; ++j) reach += p[i] * inverse[i * values + j] * p[j];
      diagonal_[pairs.at(k)] += V * pairs.weight[k] * (1 - pairs.weight[k] * reach);
    }
  }
}

/// The least-squares quadratics through mu.
template <int D>
void Divergence<D>::expand(std::vector<double> const& mu, std::vector<double>& coefficients) const {
  auto const& pairs = fits_.pairs();
  for (std::size_t a = 0; a < cells_.size(); ++a) {
    double sum[values][D]{};
    for (int J = 0; J < D; ++J) sum[0][J] = fits_.own_weight(a) * mu[a * D + static_cast<std::size_t>(J)];
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = with_constant<D>(fits_, a, pairs.at(k));
      for (int J = 0; J < D; ++J) {
        double const weighted = pairs.weight[k] * mu[pairs.at(k) * D + static_cast<std::size_t>(J)];
        for (int i = 0; i < values; ++i) sum[i][J] += weighted * p[static_cast<std::size_t>(i)];
      }
    }
    double const* const inverse = &projector_[a * static_cast<std::size_t>(values * values)];
    double* const c = &coefficients[a * static_cast<std::size_t>(values * D)];
    for (int i = 0; i < values; ++i)
      for (int J = 0; J < D; ++J) {
        c[i * D + J] = 0;
        for (int j = 0; j < values; ++j) c[i * D + J] += inverse[i * values + j] * sum[j][J];
      }
  }
}

/// result_b = sum_a w_ab (mu_b - (quadratic of a)(X_b)), b = a included.
template <int D>
void Divergence<D>::apply(std::vector<double> const& mu, std::vector<double>& coefficients,
                          std::vector<double>& result) const {
  expand(mu, coefficients);
  auto const& pairs = fits_.pairs();
  for (std::size_t b = 0; b < cells_.size(); ++b) {
    double sum[D];
    for (int J = 0; J < D; ++J) {
      auto const at = static_cast<std::size_t>(J);
      sum[J] = fits_.own_weight(b) * cells_[b].volume *
               (mu[b * D + at] - coefficients[b * static_cast<std::size_t>(values * D) + at]);
    }
    for (std::size_t k = pairs.first(b); k < pairs.end(b); ++k) {
      std::size_t const a = pairs.at(k);
      auto const p = with_constant<D>(fits_, a, b);
      double const w = pairs.weight[k] * cells_[a].volume;
      double const* const c = &coefficients[a * static_cast<std::size_t>(values * D)];
      for (int J = 0; J < D; ++J) {
        double value = mu[b * D + static_cast<std::size_t>(J)];
        for (int i = 0; i < values; ++i) value -= p[static_cast<std::size_t>(i)] * c[i * D + J];
        sum[J] += w * value;
      }
    }
    for (int J = 0; J < D; ++J) result[b * D + static_cast<std::size_t>(J)] = sum[J];
  }
}

template <int D>
Closure Divergence<D>::solve(double tolerance) const {
  std::vector<double> r = residual(), z(r.size()), p(r.size(), 0), image(r.size());
  Closure closure{std::vector<double>(r.size(), 0), std::vector<double>(cells_.size() * values * D, 0)};
  auto const goal = products<D>(r, r);
  Columns<D> before{};
  for (closure.iterations = 0; closure.iterations < most_iterations; ++closure.iterations) {
    auto const now = products<D>(r, r);
    bool done = true;
    for (std::size_t J = 0; J < D; ++J) done = done && now[J] <= tolerance * tolerance * goal[J];
    if (done) break;
    for (std::size_t k = 0; k < r.size(); ++k) z[k] = r[k] / diagonal_[k / D];
    auto const rz = products<D>(r, z);
    for (std::size_t k = 0; k < p.size(); ++k) p[k] = z[k] + (before[k % D] > 0 ? rz[k % D] / before[k % D] : 0) * p[k];
    before = rz;
    apply(p, closure.coefficients, image);
    auto const curvature = products<D>(p, image);
    for (std::size_t k = 0; k < p.size(); ++k) {
      double const step = curvature[k % D] > 0 ? rz[k % D] / curvature[k % D] : 0;
      closure.mu[k] += step * p[k];
      r[k] -= step * image[k];
    }
  }
  expand(closure.mu, closure.coefficients);
  return closure;
}

template class Divergence<1>;
template class Divergence<2>;
template class Divergence<3>;

}  // namespace piola::nodal
