// SPDX-License-Identifier: Apache-2.0
#include "piola/formulations/nodal/smoothing.hpp"
#include "formulations/nodal/nodal_bodies.hpp"

namespace piola::testing {
namespace {

TEST(NodalSmoothing, KeepsConstantsAndIntegralsAndTakesAwayCheckerboards) {
  for (int D = 1; D <= 3; ++D)
    for (double const jitter : {0.0, 0.4}) {
      SetUpBody const body(nodal_body(brick(D, jitter, {9, 8, 7})));
      nodal::Smoothing const smoothing(body.reference, D, {0, body.order.particles});
      auto const smooth = [&](Values const& f) {
        auto const smoothed = smoothing({f.begin(), f.end()});
        return Values(smoothed.begin(), smoothed.end());
      };
      auto const n = static_cast<std::size_t>(body.order.particles);
      Values const ones(n, 3);
      EXPECT_LT(largest_difference(smooth(ones), ones), 1e-13);
      Values board(n), wave(n);
      double before = 0, after = 0;
      for (std::size_t i = 0; i < n; ++i) {
        auto const& at = body.set.lattice_index[static_cast<std::size_t>(body.order.id[i])];
        board[i] = (at[0] + at[1] + at[2]) % 2 == 0 ? 1 : -1;
        wave[i] = std::sin(body.X(static_cast<Index>(i))[0]);
      }
      auto const smooth_board = smooth(board), smooth_wave = smooth(wave);
      for (std::size_t i = 0; i < n; ++i) {
        before += body.reference.V[i] * wave[i];
        after += body.reference.V[i] * smooth_wave[i];
      }
      EXPECT_NEAR(after, before, 1e-12 * std::fabs(before)) << D << jitter;
      EXPECT_LT(largest(smooth_board), 0.7) << D << jitter;
      EXPECT_LT(largest_difference(smooth_wave, wave), 0.1) << D << jitter;
    }
}

TEST(NodalSmoothing, IsInThePressureAndNotInThatOfCells) {
  Assembly a = nodal_body(brick(3, 0.2));
  displace(a, [](Point const& X) { return Point{0.2 * X[0] * X[0], 0.1 * X[0] * X[2], 0}; });
  auto const f = make_formulation(a);
  std::size_t const n = a.particles.X.size();
  auto const pressure = sample(*f, "Pressure", n), of_cells = sample(*f, "CellPressure", n),
             J = sample(*f, "Jacobian", n);
  double const kappa = NeoHookean(rubber().value).kappa;
  for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(of_cells[i], kappa * (J[i] - 1), 1e-9 * kappa);
  EXPECT_GT(largest_difference(pressure, of_cells), 0.001 * kappa);
  auto const d = f->diagnose();
  EXPECT_LT(d.pressure_oscillation, d.more[2].second);
}

}  // namespace
}  // namespace piola::testing
