// SPDX-License-Identifier: Apache-2.0
#include "piola/materials/block/own_laws.hpp"
#include "piola/materials/block/rate_form.hpp"
#include "piola/materials/eos/mie_grueneisen.hpp"
#include "piola/math/root.hpp"
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

/// Porous metal or rock whose pores are crushed (Herrmann, J. Appl. Phys. 40, 1969; with the factor 1/alpha of Carroll,
/// Holt, J. Appl. Phys. 43, 1972). Distension alpha: density of the solid between the pores over that of the porous
/// material. p is positive in compression:
///   p = P(alpha rho, e) / alpha,  P Mie-Grueneisen's of the solid
///   elastic   alpha = 1 + (a - 1) (1 - b p),  a: distension without pressure, b from alpha_e at p_e
///   crushing  alpha <= 1 + (alpha_e - 1) ((p_s - p)/(p_s - p_e))^n for p_e < p < p_s, 1 above
/// The pressure solves these with the energy of the end of the step, e += work/rho0 by the trapezoidal rule: one step
/// from rest without shear is a shock's jump. Elastic, perfectly plastic shear with constant G and Y.
namespace piola::block_laws {
namespace p_alpha_law {
namespace {

constexpr std::array parameters{
    Parameter{"density", "kg/m^3", "mass density with pores, in the reference configuration", positive},
    Parameter{"distension", "1", "alpha0, density of the solid without pores over density", Interval{1, unbounded}},
    Parameter{"bulk_sound_speed", "m/s", "c0 of the solid without pores", positive},
    Parameter{"grueneisen_gamma", "1", "Grueneisen's gamma0 of the solid", not_negative, 0},
    Parameter{"hugoniot_s1", "1", "slope of shock speed over particle speed of the solid", not_negative, 0},
    Parameter{"elastic_pressure", "Pa", "p_e, pressure at which crushing starts", positive},
    Parameter{"compaction_pressure", "Pa", "p_s, pressure at which no pores are left, above p_e", positive},
    Parameter{"compaction_exponent", "1", "n of the crush curve, at least 1", Interval{1, unbounded}, 2},
    Parameter{"elastic_distension", "1", "alpha_e, distension at p_e, from 1 to alpha0", not_negative, 0, "distension"},
    Parameter{"shear_modulus", "Pa", "G of the porous material", positive},
    Parameter{"yield_stress", "Pa", "Y of the porous material, von Mises", not_negative},
    Parameter{"spall_pressure", "Pa", "largest tension; the pressure goes no lower, nothing opens", not_negative,
              unbounded, "no limit"}};

enum Value {
  distension,
  sound_speed,
  gamma0,
  s1,
  elastic_limit,
  compacted,
  exponent,
  elastic_distension,
  shear,
  yield,
  spall
};
static_assert(parameters.size() == spall + 2);
enum History { plastic_strain, alpha_now, alpha_unloaded };
constexpr std::array<piola_history, 3> history{
    {{"EquivalentPlasticStrain", "1", 0}, {"Distension", "1", 1}, {"UnloadedDistension", "1", 1}}};

double distension_at_limit(double const* v) {
  return v[elastic_distension] > 0 ? v[elastic_distension] : v[distension];
}

class PAlpha {
 public:
  PAlpha(double density, double const* v)
      : v_(v),
        solid_density_(v[distension] * density),
        limit_(distension_at_limit(v)),
        softness_(v[distension] > 1 ? (v[distension] - limit_) / ((v[distension] - 1) * v[elastic_limit]) : 0),
        solid_(solid_density_, 0, std::array{v[sound_speed], v[gamma0], 0.0, v[s1], 0.0, 0.0}.data()) {}

  double elastic_alpha(double p, double a) const { return 1 + (a - 1) * std::max(1 - softness_ * p, 0.0); }
  double crushed_alpha(double p) const {
    double const left = (v_[compacted] - p) / (v_[compacted] - v_[elastic_limit]);
    return left > 0 ? 1 + (limit_ - 1) * std::pow(left, v_[exponent]) : 1;
  }
  double alpha(double p, double a, bool crushes) const {
    double const elastic = elastic_alpha(p, a);
    return crushes && p > v_[elastic_limit] ? std::min(elastic, crushed_alpha(p)) : elastic;
  }
  /// Distension without pressure of a point that has `alpha` at p.
  double unloaded(double p, double alpha) const { return alpha > 1 ? 1 + (alpha - 1) / (1 - softness_ * p) : 1; }

  /// A point at the end of a step but for its pressure p: specific energy e0 - p de [J/kg], J.
  struct Given {
    double J, e0, de, a;
    bool crushes;
  };
  /// Pressure [Pa], found from `guess`. The right-hand side falls with p at least nearly as fast as p rises.
  double pressure(Given const& g, double guess) const {
    auto const miss = [&](double p) {
      double const now = std::max(alpha(p, g.a, g.crushes), least_alpha);
      return solid_.pressure(now * solid_density_ / (v_[distension] * g.J), g.e0 - p * g.de) / now - p;
    };
    double const first = miss(guess), small = 1e-14 * solid_.bulk_modulus();
    if (std::fabs(first) <= small) return guess;
    double step = 2 * first, other = miss(guess + step);
    for (int k = 0; k < most_doublings && other * first > 0; ++k) other = miss(guess + (step *= 2));
    return first > 0 ? falling_root(miss, guess, first, guess + step, other, small)
                     : falling_root(miss, guess + step, other, guess, first, small);
  }
  /// Modulus of elastic compression, -V dp/dV [Pa].
  double bulk_modulus(double J, double e, double alpha, double a) const {
    double const density = alpha * solid_density_ / (v_[distension] * J);
    double const solid = std::max(density * solid_.sound_speed_squared(density, e), 0.1 * solid_.bulk_modulus());
    return solid / (alpha + solid * softness_ * (a - 1) / alpha);
  }

 private:
  static constexpr double least_alpha = 1e-3;  // trial values in search of a pressure, never a result
  static constexpr int most_doublings = 60;

  double const* v_;
  double solid_density_;  ///< at rest [kg/m^3]
  double limit_;          ///< alpha_e
  double softness_;       ///< b [1/Pa]
  MieGrueneisen solid_;
};

/// Energy that the step brings, but for the work of its last pressure p: work - p volume [J/m^3].
struct StepWork {
  double work, volume;
};
StepWork work_of(piola_points const& at, int p, SplitStress const& trial, double mises) {
  Mat<3> const before = full(symmetric_at(at.U_old, at, p)), after = full(symmetric_at(at.U_new, at, p));
  Mat<3> const change = after - before, area = cofactor(after);
  double const factor = trial.mises > 0 ? mises / trial.mises : 1;
  return {0.5 * contract(full(symmetric_at(at.stress, at, p)) * cofactor(before), change) +
              0.5 * factor * contract(full(trial.deviator) * area, change),
          0.5 * contract(area, change)};
}

int update(piola_points const* points) {
  piola_points const& at = *points;
  double const* const v = at.parameters;
  PAlpha const law(at.density, v);
  for (int p = 0; p < at.count; ++p) {
    SplitStress const trial = elastic_trial(at, p, v[shear], 0);
    bool const advances = at.dt > 0;  // else elastic, as moduli at rest come from it
    double const mises = advances ? std::min(trial.mises, v[yield]) : trial.mises;
    auto const value = [&](int h) -> double& { return at.history[h * at.stride + p]; };
    StepWork const step = work_of(at, p, trial, mises);
    double const J = determinant(matrix_at(at.F_new, at, p));
    if (!(J > 0)) return 1;
    PAlpha::Given const given{J, (at.energy[p] + step.work) / at.density, step.volume / at.density,
                              value(alpha_unloaded), advances};
    double const found = law.pressure(given, trial.pressure), pressure = std::max(found, -v[spall]);
    double const alpha = law.alpha(pressure, given.a, advances);
    put_returned(trial, mises, pressure, at, p);
    if (advances && (pressure >= v[compacted] || alpha < law.elastic_alpha(pressure, given.a)))
      value(alpha_unloaded) = law.unloaded(pressure, alpha);
    value(alpha_now) = alpha;
    value(plastic_strain) += (trial.mises - mises) / (3 * v[shear]);
    double const e = given.e0 - pressure * given.de;
    put_sound_speed(law.bulk_modulus(J, e, alpha, value(alpha_unloaded)) + 4.0 / 3 * v[shear], at, p);
  }
  return 0;
}

void start(double const* v, double* values) { values[alpha_now] = values[alpha_unloaded] = v[distension]; }

std::string problem_of(double const* v) {
  if (v[compacted] <= v[elastic_limit])
    return fmt::format("compaction_pressure {:.4g} Pa must be above elastic_pressure, {:.4g} Pa", v[compacted],
                       v[elastic_limit]);
  double const limit = distension_at_limit(v);
  if (limit < 1 || limit > v[distension])
    return fmt::format("elastic_distension {:.4g} is not between 1 and distension, {:.4g}", limit, v[distension]);
  double const least = v[distension] - (v[distension] - 1) * v[elastic_limit] / v[compacted];
  if (limit > least || v[distension] == 1) return {};
  return fmt::format(
      "pores close by elasticity before compaction_pressure: elastic_distension {:.6g} must be above "
      "{:.6g}, which is distension - (distension - 1) elastic_pressure / compaction_pressure",
      limit, least);
}

int check(double const* v, char* message, int size) { return put_message(problem_of(v), message, size); }

constexpr piola_material law =
    describe("p_alpha", PIOLA_COROTATED_CAUCHY, PIOLA_YIELDS, history, &check, &update, &start);

}  // namespace
}  // namespace p_alpha_law

constinit LawInfo const p_alpha{
    .name = "p_alpha",
    .about = "porous metal or rock: pores are crushed by pressure, Mie-Grueneisen solid, constant yield stress",
    .validity =
        "pores that collapse at once: shocks thicker than the pores; strength does not grow with compaction; shocks "
        "that leave "
        "pores overshoot and crush too many",
    .parameters = p_alpha_law::parameters,
    .block = &p_alpha_law::law};

}  // namespace piola::block_laws
