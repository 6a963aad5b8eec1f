// SPDX-License-Identifier: Apache-2.0
#include "formulations/nodal/nodal_bodies.hpp"
#include "support/key_words.hpp"

namespace piola::testing {
namespace {

using test::mentions;

/// A body with one deformation gradient everywhere.
Assembly uniform(int dimension, Mat<3> const& F, MaterialParameters const& m, std::string const& assumption) {
  Assembly a = nodal_body(brick(dimension, 0.3), m);
  choose(a, "assumption", assumption);
  displace(a, [&](Point const& X) {
    Point u{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(dimension); ++i)
      for (std::size_t J = 0; J < static_cast<std::size_t>(dimension); ++J)
        u[i] += (F(static_cast<int>(i), static_cast<int>(J)) - (i == J ? 1 : 0)) * X[J];
    return u;
  });
  a.cfl = 0.1;
  return a;
}

MaterialParameters of_law(LawInfo const& law, double ratio) {
  auto m = rubber(law.name, ratio);
  for (std::size_t k = 3; k < law.parameters.size(); ++k) m.value[k] = law.parameters[k].default_value;
  return m;
}

TEST(NodalPlaneStress, HasNoStressAcrossAndTheStretchOfTheLawThere) {
  Mat<3> F = identity<3>();
  F(0, 0) = 1.3;
  F(0, 1) = 0.2;
  F(1, 1) = 0.85;
  for (auto const& law : laws()) {
    if (law.hypoelastic || law.block != nullptr) continue;
    for (double const ratio : {0.0, 0.3, 0.499}) {
      auto const m = of_law(law, ratio);
      auto const f = make_formulation(uniform(2, F, m, "plane_stress"));
      std::size_t const n = brick(2).X.size();
      auto const P = sample(*f, "FirstPiolaStress", n), gradient = sample(*f, "DeformationGradient", n);
      Mat<3> full = F;
      full(2, 2) = gradient[8];
      with_law(m, [&](auto const& of) {
        Mat<3> const expected = of.first_piola(full);
        EXPECT_LT(std::fabs(expected(2, 2)), 1e-9 * of.kappa) << law.name << ratio;
        for (std::size_t c = 0; c < 9; ++c) EXPECT_NEAR(P[9 * 3 + c], expected.c[c], 1e-8 * of.kappa) << law.name;
        double const area = 0.9 * 1.2;
        EXPECT_NEAR(f->diagnose().strain_energy, area * of.energy(full), 1e-9 * area * of.kappa) << law.name;
      });
    }
  }
}

TEST(NodalPlaneStress, IsHookesLawForSmallStrains) {
  double const E = 17e6, e = 1e-7;
  Mat<3> F = identity<3>();
  F(0, 0) += e;
  for (double const ratio : {0.0, 0.3, 0.49}) {
    auto const m = rubber("neo_hookean", ratio);
    auto const plane = sample(*make_formulation(uniform(2, F, m, "plane_stress")), "CauchyStress", brick(2).X.size());
    EXPECT_NEAR(plane[0], E / (1 - ratio * ratio) * e, 1e-5 * E * e) << ratio;
    EXPECT_NEAR(plane[1], ratio * E / (1 - ratio * ratio) * e, 1e-5 * E * e) << ratio;
    auto const bar = sample(*make_formulation(uniform(1, F, m, "uniaxial_stress")), "CauchyStress", brick(1).X.size());
    EXPECT_NEAR(bar[0], E * e, 1e-5 * E * e) << ratio;
  }
}

TEST(NodalPlaneStress, IsRefusedInThreeDimensions) {
  Assembly a = nodal_body(brick(3));
  choose(a, "assumption", std::string("plane_stress"));
  EXPECT_TRUE(mentions(refusal(a), {"formulation", "plane_stress", "2D", "3D", "leave it out"}));
}

}  // namespace
}  // namespace piola::testing
