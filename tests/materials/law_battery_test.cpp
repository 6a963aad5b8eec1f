// SPDX-License-Identifier: Apache-2.0
// What every registered law must do. The list of tests follows piola::Laws: a new law needs no line here.
#include "piola/base/units.hpp"
#include "piola/materials/laws.hpp"
#include "materials/law_types.hpp"
#include "math/random.hpp"
#include <algorithm>
#include <gtest/gtest.h>
#include <limits>
#include <set>

namespace piola {
namespace {

using testing::diagonal;
using testing::Random;
using testing::size;

/// A plausible value: the default, or that of a soft rubber, or the middle of what is allowed.
double sample_value(Parameter const& p) {
  if (!p.required()) return p.default_value;
  if (p.name == "density") return 1100;
  if (p.name == "youngs_modulus") return 17e6;
  if (p.name == "poissons_ratio") return 0.3;
  if (std::isfinite(p.allowed.low) && std::isfinite(p.allowed.high)) return 0.5 * (p.allowed.low + p.allowed.high);
  if (same_dimension(p.unit, "Pa")) return 1e6;
  return std::isfinite(p.allowed.low) ? p.allowed.low + 1 : 1;
}

template <class Law>
struct Sample {
  double values[MaterialParameters::max_values]{};
  Sample() {
    std::size_t k = 0;
    for (Parameter const& p : Law::parameters) values[k++] = sample_value(p);
  }
};

template <class Law>
class LawBattery : public ::testing::Test {
 protected:
  Law const law{Sample<Law>().values};
  double const stiffness = law.rho0 * law.p_wave_speed() * law.p_wave_speed();

  static bool near_identity_only() { return Law::small_strain; }
  /// Admissible deformations: of any size, or near the identity for laws of small strain.
  static Mat<3> deformation(Random& random) {
    if (near_identity_only()) return identity<3>() + random.matrix(1e-2);
    for (;;) {
      Mat<3> const F = identity<3>() + random.matrix(0.6);
      double const J = determinant(F);
      if (J > 0.3 && J < 3) return F;
    }
  }
};

TYPED_TEST_SUITE(LawBattery, TypesOf<Laws>::type, LawNames);

/// Exact in real numbers; a handful of roundings of numbers as large as the stiffness.
constexpr double round_off = 1e-14;

TYPED_TEST(LawBattery, HasNoStressWithoutDeformation) {
  EXPECT_LT(size(this->law.first_piola(identity<3>())), round_off * this->stiffness);
  EXPECT_LT(std::fabs(this->law.pressure(identity<3>())), round_off * this->stiffness);
}

TYPED_TEST(LawBattery, HasNoEnergyWithoutDeformation) {
  EXPECT_LT(std::fabs(this->law.energy(identity<3>())), round_off * this->stiffness);
}

TYPED_TEST(LawBattery, HasEnergyOfEveryDeformation) {
  Random random(1);
  for (int k = 0; k < 200; ++k) {
    Mat<3> const F = this->deformation(random);
    // Not of rotations: distance of the stretch from 1.
    double const strain = size(transpose(F) * F - identity<3>());
    if (strain < 1e-3) continue;
    EXPECT_GT(this->law.energy(F), 0);
  }
}

TYPED_TEST(LawBattery, DoesNotSeeRotationsOfTheObserver) {
  if constexpr (TypeParam::small_strain) {
    GTEST_SKIP() << "a law of small strain and small rotation";
  } else {
    Random random(2);
    for (int k = 0; k < 200; ++k) {
      Mat<3> const F = this->deformation(random), Q = random.rotation();
      double const W = this->law.energy(F);
      Mat<3> const P = this->law.first_piola(F);
      EXPECT_NEAR(this->law.energy(Q * F), W, 1e-12 * (W + this->stiffness));
      EXPECT_LT(size(this->law.first_piola(Q * F) - Q * P), 1e-12 * (size(P) + this->stiffness));
      EXPECT_NEAR(this->law.pressure(Q * F), this->law.pressure(F), 1e-12 * (size(P) + this->stiffness));
    }
  }
}

TYPED_TEST(LawBattery, IsIsotropic) {
  Random random(3);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = this->deformation(random), Q = random.rotation();
    Mat<3> const turned = Q * F * transpose(Q);
    EXPECT_NEAR(this->law.energy(turned), this->law.energy(F), 1e-12 * (this->law.energy(F) + this->stiffness));
  }
}

TYPED_TEST(LawBattery, HasTheStressThatIsTheDerivativeOfItsEnergy) {
  Random random(4);
  double const step = 1e-5;  // step^2 W''' ~ 1e-10, round-off of W / step ~ 1e-11
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = this->deformation(random), P = this->law.first_piola(F);
    Mat<3> difference;
    for (int c = 0; c < 9; ++c) {
      Mat<3> more = F, less = F;
      more.c[c] += step;
      less.c[c] -= step;
      difference.c[c] = (this->law.energy(more) - this->law.energy(less)) / (2 * step);
    }
    EXPECT_LT(size(P - difference), 1e-7 * (size(P) + this->stiffness));
  }
}

/// P = W_F + W_H x F + W_J H (eq. 12) at F, H and J that do not belong together; in small strain H is the identity.
TYPED_TEST(LawBattery, HasTheStressOfItsPartialDerivativesInFAndHAndJ) {
  Random random(7);
  double const step = 1e-5;
  auto const slope = [&](Mat<3> const& A, auto const& W) {
    Mat<3> r;
    for (int c = 0; c < 9; ++c) {
      Mat<3> more = A, less = A;
      more.c[c] += step;
      less.c[c] -= step;
      r.c[c] = (W(more) - W(less)) / (2 * step);
    }
    return r;
  };
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = this->deformation(random), H = cofactor(F) + random.matrix(0.1);
    double const J = determinant(F) * random.in(0.9, 1.1);
    Mat<3> const of_F = slope(F, [&](Mat<3> const& A) { return this->law.energy(A, H, J); });
    Mat<3> const of_H = slope(H, [&](Mat<3> const& A) { return this->law.energy(F, A, J); });
    double const of_J = (this->law.energy(F, H, J + step) - this->law.energy(F, H, J - step)) / (2 * step);
    Mat<3> const area = TypeParam::small_strain ? identity<3>() : H;
    Mat<3> const expected = of_F + tensor_cross(of_H, F) + of_J * area;
    EXPECT_LT(size(this->law.stress(F, H, J) - expected), 1e-7 * (size(expected) + this->stiffness));
  }
}

TYPED_TEST(LawBattery, HasTheSameStressAndEnergyOfFAndOfItsOwnHAndJ) {
  Random random(8);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = this->deformation(random), P = this->law.first_piola(F);
    double const J = TypeParam::small_strain ? trace(F) - 2 : determinant(F), W = this->law.energy(F);
    EXPECT_LT(size(this->law.stress(F, cofactor(F), J) - P), 1e-13 * (size(P) + this->stiffness));
    EXPECT_NEAR(this->law.energy(F, cofactor(F), J), W, 1e-13 * (W + this->stiffness));
  }
}

TYPED_TEST(LawBattery, HasASymmetricCauchyStress) {
  Random random(9);
  for (int k = 0; k < 100; ++k) {
    Mat<3> const F = this->deformation(random), P = this->law.first_piola(F);
    // In small strain P is the Cauchy stress.
    Mat<3> const tau = TypeParam::small_strain ? P : P * transpose(F);
    EXPECT_LT(size(tau - transpose(tau)), 1e-13 * (size(P) + this->stiffness));
  }
}

/// dP = lambda tr(e) I + 2 mu e at rest, with the constants computed here from Young's modulus and Poisson's ratio.
TYPED_TEST(LawBattery, IsHookesLawForSmallStrain) {
  Random random(10);
  double const E = 17e6, nu = 0.3, mu = E / (2 * (1 + nu)), lambda = nu * E / ((1 + nu) * (1 - 2 * nu)), step = 1e-5;
  for (int k = 0; k < 20; ++k) {
    Mat<3> const G = random.matrix(1), I = identity<3>();
    Mat<3> const slope = (0.5 / step) * (this->law.first_piola(I + step * G) - this->law.first_piola(I - step * G));
    Mat<3> const expected = (lambda * trace(G)) * I + mu * (G + transpose(G));
    EXPECT_LT(size(slope - expected), 1e-7 * this->stiffness);
  }
}

TYPED_TEST(LawBattery, HasTheLargestModulusOfItsEnergyInThePrincipalStretches) {
  Random random(11);
  double const step = 1e-4;  // step^2 times the fourth derivative and round-off of W / step^2: 1e-8 each
  for (int k = 0; k < 200; ++k) {
    double const most = this->near_identity_only() ? 0.01 : 0.5;
    double const l[3] = {random.in(1 - most, 1 + most), random.in(1 - most, 1 + most), random.in(1 - most, 1 + most)};
    double largest = -std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      auto const W = [&](double change) {
        return this->law.energy(
            diagonal(l[0] + (i == 0 ? change : 0), l[1] + (i == 1 ? change : 0), l[2] + (i == 2 ? change : 0)));
      };
      largest = std::max(largest, (W(step) - 2 * W(0) + W(-step)) / (step * step));
    }
    double const found = this->law.largest_modulus(l[0] * l[0], l[1] * l[1], l[2] * l[2]);
    EXPECT_NEAR(found, largest, 1e-6 * (std::fabs(largest) + this->stiffness));
  }
}

/// Acoustic tensor Q_ik = n_J n_L dP_iJ / dF_kL at rest: rho c_p^2 along n, rho c_s^2 across.
TYPED_TEST(LawBattery, HasTheWaveSpeedsOfItsStiffnessAtRest) {
  Random random(5);
  double const step = 1e-5;
  for (int trial = 0; trial < 10; ++trial) {
    Vec<3> n = random.vector(1) + Vec<3>{{0, 0, 1.5}};
    n = (1 / std::sqrt(dot(n, n))) * n;
    Mat<3> Q;
    for (int k = 0; k < 3; ++k) {
      Vec<3> e;
      e[k] = 1;
      Mat<3> const change = step * outer(e, n), I = identity<3>();
      Mat<3> const slope = (0.5 / step) * (this->law.first_piola(I + change) - this->law.first_piola(I - change));
      Vec<3> const column = slope * n;
      for (int i = 0; i < 3; ++i) Q(i, k) = column[i];
    }
    double const along = dot(n, Q * n);
    EXPECT_NEAR(along, this->stiffness, 1e-7 * this->stiffness);
    if constexpr (requires { this->law.s_wave_speed(); }) {
      double const shear = this->law.rho0 * this->law.s_wave_speed() * this->law.s_wave_speed();
      EXPECT_NEAR(0.5 * (trace(Q) - along), shear, 1e-7 * this->stiffness);
    }
  }
}

/// What the stress does on a strain rate d is what its energy grows by: dW/dt = sigma : d, for a stress that a strain
/// has made.
TYPED_TEST(LawBattery, StoresThePowerOfItsStressInRateForm) {
  if constexpr (!RateForm<TypeParam>) {
    GTEST_SKIP() << "has no rate form";
  } else {
    Random random(12);
    for (int path = 0; path < 20; ++path) {
      SymMat<3> stress{};
      double worked = 0;
      // Steps of one constant rate each: the stress is linear in time, so the trapezoidal rule is exact.
      for (int k = 0; k < 10; ++k) {
        SymMat<3> d;
        for (double& c : d.c) c = random.in(-1e-2, 1e-2);
        SymMat<3> const rate = this->law.stress_rate(d);
        for (int c = 0; c < 6; ++c) {
          worked += (c < 3 ? 1 : 2) * (stress.c[c] + 0.5 * rate.c[c]) * d.c[c];
          stress.c[c] += rate.c[c];
        }
        EXPECT_NEAR(this->law.energy_of_stress(stress), worked, 1e-12 * (worked + 1e-4 * this->stiffness));
      }
      EXPECT_GT(worked, 0);
    }
  }
}

SymMat<3> symmetric_part(Mat<3> const& A) {
  SymMat<3> r;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) r(i, j) = 0.5 * (A(i, j) + A(j, i));
  return r;
}
Mat<3> full(SymMat<3> const& s) {
  Mat<3> r;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) r(i, j) = s(i, j);
  return r;
}

TYPED_TEST(LawBattery, IsIsotropicInRateForm) {
  if constexpr (!RateForm<TypeParam>) {
    GTEST_SKIP() << "has no rate form";
  } else {
    Random random(13);
    for (int k = 0; k < 100; ++k) {
      SymMat<3> const d = symmetric_part(random.matrix(1));
      Mat<3> const Q = random.rotation(), rate = full(this->law.stress_rate(d));
      Mat<3> const turned = full(this->law.stress_rate(symmetric_part(Q * full(d) * transpose(Q))));
      EXPECT_LT(size(turned - Q * rate * transpose(Q)), 1e-14 * 10 * this->stiffness);
      double const energy = this->law.energy_of_stress(symmetric_part(rate));
      EXPECT_NEAR(this->law.energy_of_stress(symmetric_part(turned)), energy, 1e-13 * energy);
    }
  }
}

/// Rates are those of the stress near rest: what the law says of a small strain, over the time that it takes.
TYPED_TEST(LawBattery, HasTheRateOfItsStressAtRest) {
  if constexpr (!RateForm<TypeParam>) {
    GTEST_SKIP() << "has no rate form";
  } else {
    Random random(14);
    double const step = 1e-5;
    for (int k = 0; k < 20; ++k) {
      Mat<3> const G = random.matrix(1), I = identity<3>();
      Mat<3> const slope = (0.5 / step) * (this->law.first_piola(I + step * G) - this->law.first_piola(I - step * G));
      EXPECT_LT(size(full(this->law.stress_rate(symmetric_part(G))) - slope), 1e-9 * this->stiffness);
    }
  }
}

TYPED_TEST(LawBattery, GivesNumbersForAnyVolumeRatio) {
  Random random(6);
  for (double J : {1e-6, 1e-3, 0.1, 0.3, 0.7, 1.0, 1.5, 3.0, 10.0, 1e3, 1e6}) {
    double const l = std::cbrt(J);
    Mat<3> const F = random.rotation() * diagonal(l * 1.2, l / 1.2, l);
    Mat<3> const P = this->law.first_piola(F);
    for (double const c : P.c) EXPECT_TRUE(std::isfinite(c)) << "J = " << J;
    EXPECT_TRUE(std::isfinite(this->law.energy(F))) << "J = " << J;
    EXPECT_TRUE(std::isfinite(this->law.pressure(F))) << "J = " << J;
  }
}

TYPED_TEST(LawBattery, CountsPressurePositiveInTension) {
  EXPECT_GT(this->law.pressure(diagonal(1.01, 1.01, 1.01)), 0);
  EXPECT_LT(this->law.pressure(diagonal(0.99, 0.99, 0.99)), 0);
  // Under equal stretch there is no shear: P = p l^2 I, to first order in the strain for laws of small strain.
  double const l = 1.001, p = this->law.pressure(diagonal(l, l, l));
  EXPECT_NEAR(this->law.first_piola(diagonal(l, l, l))(0, 0), p, 3 * (l - 1) * std::fabs(p));
}

TYPED_TEST(LawBattery, TakesItsDensityFromItsParameters) {
  auto const& parameters = TypeParam::parameters;
  auto const at = std::find_if(parameters.begin(), parameters.end(), [](auto const& p) { return p.name == "density"; });
  ASSERT_NE(at, parameters.end());
  Sample<TypeParam> sample;
  sample.values[at - parameters.begin()] = 4321;
  EXPECT_EQ(TypeParam(sample.values).rho0, 4321);
}

TYPED_TEST(LawBattery, DeclaresParametersThatCanBeReadAndChecked) {
  std::set<std::string_view> names;
  EXPECT_LE(TypeParam::parameters.size(), static_cast<std::size_t>(MaterialParameters::max_values));
  for (Parameter const& p : TypeParam::parameters) {
    EXPECT_TRUE(names.insert(p.name).second) << p.name << " is declared twice";
    EXPECT_TRUE(same_dimension(p.unit, p.unit)) << p.name << ": unit " << p.unit << " is not known";
    EXPECT_FALSE(p.meaning.empty()) << p.name;
    EXPECT_LT(p.allowed.low, p.allowed.high) << p.name;
    EXPECT_TRUE(p.allowed.contains(sample_value(p))) << p.name;
    if (!p.required()) {
      EXPECT_TRUE(p.allowed.contains(p.default_value)) << p.name;
    }
  }
}

}  // namespace
}  // namespace piola
