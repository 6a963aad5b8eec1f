// SPDX-License-Identifier: Apache-2.0
#include "piola/base/parameter.hpp"
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/points.hpp"
#include "piola/materials/elastic_constants.hpp"
#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>

/// Fibre composites, wood, single crystals: linear elasticity with three planes of symmetry between the Green strain
/// E = (U^2 - I)/2 and the second Piola stress S, in material axes 1, 2, 3 that turn with the rotation R of F = R U.
/// The stress given back is U S U / det U, Cauchy's in axes that turn with R. Compliance: E11 = S11/E1 - nu12 S22/E1
/// - nu13 S33/E1, E22 = ... - nu23 S33/E2, 2 E12 = S12/G12. nu12: strain along 2 by stress along 1, over that along 1.
/// Failure (Tsai, Wu, J. Compos. Mater. 5, 1971) by the Cauchy stress in the material axes:
///   index = sum_i F_i s_i + F_ii s_i^2 + sum_{i<j} 2 f sqrt(F_ii F_jj) s_i s_j + (s12/S12)^2 + (s23/S23)^2
///           + (s13/S13)^2,   F_i = 1/X_ti - 1/X_ci,  F_ii = 1/(X_ti X_ci)
/// When the index reaches 1, all stresses of the point fall to a fraction of themselves for the rest of the run, which
/// takes energy from the point and never gives any.
namespace piola::block_laws {
namespace orthotropic_law {
namespace {

constexpr std::array<std::string_view, 2> criteria{"none", "tsai_wu"};
constexpr std::array choices{Choice{"failure", "criterion of failure", criteria}};
constexpr Condition fails{"failure", "tsai_wu"};
constexpr Interval fraction{0, 1, true, false};

consteval Parameter modulus(std::string_view name, std::string_view meaning) { return {name, "Pa", meaning, positive}; }
consteval Parameter ratio(std::string_view name, std::string_view meaning) { return {name, "1", meaning, any_value}; }
consteval Parameter component(std::string_view name, std::string_view meaning, double value) {
  return {name, "1", meaning, any_value, value};
}
consteval Parameter strength(std::string_view name, std::string_view meaning) {
  return {name, "Pa", meaning, positive, no_default, "", fails};
}

constexpr std::array parameters{
    ElasticConstants::parameters[0],
    modulus("youngs_modulus_1", "E1, along the fibres"),
    modulus("youngs_modulus_2", "E2"),
    modulus("youngs_modulus_3", "E3"),
    ratio("poissons_ratio_12", "nu12: minus the strain along 2 over that along 1 under stress along 1"),
    ratio("poissons_ratio_13", "nu13, likewise"),
    ratio("poissons_ratio_23", "nu23, likewise"),
    modulus("shear_modulus_12", "G12"),
    modulus("shear_modulus_13", "G13"),
    modulus("shear_modulus_23", "G23"),
    component("axis_1_x", "x of the vector along axis 1 at the start, of any length", 1),
    component("axis_1_y", "its y", 0),
    component("axis_1_z", "its z", 0),
    component("axis_2_x", "x of a vector in the plane of axes 1 and 2, on the side of 2", 0),
    component("axis_2_y", "its y", 1),
    component("axis_2_z", "its z", 0),
    strength("tensile_strength_1", "Xt, stress of failure in tension along 1"),
    strength("tensile_strength_2", "Yt, along 2"),
    strength("tensile_strength_3", "Zt, along 3"),
    strength("compressive_strength_1", "Xc > 0, stress of failure in compression along 1"),
    strength("compressive_strength_2", "Yc, along 2"),
    strength("compressive_strength_3", "Zc, along 3"),
    strength("shear_strength_12", "S12, stress of failure in shear"),
    strength("shear_strength_13", "S13"),
    strength("shear_strength_23", "S23"),
    Parameter{"interaction", "1", "f of F_ij = f sqrt(F_ii F_jj), i and j different", Interval{-0.5, 0.5}, -0.5, "",
              fails},
    Parameter{"residual_stiffness", "1",
              "fraction that stays of all stresses of a point once its failure index has reached 1; 1: all stay",
              fraction, 1, "", fails}};

enum Value {
  youngs_modulus = 0,
  poissons_ratio = 3,
  shear_modulus = 6,
  axis_1 = 9,
  axis_2 = 12,
  tensile = 15,
  compressive = 18,
  shear = 21,
  interaction = 24,
  residual,
  failure
};
static_assert(parameters.size() == failure + 1);
enum History { failure_index, damage };
constexpr std::array<piola_history, 2> history{{{"FailureIndex", "1", 0}, {"Damage", "1", 0}}};

/// Normal part of the compliance [1/Pa].
Mat<3> compliance(double const* v) {
  double const *E = v + youngs_modulus, *nu = v + poissons_ratio;
  Mat<3> S;
  for (int i = 0; i < 3; ++i) S(i, i) = 1 / E[i];
  S(0, 1) = S(1, 0) = -nu[0] / E[0];
  S(0, 2) = S(2, 0) = -nu[1] / E[0];
  S(1, 2) = S(2, 1) = -nu[2] / E[1];
  return S;
}

double length(Vec<3> const& a) { return std::sqrt(dot(a, a)); }
Vec<3> vector_at(double const* v) { return {{v[0], v[1], v[2]}}; }
/// The vectors along axis 3 by the parameters: zero if the first two are parallel.
Vec<3> normal_of(double const* v) { return cross(vector_at(v + axis_1), vector_at(v + axis_2)); }

/// Rows: unit vectors along the material axes.
Mat<3> axes_of(double const* v) {
  Vec<3> const first = vector_at(v + axis_1), third = normal_of(v);
  Vec<3> const a = (1 / length(first)) * first, c = (1 / length(third)) * third, b = cross(c, a);
  Mat<3> Q;
  for (int j = 0; j < 3; ++j) Q(0, j) = a[j], Q(1, j) = b[j], Q(2, j) = c[j];
  return Q;
}

class Orthotropic {
 public:
  explicit Orthotropic(double const* v) : v_(v), Q_(axes_of(v)), normal_(inverse(compliance(v))) {}

  /// Second Piola stress of a Green strain [Pa].
  Mat<3> stress(Mat<3> const& strain) const {
    Mat<3> const e = in_axes(strain);
    Mat<3> s;
    for (int i = 0; i < 3; ++i) s(i, i) = normal_(i, 0) * e(0, 0) + normal_(i, 1) * e(1, 1) + normal_(i, 2) * e(2, 2);
    s(0, 1) = s(1, 0) = 2 * v_[shear_modulus] * e(0, 1);
    s(0, 2) = s(2, 0) = 2 * v_[shear_modulus + 1] * e(0, 2);
    s(1, 2) = s(2, 1) = 2 * v_[shear_modulus + 2] * e(1, 2);
    return transpose(Q_) * s * Q_;
  }
  /// Index of Tsai and Wu of a Cauchy stress [Pa]; 0 without a criterion.
  double index(Mat<3> const& cauchy) const {
    if (!(v_[failure] > 0)) return 0;
    Mat<3> const s = in_axes(cauchy);
    double sum = 0, scaled[3];
    for (int i = 0; i < 3; ++i) {
      double const t = v_[tensile + i], c = v_[compressive + i];
      scaled[i] = s(i, i) / std::sqrt(t * c);
      sum += s(i, i) * (1 / t - 1 / c) + scaled[i] * scaled[i];
    }
    sum += 2 * v_[interaction] * (scaled[0] * scaled[1] + scaled[0] * scaled[2] + scaled[1] * scaled[2]);
    double const ratios[3]{s(0, 1) / v_[shear], s(0, 2) / v_[shear + 1], s(1, 2) / v_[shear + 2]};
    for (double const r : ratios) sum += r * r;
    return sum;
  }
  double residual_fraction() const { return v_[failure] > 0 ? v_[residual] : 1; }

 private:
  Mat<3> in_axes(Mat<3> const& tensor) const { return Q_ * tensor * transpose(Q_); }

  double const* v_;
  Mat<3> Q_, normal_;
};

/// Factor of the speed of waves, at least 1: they are faster in stretched material.
double speed_factor(Mat<3> const& squared_stretch) {
  double most = 1;  // bound of the largest eigenvalue
  for (int i = 0; i < 3; ++i)
    most = std::max(
        most, std::fabs(squared_stretch(i, 0)) + std::fabs(squared_stretch(i, 1)) + std::fabs(squared_stretch(i, 2)));
  return std::sqrt(most * (1.5 * most - 0.5));
}

int update(piola_points const* points) {
  piola_points const& at = *points;
  Orthotropic const law(at.parameters);
  for (int p = 0; p < at.count; ++p) {
    Mat<3> const U = full(symmetric_at(at.U_new, at, p)), squared = U * U;
    double const J = determinant(U);
    if (!(J > 0)) return 1;
    Mat<3> cauchy = (1 / J) * (U * law.stress(0.5 * (squared - identity<3>())) * U);
    double &most = at.history[failure_index * at.stride + p], &lost = at.history[damage * at.stride + p];
    double const index = law.index((1 - lost) * cauchy);
    most = std::max(most, index);
    if (index >= 1) lost = 1 - law.residual_fraction();
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) at.stress[SymMat<3>::at(i, j) * at.stride + p] = (1 - lost) * cauchy(i, j);
    at.sound_speed[p] *= speed_factor(squared);
  }
  return 0;
}

std::string problem_of(double const* v) {
  constexpr double parallel = 1e-9;  // sine of the angle
  double const lengths = length(vector_at(v + axis_1)) * length(vector_at(v + axis_2));
  if (!(lengths > 0)) return "axis_1 or axis_2 has no length: give vectors other than 0 0 0";
  if (length(normal_of(v)) < parallel * lengths)
    return "axis_1 and axis_2 are parallel: give vectors that span a plane";
  double const *E = v + youngs_modulus, *nu = v + poissons_ratio;
  for (int k = 0; k < 3; ++k) {
    int const i = k == 2 ? 1 : 0, j = k == 0 ? 1 : 2;
    double const most = std::sqrt(E[i] / E[j]);
    if (!(std::fabs(nu[k]) < most))
      return fmt::format(
          "the compliance is not positive definite: poissons_ratio_{0}{1} {2:.4g} is not within the "
          "square root of youngs_modulus_{0} / youngs_modulus_{1}, {3:.4g}, on both sides of 0",
          i + 1, j + 1, nu[k], most);
  }
  double const left = determinant(compliance(v)) * E[0] * E[1] * E[2];
  if (left > 0) return {};
  return fmt::format(
      "the compliance is not positive definite: 1 - nu12^2 E2/E1 - nu13^2 E3/E1 - nu23^2 E3/E2 - 2 nu12 "
      "nu23 nu13 E3/E1 is {:.4g}, and must be above 0: reduce Poisson's ratios",
      left);
}

int check(double const* v, char* message, int size) { return put_message(problem_of(v), message, size); }

constexpr piola_material law = describe("orthotropic", PIOLA_COROTATED_CAUCHY, 0, history, &check, &update);

}  // namespace
}  // namespace orthotropic_law

constinit LawInfo const orthotropic{
    .name = "orthotropic",
    .about = "fibre composite, wood or crystal: three planes of symmetry, failure index of Tsai and Wu",
    .validity =
        "large rotation, moderate strain, stretches above 0.6; in two dimensions stresses that axes out of the "
        "plane cause along its normal are carried by the constraint",
    .parameters = orthotropic_law::parameters,
    .choices = orthotropic_law::choices,
    .block = &orthotropic_law::law};

}  // namespace piola::block_laws
