// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/closure.hpp"
#include "piola/exec/set_up_loop.hpp"
#include "piola/formulations/nodal/projection_matrix.hpp"
#include "piola/formulations/nodal/spline_levels.hpp"
#include "piola/math/solve.hpp"
#include "piola/mechanics/modes.hpp"
#include <algorithm>
#include <array>
#include <cmath>

namespace piola::nodal {
namespace {

constexpr int most_iterations = 2000;
/// Of any component of a residual, in areas of a face between two particles: what a patch test may show in one force.
constexpr double most_left = 2e-3;
/// Fewer particles need no more iterations without the coarse levels of the preconditioner.
constexpr std::size_t worth_levels = 300;

/// Sums over particles, one per column.
template <int D>
using Columns = std::array<double, static_cast<std::size_t>(D)>;

template <int D>
Columns<D> products(std::vector<double> const& u, std::vector<double> const& v) {
  auto const sums = exec_host::sums_of<D>(static_cast<Index>(u.size() / D), [&](Index particle, double* sum) {
    std::size_t const first = static_cast<std::size_t>(particle) * D;
    for (std::size_t J = 0; J < D; ++J) sum[J] = u[first + J] * v[first + J];
  });
  Columns<D> result{};
  for (int J = 0; J < D; ++J) result[static_cast<std::size_t>(J)] = sums.value(J);
  return result;
}

/// Takes from every column the quadratic that fits it best. Quadratics change no gradient, but are large in solutions
/// and would cost digits.
template <int D>
void remove_quadratic(Points const& X, std::vector<double>& u) {
  constexpr int values = Quadratic<D>::values;
  Vec<D> middle, scale;
  for (int c = 0; c < D; ++c) {
    auto const at = static_cast<std::size_t>(c);
    auto const [low, high] =
        std::minmax_element(X.begin(), X.end(), [at](auto const& p, auto const& q) { return p[at] < q[at]; });
    middle[c] = 0.5 * ((*low)[at] + (*high)[at]);
    scale[c] = 2 / ((*high)[at] - (*low)[at]);
  }
  auto const monomials_at = [&](std::size_t a, double(&p)[values]) {
    Vec<D> r;
    for (int c = 0; c < D; ++c) r[c] = scale[c] * (X[a][static_cast<std::size_t>(c)] - middle[c]);
    monomials<D>(r, p);
  };
  double A[values * values]{}, b[D][values]{}, p[values];
  for (std::size_t a = 0; a < X.size(); ++a) {
    monomials_at(a, p);
    for (int m = 0; m < values; ++m) {
      for (int n = 0; n < values; ++n) A[m * values + n] += p[m] * p[n];
      for (std::size_t J = 0; J < D; ++J) b[J][m] += p[m] * u[a * D + J];
    }
  }
  for (auto& column : b) {
    double copy[values * values];
    std::copy(std::begin(A), std::end(A), copy);
    solve_in_place<values>(copy, column);
  }
  exec_host::for_each_in_set_up(static_cast<Index>(X.size()), [&](Index particle) {
    auto const a = static_cast<std::size_t>(particle);
    double q[values];
    monomials_at(a, q);
    for (std::size_t J = 0; J < D; ++J)
      for (int m = 0; m < values; ++m) u[a * D + J] -= q[m] * b[J][m];
  });
}

/// One step of refinement of the quadratics: what they leave is orthogonal to quadratics to round-off then, however
/// badly neighbours determine them. Forces at rest vanish to that accuracy.
template <int D>
void refine(Fits<D> const& fits, ProjectionMatrix<D> const& matrix, Closure& closure) {
  constexpr auto values = static_cast<std::size_t>(Quadratic<D>::values);
  auto const& pairs = fits.pairs();
  exec_host::for_each_in_set_up(static_cast<Index>(fits.X().size()), [&](Index particle) {
    auto const a = static_cast<std::size_t>(particle);
    double* const c = &closure.coefficients[a * values * D];
    double left[D][values];
    for (std::size_t J = 0; J < D; ++J) {
      std::fill_n(left[J], values, 0.0);
      left[J][0] = fits.own_weight(a) * (closure.mu[a * D + J] - c[J]);
    }
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = fits.monomials_of(a, pairs.at(k));
      for (std::size_t J = 0; J < D; ++J) {
        double rest = closure.mu[pairs.at(k) * D + J] - c[J];
        for (std::size_t m = 1; m < values; ++m) rest -= c[m * D + J] * p[m - 1];
        rest *= pairs.weight[k];
        left[J][0] += rest;
        for (std::size_t m = 1; m < values; ++m) left[J][m] += rest * p[m - 1];
      }
    }
    for (std::size_t J = 0; J < D; ++J)
      for (std::size_t m = 0; m < values; ++m)
        for (std::size_t n = 0; n < values; ++n)
          c[m * D + J] += matrix.inverse(particle, static_cast<int>(m), static_cast<int>(n)) * left[J][n];
  });
}

/// The stiffness that coarse levels divide by, from the matrix itself.
template <int D>
void set_levels(ProjectionMatrix<D>& matrix, std::vector<ScaledCell> const& cells, SplineLevels<D>& levels) {
  // Measured: splines overlap, of one level and of several. Three times their own energy takes the fewest iterations.
  constexpr double overlap = 3;
  auto const probe = levels.probe();
  std::vector<double> image(probe.size());
  matrix.apply(probe, image);
  double volume = 0;
  for (auto const& cell : cells) volume += cell.volume;
  levels.set_stiffness(overlap * products<D>(probe, image)[0] / (volume * SplineLevels<D>::probe_square));
}

}  // namespace

template <int D>
Divergence<D>::Divergence(Fits<D> const& fits, std::vector<ScaledCell> const& cells,
                          std::vector<SurfacePatch> const& patches)
    : fits_(fits), cells_(cells), patches_(patches) {}

template <int D>
std::vector<double> Divergence<D>::shares(std::function<double(SurfacePatch const&)> const& weight) const {
  std::vector<double> share(fits_.X().size(), 0);
  for (auto const& patch : patches_) {
    double const counts = weight(patch);
    if (counts == 0) continue;
    each_share<D>(fits_, patch, [&](std::size_t b, double part) { share[b] += counts * part; });
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
  scatter_in_order(static_cast<Index>(cells_.size()), pairs.farthest(), [&](std::size_t a, auto const& mine) {
    double to_gradient[D][terms];  // of sums s p (f_b - f_a)
    for (int l = 0; l < terms; ++l) {
      typename Fits<D>::Monomials column;
      for (int i = 0; i < terms; ++i) column[static_cast<std::size_t>(i)] = fits_.inverse(a, i, l);
      for (int J = 0; J < D; ++J) to_gradient[J][l] = cells_[a].volume * at_centroid<D>(column, cells_[a], J);
    }
    bool const own = mine(a);
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      bool const other = mine(pairs.at(k));
      if (!own && !other) continue;
      auto const p = fits_.monomials_of(a, pairs.at(k));
      for (int J = 0; J < D; ++J) {
        double G = 0;
        for (int l = 0; l < terms; ++l) G += to_gradient[J][l] * p[static_cast<std::size_t>(l)];
        G *= pairs.weight[k];
        if (other) R[pairs.at(k) * D + static_cast<std::size_t>(J)] -= G;
        if (own) R[a * D + static_cast<std::size_t>(J)] += G;
      }
    }
  });
  return R;
}

template <int D>
Closure Divergence<D>::solve(double tolerance, Machine const& machine, LatticeLayout const* lattice,
                             Fold<D> const* fold) const {
  ProjectionMatrix<D> matrix(fits_, cells_, machine, lattice);
  std::vector<double> r = residual(), z(r.size()), p(r.size(), 0), image(r.size());
  Closure closure{std::vector<double>(r.size(), 0), {}};
  std::optional<SplineLevels<D>> levels;
  if (cells_.size() >= worth_levels) set_levels(matrix, cells_, levels.emplace(fits_.X()));
  // f(particle, number) for the D numbers of each particle.
  auto const each_particle = [&](auto const& f) {
    exec_host::for_each_in_set_up(static_cast<Index>(cells_.size()), [&](Index particle) {
      auto const a = static_cast<std::size_t>(particle);
      for (std::size_t J = 0; J < D; ++J) f(a, a * D + J);
    });
  };
  auto const inner = [fold](std::vector<double> const& u, std::vector<double> const& v) {
    return fold != nullptr ? fold->products(u, v) : products<D>(u, v);
  };
  auto const extend = [fold](std::vector<double>& u) {
    if (fold != nullptr) fold->extend(u);
  };
  extend(r);
  auto const goal = inner(r, r);
  Columns<D> before{};
  for (closure.iterations = 0; closure.iterations < most_iterations; ++closure.iterations) {
    auto const now = inner(r, r);
    bool done = true;
    for (std::size_t J = 0; J < D; ++J) done = done && now[J] <= tolerance * tolerance * goal[J];
    if (done && largest_of(r) <= most_left) break;
    each_particle([&](std::size_t a, std::size_t k) { z[k] = r[k] / matrix.diagonal()[a]; });
    if (levels) levels->add(r, z);
    if (fold != nullptr) fold->gather(z);
    auto const rz = inner(r, z);
    each_particle(
        [&](std::size_t, std::size_t k) { p[k] = z[k] + (before[k % D] > 0 ? rz[k % D] / before[k % D] : 0) * p[k]; });
    before = rz;
    matrix.apply(p, image);
    extend(image);
    auto const curvature = inner(p, image);
    each_particle([&](std::size_t, std::size_t k) {
      double const step = curvature[k % D] > 0 ? rz[k % D] / curvature[k % D] : 0;
      closure.mu[k] += step * p[k];
      r[k] -= step * image[k];
    });
  }
  if (fold == nullptr || !fold->endless()) remove_quadratic<D>(fits_.X(), closure.mu);
  extend(closure.mu);
  matrix.apply(closure.mu, image);
  closure.coefficients = matrix.coefficients();
  refine<D>(fits_, matrix, closure);
  return closure;
}

template class Divergence<1>;
template class Divergence<2>;
template class Divergence<3>;

}  // namespace piola::nodal
