// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/points.hpp"
#include "piola/materials/elastic_constants.hpp"
#include <array>
#include <cmath>

/// Rubber whose molecular chains cannot be stretched beyond a limit: the model of eight chains in five terms,
///   W = m sum_i C_i L^(2-2i) (I^i - 3^i) + kappa/2 (J - 1)^2,   I = J^(-2/3) F:F,
/// with the limiting stretch L (Arruda, Boyce, J. Mech. Phys. Solids 41, 1993). m follows from the shear modulus at
/// rest, mu = 2 m sum_i i C_i 3^(i-1) L^(2-2i).
namespace piola::block_laws {
namespace arruda_boyce_law {
namespace {

constexpr std::array terms{1.0 / 2, 1.0 / 20, 11.0 / 1050, 19.0 / 7000, 519.0 / 673750};

constexpr std::array parameters{
    ElasticConstants::parameters[0], ElasticConstants::parameters[1], ElasticConstants::parameters[2],
    Parameter{"limiting_stretch", "1", "stretch of the chains at which they lock", Interval{1, unbounded, true, true}}};

struct EightChains {
  /// values: parameters after the density.
  EightChains(double density, double const* values)
      : elastic(std::array{density, values[0], values[1]}.data()), per_square(1 / (values[2] * values[2])) {
    modulus = 1;
    modulus = elastic.mu / (2 * slope(3));
  }
  /// Sum of the series without its constant [J/m^3].
  double series(double I) const {
    double sum = 0, power = 1, three = 1, scale = modulus;
    for (double const C : terms) {
      power *= I;
      three *= 3;
      sum += scale * C * (power - three);
      scale *= per_square;
    }
    return sum;
  }
  /// Its derivative by I [Pa].
  double slope(double I) const {
    double sum = 0, power = 1, scale = modulus;
    for (std::size_t i = 0; i < terms.size(); ++i) {
      sum += static_cast<double>(i + 1) * scale * terms[i] * power;
      power *= I;
      scale *= per_square;
    }
    return sum;
  }

  ElasticConstants elastic;
  double per_square;  ///< 1 / L^2
  double modulus;     ///< m [Pa]
};

int update(piola_points const* points) {
  piola_points const& at = *points;
  EightChains const law(at.density, at.parameters);
  for (int p = 0; p < at.count; ++p) {
    Mat<3> const F = matrix_at(at.F_new, at, p), H = cofactor(F);
    double const J = determinant(F), square = contract(F, F);
    if (!(J > 0)) return 1;
    double const shape = 1 / (std::cbrt(J) * std::cbrt(J)), I = shape * square, s = 2 * law.slope(I) * shape;
    put(s * F + (law.elastic.kappa * (J - 1) - s * square / (3 * J)) * H, at.stress, at, p);
    at.energy[p] = law.series(I) + 0.5 * law.elastic.kappa * (J - 1) * (J - 1);
  }
  return 0;
}

constexpr piola_material law = describe("arruda_boyce", PIOLA_FIRST_PIOLA, PIOLA_ELASTIC, {}, nullptr, &update);

}  // namespace
}  // namespace arruda_boyce_law

constinit LawInfo const arruda_boyce{
    .name = "arruda_boyce",
    .about = "rubber with a limit of stretch: eight chains, five terms",
    .validity = "stretches of the chains below limiting_stretch: sqrt(I/3), I = J^(-2/3) F:F",
    .parameters = arruda_boyce_law::parameters,
    .block = &arruda_boyce_law::law};

}  // namespace piola::block_laws
