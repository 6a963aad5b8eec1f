// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/integration_constraint.hpp"
#include "piola/domain/sum_over_slots.hpp"
#include "piola/exec/host_loops.hpp"
#include "piola/formulations/nodal/projection_matrix.hpp"
#include "piola/formulations/nodal/spline_levels.hpp"
#include "piola/math/solve.hpp"
#include "piola/mechanics/step_limit_modes.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace piola::nodal {
namespace {

constexpr int most_iterations = 2000;
/// Limit of any component of a residual, in areas of a face between two particles: the error of one force in a patch
/// test.
constexpr double most_left = 2e-3;
/// Fewer particles need no more iterations without the coarse levels of the preconditioner.
constexpr std::size_t worth_levels = 300;

/// Sums over particles, one per column.
template <int D>
using Columns = std::array<double, static_cast<std::size_t>(D)>;

template <int D>
Columns<D> products(LocalFits<D> const& fits, LazyZeroArray<double> const& u, LazyZeroArray<double> const& v) {
  auto const sums = sums_over_slots<D>(fits.shared().has_value(), fits.own(), [&](Index particle, double* sum) {
    std::size_t const first = static_cast<std::size_t>(particle) * D;
    for (std::size_t J = 0; J < D; ++J) sum[J] = u[first + J] * v[first + J];
  });
  Columns<D> result{};
  for (int J = 0; J < D; ++J) result[static_cast<std::size_t>(J)] = sums.value(J);
  return result;
}

/// Monomials in the box around all points.
template <int D>
class BoxMonomials {
 public:
  static constexpr int values = Quadratic<D>::values;
  explicit BoxMonomials(Points const& X) : X_(X) {
    for (int c = 0; c < D; ++c) {
      auto const at = static_cast<std::size_t>(c);
      auto const [low, high] =
          std::minmax_element(X.begin(), X.end(), [at](auto const& p, auto const& q) { return p[at] < q[at]; });
      middle_[c] = 0.5 * ((*low)[at] + (*high)[at]);
      scale_[c] = 2 / ((*high)[at] - (*low)[at]);
    }
  }
  void operator()(std::size_t a, double (&p)[values]) const {
    Vec<D> r;
    for (int c = 0; c < D; ++c) r[c] = scale_[c] * (X_[a][static_cast<std::size_t>(c)] - middle_[c]);
    monomials<D>(r, p);
  }

 private:
  Points const& X_;
  Vec<D> middle_, scale_;
};

/// Takes from every column the quadratic that fits it best. Quadratics change no gradient, but are large in solutions
/// and would cost digits.
template <int D>
void remove_quadratic(LocalFits<D> const& fits, LazyZeroArray<double>& u) {
  constexpr int values = Quadratic<D>::values, all = values * (values + D);
  BoxMonomials<D> const monomials_at(fits.X());
  // Products of the monomials, then those with each column.
  auto const sums = sums_over_slots<all>(fits.shared().has_value(), fits.own(), [&](Index particle, double* sum) {
    auto const a = static_cast<std::size_t>(particle);
    double p[values];
    monomials_at(a, p);
    for (int m = 0; m < values; ++m) {
      for (int n = 0; n < values; ++n) sum[m * values + n] = p[m] * p[n];
      for (std::size_t J = 0; J < D; ++J) sum[(values + J) * values + m] = p[m] * u[a * D + J];
    }
  });
  double b[D][values];
  for (int J = 0; J < D; ++J) {
    double A[values * values];
    for (int k = 0; k < values * values; ++k) A[k] = sums.value(k);
    for (int m = 0; m < values; ++m) b[J][m] = sums.value((values + J) * values + m);
    solve_in_place<values>(A, b[J]);
  }
  exec_host::parallel_for(fits.own(), [&](Index particle) {
    auto const a = static_cast<std::size_t>(particle);
    double q[values];
    monomials_at(a, q);
    for (std::size_t J = 0; J < D; ++J)
      for (int m = 0; m < values; ++m) u[a * D + J] -= q[m] * b[J][m];
  });
}

/// One step of refinement of the quadratics: their residual is then orthogonal to quadratics to round-off, even for
/// badly conditioned neighbourhoods. Forces at rest vanish to that accuracy.
template <int D>
void refine(LocalFits<D> const& fits, ProjectionMatrix<D> const& matrix,
            IntegrationCorrection& integration_correction) {
  constexpr auto values = static_cast<std::size_t>(Quadratic<D>::values);
  auto const& pairs = fits.pairs();
  exec_host::parallel_for(fits.own(), [&](Index particle) {
    auto const a = static_cast<std::size_t>(particle);
    auto const c = [&](std::size_t k) -> double& {
      return integration_correction.coefficients->at(particle, static_cast<int>(k));
    };
    double left[D][values];
    for (std::size_t J = 0; J < D; ++J) {
      std::fill_n(left[J], values, 0.0);
      left[J][0] = fits.own_weight(a) * (integration_correction.mu[a * D + J] - c(J));
    }
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      auto const p = fits.monomials_of(a, pairs.at(k));
      for (std::size_t J = 0; J < D; ++J) {
        double rest = integration_correction.mu[pairs.at(k) * D + J] - c(J);
        for (std::size_t m = 1; m < values; ++m) rest -= c(m * D + J) * p[m - 1];
        rest *= pairs.weight[k];
        left[J][0] += rest;
        for (std::size_t m = 1; m < values; ++m) left[J][m] += rest * p[m - 1];
      }
    }
    for (std::size_t J = 0; J < D; ++J)
      for (std::size_t m = 0; m < values; ++m)
        for (std::size_t n = 0; n < values; ++n)
          c(m * D + J) += matrix.inverse(particle, static_cast<int>(m), static_cast<int>(n)) * left[J][n];
  });
}

/// The stiffness that coarse levels divide by, from the matrix itself.
template <int D>
void set_levels(LocalFits<D> const& fits, ProjectionMatrix<D>& matrix, LazyZeroArray<ScaledCell> const& cells,
                SplineLevels<D>& levels) {
  // Measured: splines overlap, of one level and of several. Three times their own energy takes the fewest iterations.
  constexpr double overlap = 3;
  auto const probe = levels.probe();
  LazyZeroArray<double> image(probe.size());
  matrix.apply(probe, image);
  double const volume = sum_over_slots(fits.shared().has_value(), fits.own(),
                                       [&](Index i) { return cells[static_cast<std::size_t>(i)].volume; });
  levels.set_stiffness(overlap * products(fits, probe, image)[0] / (volume * SplineLevels<D>::probe_square));
}

/// The largest of `width` numbers per particle, of the particles of all ranks.
template <int D, int width = D>
double largest(LocalFits<D> const& fits, LazyZeroArray<double> const& u) {
  auto const [first, last] = fits.own();
  double most = largest_of(
      std::span(u).subspan(static_cast<std::size_t>(first) * width, static_cast<std::size_t>(last - first) * width));
  if (fits.shared()) comm::allreduce_max(most);
  return most;
}

/// Preconditioned conjugate gradients for the columns of mu, each with its own steps.
template <int D>
struct ConjugateGradients {
  LocalFits<D> const& fits;
  ProjectionMatrix<D>& matrix;
  std::optional<SplineLevels<D>>& levels;
  SymmetryReduction<D> const* fold;

  void extend(LazyZeroArray<double>& u) const {
    if (fold != nullptr) fold->extend(u);
  }
  Columns<D> inner(LazyZeroArray<double> const& u, LazyZeroArray<double> const& v) const {
    return fold != nullptr ? fold->products(u, v) : products(fits, u, v);
  }
  /// f(particle, number) for the D numbers of each particle.
  template <class F>
  void each_number(F const& f) const {
    exec_host::parallel_for(fits.own(), [&](Index particle) {
      auto const a = static_cast<std::size_t>(particle);
      for (std::size_t J = 0; J < D; ++J) f(a, a * D + J);
    });
  }

  /// r: the residual without corrections, then the one left.
  void run(LazyZeroArray<double>& r, double tolerance, IntegrationCorrection& found) const {
    LazyZeroArray<double> z(r.size()), p(r.size()), image(r.size());
    extend(r);
    found.before = largest(fits, r);
    auto const goal = inner(r, r);
    Columns<D> before{};
    for (; found.iterations < most_iterations; ++found.iterations) {
      auto const now = inner(r, r);
      bool done = true;
      for (std::size_t J = 0; J < D; ++J) done = done && now[J] <= tolerance * tolerance * goal[J];
      found.converged = done && largest(fits, r) <= most_left;
      if (found.converged) break;
      each_number([&](std::size_t a, std::size_t k) { z[k] = r[k] / matrix.diagonal()[a]; });
      if (levels) levels->add(r, z);
      if (fold != nullptr) fold->gather(z);
      auto const rz = inner(r, z);
      each_number([&](std::size_t, std::size_t k) {
        p[k] = z[k] + (before[k % D] > 0 ? rz[k % D] / before[k % D] : 0) * p[k];
      });
      before = rz;
      matrix.apply(p, image);
      extend(image);
      auto const curvature = inner(p, image);
      each_number([&](std::size_t, std::size_t k) {
        double const step = curvature[k % D] > 0 ? rz[k % D] / curvature[k % D] : 0;
        found.mu[k] += step * p[k];
        r[k] -= step * image[k];
      });
    }
  }
};

}  // namespace

template <int D>
IntegrationConstraint<D>::IntegrationConstraint(LocalFits<D> const& fits, LazyZeroArray<ScaledCell> const& cells,
                                                std::vector<SurfacePatch> const& patches)
    : fits_(fits), cells_(cells), patches_(patches) {}

template <int D>
LazyZeroArray<double> IntegrationConstraint<D>::shares(std::function<double(SurfacePatch const&)> const& weight) const {
  LazyZeroArray<double> share(fits_.X().size());
  for (auto const& patch : patches_) {
    if (!fits_.has(static_cast<std::size_t>(patch.particle))) continue;  // far from the particles of this rank
    double const counts = weight(patch);
    if (counts == 0) continue;
    each_share<D>(fits_, patch, [&](std::size_t b, double part) { share[b] += counts * part; });
  }
  return share;
}

template <int D>
LazyZeroArray<double> IntegrationConstraint<D>::surface_vectors() const {
  LazyZeroArray<double> A(fits_.X().size() * D);
  for (int axis = 0; axis < D; ++axis)
    for (bool const upper : {false, true}) {
      auto const share = shares([&](SurfacePatch const& p) { return p.axis == axis && p.upper == upper ? 1.0 : 0.0; });
      for_each_local([&](std::size_t b) { A[b * D + static_cast<std::size_t>(axis)] += upper ? share[b] : -share[b]; });
    }
  return A;
}

template <int D>
LazyZeroArray<double> IntegrationConstraint<D>::residual(IntegrationCorrection const* corrected,
                                                         LazyZeroArray<double>* size) const {
  auto R = surface_vectors();
  auto const& pairs = fits_.pairs();
  scatter_in_order(fits_.own(), fits_.rows(), pairs.farthest(), [&](std::size_t a, auto const& mine) {
    double to_gradient[D][terms];  // of sums s p (f_b - f_a)
    for (int l = 0; l < terms; ++l) {
      typename LocalFits<D>::Monomials column;
      for (int i = 0; i < terms; ++i) column[static_cast<std::size_t>(i)] = fits_.inverse(a, i, l);
      for (int J = 0; J < D; ++J) to_gradient[J][l] = cells_[a].volume * at_centroid<D>(column, cells_[a], J);
    }
    bool const own = mine(a);
    for (std::size_t k = pairs.first(a); k < pairs.end(a); ++k) {
      bool const other = mine(pairs.at(k));
      if (!own && !other) continue;
      auto const p = fits_.monomials_of(a, pairs.at(k));
      double square = 0;
      for (int J = 0; J < D; ++J) {
        double G = 0;
        for (int l = 0; l < terms; ++l) G += to_gradient[J][l] * p[static_cast<std::size_t>(l)];
        if (corrected != nullptr) G += cells_[a].volume * corrected->unexplained<D>(a, pairs.at(k), p, J);
        G *= pairs.weight[k];
        square += G * G;
        if (other) R[pairs.at(k) * D + static_cast<std::size_t>(J)] -= G;
        if (own) R[a * D + static_cast<std::size_t>(J)] += G;
      }
      if (own && size != nullptr) (*size)[a] = std::max((*size)[a], std::sqrt(square) / cells_[a].volume);
    }
  });
  return R;
}

/// Error of the corrected gradients in the divergence theorem. Collective on a distributed body.
template <int D>
void IntegrationConstraint<D>::measure(IntegrationCorrection& integration_correction, SolveContext const& whole) const {
  if (whole.halo != nullptr)
    exchange_once(*whole.halo, integration_correction.coefficients->ref(), Quadratic<D>::values * D);
  LazyZeroArray<double> size(particles());
  LazyZeroArray<double> left = residual(&integration_correction, &size);
  if (whole.fold != nullptr) {
    whole.fold->extend(left);
    std::fill(size.begin() + static_cast<std::ptrdiff_t>(whole.fold->particles()), size.end(), 0.0);
  }
  double farthest = 0;
  for (auto const& X : fits_.X())
    for (std::size_t c = 0; c < D; ++c) farthest = std::max(farthest, std::abs(X[c]));
  integration_correction.rounding =
      largest(fits_, integration_correction.mu) * farthest * std::numeric_limits<double>::epsilon();
  integration_correction.residual = largest(fits_, left);
  integration_correction.steepest = largest<D, 1>(fits_, size);
}

template <int D>
IntegrationCorrection IntegrationConstraint<D>::solve(double tolerance, Backend const& backend,
                                                      LatticeLayout const* lattice, SolveContext const& whole) const {
  auto const [fold, halo] = whole;
  ProjectionMatrix<D> matrix(fits_, cells_, backend, lattice, halo);
  LazyZeroArray<double> r = residual();
  IntegrationCorrection integration_correction{.mu = LazyZeroArray<double>(r.size()), .coefficients = {}};
  std::optional<SplineLevels<D>> levels;
  if (cells_.size() >= worth_levels) set_levels(fits_, matrix, cells_, levels.emplace(fits_.X(), fits_.shared()));
  ConjugateGradients<D> iteration{fits_, matrix, levels, fold};
  iteration.run(r, tolerance, integration_correction);
  if (fold == nullptr || !fold->endless()) remove_quadratic<D>(fits_, integration_correction.mu);
  iteration.extend(integration_correction.mu);
  if (halo != nullptr)
    exchange_once(*halo, {.data = integration_correction.mu.data(), .component_stride = 1, .particle_stride = D}, D);
  matrix.apply(integration_correction.mu, r);  // the matrix keeps the coefficients of its last product
  integration_correction.coefficients = matrix.take_coefficients();
  refine<D>(fits_, matrix, integration_correction);
  measure(integration_correction, whole);
  return integration_correction;
}

template class IntegrationConstraint<1>;
template class IntegrationConstraint<2>;
template class IntegrationConstraint<3>;

}  // namespace piola::nodal
