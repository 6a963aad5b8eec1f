// SPDX-License-Identifier: Apache-2.0
#include "formulations/small_bodies.hpp"

/// The forms of gradient and internal force of Lee et al., Remarks 3 and 4.
namespace piola::testing {
namespace {

Assembly body(std::string const& gradient, double jitter) {
  Assembly a = tumbling_box(3, 6, jitter);
  choose(a, "scheme", "paper");
  choose(a, "gradient", gradient);
  return a;
}

/// Corrected forms differentiate linear fields exactly (Remark 3); the raw gradient does not near a boundary.
TEST(GradientForms, AreExactForLinearFieldsIfCorrected) {
  auto const error = [](std::string const& gradient) {
    Assembly a = body(gradient, 0.2);
    displace(a, [](Point const& X) { return Point{0.1 * X[1], 0.2 * X[2] - 0.05 * X[0], 0.03 * X[0]}; });
    auto const f = make_formulation(a);
    Values const F = sample(*f, "DeformationGradient", a.particles.X.size());
    double const exact[9] = {1, 0.1, 0, -0.05, 1, 0.2, 0.03, 0, 1};
    double most = 0;
    for (std::size_t k = 0; k < F.size(); ++k) most = std::max(most, std::fabs(F[k] - exact[k % 9]));
    return most;
  };
  EXPECT_LT(error("corrected"), 1e-12);
  EXPECT_LT(error("corrected_kernel"), 1e-12);
  EXPECT_GT(error("uncorrected"), 0.1);
}

/// Each internal force does the work that its gradient sees, so that without stabilisation energy is kept to the error
/// of the time integration, which falls with dt^2; and a force of another gradient does not.
TEST(GradientForms, BalancePowerWithTheirInternalForce) {
  auto const drift = [](std::string const& gradient, std::string const& force, int steps) {
    Assembly a = body(gradient, 0.2);
    choose(a, "internal_force", force);
    choose(a, "eps4_momentum", 0);
    choose(a, "angular_momentum_projection", "off");
    auto const f = make_formulation(a);
    double const before = f->diagnose().total_energy();
    advance(*f, 2e-3 / steps, steps);
    return std::fabs(f->diagnose().total_energy() / before - 1);
  };
  for (auto const* form : {"corrected", "uncorrected", "corrected_kernel"}) {
    double const coarse = drift(form, "as_gradient", 200), fine = drift(form, "as_gradient", 400);
    EXPECT_LT(fine, 1e-5) << form;
    EXPECT_GT(coarse / fine, 3) << form;
  }
  EXPECT_GT(drift("corrected", "uncorrected", 400), 1e-4);
  EXPECT_GT(drift("corrected", "corrected_kernel", 400), 1e-4);
}

}  // namespace
}  // namespace piola::testing
