// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"

namespace piola {
namespace {

using namespace testing;

/// The free spinning cube of Section 8.3 of the paper: 6^3 particles, 105 rad/s about z, here also drifting.
Assembly spinning_cube(std::string const& scheme, std::string const& projection) {
  Assembly a = assemble(unit_box(3, 6));
  choose(a, "scheme", scheme);
  choose(a, "angular_momentum_projection", projection);
  give_velocity(a, [](Point const& X) { return Point{-105 * (X[1] - 0.5) + 2, 105 * (X[0] - 0.5) - 1, 3}; });
  return a;
}

struct Drift {
  double linear = 0, angular = 0;  ///< largest change of a component, relative to the largest component
};

Drift drift(Formulation& f, int steps) {
  Diagnostics const before = f.diagnose();
  for (int k = 0; k < steps; ++k) f.step(0, f.stable_time_step());
  EXPECT_FALSE(f.failure().has_value());
  Diagnostics const after = f.diagnose();
  auto const change = [](Point const& a, Point const& b) {
    double most = 0, size = 0;
    for (std::size_t c = 0; c < 3; ++c) {
      most = std::max(most, std::fabs(a[c] - b[c]));
      size = std::max(size, std::fabs(a[c]));
    }
    return most / size;
  };
  return {change(before.linear_momentum, after.linear_momentum),
          change(before.angular_momentum, after.angular_momentum)};
}

class Conservation : public ::testing::TestWithParam<std::string> {};

TEST_P(Conservation, OfBothMomentaHoldsToRoundOffForAFreeSpinningCube) {
  auto const f = make_formulation(spinning_cube(GetParam(), "on"));
  Drift const d = drift(*f, 200);
  EXPECT_LT(d.linear, 1e-12);  // 400 stages of sums over 216 particles, each 1e-16
  EXPECT_LT(d.angular, 1e-12);
}

TEST_P(Conservation, OfAngularMomentumFailsWithoutItsProjection) {
  auto const f = make_formulation(spinning_cube(GetParam(), "off"));
  EXPECT_GT(drift(*f, 200).angular, 1e-4);
}

INSTANTIATE_TEST_SUITE_P(Schemes, Conservation, ::testing::Values("filtered", "paper"));

TEST(Conservation, HoldsInOneAndTwoDimensionsAndOnIrregularParticles) {
  for (int dimension = 1; dimension <= 3; ++dimension)
    for (double const jitter : {0.0, 0.2}) {
      auto const f = make_formulation(tumbling_box(dimension, 6, jitter));
      Drift const d = drift(*f, 50);
      EXPECT_LT(d.linear, 1e-12) << dimension << "D, jitter " << jitter;
      if (dimension > 1) {
        EXPECT_LT(d.angular, 1e-12) << dimension << "D, jitter " << jitter;
      }
    }
}

/// The internal force is the adjoint of the gradient: it sums to zero before any projection, and so does the adjoint
/// biharmonic; the literal one does not.
TEST(Conservation, OfLinearMomentumNeedsNoProjectionForTheAdjointForm) {
  for (double const jitter : {0.0, 0.2}) {
    Assembly a = tumbling_box(3, 6, jitter);
    choose(a, "angular_momentum_projection", "off");
    choose(a, "scheme", "filtered");
    EXPECT_LT(drift(*make_formulation(a), 50).linear, 1e-12);
    choose(a, "scheme", "paper");
    if (jitter > 0) {
      EXPECT_GT(drift(*make_formulation(a), 50).linear, 1e-8);
    }
  }
}

/// Without stabilisation and projection, F stays the gradient of x, and the exact time-continuous scheme conserves
/// angular momentum: what drifts is the error of the time steps, of second order.
TEST(Conservation, OfAngularMomentumOfDisplacementVariablesIsOfTheOrderOfTheTimeStep) {
  Assembly a = tumbling_box(3, 5);
  choose(a, "variables", "displacement");
  double drifts[2];
  for (int k = 0; k < 2; ++k) {
    auto const f = make_formulation(a);
    Point const before = f->diagnose().angular_momentum;
    advance(*f, 2e-4 / (k + 1), 20 * (k + 1));
    Point const after = f->diagnose().angular_momentum;
    drifts[k] = std::fabs(after[2] - before[2]) / std::fabs(before[2]);
  }
  EXPECT_GT(drifts[0] / drifts[1], 3.5);  // at least second order
  EXPECT_LT(drifts[0], 1e-3);
}

}  // namespace
}  // namespace piola
