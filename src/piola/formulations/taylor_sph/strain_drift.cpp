// SPDX-License-Identifier: Apache-2.0
// Strain drift: consistency of positions and stress of a moving body.
#include "piola/formulations/taylor_sph/observe.hpp"
#include "piola/materials/laws.hpp"
#include "piola/math/solve.hpp"
#include <algorithm>
#include <cmath>

namespace piola::taylor_sph {
namespace {

/// The edges that span a cell, one per column: from the first corner of a simplex, between the middles of opposite
/// faces of a box. Columns that do not exist are those of the identity.
Mat<3> span_of(std::span<Index const> corners, Points const& x, int D) {
  Mat<3> edges = identity<3>();
  bool const simplex = static_cast<int>(corners.size()) == D + 1;
  auto const corner = [&](std::size_t k) { return x[static_cast<std::size_t>(corners[k])]; };
  for (int a = 0; a < D; ++a)
    for (int c = 0; c < D; ++c) {
      auto const component = static_cast<std::size_t>(c);
      edges(c, a) = simplex ? corner(static_cast<std::size_t>(a) + 1)[component] - corner(0)[component] : 0;
      for (std::size_t k = 0; !simplex && k < corners.size(); ++k) {
        double const share = 2 / static_cast<double>(corners.size());
        edges(c, a) += (k >> a & 1) != 0 ? share * corner(k)[component] : -share * corner(k)[component];
      }
    }
  return edges;
}

double size(Mat<3> const& m, int D) {
  double sum = 0;
  for (int i = 0; i < D; ++i)
    for (int j = 0; j < D; ++j) sum += m(i, j) * m(i, j);
  return std::sqrt(sum);
}

}  // namespace

/// Per particle, the largest of its cells: |(F F^T - 1)/2 - e| - |e|^2 with the deformation gradient F of the corners
/// and the elastic strain e of their mean stress, D^-1:s. Both are equal except for second-order terms.
std::vector<double> strain_drift(TaylorBody const& body) {
  Particles const& particles = body.particles();
  Cells const& cells = body.mesh().cells();
  int const D = particles.dimension();
  std::vector<double> out(particles.X().size(), 0);
  if (!body.state().k.moving) return out;
  double lambda = 0, mu = 1;
  with_law(body.state().material, [&](auto const& law) {
    if constexpr (RateForm<std::decay_t<decltype(law)>>) {
      lambda = law.lambda;
      mu = law.mu;
    }
  });
  Points const now = particles.positions();
  for (Index cell = 0; cell < cells.count(); ++cell) {
    auto const corners = cells.of(cell);
    Mat<3> const F = span_of(corners, now, D) * inverse(span_of(corners, particles.start(), D));
    Mat<3> s{};
    for (Index const corner : corners)
      s = s + (1.0 / static_cast<double>(corners.size())) * (identity<3>() * particles.stress(corner));
    double const spherical = lambda / (2 * mu + 3 * lambda) * trace(s);
    Mat<3> const elastic = (0.5 / mu) * (s - spherical * identity<3>());
    Mat<3> const shown = 0.5 * (F * transpose(F) - identity<3>());
    double const e = size(elastic, D), value = size(shown - elastic, D) - e * e;
    for (Index const corner : corners) {
      double& largest = out[static_cast<std::size_t>(corner)];
      largest = std::max(largest, value);
    }
  }
  return out;
}

}  // namespace piola::taylor_sph
