// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/points.hpp"
#include "piola/materials/elastic_constants.hpp"
#include <array>
#include <cmath>
#include <fmt/format.h>

/// Rubber and polymers whose shear stress relaxes: linear viscoelasticity at finite strain (Simo, Comput. Methods Appl.
/// Mech. Eng. 60, 1987; Simo, Hughes, Computational Inelasticity, 1998, Section 10.3) on the instantaneous law
/// `neo_hookean`. With the second Piola stress S~ = mu (I - tr C/3 C^-1) of its isochoric part,
///   P = J^(-2/3) F DEV[(1 - sum g_i) S~ + sum g_i H_i] + kappa (J - 1) cof F,  H_i = int exp(-(t - s)/tau_i) dS~(s),
/// DEV[A] = A - (A : C)/3 C^-1. The history H_i stands in the reference configuration: the law is objective.
namespace piola::block_laws {
namespace viscoelastic_law {
namespace {

constexpr int most_terms = 4;

constexpr Interval part_of_one{0, 1, false, true};
constexpr std::array parameters{
    ElasticConstants::parameters[0],
    Parameter{"bulk_modulus", "Pa", "bulk modulus; the pressure is elastic", positive},
    Parameter{"shear_modulus", "Pa", "instantaneous shear modulus", positive},
    Parameter{"g_1", "1", "fraction of the shear modulus that relaxes with tau_1", part_of_one},
    Parameter{"tau_1", "s", "relaxation time of the first term", positive},
    Parameter{"g_2", "1", "fraction of the shear modulus that relaxes with tau_2", part_of_one, 0},
    Parameter{"tau_2", "s", "relaxation time of the second term", not_negative, 0},
    Parameter{"g_3", "1", "fraction of the shear modulus that relaxes with tau_3", part_of_one, 0},
    Parameter{"tau_3", "s", "relaxation time of the third term", not_negative, 0},
    Parameter{"g_4", "1", "fraction of the shear modulus that relaxes with tau_4", part_of_one, 0},
    Parameter{"tau_4", "s", "relaxation time of the fourth term", not_negative, 0}};

/// H_i / mu.
constexpr piola_history history[6 * most_terms]{
    {"H1_XX", "1", 0}, {"H1_YY", "1", 0}, {"H1_ZZ", "1", 0}, {"H1_XY", "1", 0}, {"H1_YZ", "1", 0}, {"H1_XZ", "1", 0},
    {"H2_XX", "1", 0}, {"H2_YY", "1", 0}, {"H2_ZZ", "1", 0}, {"H2_XY", "1", 0}, {"H2_YZ", "1", 0}, {"H2_XZ", "1", 0},
    {"H3_XX", "1", 0}, {"H3_YY", "1", 0}, {"H3_ZZ", "1", 0}, {"H3_XY", "1", 0}, {"H3_YZ", "1", 0}, {"H3_XZ", "1", 0},
    {"H4_XX", "1", 0}, {"H4_YY", "1", 0}, {"H4_ZZ", "1", 0}, {"H4_XY", "1", 0}, {"H4_YZ", "1", 0}, {"H4_XZ", "1", 0}};

std::string problem_of(double const* values) {
  double sum = 0;
  for (int i = 0; i < most_terms; ++i) {
    double const g = values[2 + 2 * i], tau = values[3 + 2 * i];
    sum += g;
    if (g > 0 && !(tau > 0))
      return fmt::format("g_{0} = {1:g} needs a relaxation time tau_{0} above 0 s, not {2:g} s", i + 1, g, tau);
  }
  if (sum < 1) return {};
  return fmt::format("the sum of g_i is {:g}, but must be below 1: 1 - sum is what never relaxes", sum);
}

int check(double const* v, char* message, int size) { return put_message(problem_of(v), message, size); }

SymMat<3> operator+(SymMat<3> A, SymMat<3> const& B) {
  for (int c = 0; c < 6; ++c) A.c[c] += B.c[c];
  return A;
}
SymMat<3> operator*(double s, SymMat<3> A) {
  for (double& a : A.c) a *= s;
  return A;
}

/// S~ / mu = I - tr C/3 C^-1.
SymMat<3> shape_stress(Mat<3> const& F) {
  SymMat<3> S = right_cauchy_green(cofactor(F));  // J^2 C^-1
  double const J = determinant(F);
  S = (-contract(F, F) / (3 * J * J)) * S;
  for (int i = 0; i < 3; ++i) S(i, i) += 1;
  return S;
}

/// The series over a step, for a stress S~ that changes linearly in it. values: parameters after the density.
struct Series {
  Series(double const* values, double dt) {
    for (int i = 0; i < most_terms; ++i) {
      double const tau = values[3 + 2 * i];
      g[i] = values[2 + 2 * i];
      lasting -= g[i];
      if (g[i] == 0 || !(dt > 0)) continue;
      decay[i] = std::exp(-dt / tau);
      gain[i] = -std::expm1(-dt / tau) * tau / dt;
    }
  }
  /// Advances the terms of point p and returns what DEV acts on, over mu.
  SymMat<3> advance(piola_points const& at, int p, SymMat<3> const& before, SymMat<3> const& now) const {
    SymMat<3> sum = lasting * now;
    for (int i = 0; i < most_terms; ++i) {
      if (g[i] == 0) continue;
      double* const own = at.history + 6 * i * at.stride;
      SymMat<3> const H = decay[i] * symmetric_at(own, at, p) + gain[i] * (now + -1.0 * before);
      put(H, own, at, p);
      sum = sum + g[i] * H;
    }
    return sum;
  }

  double lasting = 1;  ///< 1 - sum g_i
  double g[most_terms]{};
  double decay[most_terms]{1, 1, 1, 1};  ///< of H_i over the step
  double gain[most_terms]{1, 1, 1, 1};   ///< change of H_i over that of S~
};

int update(piola_points const* points) {
  piola_points const& at = *points;
  double const kappa = at.parameters[0], mu = at.parameters[1];
  Series const series(at.parameters, at.dt);
  for (int p = 0; p < at.count; ++p) {
    Mat<3> const F = matrix_at(at.F_new, at, p);
    double const J = determinant(F);
    if (!(J > 0)) return 1;
    Mat<3> const A = F * series.advance(at, p, shape_stress(matrix_at(at.F_old, at, p)), shape_stress(F));
    double const shape = mu / (std::cbrt(J) * std::cbrt(J));
    put(shape * A + (kappa * (J - 1) - shape * contract(A, F) / (3 * J)) * cofactor(F), at.stress, at, p);
  }
  return 0;
}

constexpr piola_material law = describe("viscoelastic", PIOLA_FIRST_PIOLA, 0, history, &check, &update);

}  // namespace
}  // namespace viscoelastic_law

constinit LawInfo const viscoelastic{
    .name = "viscoelastic",
    .about = "rubber and polymers whose shear stress relaxes: neo-Hookean with a Prony series of up to four terms",
    .validity = "nearly incompressible, J > 0",
    .parameters = viscoelastic_law::parameters,
    .block = &viscoelastic_law::law};

}  // namespace piola::block_laws
