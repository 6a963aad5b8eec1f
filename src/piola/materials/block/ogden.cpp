// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/points.hpp"
#include "piola/materials/elastic_constants.hpp"
#include "piola/math/symmetric_eigen.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

/// Rubber by powers of the principal stretches (Ogden, Proc. R. Soc. London A 326, 1972),
///   W = sum_i mu_i/alpha_i (l_1^alpha_i + l_2^alpha_i + l_3^alpha_i - 3) + kappa/2 (J - 1)^2,
/// with the isochoric stretches l_k = J^(-1/3) lambda_k. The shear modulus at rest is sum_i mu_i alpha_i / 2.
namespace piola::block_laws {
namespace ogden_law {
namespace {

constexpr int most_terms = 3;

constexpr std::array parameters{
    ElasticConstants::parameters[0],
    Parameter{"bulk_modulus", "Pa", "bulk modulus", positive},
    Parameter{"mu_1", "Pa", "factor mu of the first term mu/alpha (l1^alpha + l2^alpha + l3^alpha - 3)"},
    Parameter{"alpha_1", "1", "exponent alpha of the first term"},
    Parameter{"mu_2", "Pa", "factor of the second term", any_value, 0},
    Parameter{"alpha_2", "1", "exponent of the second term", any_value, 0},
    Parameter{"mu_3", "Pa", "factor of the third term", any_value, 0},
    Parameter{"alpha_3", "1", "exponent of the third term", any_value, 0}};

/// The terms that count; values: parameters after the density.
struct Terms {
  explicit Terms(double const* values) {
    for (int i = 0; i < most_terms; ++i)
      if (double const m = values[1 + 2 * i]; m != 0) {
        mu[count] = m;
        alpha[count++] = values[2 + 2 * i];
      }
  }
  int count = 0;
  double mu[most_terms]{}, alpha[most_terms]{};
};

std::string problem_of(double const* values) {
  double twice_shear = 0;
  for (int i = 0; i < most_terms; ++i) {
    double const mu = values[1 + 2 * i], alpha = values[2 + 2 * i];
    if ((mu == 0) != (alpha == 0))
      return fmt::format("mu_{0} = {1:g} Pa and alpha_{0} = {2:g}: a term needs both, other than 0", i + 1, mu, alpha);
    twice_shear += mu * alpha;
  }
  if (twice_shear > 0) return {};
  return fmt::format("the sum of mu_i alpha_i, twice the shear modulus at rest, is {:.4g} Pa, but must be above 0",
                     twice_shear);
}

int check(double const* v, char* message, int size) { return put_message(problem_of(v), message, size); }

/// Principal Kirchhoff stresses from the powers of the stretches: sum_i mu_i (l_k^alpha_i - mean), of trace 0; returns
/// the isochoric energy.
double kirchhoff(Terms const& terms, double const (&logarithm)[3], double (&tau)[3]) {
  double energy = 0;
  for (int i = 0; i < terms.count; ++i) {
    double power[3], sum = 0;
    for (int k = 0; k < 3; ++k) sum += power[k] = std::expm1(terms.alpha[i] * logarithm[k]);
    for (int k = 0; k < 3; ++k) tau[k] += terms.mu[i] * (power[k] - sum / 3);
    energy += terms.mu[i] / terms.alpha[i] * sum;
  }
  return energy;
}

/// P = F S with S = sum_k tau_k / lambda_k^2 N_k N_k from the eigenvectors N_k of C = F^T F. No difference of stretches
/// divides anything, so that any eigenvectors of repeated stretches give the right stress.
int update(piola_points const* points) {
  piola_points const& at = *points;
  Terms const terms(at.parameters);
  double const kappa = at.parameters[0];
  for (int p = 0; p < at.count; ++p) {
    Mat<3> const F = matrix_at(at.F_new, at, p);
    double const J = determinant(F);
    auto const e = symmetric_eigen(right_cauchy_green(F));
    if (!(J > 0 && *std::min_element(e.value, e.value + 3) > 0)) return 1;
    double logarithm[3], tau[3]{};
    for (int k = 0; k < 3; ++k) logarithm[k] = 0.5 * std::log(e.value[k]);
    double const mean = (logarithm[0] + logarithm[1] + logarithm[2]) / 3;
    for (double& l : logarithm) l -= mean;
    at.energy[p] = kirchhoff(terms, logarithm, tau) + 0.5 * kappa * (J - 1) * (J - 1);
    Mat<3> S;
    for (int k = 0; k < 3; ++k) S = S + (tau[k] / e.value[k]) * outer(e.vector[k], e.vector[k]);
    put(F * S + (kappa * (J - 1)) * cofactor(F), at.stress, at, p);
  }
  return 0;
}

constexpr piola_material law = describe("ogden", PIOLA_FIRST_PIOLA, PIOLA_ELASTIC, {}, &check, &update);

}  // namespace
}  // namespace ogden_law

constinit LawInfo const ogden{.name = "ogden",
                              .about = "rubber by powers of the principal stretches, up to three terms",
                              .validity = "stable at all stretches if mu_i alpha_i > 0 in each term",
                              .parameters = ogden_law::parameters,
                              .block = &ogden_law::law};

}  // namespace piola::block_laws
